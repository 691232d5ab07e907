#include "sim/emit/sun/strand/strand_density.h"

#include <algorithm>
#include <cmath>

#include "sim/emit/sun/strand/closest_point.h"

namespace vegard::sim {

double falloff_across(RadialFalloff falloff, double q) {
  if (!(q < 1.0)) return 0.0;
  switch (falloff) {
    case RadialFalloff::linear:
      return 1.0 - q;
    case RadialFalloff::gaussian:
      return std::exp(-4.5 * q * q);
    case RadialFalloff::smooth:
      break;
  }
  return (1.0 - q * q) * (1.0 - q * q);
}

double density_in_middle(const Strand<double>& strand, double t) {
  const int last = static_cast<int>(strand.along.size()) - 1;
  const double at = std::clamp(t, 0.0, 1.0) * last;
  const int i = std::min(static_cast<int>(at), last - 1);
  return strand.along[i] + (at - i) * (strand.along[i + 1] - strand.along[i]);
}

bool beyond_end(const Strand<double>& strand, bool last, const std::array<double, 3>& place) {
  const int count = static_cast<int>(strand.points.size());
  const auto& end = strand.points[last ? count - 1 : 0];
  // The tangent points from the end into the chain: to the first point that is not the end itself.
  for (int p = 1; p < count; ++p) {
    const auto& inner = strand.points[last ? count - 1 - p : p];
    if (inner == end) continue;
    double along = 0.0;
    for (int i = 0; i < 3; ++i) along += (place[i] - end[i]) * (inner[i] - end[i]);
    return along < 0.0;
  }
  return false;
}

double density_at(const Strand<double>& strand, RadialFalloff falloff, const std::array<double, 3>& place) {
  const ClosestPoint closest = closest_point(strand.points, place);
  if (closest.t <= 0.0 && beyond_end(strand, false, place)) return 0.0;
  if (closest.t >= 1.0 && beyond_end(strand, true, place)) return 0.0;
  const double radius = strand.radius_first + closest.t * (strand.radius_last - strand.radius_first);
  if (!(radius > 0.0)) return 0.0;
  return density_in_middle(strand, closest.t) * falloff_across(falloff, closest.distance / radius);
}

}  // namespace vegard::sim
