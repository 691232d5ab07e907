#include "fit/sequence.h"

#include <algorithm>
#include <cmath>

#include "fit/free_parameters.h"
#include "sim/view/line_colours.h"

namespace vegard::fit {
namespace {

/// Starts at the values of another frame. Entries for a vector become one for each of its components.
sim::Scene started_at(const sim::Scene& scene, const std::vector<double>& values) {
  const std::vector<FreeNumber> free = free_numbers(scene);
  sim::Scene warm = scene;
  warm.fit.free.clear();
  for (const sim::FreeParameter& entry : scene.fit.free) {
    if (entry.path.empty()) {  // a number that only expressions use
      warm.fit.free.push_back(entry);
      for (std::size_t j = 0; j < free.size() && j < values.size(); ++j)
        if (free[j].name == entry.name)
          warm.fit.free.back().start = std::clamp(values[j], free[j].min, free[j].max);
      continue;
    }
    for (const sim::ParameterPath& path : sim::resolve(scene, entry.path)) {
      sim::FreeParameter one = entry;
      one.path = path.text;
      for (std::size_t j = 0; j < free.size() && j < values.size(); ++j)
        if (free[j].path.text == path.text) one.start = std::clamp(values[j], free[j].min, free[j].max);
      warm.fit.free.push_back(one);
    }
  }
  return warm;
}

bool is_better(const FitResult& a, const FitResult& b) {
  return a.verdict != b.verdict ? a.verdict < b.verdict : a.chi2 < b.chi2;
}

/// The relative standard deviation of the mean of a photograph's gains; none if none of them has one.
std::optional<double> relative_sigma_of_gain(const FittedPhoto& photo) {
  double sum = 0.0, variance = 0.0;
  for (const SolvedNumber& solved : photo.solved) {
    if (solved.name.compare(0, 4, "gain") != 0 || solved.value <= 0.0) continue;
    if (!solved.sigma) return {};
    sum += solved.value;
    variance += *solved.sigma * *solved.sigma;
  }
  if (sum <= 0.0) return {};
  return std::sqrt(variance) / sum;
}

}  // namespace

FrameFit fit_frame(const sim::Scene& scene, const Photo& photo, double time_s, const SequenceRow* before,
                   const FitOptions& options) {
  sim::Scene of_frame = scene;
  of_frame.time.start_s = time_s;
  const bool has_answer =
      before != nullptr && (before->verdict == Verdict::good || before->verdict == Verdict::doubtful);
  if (!has_answer) return {fit_photo(of_frame, photo, options), true};

  sim::Scene warm = started_at(of_frame, before->values);
  warm.fit.scan_points = 0;
  FrameFit frame{fit_photo(warm, photo, options), false};
  if (frame.result.verdict == Verdict::good || frame.result.verdict == Verdict::interrupted) return frame;
  warm.fit.scan_points = scene.fit.scan_points;
  FitResult searched = fit_photo(before->verdict == Verdict::good ? warm : of_frame, photo, options);
  if (is_better(searched, frame.result)) frame = {std::move(searched), true};
  return frame;
}

SequenceRow sequence_row(const std::string& frame, double time_s, const sim::Scene& scene,
                         const FrameFit& fit, const Photo& photo) {
  const FitResult& result = fit.result;
  SequenceRow row;
  row.frame = frame;
  row.time_s = time_s;
  row.photo_sha256 = photo.sha256;
  row.decoding = photo.decoding;
  row.verdict = result.verdict;
  row.searched = fit.searched;
  row.chi2_per_dof = result.dof > 0 ? result.chi2 / result.dof : 0.0;
  for (const FittedParameter& p : result.parameters) {
    row.values.push_back(p.value);
    if (!p.of_profile) row.numbers.push_back({p.path, p.unit, p.value, p.sigma});
  }
  const FittedPhoto& fitted = result.photos.front();
  if (scene.sensor.calibration_error > 0.0) {
    const double share = fitted.best.sensor.gain_per_kilorayleigh / sim::gain_per_kilorayleigh(scene);
    const std::optional<double> of_gain = relative_sigma_of_gain(fitted);
    for (const sim::Sheet& sheet : fitted.best.sheets) {
      const std::string path = "sheet." + sheet.name + ".energy_flux_mw_m2";
      const auto is_it = [&](const FittedParameter& p) { return p.path == path; };
      if (sheet.brightness_kilorayleigh > 0.0 ||
          std::any_of(result.parameters.begin(), result.parameters.end(), is_it))
        continue;
      SequenceNumber flux{path, "mW m\u207b\u00b2", sheet.energy_flux_mw_m2 * share, {}};
      if (of_gain) flux.sigma = flux.value * std::hypot(*of_gain, scene.sensor.calibration_error);
      row.numbers.push_back(flux);
    }
  }
  for (const DerivedNumber& d : result.derived) row.numbers.push_back({d.name, d.unit, d.value, d.sigma});
  return row;
}

}  // namespace vegard::fit
