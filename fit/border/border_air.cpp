#include "fit/border/border_air.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "fit/border/border_distance.h"
#include "sim/base/number/constants.h"
#include "sim/view/sky/air.h"

namespace vegard::fit {
namespace border_air {
namespace {

constexpr std::array kWavelength_nm = {630.0, 557.7, 427.8};
constexpr double kClearAerosol = 0.5, kHazyAerosol = 2.0;
constexpr double kRefractionError = 0.16;

std::vector<double> depths(sim::Scene scene, const SkyCells& cells, int channel, double aerosol) {
  scene.air.model = sim::AirModel::standard;
  const sim::AirAbove air(scene);
  std::vector<double> out(static_cast<std::size_t>(cells.rows), 0.0);
  if (air.none()) return out;
  const sim::LineDepths<double> vertical(kWavelength_nm[static_cast<std::size_t>(channel)],
                                         aerosol * scene.air.aerosol_optical_depth,
                                         scene.air.angstrom_exponent, scene.air.ozone_dobson);
  for (int r = 0; r < cells.rows; ++r)
    out[static_cast<std::size_t>(r)] = -std::log(
        vertical.transmission(air.towards(std::sin(cells.elevation_deg(r) * sim::kRadiansPerDegree))));
  return out;
}

}  // namespace
}  // namespace border_air

BorderAir air_of_rows(const sim::Scene& scene, const SkyCells& cells, int channel) {
  using namespace border_air;
  return {depths(scene, cells, channel, 1.0), depths(scene, cells, channel, kClearAerosol),
          depths(scene, cells, channel, kHazyAerosol)};
}

BorderAir no_air(const SkyCells& cells) {
  const std::vector<double> none(static_cast<std::size_t>(cells.rows), 0.0);
  return {none, none, none};
}

double refraction_error_deg(double apparent_elevation_deg, double site_altitude_m) {
  return border_air::kRefractionError *
         (apparent_elevation_deg - true_elevation_deg(apparent_elevation_deg, site_altitude_m));
}

}  // namespace vegard::fit
