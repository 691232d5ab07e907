#include "sim/light/air/msis_profile.h"

#include <cmath>
#include <cstddef>

#include "sim/base/number/spline.h"

namespace vegard::sim {
namespace {

constexpr std::array<double, 4> kNodeKm = {110.0, 100.0, 90.0, 72.5};

/// 8.314 J/(mol K), with gravity in cm/s^2 and heights in km; the model's own digits.
constexpr double kMsisGasConstant = 831.4;

}  // namespace

MsisGravity::MsisGravity(double latitude_deg) {
  constexpr double kDegree = 1.74533e-2;  // the model's digits
  const double cosine = std::cos(2.0 * kDegree * latitude_deg);
  surface_cm_s2 = 980.616 * (1.0 - 0.0026373 * cosine);
  radius_km = 2.0 * surface_cm_s2 / (3.085462e-6 + 2.27e-9 * cosine) * 1e-5;
}

double MsisGravity::at(double altitude_km) const {
  const double ratio = radius_km / (radius_km + altitude_km);
  return surface_cm_s2 * ratio * ratio;
}

double MsisGravity::geopotential_km(double altitude_km, double from_km) const {
  return (altitude_km - from_km) * (radius_km + from_km) / (radius_km + altitude_km);
}

MsisProfile::MsisProfile(const MsisGravity& gravity, const MsisTemperatures& temperatures, double boundary_km,
                         double join_km)
    : gravity_(gravity),
      boundary_km_(boundary_km),
      join_km_(join_km),
      t_inf_k_(temperatures.t_inf_k),
      t_lb_k_(temperatures.t_lb_k),
      sigma_(temperatures.gradient_k_km / (temperatures.t_inf_k - temperatures.t_lb_k)) {
  for (std::size_t n = kNodeKm.size(); n-- > 0;) {
    height_.push_back(gravity.geopotential_km(kNodeKm[n], join_km));
    inverse_.push_back(1.0 / temperatures.node_k[n]);
  }
  const double join_k = bates_k(join_km);
  height_.push_back(0.0);
  inverse_.push_back(1.0 / join_k);
  // Slopes of the temperature by altitude, as slopes of 1/T by geopotential height.
  const double bottom_ratio = gravity.at(join_km) / gravity.at(kNodeKm.back());
  const double join_ratio = gravity.at(join_km) / gravity.at(boundary_km);
  const double join_slope = (t_inf_k_ - join_k) * sigma_ * join_ratio;
  curvature_ = clamped_spline_curvature(
      height_, inverse_, -temperatures.node_slope_k_km * inverse_[0] * inverse_[0] * bottom_ratio,
      -join_slope / (join_k * join_k));
  whole_ = spline_integral(height_, inverse_, curvature_, 0.0);
}

double MsisProfile::bates_k(double altitude_km) const {
  return t_inf_k_ -
         (t_inf_k_ - t_lb_k_) * std::exp(-sigma_ * gravity_.geopotential_km(altitude_km, boundary_km_));
}

double MsisProfile::inverse_at(double geopotential_km) const {
  return spline_at(height_, inverse_, curvature_, geopotential_km).value;
}

double MsisProfile::temperature_k(double altitude_km) const {
  if (altitude_km >= join_km_) return bates_k(altitude_km);
  return 1.0 / inverse_at(gravity_.geopotential_km(altitude_km, join_km_));
}

double MsisProfile::falloff(double altitude_km, double mass_number, double thermal_diffusion) const {
  const bool spline = altitude_km < join_km_;
  const double bates_km = spline ? join_km_ : altitude_km;
  const double here_k = bates_k(bates_km);
  const double gamma = mass_number * gravity_.at(boundary_km_) / (sigma_ * kMsisGasConstant * t_inf_k_);
  const double above = std::pow(t_lb_k_ / here_k, 1.0 + thermal_diffusion + gamma) *
                       std::exp(-sigma_ * gamma * gravity_.geopotential_km(bates_km, boundary_km_));
  if (!spline) return above;
  const double geopotential = gravity_.geopotential_km(altitude_km, join_km_);
  const double column = whole_ - spline_integral(height_, inverse_, curvature_, geopotential);
  return above * std::pow(here_k * inverse_at(geopotential), 1.0 + thermal_diffusion) *
         std::exp(mass_number * gravity_.at(join_km_) / kMsisGasConstant * column);
}

}  // namespace vegard::sim
