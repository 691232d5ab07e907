#include "fit/answer/energy_flux.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/light/sheet_profile.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sensor/expected_counts.h"

namespace vegard::fit {
namespace {

/// Of the mean of a photograph's gains, relative to it.
struct GainError {
  double sigma = 0.0;
  std::vector<double> by_mode;  ///< part of sigma
};

/// None if one of the gains has no error bar.
std::optional<GainError> error_of_gain(const FittedPhoto& photo) {
  double sum = 0.0, variance = 0.0;
  std::vector<double> by_mode;  // of the sum
  for (const SolvedNumber& solved : photo.solved) {
    if (solved.name.compare(0, 4, "gain") != 0 || solved.value <= 0.0) continue;
    if (!solved.sigma) return {};
    sum += solved.value;
    double by_itself = *solved.sigma * *solved.sigma;
    by_mode.resize(std::max(by_mode.size(), solved.by_mode.size()), 0.0);
    for (std::size_t m = 0; m < solved.by_mode.size(); ++m) {
      by_mode[m] += solved.by_mode[m];
      by_itself -= solved.by_mode[m] * solved.by_mode[m];
    }
    variance += std::max(0.0, by_itself);
  }
  if (sum <= 0.0) return {};
  for (double& change : by_mode) {
    variance += change * change;
    change /= sum;
  }
  return GainError{std::sqrt(variance) / sum, by_mode};
}

/// Of the scale; none if it is not given.
std::optional<double> relative_sigma_of_scale(const sim::Scene& known) {
  if (known.sensor.calibration_error > 0.0) return known.sensor.calibration_error;
  if (known.sensor.exposure != sim::ExposureRule::camera) return {};
  return sim::expected_counts(known).relative_uncertainty;
}

/// If it is a number of the fit's own, it is that.
bool is_own_number(const FitResult& result, const std::string& path, DerivedNumber& d) {
  for (const FittedParameter& p : result.parameters)
    if (p.path == path) {
      d.value = p.value;
      d.sigma = p.sigma;
      d.by_mode = p.by_mode;
      d.why_no_sigma = p.why_no_sigma;
      return true;
    }
  for (const TiedNumber& t : result.tied)
    if (t.path == path) {
      d.value = t.value;
      d.sigma = t.sigma;
      if (!d.sigma) d.why_no_sigma = "the data do not determine it";
      return true;
    }
  return false;
}

/// Q of the scene, times found over known gain. `why_not_this`: what speaks against it, whatever the scale.
std::optional<FoundFlux> scaled(double mw_m2, const sim::Scene& known, const FittedPhoto& fitted,
                                const std::string& why_not_this, std::string& why_none) {
  const std::optional<double> of_scale = relative_sigma_of_scale(known);
  if (!of_scale)
    why_none = "not calibrated: sensor.calibration_error is 0";
  else if (!why_not_this.empty())
    why_none = why_not_this;
  else if (!known.fit.white_balance_known)
    why_none = "not calibrated: every channel has a gain of its own";
  else
    why_none.clear();
  if (!why_none.empty()) return {};
  const double share = sim::gain_per_kilorayleigh(fitted.best) / sim::gain_per_kilorayleigh(known);
  FoundFlux flux{mw_m2 * share, {}};
  if (const std::optional<GainError> of_gain = error_of_gain(fitted)) {
    flux.sigma = flux.mw_m2 * std::hypot(of_gain->sigma, *of_scale);
    for (const double change : of_gain->by_mode) flux.by_mode.push_back(flux.mw_m2 * change);
  }
  return flux;
}

/// Of element `index` of a table of that name, by found_flux() or its like.
template <class Found>
DerivedNumber energy_flux(const std::string& table, const std::string& name, int index, const Found& found,
                          const std::vector<const sim::Scene*>& known, const FitResult& result) {
  DerivedNumber d;
  d.name = "energy flux Q of the " + name + " " + table;
  d.unit = "mW m\u207b\u00b2";
  d.quantity = Quantity::energy_flux;
  if (is_own_number(result, table + "." + name + ".energy_flux_mw_m2", d)) return d;
  d.value = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < result.photos.size() && i < known.size(); ++i) {
    std::string why_none;
    const auto flux = found(*known[i], result.photos[i], index, why_none);
    if (d.why_none.empty()) d.why_none = why_none;
    if (!flux || (d.sigma && !(flux->sigma && *flux->sigma < *d.sigma))) continue;
    d.value = flux->mw_m2;
    d.sigma = flux->sigma;
    d.by_mode = flux->by_mode;
  }
  if (std::isfinite(d.value)) {
    d.why_none.clear();
    if (!d.sigma) d.why_no_sigma = "the gain has none";
  }
  return d;
}

}  // namespace

std::optional<FoundFlux> found_flux(const sim::Scene& known, const FittedPhoto& fitted, int index,
                                    std::string& why_none) {
  const sim::Sheet& sheet = fitted.best.sheets[index];
  std::string why_not_this;
  if (sim::has_given_brightness(sheet))
    why_not_this = "the sheet's brightness was given in its place";
  else if (sim::has_spline_profile(sheet))
    why_not_this = "a free-form height profile has a scale of its own";
  return scaled(sheet.energy_flux_mw_m2, known, fitted, why_not_this, why_none);
}

std::optional<FoundFlux> found_flux_of_footprint(const sim::Scene& known, const FittedPhoto& fitted,
                                                 int footprint, std::string& why_none) {
  return scaled(fitted.best.footprints[footprint].energy_flux_mw_m2, known, fitted, "", why_none);
}

std::vector<DerivedNumber> energy_fluxes(const std::vector<const sim::Scene*>& known,
                                         const FitResult& result) {
  std::vector<DerivedNumber> fluxes;
  for (std::size_t s = 0; s < result.best.sheets.size(); ++s)
    fluxes.push_back(
        energy_flux("sheet", result.best.sheets[s].name, static_cast<int>(s), found_flux, known, result));
  for (std::size_t f = 0; f < result.best.footprints.size(); ++f)
    fluxes.push_back(energy_flux("footprint", result.best.footprints[f].name, static_cast<int>(f),
                                 found_flux_of_footprint, known, result));
  return fluxes;
}

}  // namespace vegard::fit
