// Bins by direction in the sky: sectors of azimuth in steps of elevation.
#pragma once

#include <optional>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/region.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// Steps of tangent altitude (sim/view/camera/camera.h) instead of elevation: `step_km` each, from
/// the lowest to the highest, which is at most the observer's height.
struct TangentSteps {
  double lowest_km = 0.0;
  double highest_km = 250.0;
  double step_km = 5.0;
};

/// Sectors of azimuth, `width_deg` wide and centred on each of `azimuths_deg` (in any turn), divided into
/// steps of elevation, `step_deg` each from `lowest_deg` up to 90.
struct DirectionSectors {
  std::vector<double> azimuths_deg;
  double width_deg = 10.0;
  double lowest_deg = 0.0;
  double step_deg = 1.0;
  /// Height of an observer above the air: lines of sight below the horizontal then have tangent altitudes.
  std::optional<double> observer_km{};
  /// Needs observer_km; lowest_deg and step_deg then have no effect.
  std::optional<TangentSteps> tangent{};
};

/// Returns `count` adjacent sectors that cover all azimuths, the first centred on north.
DirectionSectors even_sectors(int count);

/// Returns the smallest angle between two of the azimuths; 360 if there is only one.
double min_spacing_deg(const std::vector<double>& azimuths_deg);

/// Returns the bins of the sectors: groups are the sectors in their order, positions the steps of elevation
/// from the lowest up. A pixel belongs to a bin by its centre. Throws sim::Error(usage), with the option's
/// key, unless 0 < step <= 90, -90 <= lowest < 90 and the sectors do not overlap; with tangent steps unless 0
/// < step and lowest < highest <= observer; and if no pixel of the region is in any bin.
BinGrid direction_bins(const sim::DirectionMap& map, const Region& region, const DirectionSectors& sectors);

/// Returns the elevation of the middle of a position.
double elevation_of_position_deg(const DirectionSectors& sectors, int position);

/// Returns the tangent altitude of the middle of a position; NaN without observer_km, and for lines of sight
/// that are horizontal or go upwards.
double tangent_of_position_km(const DirectionSectors& sectors, int position);

}  // namespace vegard::fit
