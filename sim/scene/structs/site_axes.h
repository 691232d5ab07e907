// The east, north and up axes of a site, and the transformation from one site's frame to another's.
#pragma once

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

/// Unit vectors in coordinates of the body: z through the north pole, x through latitude and longitude 0.
struct SiteAxes {
  double axis[3][3];  ///< east, north, up
};

inline SiteAxes axes_at(const Site& site) {
  const double lat = site.latitude_deg * kRadiansPerDegree, lon = site.longitude_deg * kRadiansPerDegree;
  return {{{-std::sin(lon), std::cos(lon), 0.0},
           {-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)},
           {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)}}};
}

/// Maps a point p of one frame to another: turn p + shift_km. The axes of a frame are east, north and up; its
/// origin is the observer, at the observer's altitude above the sphere.
struct SiteTurn {
  double turn[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  double shift_km[3] = {0.0, 0.0, 0.0};
};

inline SiteTurn turn_between(const Site& from, const Site& to, double sphere_km = kEarthRadiusKm) {
  SiteTurn out;
  if (from.latitude_deg == to.latitude_deg && from.longitude_deg == to.longitude_deg) {
    out.shift_km[2] = (from.altitude_m - to.altitude_m) * 1e-3;
    return out;
  }
  const SiteAxes a = axes_at(from), b = axes_at(to);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      out.turn[i][j] = 0.0;
      for (int k = 0; k < 3; ++k) out.turn[i][j] += b.axis[i][k] * a.axis[j][k];
    }
    out.shift_km[i] = out.turn[i][2] * (sphere_km + from.altitude_m * 1e-3) -
                      (i == 2 ? sphere_km + to.altitude_m * 1e-3 : 0.0);
  }
  return out;
}

}  // namespace vegard::sim
