// What Python adds: residuals and Jacobian of one cost, asked from C++ as Ceres asks and through the module,
// in turns, on one thread. --tiny shrinks the work to a check that everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <pybind11/embed.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "bench_scene.h"
#include "fit/photo/photo.h"
#include "fit/scene_cost.h"
#include "interleaved.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"

namespace {

using namespace vegard;
namespace py = pybind11;

constexpr int kThreads = 1;

sim::Scene scene_of(int beams) {
  sim::Scene scene = bench::arc_scene(720, 480, beams);
  for (const char* path : {"sheet.main.center_km", "sheet.main.bearing_deg", "sheet.main.thickness_km",
                           "sheet.main.energy_kev", "sheet.main.energy_flux_mw_m2"}) {
    sim::FreeParameter free;
    free.path = path;
    scene.fit.free.push_back(free);
  }
  return sim::parse_scene(sim::write_scene(scene), "bench.toml");  // as the module reads it
}

void add(const char* name, const std::function<void()>& body) {
  benchmark::RegisterBenchmark(name,
                               [body](benchmark::State& state) {
                                 body();
                                 for (auto _ : state) body();
                               })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = bench::take_flag(argc, argv, "--tiny");
  const sim::Scene scene = scene_of(tiny ? 30 : 4000);
  sim::Image light = sim::render(scene, {}).rgb;
  for (float& value : light.data) value = std::clamp(value, 0.0f, 1.0f);

  const fit::Photo photo = fit::photo_of_light(light, {}, "array");
  const fit::SceneCost cost(scene, {&photo}, kThreads);
  const std::vector<double> values = cost.start();
  const std::vector<double> at = cost.cost().coordinates(values);
  std::vector<double> residuals(static_cast<std::size_t>(cost.residuals())),
      jacobian(residuals.size() * values.size());
  const double* parameters[] = {at.data()};
  double* jacobians[] = {jacobian.data()};

  const py::scoped_interpreter interpreter;
  py::module_::import("sys").attr("path").attr("insert")(0, VEGARD_PYTHON_MODULES);
  const py::module_ vegard_module = py::module_::import("vegard");
  const py::array_t<float> pixels({light.height, light.width, 3}, light.data.data());
  const py::object python_cost =
      vegard_module.attr("parse")(sim::write_scene(scene))
          .attr("cost")(vegard_module.attr("photo_of_light")(pixels), py::arg("threads") = kThreads);
  const py::array_t<double> point(static_cast<py::ssize_t>(values.size()), values.data());

  // Not a benchmark of something else: both say the same.
  if (!cost.cost().Evaluate(parameters, residuals.data(), nullptr)) return 1;
  const auto through_python = python_cost.attr("residuals")(point).cast<py::array_t<double>>();
  if (through_python.size() != static_cast<py::ssize_t>(residuals.size()) ||
      !std::equal(residuals.begin(), residuals.end(), through_python.data())) {
    fmt::print("the module's residuals are others\n");
    return 1;
  }

  add("residuals_cpp", [&] { cost.cost().Evaluate(parameters, residuals.data(), nullptr); });
  add("residuals_python", [&] { python_cost.attr("residuals")(point); });
  add("jacobian_cpp", [&] { cost.cost().Evaluate(parameters, residuals.data(), jacobians); });
  add("jacobian_python", [&] { python_cost.attr("residuals_and_jacobian")(point); });
  const bench::TimingsByClock clocks = bench::run_interleaved(argc, argv);
  const bench::Timings& t = clocks.processor;  // everything is on one thread
  for (const char* name : {"residuals_cpp", "residuals_python", "jacobian_cpp", "jacobian_python"})
    if (!t.has(name)) return 0;
  fmt::print("\n{} residuals, {} free parameters, {} thread\n", residuals.size(), values.size(), kThreads);
  fmt::print("  residuals: C++ {}, Python {}\n", t.words("residuals_cpp"), t.words("residuals_python"));
  fmt::print("  residuals and Jacobian: C++ {}, Python {}\n", t.words("jacobian_cpp"),
             t.words("jacobian_python"));
  fmt::print("  residuals, Python / C++ (target <= 1.03): {}; wall clock: {}\n",
             t.ratio("residuals_python", "residuals_cpp"),
             clocks.wall.ratio("residuals_python", "residuals_cpp"));
  fmt::print("  residuals and Jacobian, Python / C++ (target <= 1.03): {}; wall clock: {}\n",
             t.ratio("jacobian_python", "jacobian_cpp"),
             clocks.wall.ratio("jacobian_python", "jacobian_cpp"));
  return 0;
}
