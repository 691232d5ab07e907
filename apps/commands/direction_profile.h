// The part of `vegard profile` that measures against elevation in sectors of azimuth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/command.h"

#include "apps/options/direction_maps.h"
#include "fit/photo/photo.h"
#include "fit/photo/region.h"
#include "fit/report/plot/plot.h"

namespace vegard::apps {

/// Options of the sectors; empty if not given.
struct SectorOptions {
  std::vector<double> azimuths_deg;
  std::optional<int> directions;
  std::optional<double> width_deg, step_deg, lowest_deg;
  std::vector<double> dark;
  std::optional<double> tangent_step_km;
  std::vector<double> tangent_range_km;

  bool asked() const { return !azimuths_deg.empty() || directions; }
};

/// Adds --azimuths, --directions and what belongs to them; `options` must outlive the parsing.
void add_sector_options(const Command& command, SectorOptions& options);

/// Throws Error(usage) if options for sectors are given without --azimuths or --directions, or contradict
/// each other.
void check_sector_options(const SectorOptions& options);

struct MeasuredDirections {
  std::string csv;
  fit::Plot plot;
  std::string words;                 ///< "8 directions of 90 steps"
  std::vector<std::string> details;  ///< lines to print: the limb's layers
};

/// Measures the profiles. `observer_km` is the height of an observer above the air. Throws Error(usage).
MeasuredDirections measure_directions(const SectorOptions& options, const fit::Photo& photo,
                                      const fit::Region& region, const KnownDirections& known,
                                      std::optional<double> observer_km);

}  // namespace vegard::apps
