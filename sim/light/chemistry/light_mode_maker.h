// Makes the modes of the uncertainty of emission tables (sim/light/tables/light_modes.h): of draws of the
// numbers of physics the tables' light is computed, and its changes are taken apart into principal
// components.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/light/chemistry/table_maker.h"

namespace vegard::sim {

/// Fineness of the draws over that of the tables: changes need less than the light itself, in half of the
/// time.
inline constexpr double kModeRefinement = 0.8;

struct ModeRequest {
  int draws = 200;
  std::uint64_t seed = 1;
  double carried_share = 0.98;  ///< of the variance, by the modes together
};

/// What the modes are of, for a report.
struct ModeSummary {
  int modes = 0;
  double carried_share = 0.0;  ///< of the variance, by these modes
};

/// Returns the text of modes.csv. `request`: as for make_tables(); its first and last energies, and every
/// second one between, are those of the modes. The weight of a change at an altitude is the share of the
/// light that comes from there; lines weigh as mode_weight() says, energies alike. `progress` as in
/// make_tables(). The bytes do not depend on the number of threads.
std::string make_light_modes(const TableRequest& request, const ModeRequest& modes, int threads,
                             ModeSummary& summary,
                             const std::function<void(std::size_t done, std::size_t all)>& progress = {});

/// Returns the weight of a column ("ver_5577") in the choice of modes, ours: most of 427.8 nm, which is the
/// best known and gives the energy flux; 1 of the other two that photometers measure; little of the others.
double mode_weight(const std::string& column);

}  // namespace vegard::sim
