// The light of a sheet by walking along lines of sight: plain double code that shares nothing with the beams
// but the emission tables.
//
// For sheets whose electrons are not deflected (loss cone 0): then the light at a point is Q times the sum of
// the layers' Gaussian cross-sections at the foot of the field line through it, times the volume emission
// rate at its altitude. Beams count the area of the tangent plane as that of the ground, which is 0.05 % too
// little at 200 km; so does this.
#pragma once

#include <cmath>
#include <vector>

#include "sim/light/sheet_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::tests {

class LineOfSight {
 public:
  explicit LineOfSight(const sim::Scene& scene, double step_km)
      : scene_(scene), step_km_(step_km), observer_km_(scene.site.altitude_m * 1e-3) {
    for (std::size_t s = 0; s < scene.sheets.size(); ++s)
      profiles_.push_back(sim::sheet_profile(scene.emission.lines, scene, static_cast<int>(s)));
    const double degree = std::acos(-1.0) / 180.0;
    const double i = scene.field.inclination_deg * degree, d = scene.field.declination_deg * degree;
    const double sign = i < 0.0 ? -1.0 : 1.0;
    along_[0] = sign * std::cos(i) * std::sin(d);
    along_[1] = sign * std::cos(i) * std::cos(d);
    along_[2] = -sign * std::sin(i);
  }

  /// Rayleighs of one line in the direction of a unit vector to the east, north, up.
  double rayleigh(const double direction[3], int line) const {
    const double up = direction[2];
    double sum = 0.0;
    for (std::size_t s = 0; s < scene_.sheets.size(); ++s) {
      const double first = range_at(up, sim::HeightProfile::kBottomKm),
                   last = range_at(up, scene_.sheets[s].top_km);
      const int steps = static_cast<int>(std::ceil((last - first) / step_km_));
      const double step = (last - first) / steps;
      for (int k = 0; k < steps; ++k) {
        const double range = first + (k + 0.5) * step;
        const double point[3] = {range * direction[0], range * direction[1], range * direction[2]};
        sum += 0.1 * step * emission(point, s, line);
      }
    }
    return sum;
  }

 private:
  static constexpr double kEarth = 6371.0, kFoot = 110.0;

  /// Distance at which a ray reaches an altitude.
  double range_at(double up, double altitude_km) const {
    const double r = kEarth + observer_km_, target = kEarth + altitude_km;
    return -r * up + std::sqrt(r * r * up * up + target * target - r * r);
  }

  /// Photons per cm3 and second.
  double emission(const double point[3], std::size_t s, int line) const {
    const sim::Sheet& sheet = scene_.sheets[s];
    const double q[3] = {point[0], point[1], point[2] + observer_km_ + kEarth};
    const double q2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const double altitude = std::sqrt(q2) - kEarth;
    // Down or up the field line to 110 km: the root near the point.
    const double b = q[0] * along_[0] + q[1] * along_[1] + q[2] * along_[2];
    const double c = q2 - (kEarth + kFoot) * (kEarth + kFoot);
    const double to_foot = -b - std::sqrt(b * b - c);
    const double east = q[0] + to_foot * along_[0] - sheet.center_km.east;
    const double north = q[1] + to_foot * along_[1] - sheet.center_km.north;
    const double bearing = sheet.bearing_deg * std::acos(-1.0) / 180.0;
    const double forward = east * std::sin(bearing) + north * std::cos(bearing);
    const double left = north * std::sin(bearing) - east * std::cos(bearing);
    if (std::abs(forward) > 0.5 * sheet.length_km) return 0.0;
    const double side = scene_.field.inclination_deg < 0.0 ? -1.0 : 1.0;
    double flux = 0.0;
    for (int layer = 0; layer < sheet.layers; ++layer) {
      const double share = sheet.layers > 1 ? static_cast<double>(layer) / (sheet.layers - 1) : 0.0;
      const double phase = sheet.phase_rad + share * sheet.phase_shift_rad +
                           2.0 * std::acos(-1.0) * (forward + 0.5 * sheet.length_km) / sheet.wavelength_km;
      const double across = (left - side * sheet.thickness_km * std::sin(phase)) / sheet.width_km;
      flux += sheet.energy_flux_mw_m2 * std::exp(-0.5 * across * across);
    }
    const sim::HeightProfile& profile = profiles_[s];
    const double place = (altitude - sim::HeightProfile::kBottomKm) / sim::HeightProfile::kStepKm;
    const int below = static_cast<int>(place);
    if (place < 0.0 || below + 1 >= sim::HeightProfile::kAltitudes) return 0.0;
    const double here = profile.rate[below * profile.stride + line];
    const double next = profile.rate[(below + 1) * profile.stride + line];
    return flux * (here + (next - here) * (place - below));
  }

  const sim::Scene& scene_;
  double step_km_, observer_km_;
  std::vector<sim::HeightProfile> profiles_;
  double along_[3];
};

}  // namespace vegard::tests
