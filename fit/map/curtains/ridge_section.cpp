#include "fit/map/curtains/ridge_section.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace ridge_section_of {
namespace {

constexpr double kAcross_km = 14.0, kAcrossStep_km = 0.5;
constexpr double kLookAside_km = 12.0;

}  // namespace
}  // namespace ridge_section_of

RidgeSection ridge_section(const RasterGrid& raster, const std::vector<double>& smooth,
                           const RasterFlux& flux, sim::EastNorth at, sim::EastNorth across, double step_km) {
  using namespace ridge_section_of;
  const auto moved = [&](double t, double along = 0.0) {
    return sim::EastNorth{at.east + t * across.east + along * across.north,
                          at.north + t * across.north - along * across.east};
  };
  const auto mean = [&](const std::vector<double>& values, double t) {
    const double third = step_km / 3.0;
    return (raster_value(raster, values, moved(t, -third)) + raster_value(raster, values, moved(t)) +
            raster_value(raster, values, moved(t, third))) /
           3.0;
  };
  RidgeSection s;
  double most = -1.0;
  for (double t = -kLookAside_km; t <= kLookAside_km; t += kAcrossStep_km) {
    // The nearer of two like ridges.
    const double v = raster_value(raster, smooth, moved(t)) * std::exp(-0.5 * t * t / (8.0 * 8.0));
    if (v > most) {
      most = v;
      s.aside_km = t;
    }
  }
  // Out to where the flux has its valley to the next curtain, on either side.
  double bounds[2];
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? -1.0 : 1.0;
    double reach = kAcrossStep_km, before = raster_value(raster, smooth, moved(s.aside_km));
    const double top = before;
    for (; reach < kAcross_km; reach += kAcrossStep_km) {
      const double v = raster_value(raster, smooth, moved(s.aside_km + sign * reach));
      if (v > before || v < 0.02 * top) break;
      before = v;
    }
    bounds[side] = s.aside_km + sign * reach;
  }
  double sum = 0.0, first = 0.0, second = 0.0, ln = 0.0;
  for (double t = bounds[0]; t <= bounds[1]; t += kAcrossStep_km) {
    const double q = mean(flux.flux, t);
    sum += q;
    first += q * t;
    second += q * t * t;
    ln += mean(flux.flux_ln_energy, t);
  }
  if (sum > 0.0) {
    s.ln_energy = ln / sum;
    s.width_km = std::sqrt(std::max(0.0, second / sum - std::pow(first / sum, 2)));
    // Of a Gaussian of this width that carries the section's flux.
    constexpr double kRootTwoPi = 2.5066282746310002;
    s.flux = sum * kAcrossStep_km / (kRootTwoPi * std::max(s.width_km, 0.5 * raster.step_km));
  }
  return s;
}

RidgeHeight ridge_height(const RasterGrid& raster, const std::vector<double>& values, sim::EastNorth at,
                         sim::EastNorth across, double reach_km, double valley_km) {
  const auto value = [&](double t) {
    return raster_value(raster, values, {at.east + t * across.east, at.north + t * across.north});
  };
  constexpr double kStepAcross_km = 1.0;
  RidgeHeight ridge;
  double top = value(0.0);
  const int steps = static_cast<int>(reach_km / kStepAcross_km);
  for (int k = -steps; k <= steps; ++k)
    if (const double v = value(k * kStepAcross_km); v > top) {
      top = v;
      ridge.aside_km = k * kStepAcross_km;
    }
  double valley[2] = {top, top};
  for (int side = 0; side < 2; ++side)
    for (double t = kStepAcross_km; t <= valley_km; t += kStepAcross_km)
      valley[side] = std::min(valley[side], value(ridge.aside_km + (side == 0 ? -t : t)));
  ridge.height = top - std::max(valley[0], valley[1]);
  return ridge;
}

sim::EastNorth across_line(const RidgeLine& feet, std::size_t i) {
  const sim::EastNorth before = feet[i > 0 ? i - 1 : 0], after = feet[std::min(i + 1, feet.size() - 1)];
  const double length = std::hypot(after.east - before.east, after.north - before.north);
  return {-(after.north - before.north) / length, (after.east - before.east) / length};
}

}  // namespace vegard::fit
