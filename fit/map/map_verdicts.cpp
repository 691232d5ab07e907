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

double median_error(std::vector<double> errors) { return sim::median(errors); }

/// Whether the map and a sky explain the picture.
QuantityVerdict verdict_of_picture(const MapResult& result) {
  const double chi2 = result.chi2_per_value();
  const double model_error = 100.0 * result.scene.fit.model_error;
  return {"the picture is explained",
          chi2 <= kGoodChi2  ? Trust::good
          : chi2 <= kBadChi2 ? Trust::doubtful
                             : Trust::unconstrained,
          fmt::format("chi2 per value {} at a model error of {} %", sim::short_number(chi2, 3),
                      sim::short_number(model_error, 2)),
          chi2 <= kGoodChi2 ? "the map and a smooth sky account for it within its errors"
                            : "the residual picture shows what the map leaves"};
}

/// Whether the light's lower borders are in view.
QuantityVerdict verdict_of_borders(const MapResult& result) {
  double all = 0.0, in_view = 0.0;
  for (std::size_t c = 0; c < result.cells.size(); ++c) {
    const double light = result.cells[c].flux_mw_m2 * result.grid.area_km2(static_cast<int>(c));
    all += light;
    if (result.border_in_view[c] != 0) in_view += light;
  }
  const double share = all > 0.0 ? in_view / all : 0.0;
  return {"lower borders are in view", share >= kBorderInView ? Trust::good : Trust::doubtful,
          fmt::format("of {:.0f} % of the energy flux", 100.0 * share),
          share >= kBorderInView ? "the elevation of a lower border gives its distance"
                                 : "light without its lower border gives a direction, and hardly a distance"};
}

/// The numbers of all points of curtains whose lower border is in view, and their relative errors.
struct CurtainNumbers {
  std::vector<double> distance, distance_error, energy, energy_error, border, flux, flux_error;

  explicit CurtainNumbers(const std::vector<Curtain>& curtains) {
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
  }
};

/// The verdict by the median of a quantity's relative errors, and the reason; `more` is added to it.
QuantityVerdict verdict_by_error(const MapResult& result, const char* name, Quantity quantity,
                                 double relative_error, const std::string& value, const std::string& more) {
  if (result.replicates.empty()) return {name, Trust::doubtful, value, "no error bars were asked for"};
  return {
      name, trust_of(quantity, 1.0, relative_error), value,
      fmt::format("standard error {} % in the median{}", sim::short_number(100.0 * relative_error, 2), more)};
}

QuantityVerdict verdict_of_distance(const MapResult& result, const CurtainNumbers& seen) {
  const double error = median_error(seen.distance_error);
  return verdict_by_error(
      result, "distance of the curtains", Quantity::distance, error, range_text(seen.distance, "km"),
      error < error_scale(Quantity::distance).none
          ? ""
          : ": the light is too close to the magnetic zenith, or its border is not sharp");
}

QuantityVerdict verdict_of_energy(const MapResult& result, const CurtainNumbers& seen) {
  std::string from_colour;
  for (const MappedPhoto& photo : result.photos)
    if (!photo.scene.fit.white_balance_known) from_colour = "; its colours were not used";
  return verdict_by_error(
      result, "energy along the curtains", Quantity::energy, median_error(seen.energy_error),
      range_text(seen.energy, "keV") + ", lower borders at " + range_text(seen.border, "km"), from_colour);
}

QuantityVerdict verdict_of_flux(const MapResult& result, const CurtainNumbers& seen) {
  QuantityVerdict verdict =
      verdict_by_error(result, "energy flux along the curtains", Quantity::energy_flux,
                       median_error(seen.flux_error), range_text(seen.flux, "mW m⁻²"), "");
  if (!is_absolute(result)) {
    verdict.trust = std::max(verdict.trust, Trust::doubtful);
    verdict.reason += "; relative: the sensor is not calibrated (sensor.calibration_error)";
  }
  return verdict;
}

}  // namespace

bool is_absolute(const MapResult& result) {
  return result.scene.sensor.calibration_error > 0.0 ||
         result.scene.sensor.exposure == sim::ExposureRule::camera;
}

std::vector<QuantityVerdict> map_verdicts(const MapResult& result, const std::vector<Curtain>& curtains) {
  std::vector<QuantityVerdict> verdicts = {verdict_of_picture(result), verdict_of_borders(result)};
  const CurtainNumbers seen(curtains);
  if (seen.distance.empty()) {
    const std::string reason = "the map has no curtain with its lower border in view";
    for (const char* quantity :
         {"distance of the curtains", "energy along the curtains", "energy flux along the curtains"})
      verdicts.push_back({quantity, Trust::unconstrained, "", reason});
    return verdicts;
  }
  verdicts.push_back(verdict_of_distance(result, seen));
  verdicts.push_back(verdict_of_energy(result, seen));
  verdicts.push_back(verdict_of_flux(result, seen));
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
