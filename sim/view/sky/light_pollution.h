// The glow of a town beyond the horizon. Ours: a form with a free hand, not a calculation of scattered light
// such as Garstang's (1986, doi:10.1086/131768).
#pragma once

#include <cmath>

#include "sim/base/earth.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {

/// Luminance over that at the horizon towards the town: exp(-sin e / sin h - cos e (1 - cos a) / s^2), with
/// the elevation e, the azimuth a from the town, and height h and spread s of [light_pollution]. Below the
/// horizontal it stays as it is there. T is double or a dual number.
template <class T>
T light_pollution_share(const SightLine<T>& line, const LightPollution& town) {
  const double azimuth = town.azimuth_deg * kRadiansPerDegree, spread = town.spread_deg * kRadiansPerDegree;
  const T towards = line.east * std::sin(azimuth) + line.north * std::cos(azimuth);
  // Straight up the root has no slope, and nothing depends on the azimuth.
  const T level = square_root(line.east * line.east + line.north * line.north + 1e-12);
  const T height =
      value_of(line.up) > 0.0 ? line.up * (-1.0 / std::sin(town.height_deg * kRadiansPerDegree)) : T(0.0);
  return exponential(height - (level - towards) * (1.0 / (spread * spread)));
}

}  // namespace vegard::sim
