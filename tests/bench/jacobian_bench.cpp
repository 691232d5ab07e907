// What derivatives cost: residuals and Jacobian of a fit's cost against one forward render of the same points
// at render speed, on one thread. --tiny shrinks the work to a check that everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "bench_scene.h"
#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/measure/noise_model.h"
#include "fit/measure/profile.h"
#include "interleaved.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/view/film/blur.h"

namespace {

using namespace vegard;

constexpr int kThreads = 1;
constexpr double kBeyond = 0.5;  // as in fit/model/profile_model.cpp
constexpr int kCellWidth = 2;    // of the model's film for 24 bands over 720 pixels, as there

const std::vector<std::string> kTwelve = {
    "sheet.main.center_km",         "sheet.main.bearing_deg",   "sheet.main.length_km",
    "sheet.main.thickness_km",      "sheet.main.wavelength_km", "sheet.main.phase_rad",
    "sheet.main.phase_shift_rad",   "sheet.main.width_km",      "sheet.main.energy_kev",
    "sheet.main.energy_flux_mw_m2", "blur.width_deg.5577"};
// Two of these turn the camera, so that the kernel's tangents by what all beams share are in use.
const std::vector<std::string> kFourMore = {"blur.width_deg.6300", "blur.width_deg.4278",
                                            "camera.azimuth_deg", "camera.elevation_deg"};

sim::Scene scene_with_free(int beams, const std::vector<std::string>& paths) {
  sim::Scene scene = bench::arc_scene(720, 480, beams);
  scene.sheets[0].spacing_jitter = 0.0;  // the fit's model has none, and the points are to be the same
  for (const std::string& path : paths) {
    sim::FreeParameter free;
    free.path = path;
    scene.fit.free.push_back(free);
  }
  return scene;
}

std::vector<sim::ParameterId> ids_of(const std::vector<fit::FreeNumber>& free) {
  std::vector<sim::ParameterId> ids;
  for (const fit::FreeNumber& number : free) ids.push_back(number.id);
  return ids;
}

/// A photograph of the scene as this program renders it, every pixel usable.
fit::Photo photo_of(const sim::Scene& scene) {
  sim::RenderOptions options;
  options.threads = kThreads;
  fit::Photo photo;
  photo.linear = sim::render(scene, options).rgb;
  for (float& value : photo.linear.data) value = std::clamp(value, 0.0f, 1.0f);
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.bits = 16;
  photo.decoding = "linear";
  photo.srgb = false;
  return photo;
}

/// One set of free parameters with its cost, ready to be evaluated near (not at) the truth.
struct Problem {
  sim::Scene scene;
  fit::Region region;
  std::vector<fit::FreeNumber> free;
  fit::ProfileModel model;
  fit::Comparison comparison;
  fit::EvaluationLog log;
  fit::ProfileCost cost;
  std::vector<double> coordinates, residuals, jacobian;
  fit::ModelProfile profile;

  Problem(const sim::Scene& with_free, const fit::Photo& photo)
      : scene(with_free),
        region(fit::checked_region(scene.fit.roi_px, photo.linear.width, photo.linear.height)),
        free(fit::free_numbers(scene)),
        model(scene, photo, region, scene.fit.bands, 1.0, fit::kProfileSmoothing_px, kThreads, 0,
              fit::kLastFineness),
        comparison(
            scene, photo,
            fit::smoothed(fit::extract_profile(photo, region, scene.fit.bands), fit::kProfileSmoothing_px),
            sigma(photo), {1.0, fit::kProfileSmoothing_px, kThreads, {}, 0, fit::kLastFineness}),
        cost(free, {{scene, fit::ParameterMap(scene, free), &comparison}}, log) {
    for (const fit::FreeNumber& number : free) coordinates.push_back(number.coordinate(number.start));
    residuals.resize(cost.num_residuals());
    jacobian.resize(residuals.size() * free.size());
  }

  std::vector<double> sigma(const fit::Photo& photo) const {
    return fit::profile_sigma(fit::extract_profile(photo, region, scene.fit.bands), scene.fit.model_error);
  }
  bool residuals_only() {
    const double* blocks[] = {coordinates.data()};
    return cost.Evaluate(blocks, residuals.data(), nullptr);
  }
  bool residuals_and_jacobian() {
    const double* blocks[] = {coordinates.data()};
    double* jacobians[] = {jacobian.data()};
    return cost.Evaluate(blocks, residuals.data(), jacobians);
  }
  void profile_with_derivatives() { model.evaluate_with_derivatives(scene, ids_of(free), profile); }
  void linear_part() {
    std::vector<double> out;
    const fit::LinearPart& linear = comparison.linear();
    linear.jacobian(profile, linear.solve(profile), out);
    benchmark::DoNotOptimize(out.data());
  }
};

/// A forward render as sim::render does it, from a film of one cell per pixel to blurred rayleighs, without
/// the laying out of the beams (a fit lays them out once, too), the colour and the sky.
struct ForwardRender {
  sim::Scene scene;
  sim::FilmGeometry film;
  sim::BeamExposer exposer;
  sim::Exposure exposure;
  std::vector<float> down, both;

  explicit ForwardRender(const sim::Scene& s)
      : scene(s),
        film(sim::film_for(s, 0, 0, s.camera.width, s.camera.height, 1.0, 1.0)),
        exposer(s, film, kThreads) {}
  void run() {
    exposer.expose(scene, exposure);
    down.resize(exposure.cells());
    both.resize(exposure.cells());
    for (int l = 0; l < exposure.lines; ++l) {
      const sim::BlurKernel kernel = sim::gaussian_kernel(sim::blur_sigma_px(scene, l));
      sim::blur_down(exposure.rayleigh.data() + l * exposure.cells(), down.data(), film.rows, film.columns, 1,
                     kernel, kThreads);
      sim::blur_across(down.data(), both.data(), film.rows, film.columns, 1, kernel, kThreads);
      benchmark::DoNotOptimize(both.data());
    }
  }
};

/// The exposure alone, on the film that the fit's model uses.
struct ModelExposure {
  const sim::Scene& scene;
  std::vector<sim::ParameterId> free;
  sim::BeamExposer exposer;
  sim::Exposure exposure;

  explicit ModelExposure(const Problem& p)
      : scene(p.scene),
        free(ids_of(p.free)),
        exposer(p.scene,
                sim::film_for(p.scene, 0, 0, p.scene.camera.width, p.scene.camera.height, kCellWidth, 1.0),
                kThreads, kBeyond) {}
};

void add(const char* name, const std::function<void()>& body) {
  benchmark::RegisterBenchmark(name,
                               [body](benchmark::State& state) {
                                 body();  // tables and films come into being
                                 for (auto _ : state) body();
                               })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = bench::take_flag(argc, argv, "--tiny");
  const int beams = tiny ? 30 : 4000;
  std::vector<std::string> sixteen = kTwelve;
  sixteen.insert(sixteen.end(), kFourMore.begin(), kFourMore.end());
  const sim::Scene scene = scene_with_free(beams, kTwelve);
  const fit::Photo photo = photo_of(scene);
  Problem twelve(scene, photo), more(scene_with_free(beams, sixteen), photo);
  ForwardRender forward(scene);
  ModelExposure exposure(twelve);
  if (twelve.free.size() != 12 || more.free.size() != 16 || !twelve.residuals_and_jacobian() ||
      !more.residuals_and_jacobian()) {
    fmt::print("the cost cannot be evaluated\n");
    return 1;
  }
  for (double x : twelve.jacobian) {
    if (!std::isfinite(x)) {
      fmt::print("the Jacobian is not finite\n");
      return 1;
    }
  }
  twelve.profile_with_derivatives();

  add("forward_render", [&] { forward.run(); });
  add("residuals", [&] { twelve.residuals_only(); });
  add("residuals_jacobian_12", [&] { twelve.residuals_and_jacobian(); });
  add("residuals_jacobian_16", [&] { more.residuals_and_jacobian(); });
  add("exposure_derivatives_12",
      [&] { exposure.exposer.expose_with_derivatives(scene, exposure.free, exposure.exposure); });
  add("profile_derivatives_12", [&] { twelve.profile_with_derivatives(); });
  add("linear_part_12", [&] { twelve.linear_part(); });
  const bench::TimingsByClock clocks = bench::run_interleaved(argc, argv);
  const bench::Timings& t = clocks.processor;  // everything is on one thread
  for (const char* name : {"forward_render", "residuals", "residuals_jacobian_12", "residuals_jacobian_16",
                           "exposure_derivatives_12", "profile_derivatives_12", "linear_part_12"})
    if (!t.has(name)) return 0;

  fmt::print(
      "\n{} x {}, 3 x {} beams, {} bands, {} thread; deflection points: {} of the render, {} of the fit\n",
      scene.camera.width, scene.camera.height, beams, scene.fit.bands, kThreads,
      forward.exposure.deflection_points, twelve.model.deflection_points());
  fmt::print("  forward render (exposure, 1 x 1 px cells, and blur): {}\n", t.words("forward_render"));
  fmt::print("  residuals only: {}\n", t.words("residuals"));
  fmt::print("  residuals and Jacobian, 12 free: {}\n", t.words("residuals_jacobian_12"));
  fmt::print("    exposure with derivatives, {} x 1 px cells: {}\n", kCellWidth,
             t.words("exposure_derivatives_12"));
  fmt::print("    blur and profile, by difference: {:.2f} ms\n",
             (t.median("profile_derivatives_12") - t.median("exposure_derivatives_12")) * 1e3);
  fmt::print("    linear part: {}\n", t.words("linear_part_12"));
  fmt::print("  residuals and Jacobian, 16 free, the camera among them: {}\n",
             t.words("residuals_jacobian_16"));
  fmt::print("  residuals only / forward render: {}\n", t.ratio("residuals", "forward_render"));
  fmt::print("  16 free / forward render (target <= 6): {}\n",
             t.ratio("residuals_jacobian_16", "forward_render"));
  fmt::print("  residuals and Jacobian, 12 free / forward render (target <= 4.5): {}; wall clock: {}\n",
             t.ratio("residuals_jacobian_12", "forward_render"),
             clocks.wall.ratio("residuals_jacobian_12", "forward_render"));
  return 0;
}
