// A Sun due north on the horizon, as large as one likes, and rays to it.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "sim/emit/sun/strand/strand.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"

namespace vegard::tests {

/// Its x axis points to the observer, y to the right and z up; its unit is a kilometre. No photosphere stops
/// rays.
inline sim::Sun level_sun(double distance) {
  sim::Sun sun;
  sun.shown = true;
  sun.elevation_deg = 0.0;
  sun.distance_km = distance;
  sun.unit_km = 1.0;
  sun.radius = 0.0;
  return sun;
}

struct SunRay {
  double rayleigh = 0.0, entry_km = std::numeric_limits<double>::infinity(), depth_km = entry_km;
};

/// Of one line, along the ray through the place (0, right, up).
inline SunRay sun_ray(const sim::Emitter<double>& emitter, double distance, double right, double up,
                      double cell_rad = 0.0, double end_km = std::numeric_limits<double>::infinity()) {
  const double length = std::sqrt(right * right + up * up + distance * distance);
  const double d[3] = {right / length, distance / length, up / length};
  double kept = 1.0;
  SunRay out;
  emitter.march({1, {&d[0], &d[1], &d[2]}, &end_km, cell_rad},
                {1, &out.rayleigh, &kept, &out.entry_km, &out.depth_km});
  return out;
}

/// Light times area over cells of a film from -half to half, at x = 0: of an observer far off, the integral
/// of the density over space.
inline double light_of_film(const sim::Emitter<double>& emitter, double distance, double half, int cells) {
  const double cell = 2.0 * half / cells;
  double sum = 0.0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i)
      sum += sun_ray(emitter, distance, -half + (i + 0.5) * cell, -half + (j + 0.5) * cell, cell / distance)
                 .rayleigh;
  return sum * cell * cell;
}

template <class T>
sim::Strand<T> strand_of(const std::vector<std::array<T, 3>>& points, const T& first, const T& last,
                         const std::vector<T>& along) {
  sim::Strand<T> strand;
  strand.points = points;
  strand.radius_first = first;
  strand.radius_last = last;
  strand.along = along;
  return strand;
}

/// A straight one, of one radius and density.
inline sim::Strand<double> straight(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                    double radius, double density = 1.0) {
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 4; ++i) {
    const double t = i / 3.0;
    points.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
  }
  return strand_of<double>(points, radius, radius, {density, density});
}

}  // namespace vegard::tests
