#include "sim/view/sky/air.h"

#include <algorithm>
#include <cmath>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

constexpr double kMoleculesPerDobson_cm2 = 2.687e16;
constexpr double kAirEndsKm = 80.0;  // where the aurora's light begins
constexpr int kAirIntervals = 192;
constexpr int kPanels = 40;
constexpr double kAirReach = 40.0;  // in scale heights: what lies higher is e^-40 of it all

// Gauss-Legendre, 6 points on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr double kNode[3] = {0.238619186083197, 0.661209386466265, 0.932469514203152};
constexpr double kWeight[3] = {0.467913934572691, 0.360761573048139, 0.171324492379170};

/// A number with its derivative by the sine of the elevation.
using SineDual = Dual<double, Tangents<double, 1>>;

/// Returns the density over that at the observer.
SineDual relative_density(const AirShape& shape, const SineDual& altitude_km, double observer_km) {
  if (!shape.gaussian) return exponential((altitude_km - observer_km) * (-1.0 / shape.width_km));
  const SineDual away = (altitude_km - shape.centre_km) / shape.width_km;
  return exponential(away * away * -0.5);
}

/// Returns the way along the line up to `top_km` and the column along it.
SineDual column_km(const AirShape& shape, double observer_km, double top_km, const SineDual& sine) {
  const double from_centre = kEarthRadiusKm + observer_km, to_top = kEarthRadiusKm + top_km;
  const double along = from_centre * sine.v;
  const double end = -along + std::sqrt(along * along + (to_top - from_centre) * (to_top + from_centre));
  SineDual sum(0.0);
  for (int panel = 0; panel < kPanels; ++panel) {
    const double middle = (panel + 0.5) * end / kPanels, half = 0.5 * end / kPanels;
    for (int k = 0; k < 6; ++k) {
      const double s = middle + (k % 2 == 0 ? half : -half) * kNode[k / 2];
      const SineDual climb = sine * (2.0 * from_centre * s) + s * s;
      const SineDual above = climb / (square_root(climb + from_centre * from_centre) + from_centre);
      sum = sum + relative_density(shape, above + observer_km, observer_km) * (kWeight[k / 2] * half);
    }
  }
  return sum;
}

}  // namespace

double rayleigh_optical_depth(double wavelength_nm) {
  const double um2 = wavelength_nm * wavelength_nm * 1e-6;
  return 0.0021520 * (1.0455996 - 341.29061 / um2 - 0.90230850 * um2) /
         (1.0 + 0.0027059889 / um2 - 85.968563 * um2);
}

double ozone_optical_depth(double wavelength_nm, double ozone_dobson) {
  static const CsvTable table = embedded_csv_table("ozone_233k.csv");
  const std::vector<double>& nm = table.column("wavelength_nm");
  const std::vector<double>& cm2 = table.column("cross_section_cm2");
  const double inside = std::clamp(wavelength_nm, nm.front(), nm.back());
  const auto next = std::clamp<std::ptrdiff_t>(std::upper_bound(nm.begin(), nm.end(), inside) - nm.begin(), 1,
                                               static_cast<std::ptrdiff_t>(nm.size()) - 1);
  const double t = (inside - nm[next - 1]) / (nm[next] - nm[next - 1]);
  return ozone_dobson * kMoleculesPerDobson_cm2 * ((1.0 - t) * cm2[next - 1] + t * cm2[next]);
}

double pressure_share(double altitude_km) {
  constexpr double kStandardRadiusKm = 6356.766, kTropopauseKm = 11.0, kScaleHeightAboveKm = 6.34162;
  // The geopotential altitude, in which gravity is constant.
  const double potential_km = kStandardRadiusKm * altitude_km / (kStandardRadiusKm + altitude_km);
  const double below = std::min(potential_km, kTropopauseKm);
  return std::pow(1.0 - 6.5 * below / 288.15, 5.25588) *
         std::exp(-(potential_km - below) / kScaleHeightAboveKm);
}

double sine_of_horizon(double observer_km, double sphere_km) {
  const double cos_of_dip = sphere_km / (sphere_km + std::max(0.0, observer_km));
  return -std::sqrt(1.0 - cos_of_dip * cos_of_dip);
}

AirShape molecules_shape() { return {0.0, 7.0, false}; }
AirShape ozone_shape() { return {22.0, 5.0, true}; }

AirColumn::AirColumn(const AirShape& shape, double observer_km, double unit_km) {
  lowest_sine_ = sine_of_horizon(observer_km);
  const double top_km = shape.gaussian ? std::max(observer_km, shape.centre_km) + 9.0 * shape.width_km
                                       : observer_km + kAirReach * shape.width_km;
  log_column_.resize(kAirIntervals + 1);
  slope_.resize(kAirIntervals + 1);
  for (int i = 0; i <= kAirIntervals; ++i) {
    SineDual sine(sine_at(i));
    sine.d.t[0] = 1.0;
    const SineDual column = column_km(shape, observer_km, top_km, sine) / unit_km;
    log_column_[i] = std::log(column.v);
    slope_[i] = column.d.t[0] / column.v;
  }
}

AirAbove::AirAbove(const Scene& scene)
    : none_(scene.air.model == AirModel::none || scene.site.altitude_m * 1e-3 >= kAirEndsKm) {
  if (none_) return;
  const double observer_km = scene.site.altitude_m * 1e-3, scale_km = scene.air.aerosol_height_km;
  molecules_above_ = pressure_share(observer_km);
  aerosol_above_ = std::exp(-observer_km / scale_km);
  molecules_.emplace(molecules_shape(), observer_km, molecules_shape().width_km);
  aerosol_.emplace(AirShape{0.0, scale_km, false}, observer_km, scale_km);
  // A Gaussian's column is counted from the middle of the layer, not from the observer.
  ozone_.emplace(ozone_shape(), observer_km, std::sqrt(kTwoPi) * ozone_shape().width_km);
}

double air_transmission(const Scene& scene, double wavelength_nm, double elevation_deg) {
  const AirAbove air(scene);
  if (air.none()) return 1.0;
  const LineDepths<double> depths(wavelength_nm, scene.air.aerosol_optical_depth, scene.air.angstrom_exponent,
                                  scene.air.ozone_dobson);
  return depths.transmission(air.towards(std::sin(elevation_deg * kRadiansPerDegree)));
}

}  // namespace vegard::sim
