#include "fit/map/map_verdicts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/file/number_text.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr double kGoodChi2 = 2.0, kBadChi2 = 4.0;
constexpr double kBorderInView = 0.5;  // share of the light

std::string range_text(const std::vector<double>& values, const std::string& unit) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return sim::short_number(*low, 3) + " to " + sim::short_number(*high, 3) + " " + unit;
}

}  // namespace

bool is_absolute(const MapResult& result) {
  return result.scene.sensor.calibration_error > 0.0 ||
         result.scene.sensor.exposure == sim::ExposureRule::camera;
}

std::vector<QuantityVerdict> map_verdicts(const MapResult& result, const std::vector<Curtain>& curtains) {
  std::vector<QuantityVerdict> verdicts;
  const double chi2 = result.chi2_per_value();
  const double model_error = 100.0 * result.scene.fit.model_error;
  verdicts.push_back({"the picture is explained",
                      chi2 <= kGoodChi2  ? Trust::good
                      : chi2 <= kBadChi2 ? Trust::doubtful
                                         : Trust::unconstrained,
                      fmt::format("chi2 per value {} at a model error of {} %", sim::short_number(chi2, 3),
                                  sim::short_number(model_error, 2)),
                      chi2 <= kGoodChi2 ? "the map and a smooth sky account for it within its errors"
                                        : "the residual picture shows what the map leaves"});

  double all = 0.0, in_view = 0.0;
  for (std::size_t c = 0; c < result.cells.size(); ++c) {
    const double light = result.cells[c].flux_mw_m2 * result.grid.area_km2(static_cast<int>(c));
    all += light;
    if (result.border_in_view[c] != 0) in_view += light;
  }
  const double share = all > 0.0 ? in_view / all : 0.0;
  verdicts.push_back({"lower borders are in view", share >= kBorderInView ? Trust::good : Trust::doubtful,
                      fmt::format("of {:.0f} % of the energy flux", 100.0 * share),
                      share >= kBorderInView
                          ? "the elevation of a lower border gives its distance"
                          : "light without its lower border gives a direction, and hardly a distance"});

  std::vector<double> distance, distance_error, energy, energy_error, border, flux, flux_error;
  for (const Curtain& curtain : curtains)
    for (const CurtainPoint& p : curtain.points) {
      if (!p.border_in_view) continue;
      distance.push_back(p.distance_km);
      distance_error.push_back(p.distance_error_km / std::max(p.distance_km, 10.0));
      energy.push_back(p.energy_kev.value);
      energy_error.push_back(p.energy_kev.error / p.energy_kev.value);
      border.push_back(p.lower_border_km.value);
      flux.push_back(p.flux_mw_m2.value);
      flux_error.push_back(p.flux_mw_m2.error / p.flux_mw_m2.value);
    }
  if (distance.empty()) {
    const std::string reason = "the map has no curtain with its lower border in view";
    for (const char* quantity :
         {"distance of the curtains", "energy along the curtains", "energy flux along the curtains"})
      verdicts.push_back({quantity, Trust::unconstrained, "", reason});
    return verdicts;
  }
  const bool errors = !result.replicates.empty();
  const std::string no_errors = "no error bars were asked for";
  const double of_distance = sim::median(distance_error), of_energy = sim::median(energy_error),
               of_flux = sim::median(flux_error);
  verdicts.push_back(
      {"distance of the curtains", errors ? trust_of(Quantity::distance, 1.0, of_distance) : Trust::doubtful,
       range_text(distance, "km"),
       errors ? fmt::format("standard error {} % in the median{}", sim::short_number(100.0 * of_distance, 2),
                            of_distance < error_scale(Quantity::distance).none
                                ? ""
                                : ": the light is too close to the magnetic zenith, or "
                                  "its border is not sharp")
              : no_errors});
  std::string from_colour;
  for (const MappedPhoto& photo : result.photos)
    if (!photo.scene.fit.white_balance_known) from_colour = "; its colours were not used";
  verdicts.push_back({"energy along the curtains",
                      errors ? trust_of(Quantity::energy, 1.0, of_energy) : Trust::doubtful,
                      range_text(energy, "keV") + ", lower borders at " + range_text(border, "km"),
                      errors ? fmt::format("standard error {} % in the median{}",
                                           sim::short_number(100.0 * of_energy, 2), from_colour)
                             : no_errors});
  Trust trust = errors ? trust_of(Quantity::energy_flux, 1.0, of_flux) : Trust::doubtful;
  std::string reason =
      errors ? fmt::format("standard error {} % in the median", sim::short_number(100.0 * of_flux, 2))
             : no_errors;
  if (!is_absolute(result)) {
    trust = std::max(trust, Trust::doubtful);
    reason += "; relative: the sensor is not calibrated (sensor.calibration_error)";
  }
  verdicts.push_back({"energy flux along the curtains", trust, range_text(flux, "mW m⁻²"), reason});
  // What rests on a picture that is not explained is not to be believed as it stands.
  if (verdicts.front().trust == Trust::unconstrained)
    for (QuantityVerdict& v : verdicts)
      if (v.trust == Trust::good) {
        v.trust = Trust::doubtful;
        v.reason += "; but the map does not explain the picture";
      }
  return verdicts;
}

std::string verdict_line(const std::vector<QuantityVerdict>& verdicts) {
  std::string good, other;
  for (const QuantityVerdict& v : verdicts) {
    std::string& list = v.trust == Trust::good ? good : other;
    list += (list.empty() ? "" : ", ") + v.quantity +
            (v.trust == Trust::good ? "" : std::string(" (") + trust_name(v.trust) + ")");
  }
  if (other.empty()) return "to be believed: " + good;
  return (good.empty() ? "" : "to be believed: " + good + "; ") + "with care: " + other;
}

}  // namespace vegard::fit
