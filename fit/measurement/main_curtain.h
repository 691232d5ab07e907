// What a map says of the border of a measurement: its curtain there, weighted by energy flux.
#pragma once

#include <optional>
#include <vector>

#include "fit/map/curtains/curtains.h"
#include "fit/map/map_result.h"
#include "fit/measurement/main_border.h"

namespace vegard::fit {

/// Means over a curtain's points whose lower border is in view, each weighted by its energy flux times the
/// width. An error is the mean of the points' errors, not less: neighbours err together.
struct MainCurtain {
  std::size_t curtain = 0;       ///< in the map's curtains
  bool is_along_border = false;  ///< some of it has the border's azimuths; else the means are over all of it
  double azimuth_deg = 0.0;
  WithError distance_km;         ///< along the ground
  WithError border_distance_km;  ///< what the border alone has at the same azimuths; NaN if not along it
  WithError energy_kev;          ///< geometric mean
  WithError lower_border_km;
  double lowest_kev = 0.0, highest_kev = 0.0;  ///< along the curtain
  double share_at_end = 0.0;  ///< of the weight at the highest or the lowest energy that a map can have

  /// Whether map and border place the same arc alike, within two errors.
  bool agrees() const;
};

/// The curtain with the most energy along the border, or, if there is none, with the most energy at all.
/// Returns none without a curtain whose lower border is in view.
std::optional<MainCurtain> main_curtain(const MapResult& map, const std::vector<Curtain>& curtains,
                                        const BorderTrace& trace, const sim::Scene& scene);

}  // namespace vegard::fit
