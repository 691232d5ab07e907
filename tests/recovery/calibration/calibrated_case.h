// One truth drawn from the prior of a fit, its photograph, the fit's chain, and where the truth stands in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::calibration {

enum class Photographs {
  as_assumed,  ///< profiles of the expected picture with independent normal noise of the sigma that the
               ///< likelihood has: what the chain takes for granted is so, and ranks must be flat
  of_draws     ///< a draw of beams, photons, eight bits, JPEG; a whole fit, with its own noise and inflation
};

/// The scene that is fitted: a sheet of which five numbers are free between limits, without priors.
sim::Scene calibration_scene();

/// The paths of what is free.
std::vector<std::string> free_numbers_of_calibration();

struct Ranks {
  std::vector<std::size_t> rank;  ///< of each free number, see rank_statistic.h; empty: there was no chain
  double fewest_effective = 0.0;
  double inflation = 1.0;
};

/// Truths are drawn as the chain has its prior: alike likely between the limits, in the logarithm for a
/// logarithmic number. A pure function of set, number and steps.
Ranks ranks_of_case(std::uint64_t set, int number, Photographs photographs, int steps);

}  // namespace vegard::calibration
