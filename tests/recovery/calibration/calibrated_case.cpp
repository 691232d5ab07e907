#include "tests/recovery/calibration/calibrated_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/fit.h"
#include "fit/photo/photo.h"
#include "fit/search/descent.h"
#include "fit/search/journal.h"
#include "fit/uncertainty/converged_fit.h"
#include "fit/uncertainty/sampled_uncertainty.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "tests/recovery/calibration/rank_statistic.h"
#include "tests/recovery/scorecard/photograph.h"
#include "tests/recovery/scorecard/truth.h"

namespace vegard::calibration {
namespace {

constexpr double kExposure = 0.7;                         // of the brightest row, of white
constexpr double kPixelNoise = 0.01;                      // of white
constexpr double kFinePicture = 3.0;                      // sim::BeamSampling
const std::array<double, 3> kSky = {0.008, 0.01, 0.012};  // of white
constexpr int kIterations = 60;
// No stream of the simulator's.
constexpr std::uint32_t kTruthTag = 0x5bc0ffeeu, kNoiseTag = 0x5bc0ffefu;

double normal_number(std::uint64_t set, int number, std::uint32_t tag, std::uint32_t index) {
  const sim::Words w =
      sim::philox4x32({static_cast<std::uint32_t>(number), index, 0, tag}, sim::random_key(set));
  return sim::normal_quantile(sim::fine_uniform(w[0], w[1]));
}

std::vector<double> drawn_values(const std::vector<fit::FreeNumber>& free, std::uint64_t set, int number) {
  std::vector<double> values;
  for (std::uint32_t j = 0; j < free.size(); ++j) {
    const sim::Words w =
        sim::philox4x32({static_cast<std::uint32_t>(number), j, 0, kTruthTag}, sim::random_key(set));
    const double u = sim::fine_uniform(w[0], w[1]);
    values.push_back(free[j].logarithmic() ? free[j].min * std::pow(free[j].max / free[j].min, u)
                                           : free[j].min + (free[j].max - free[j].min) * u);
  }
  return values;
}

/// Linear light of the expected picture with normal noise, the brightest pixel at kExposure.
fit::Photo expected_photo(const sim::Scene& truth, std::uint64_t set, int number) {
  const sim::Camera& camera = truth.camera;
  sim::BeamSampling sampling;
  sampling.mean = true;
  sampling.fineness = kFinePicture;
  const sim::FilmGeometry film = sim::film_for(truth, 0, 0, camera.width, camera.height, 1.0, 1.0);
  sim::BeamExposer exposer(truth, film, 1, 0.0, sampling);
  sim::Exposure exposure;
  exposer.expose(truth, exposure);
  fit::Photo photo;
  photo.linear = sim::rgb_from_rayleigh(sim::rayleigh_image(truth, exposure, 1), sim::line_colours(truth));
  const float most = *std::max_element(photo.linear.data.begin(), photo.linear.data.end());
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i)
    photo.linear.data[i] = static_cast<float>(
        photo.linear.data[i] * kExposure / most +
        kPixelNoise * normal_number(set, number, kNoiseTag, static_cast<std::uint32_t>(i)));
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  return photo;
}

Ranks ranks_in(const std::vector<double>& chain, const std::vector<double>& truth) {
  Ranks ranks;
  const std::size_t n = truth.size();
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> series;
    for (std::size_t i = j; i < chain.size(); i += n) series.push_back(chain[i]);
    if (series.size() < kSamples) return {};
    ranks.rank.push_back(rank_of(truth[j], series));
  }
  return ranks;
}

/// The photograph only says what there is to compare and how large sigma is; its profile is then replaced by
/// the model's own at the truth, with noise of exactly that sigma in every bin, independent of all others.
Ranks as_assumed(const sim::Scene& scene, const sim::Scene& truth, const std::vector<double>& values,
                 std::uint64_t set, int number, int steps) {
  const fit::Photo photo = expected_photo(truth, set, number);
  std::vector<fit::Observation> observations;
  observations.push_back(fit::observed(scene, photo, 1));
  fit::Observation& o = observations.front();
  const std::vector<fit::FreeNumber> free = fit::free_numbers(scene);
  fit::Profile data = o.full->data();
  const std::vector<double> model = o.full->profile_model(o.full->at(truth));
  const std::vector<double> sigma = o.full->sigma();
  for (std::size_t i = 0; i < data.mean.size(); ++i)
    data.mean[i] =
        model[i] + sigma[i] * normal_number(set, number, kNoiseTag + 1, static_cast<std::uint32_t>(i));
  o.full = std::make_unique<fit::Comparison>(
      scene, photo, data, sigma,
      fit::Comparison::Resolution{1.0, fit::kProfileSmoothing_px, 1, {}, 0, fit::kLastFineness});

  fit::EvaluationLog log;
  std::vector<fit::TraceRow> trace;
  const fit::SplinePrior none;
  const fit::ProfileCost cost(free, fit::cost_terms(observations, free, fit::Detail::full), log);
  const std::vector<double> answer =
      fit::descend_off_limits(cost, values, kIterations, "calibration", log, trace).values;
  const fit::Uncertainty uncertainty = fit::sampled_uncertainty(
      observations, free, answer, none, {}, 1.0, fit::sampled_jacobians(observations, free, answer, {}, 1));
  const fit::ConvergedFit converged{scene, free, observations, answer, none, 1.0, uncertainty};
  fit::NullJournal journal;
  const sim::EnsembleState state = fit::chain_of_fit(converged, steps, nullptr, journal, {});
  std::vector<double> chain = state.chain;
  for (std::size_t i = 0; i < chain.size(); ++i) chain[i] = free[i % free.size()].value(chain[i]);
  Ranks ranks = ranks_in(chain, values);
  const sim::EnsembleSummary summary = sim::summary_of(state);
  if (!summary.effective.empty())
    ranks.fewest_effective = *std::min_element(summary.effective.begin(), summary.effective.end());
  return ranks;
}

Ranks of_draws(const sim::Scene& scene, const sim::Scene& truth, const std::vector<double>& values,
               int steps) {
  scorecard::Truth photographed;
  photographed.scene = truth;
  photographed.exposure = kExposure;
  // Of a dark sky the code would cut the lower half of the noise off, and so brighten faint light.
  photographed.scene.sky.level = kSky;
  const fit::Photo photo = fit::read_photo_bytes(scorecard::photograph(photographed, 1).bytes,
                                                 "calibration.jpg", fit::Decoding::automatic);
  sim::Scene start = scene;
  fit::start_from(fit::free_numbers(scene), values, start);
  for (std::size_t s = 0; s < start.sheets.size(); ++s) {
    const std::uint64_t seed = start.seed;
    start.sheets[s] = truth.sheets[s];
    start.seed = seed;
  }
  fit::FitOptions options;
  options.threads = 1;
  options.mcmc = steps;
  const fit::FitResult result = fit::fit_photo(start, photo, options);
  if (!result.chain) return {};
  Ranks ranks = ranks_in(result.chain->samples, values);
  ranks.fewest_effective = *std::min_element(result.chain->effective.begin(), result.chain->effective.end());
  ranks.inflation = result.error_inflation;
  return ranks;
}

}  // namespace

sim::Scene calibration_scene() {
  sim::Scene scene;
  scene.seed = 1;
  scene.camera.width = 192;
  scene.camera.height = 128;
  scene.camera.hfov_deg = 60.0;
  scene.camera.elevation_deg = 36.0;
  scene.field.inclination_deg = 78.0;
  sim::Sheet sheet;
  sheet.name = "main";
  sheet.length_km = 700.0;
  sheet.center_km = {0.0, 180.0};
  sheet.bearing_deg = 90.0;
  sheet.layers = 3;
  sheet.beams = 3000;
  sheet.thickness_km = 4.0;
  sheet.wavelength_km = 70.0;
  sheet.phase_rad = 1.0;
  sheet.phase_shift_rad = 0.3;
  sheet.width_km = 1.0;
  sheet.energy_kev = 3.5;
  scene.sheets = {sheet};
  scene.fit.bands = 16;
  scene.fit.scan_points = 0;  // from near the truth
  const auto add = [&](const char* path, double min, double max) {
    sim::FreeParameter free;
    free.path = path;
    free.min = min;
    free.max = max;
    scene.fit.free.push_back(free);
  };
  add("sheet.main.center_km.north", 150.0, 210.0);
  add("sheet.main.bearing_deg", 80.0, 100.0);
  add("sheet.main.thickness_km", 2.0, 6.0);
  add("sheet.main.wavelength_km", 55.0, 90.0);
  add("sheet.main.energy_kev", 2.0, 6.0);
  sim::validate(scene);
  return scene;
}

std::vector<std::string> free_numbers_of_calibration() {
  std::vector<std::string> labels;
  for (const fit::FreeNumber& number : fit::free_numbers(calibration_scene()))
    labels.push_back(number.label());
  return labels;
}

Ranks ranks_of_case(std::uint64_t set, int number, Photographs photographs, int steps) {
  sim::Scene scene = calibration_scene();
  const sim::Words seed =
      sim::philox4x32({static_cast<std::uint32_t>(number), 0, 1, kTruthTag}, sim::random_key(set));
  scene.seed = seed[0];
  const std::vector<fit::FreeNumber> free = fit::free_numbers(scene);
  const std::vector<double> values = drawn_values(free, set, number);
  sim::Scene truth = scene;
  truth.seed = seed[1];
  fit::ParameterMap(scene, free).put(values, truth);
  return photographs == Photographs::as_assumed ? as_assumed(scene, truth, values, set, number, steps)
                                                : of_draws(scene, truth, values, steps);
}

}  // namespace vegard::calibration
