#include "fit/map/curtains/map_verdicts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "fit/answer/tables_correction.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr double kGoodChi2 = 2.0, kBadChi2 = 4.0;
constexpr double kBorderInView = 0.5;                     // share of the light
constexpr double kToldAtEdge = 0.05, kMostAtLimit = 0.5;  // likewise
constexpr double kToldInFold = 0.1;                       // likewise
constexpr const char *kDistance = "distance of the curtains", *kEnergy = "energy along the curtains",
                     *kFlux = "energy flux along the curtains", *kHeight = "height of the lower border";
constexpr const char* kNoErrorBars = "no error bars were made";

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

/// What the light's lower borders say, as shares of the energy flux.
struct LightShares {
  double in_view = 0.0, at_edge = 0.0;

  explicit LightShares(const MapResult& result) {
    double all = 0.0;
    for (std::size_t c = 0; c < result.cells.size(); ++c) {
      const double light = result.cells[c].flux_mw_m2 * result.grid.area_km2(static_cast<int>(c));
      all += light;
      if (result.border_in_view[c] == 0) continue;
      in_view += light;
      if (light > 0.0 && is_at_edge(result, result.grid.middle_km(static_cast<int>(c)))) at_edge += light;
    }
    if (!(all > 0.0)) return;
    in_view /= all;
    at_edge /= all;
  }
};

/// Whether the light's lower borders are in view, and not in the farthest cells.
QuantityVerdict verdict_of_borders(const LightShares& light) {
  std::string value = fmt::format("of {:.0f} % of the energy flux", 100.0 * light.in_view);
  if (light.at_edge >= kToldAtEdge)
    value += fmt::format(", {:.0f} % of it in the farthest cells", 100.0 * light.at_edge);
  if (light.in_view < kBorderInView)
    return {"lower borders are in view", Trust::doubtful, value,
            "light without its lower border gives a direction, and hardly a distance"};
  if (light.in_view - light.at_edge < kBorderInView)
    return {"lower borders are in view", Trust::unconstrained, value,
            "light in the farthest cells may come from anywhere beyond them, with any energy"};
  return {"lower borders are in view", Trust::good, value,
          "the elevation of a lower border gives its distance"};
}

/// Whether the curtain is seen at a point's azimuth at another distance too.
bool is_in_fold(const Curtain& curtain, const CurtainPoint& point) {
  constexpr double kSameAzimuth_deg = 1.0, kApart = 3.0;  // standard errors
  return std::any_of(curtain.points.begin(), curtain.points.end(), [&](const CurtainPoint& other) {
    return std::abs(std::remainder(other.azimuth_deg - point.azimuth_deg, 360.0)) < kSameAzimuth_deg &&
           std::abs(other.distance_km - point.distance_km) >
               kApart * std::hypot(other.distance_error_km, point.distance_error_km);
  });
}

double weight_of(const CurtainPoint& p) { return p.flux_mw_m2.value * p.width_km.value; }

/// The energy flux of a curtain's points whose lower border is in view.
double light_of(const Curtain& curtain) {
  double sum = 0.0;
  for (const CurtainPoint& p : curtain.points)
    if (p.border_in_view) sum += weight_of(p);
  return sum;
}

/// The brightest curtain of which some lower border is in view: what the verdicts speak of. Means are
/// weighted with the energy flux; errors are the median of the points' own, for those along a curtain are
/// alike.
struct MainCurtain {
  double nearest_km = 0.0, nearest_error_km = 0.0, farthest_km = 0.0, azimuth_deg = 0.0;
  double distance_error = 0.0;                  ///< relative
  double energy_kev = 0.0, energy_error = 0.0;  ///< relative error
  double border_km = 0.0, border_error_km = 0.0;
  double flux_mw_m2 = 0.0, flux_error = 0.0;                                      ///< relative error
  double at_edge = 0.0, least_energy = 0.0, largest_energy = 0.0, in_fold = 0.0;  ///< shares of its flux
  bool is_tested = true, exists = false;
  double probability = 0.0;

  explicit MainCurtain(const std::vector<Curtain>& curtains) {
    const Curtain* main = nullptr;
    for (const Curtain& curtain : curtains)
      if (light_of(curtain) > 0.0 && (main == nullptr || light_of(curtain) > light_of(*main)))
        main = &curtain;
    if (main == nullptr) return;
    exists = true;
    probability = main->probability;
    is_tested = !std::isnan(probability);
    std::vector<double> distance_errors, energy_errors, border_errors, flux_errors;
    double sum = 0.0, ln_energy = 0.0;
    nearest_km = std::numeric_limits<double>::infinity();
    for (const CurtainPoint& p : main->points) {
      if (!p.border_in_view) continue;
      const double weight = weight_of(p);
      sum += weight;
      ln_energy += weight * std::log(p.energy_kev.value);
      border_km += weight * p.lower_border_km.value;
      flux_mw_m2 += weight * p.flux_mw_m2.value;
      if (p.at_edge) at_edge += weight;
      if (is_in_fold(*main, p)) in_fold += weight;
      if (p.energy_limit < 0) least_energy += weight;
      if (p.energy_limit > 0) largest_energy += weight;
      if (p.distance_km < nearest_km) {
        nearest_km = p.distance_km;
        nearest_error_km = p.distance_error_km;
        azimuth_deg = p.azimuth_deg;
      }
      farthest_km = std::max(farthest_km, p.distance_km);
      distance_errors.push_back(p.distance_error_km / std::max(p.distance_km, 10.0));
      energy_errors.push_back(p.energy_kev.error / p.energy_kev.value);
      border_errors.push_back(p.lower_border_km.error);
      flux_errors.push_back(p.flux_mw_m2.error / p.flux_mw_m2.value);
    }
    energy_kev = std::exp(ln_energy / sum);
    for (double* mean : {&border_km, &flux_mw_m2, &at_edge, &least_energy, &largest_energy, &in_fold})
      *mean /= sum;
    distance_error = sim::median(distance_errors);
    energy_error = sim::median(energy_errors);
    border_error_km = sim::median(border_errors);
    flux_error = sim::median(flux_errors);
  }
};

std::string value_words(double value, double error, const char* unit) {
  return (std::isfinite(error) ? sim::number_with_error(value, error) : sim::short_number(value, 3)) + " " +
         unit;
}

/// The verdict by a quantity's error alone, and the reason.
QuantityVerdict verdict_by_error(const MapResult& result, const char* name, Quantity quantity,
                                 double relative_error, const std::string& value, const std::string& more) {
  if (result.replicates.empty()) return {name, Trust::doubtful, value, kNoErrorBars};
  return {
      name, trust_of(quantity, 1.0, relative_error), value,
      fmt::format("standard error {} % in the median{}", sim::short_number(100.0 * relative_error, 2), more)};
}

QuantityVerdict verdict_of_distance(const MapResult& result, const MainCurtain& main) {
  const std::string value = fmt::format("brightest curtain: nearest {} at azimuth {:.0f}°, farthest {} km",
                                        value_words(main.nearest_km, main.nearest_error_km, "km"),
                                        main.azimuth_deg, sim::short_number(main.farthest_km, 3));
  if (main.at_edge > kMostAtLimit)
    return {kDistance, Trust::unconstrained, value,
            fmt::format("{:.0f} % of its light is in the farthest cells or may be, within its errors, and "
                        "may come from beyond",
                        100.0 * main.at_edge)};
  QuantityVerdict verdict =
      verdict_by_error(result, kDistance, Quantity::distance, main.distance_error, value,
                       main.distance_error < error_scale(Quantity::distance).none
                           ? ""
                           : ": the light is too close to the magnetic zenith, or its border is not sharp");
  if (result.replicates.empty()) verdict.reason += ", and no ridge was tested against chance";
  if (is_of_one_station(result) && main.in_fold > kToldInFold) {
    verdict.trust = std::max(verdict.trust, Trust::doubtful);
    verdict.reason += fmt::format(
        "; over {:.0f} % of its light it folds along the line of sight, where one station hardly tells which "
        "part of the light is how far",
        100.0 * main.in_fold);
  }
  return verdict;
}

QuantityVerdict verdict_of_energy(const MapResult& result, const MainCurtain& main) {
  std::string from_colour;
  for (const MappedPhoto& photo : result.photos)
    if (!photo.scene.fit.white_balance_known) from_colour = "; its colours were not used";
  const std::string value =
      fmt::format("mean of the brightest curtain: {}",
                  value_words(main.energy_kev, main.energy_kev * main.energy_error, "keV"));
  if (main.at_edge > kMostAtLimit)
    return {kEnergy, Trust::unconstrained, value,
            fmt::format("{:.0f} % of its light is in the farthest cells or may be: the energy there is open",
                        100.0 * main.at_edge)};
  for (const bool is_largest : {false, true})
    if ((is_largest ? main.largest_energy : main.least_energy) > kMostAtLimit)
      return {kEnergy, Trust::unconstrained, value,
              fmt::format(
                  "{:.0f} % of its light has the {} energies of the map, {} keV: a {} limit",
                  100.0 * (is_largest ? main.largest_energy : main.least_energy),
                  is_largest ? "largest" : "least",
                  sim::short_number(is_largest ? result.energies_kev.back() : result.energies_kev.front(), 3),
                  is_largest ? "lower" : "upper")};
  QuantityVerdict verdict =
      verdict_by_error(result, kEnergy, Quantity::energy, main.energy_error, value, from_colour);
  for (const OtherSpectrum& other : result.spectra)
    if (other.is_preferred()) {
      verdict.trust = std::max(verdict.trust, Trust::doubtful);
      verdict.reason +=
          fmt::format("; other electrons ({}) explain the picture better, with other energies: --spectrum {}",
                      sim::spectrum_in_words(other.spectrum), sim::spectrum_word(other.spectrum.kind));
    }
  return verdict;
}

QuantityVerdict verdict_of_flux(const MapResult& result, const MainCurtain& main) {
  QuantityVerdict verdict =
      verdict_by_error(result, kFlux, Quantity::energy_flux, main.flux_error,
                       "mean of the brightest curtain: " +
                           value_words(main.flux_mw_m2, main.flux_mw_m2 * main.flux_error, "mW m⁻²"),
                       "");
  if (!is_absolute(result)) {
    verdict.trust = std::max(verdict.trust, Trust::doubtful);
    verdict.reason += "; relative: the sensor is not calibrated (sensor.calibration_error)";
  }
  return verdict;
}

QuantityVerdict verdict_of_height(const MapResult& result, const MainCurtain& main) {
  QuantityVerdict verdict{
      kHeight, Trust::doubtful,
      "of the brightest curtain: " + value_words(main.border_km, main.border_error_km, "km"), kNoErrorBars};
  if (!result.replicates.empty()) {
    verdict.trust = trust_of(Quantity::altitude, main.border_km, main.border_error_km);
    verdict.reason =
        fmt::format("standard error {} km in the median", sim::short_number(main.border_error_km, 2));
  }
  if (is_of_one_station(result)) {
    verdict.trust = std::max(verdict.trust, Trust::doubtful);
    verdict.reason +=
        "; from one station it is assumed rather than measured: it follows from the electrons' energy and "
        "spectrum, which the shape of the light hardly tells. A second station would measure it";
  }
  return verdict;
}

}  // namespace

bool is_absolute(const MapResult& result) {
  return result.scene.sensor.calibration_error > 0.0 ||
         result.scene.sensor.exposure == sim::ExposureRule::camera;
}

std::vector<QuantityVerdict> map_verdicts(const MapResult& result, const std::vector<Curtain>& curtains) {
  std::vector<QuantityVerdict> verdicts = {verdict_of_picture(result),
                                           verdict_of_borders(LightShares(result))};
  const MainCurtain main(curtains);
  if (!main.exists) {
    for (const char* quantity : {kDistance, kEnergy, kFlux, kHeight})
      verdicts.push_back({quantity, Trust::unconstrained, "",
                          "the map has no curtain that is sure and has its lower border in view"});
    return verdicts;
  }
  verdicts.push_back(verdict_of_distance(result, main));
  verdicts.push_back(verdict_of_energy(result, main));
  verdicts.push_back(verdict_of_flux(result, main));
  verdicts.push_back(verdict_of_height(result, main));
  // What rests on a picture that is not explained is not to be believed as it stands.
  if (verdicts.front().trust == Trust::unconstrained)
    for (QuantityVerdict& v : verdicts)
      if (v.trust == Trust::good) {
        v.trust = Trust::doubtful;
        v.reason += "; but the map does not explain the picture";
      }
  return verdicts;
}

std::vector<TablesCorrection> map_corrections(const MapResult& result, const std::vector<Curtain>& curtains) {
  const MainCurtain main(curtains);
  if (!main.exists || result.modes_covariance.size() == 0) return {};
  LearntModes learnt;
  const std::vector<double>& modes = result.scene.emission.modes;
  learnt.value = Eigen::Map<const Eigen::VectorXd>(modes.data(), static_cast<Eigen::Index>(modes.size()));
  learnt.covariance = result.modes_covariance;
  for (std::size_t k = 0; k < modes.size(); ++k) learnt.modes.push_back(static_cast<int>(k));
  sim::Scene curtain = result.scene;
  curtain.sheets.assign(1, sim::Sheet());
  curtain.sheets[0].profile = sim::ProfileKind::maxwellian;
  // Of electrons with the mean energy that the map's have.
  curtain.sheets[0].energy_kev =
      main.energy_kev * sim::mean_energy_over_e0(result.spectrum) / sim::mean_energy_over_e0({});
  return tables_corrections(lines_by_modes(curtain, learnt.modes), learnt);
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
