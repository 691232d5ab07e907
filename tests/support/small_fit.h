// A fit's result made by hand: small, complete, and with all that is awkward in it.
#pragma once

#include <cmath>
#include <limits>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"

namespace vegard::tests {

inline fit::Photo small_photo(int width = 40, int height = 30) {
  fit::Photo photo;
  photo.linear = sim::Image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) = 0.02f + 0.3f * static_cast<float>(c == 1 ? y : 0.5 * x) / (width + height);
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.decoding = "sRGB (8-bit JPEG, assumed)";
  photo.file_name = "a <b> & \"c\".jpg";
  photo.sha256 = std::string(64, 'a');
  return photo;
}

/// Two bands of all of small_photo(); one sheet in view; a parameter without error bar; values that are not
/// finite.
inline fit::FitResult small_fit(const fit::Photo& photo) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  fit::FitResult result;
  result.verdict = fit::Verdict::doubtful;
  result.verdict_line = "Doubtful: sheet.main.energy_kev is at a limit.";
  result.reasons = {"sheet.main.energy_kev is at a limit", "something <else>"};
  result.checks = {{"converged", true, "another step would hardly change chi2"},
                   {"inside the limits", false, "sheet.main.energy_kev is at a limit"}};
  result.compared = {{{0, 0, 40, 30}}, 120, 1e4 / 3.0, 0.004, 10};
  fit::FittedParameter energy;
  energy.path = "sheet.main.energy_kev";
  energy.unit = "keV";
  energy.meaning = "characteristic energy E0";
  energy.value = 4.3297520961668114;
  energy.initial = 8.6595041923336229;
  energy.min = 0.1;
  energy.max = 20.0;
  energy.sigma = 0.1234;
  energy.interval68 = {4.21, 4.46};
  energy.at_limit = true;
  energy.moved_sigma = 35.1;
  fit::FittedParameter phase;
  phase.path = "sheet.main.phase_rad";
  phase.unit = "rad";
  phase.meaning = "phase";
  phase.value = 1.0 / 3.0;
  phase.min = -kInfinity;
  phase.max = kInfinity;
  phase.why_no_sigma = "the data do not determine it";
  result.parameters = {energy, phase};
  fit::FittedPhoto fitted;
  fitted.solved = {
      {"gain.band_0", 0.06, 0.001}, {"gain.band_1", 0.05, {}}, {"sky.level.red", 0.0068, 0.0001}};
  result.derived = {{"distance of the main sheet", 220.1, 3.2, "km"}};
  result.correlation = {{1.0, 0.0}, {0.0, 0.0}};
  result.chi2 = 123.456;
  result.chi2_initial = 4e5;
  result.dof = 110;
  result.statistics = {{"profile", 1.0, 100, 100.0}, {"colour", 0.5, 20, 23.456}};
  result.rms_over_peak = std::nan("");
  result.error_inflation = 1.5;
  result.correlated_residuals = 2.25;
  result.termination = "Function tolerance reached.";
  result.evaluations = 321;
  result.jacobian_evaluations = 12;
  result.seed = 9223372036854775807u;

  result.best.seed = result.seed;
  result.best.camera.width = photo.linear.width;
  result.best.camera.height = photo.linear.height;
  sim::Sheet sheet;
  sheet.beams = 40;
  sheet.layers = 1;
  sheet.energy_kev = energy.value;
  result.best.sheets = {sheet};
  result.best.sky.level = {0.01, 0.02, 0.03};
  result.best.sky.gradient = {0.0, 0.01, -0.01};

  fitted.data = fit::extract_profile(
      photo, fit::checked_region({0, 0, 0, 0}, photo.linear.width, photo.linear.height), 2);
  fitted.sigma.assign(fitted.data.mean.size(), 0.01);
  fitted.model = fitted.data.mean;
  for (double& light : fitted.model) light *= 0.98;
  fitted.sigma[0] = 0.0;  // not used
  fitted.gain = {{0.06, 0.06, 0.06}, {0.04, 0.04, 0.04}};
  fitted.best = result.best;
  fitted.rms_over_peak = result.rms_over_peak;
  fitted.decoding = photo.decoding;
  result.photos = {fitted};
  result.trace = {{"start", 1, 4e5, {8.66, 0.0}},
                  {"scan, \"wide\"", 100, 300.0, {5.0, 0.1}},
                  {"polish", 321, 123.456, {4.33, 1.0 / 3.0}}};
  result.inputs = {{"scene", "h000.toml", std::string(64, 'b')}, {"photo", photo.file_name, photo.sha256}};
  result.command = "vegard fit h000.toml --photo 'a <b> & \"c\".jpg' --out run";
  return result;
}

}  // namespace vegard::tests
