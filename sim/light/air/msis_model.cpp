#include "sim/light/air/msis_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/base/number/spline.h"

namespace vegard::sim {
namespace {

constexpr double kMeanNodesKm = 300.0;  // from here the variation of the nodes is left out
constexpr double kAtomicMassG = 1.66e-24, kHotGasConstant = 831.4;  // the model's digits

double correction(const MsisCorrection& c, double log, double altitude_km) {
  const double away = altitude_km - c.altitude_km;
  return std::exp(log / (1.0 + 0.5 * (std::exp(away / c.length_km) + std::exp(away / c.length_2_km))));
}

/// Joins the mixed and the diffusive density (Hedin 1987, equation A12): the larger where they are far apart,
/// a smooth transition at the turbopause. `transition` is the mass that sets its width.
double turbulent_cm3(double diffusive, double mixed, double transition) {
  constexpr double kFarApart = 10.0;
  if (!(diffusive > 0.0) || !(mixed > 0.0)) return std::max(diffusive, mixed);
  const double apart = transition * std::log(mixed / diffusive);
  if (apart < -kFarApart) return diffusive;
  if (apart > kFarApart) return mixed;
  return diffusive * std::pow(1.0 + std::exp(apart), 1.0 / transition);
}

constexpr std::array<double, 4> kNodeKm = {110.0, 100.0, 90.0, 72.5};

/// The gas constant, 8.314 J/(mol K), with gravity in cm/s^2 and heights in km; the model's own digits.
constexpr double kMsisGasConstant = 831.4;

}  // namespace

MsisModel::MsisModel(const MsisDrivers& drivers)
    : numbers_(msis_coefficients()), expansion_(drivers), gravity_(drivers.latitude_deg) {
  const double season = numbers_.turbopause_season * expansion_.sine_of_latitude() *
                        expansion_.annual_cosine(numbers_.t_inf[13]);
  for (std::size_t g = 0; g < kMsisGases; ++g) {
    const MsisGasNumbers& gas = numbers_.gas[g];
    boundary_cm3_[g] = gas.boundary_cm3 * gas.density[0] * std::exp(expansion_.thermosphere(gas.density));
    turbopause_km_[g] = gas.turbopause_km * (g == static_cast<std::size_t>(MsisGas::n2) ? 1.0 + season : 1.0);
  }
  hot_boundary_cm3_ =
      numbers_.hot_o_cm3 * numbers_.hot_o[0] * std::exp(expansion_.thermosphere(numbers_.hot_o));
  below_join_ = layer(true, false);
  middle_ = layer(false, false);
  high_ = layer(false, true);
}

MsisModel::Layer MsisModel::layer(bool mean_exosphere, bool mean_nodes) const {
  const MsisCoefficients& n = numbers_;
  const auto varied = [&](double value, const MsisParameters& p) {
    return value * p[0] * (1.0 + expansion_.thermosphere(p));
  };
  const double activity = expansion_.activity(n.t_lb);
  const auto node = [&](const MsisParameters& p) { return mean_nodes ? 0.0 : expansion_.node(p, activity); };
  MsisTemperatures temperatures;
  temperatures.t_inf_k = mean_exosphere ? n.t_inf_k * n.t_inf[0] : varied(n.t_inf_k, n.t_inf);
  temperatures.t_lb_k = varied(n.t_lb_k, n.t_lb);
  temperatures.gradient_k_km = varied(n.gradient_k_km, n.gradient);
  for (std::size_t k = 0; k < n.node.size(); ++k)
    temperatures.node_k[k] = n.node_k[k] * n.node[k][0] / (1.0 - node(n.node[k]));
  const double bottom_ratio = temperatures.node_k.back() / (n.node_k.back() * n.node.back()[0]);
  temperatures.node_slope_k_km =
      n.node_slope_k_km * n.node_slope[0] * (1.0 + node(n.node_slope)) * bottom_ratio * bottom_ratio;

  Layer made = {temperatures, MsisProfile(gravity_, temperatures, n.boundary_km, n.join_km), {}};
  for (std::size_t g = 0; g < kMsisGases; ++g) {
    const MsisGasNumbers& gas = n.gas[g];
    made.mixed_cm3[g] = boundary_cm3_[g] *
                        made.profile.falloff(turbopause_km_[g], gas.mass_number, gas.thermal_diffusion) /
                        made.profile.falloff(turbopause_km_[g], n.mean_mass, 0.0);
  }
  return made;
}

double MsisModel::gas_cm3(const Layer& layer, std::size_t g, double altitude_km) const {
  const MsisGasNumbers& gas = numbers_.gas[g];
  double density =
      boundary_cm3_[g] * layer.profile.falloff(altitude_km, gas.mass_number, gas.thermal_diffusion);
  const auto solar = [&](const MsisCorrection& c) {
    return c.log * (1.0 + c.solar * expansion_.above_mean_flux());
  };
  if (altitude_km <= gas.mixed_below_km) {
    const double mixed = layer.mixed_cm3[g] * layer.profile.falloff(altitude_km, numbers_.mean_mass, 0.0);
    density = turbulent_cm3(density, mixed, numbers_.transition / (numbers_.mean_mass - gas.mass_number));
    const double nitrogen = layer.mixed_cm3[static_cast<std::size_t>(MsisGas::n2)];
    const double log = gas.mixing_ratio > 0.0 ? std::log(nitrogen * gas.mixing_ratio / layer.mixed_cm3[g])
                                              : solar(gas.bottom);
    density *= correction(gas.bottom, log, altitude_km);
  }
  if (altitude_km <= gas.departure_below_km)
    density *= correction(gas.departure, solar(gas.departure), altitude_km);
  return density;
}

bool MsisModel::sound() const {
  constexpr double kMaxFactor = 2.0, kMaxInversion = 1.25;
  for (const Layer* layer : {&*below_join_, &*middle_}) {
    const MsisTemperatures& t = layer->temperatures;
    if (!(t.t_lb_k > 0.0 && t.t_inf_k > t.t_lb_k && t.gradient_k_km > 0.0)) return false;
    for (std::size_t k = 0; k < t.node_k.size(); ++k) {
      const double mean_k = numbers_.node_k[k] * numbers_.node[k][0];
      const double max_k = k == 0 ? kMaxInversion * t.t_lb_k : kMaxFactor * mean_k;
      if (!(t.node_k[k] > mean_k / kMaxFactor && t.node_k[k] < max_k)) return false;
    }
  }
  return true;
}

MsisAir MsisModel::at(double altitude_km) const {
  assert(altitude_km >= kMsisBottomKm && altitude_km <= kMsisTopKm);
  const Layer& layer = *(altitude_km <= numbers_.join_km ? below_join_
                         : altitude_km < kMeanNodesKm    ? middle_
                                                         : high_);
  MsisAir air;
  air.exospheric_k = layer.temperatures.t_inf_k;
  air.temperature_k = layer.profile.temperature_k(altitude_km);
  double mass = 0.0;
  for (std::size_t g = 0; g < kMsisGases; ++g) {
    air.density_cm3[g] = gas_cm3(layer, g, altitude_km);
    mass += numbers_.gas[g].mass_number * air.density_cm3[g];
  }
  air.mass_g_cm3 = kAtomicMassG * mass;

  // Anomalous oxygen: isothermal, and cut off below 550 km.
  const double oxygen = numbers_.gas[static_cast<std::size_t>(MsisGas::o)].mass_number;
  const auto height_km = [&](double from_km) {
    return kHotGasConstant * numbers_.hot_o_k / (oxygen * gravity_.at(from_km));
  };
  const double way =
      gravity_.geopotential_km(altitude_km, numbers_.boundary_km) / height_km(numbers_.boundary_km);
  const double cut = numbers_.hot_o_length_km / height_km(numbers_.hot_o_km) *
                     std::expm1(-(altitude_km - numbers_.hot_o_km) / numbers_.hot_o_length_km);
  air.hot_o_cm3 = hot_boundary_cm3_ * std::exp(-way - cut);
  return air;
}

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
