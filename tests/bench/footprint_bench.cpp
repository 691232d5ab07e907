// How fast the march through a footprint is: an auroral oval on a cube's face of 4096 cells, seen from 400 km
// above 65 degrees north, in 1280 x 853 pixels with steps of 2 km; against a simple march of sixteen rays
// side by side that passes over nothing; and how the cost grows with pixels, steps and footprint. --tiny
// shrinks the work to a check that everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "footprint_floor.h"
#include "interleaved.h"
#include "sim/base/parallel.h"
#include "sim/emit/footprint/footprint_emitter.h"
#include "sim/emit/footprint/lit_map.h"
#include "sim/render/film.h"
#include "sim/view/camera/camera.h"
#include "tests/support/glow.h"

namespace {

using namespace vegard;

constexpr int kOvalFace = 4;  // about the north pole

/// Folded arcs about 67 degrees of latitude, wider by night than by day.
double oval(double u, double v) {
  const double latitude = std::atan2(1.0, std::hypot(u, v)) / sim::kRadiansPerDegree,
               longitude = std::atan2(v, u);
  const double width = 0.6 + 0.35 * std::cos(longitude + 2.0);
  const double fold = std::sin(23.0 * longitude + 4.0 * std::sin(7.0 * longitude));
  const double arc = std::exp(-0.5 * std::pow((latitude - 67.0 - 0.6 * fold) / 0.15, 2));
  const double wide = 0.3 * std::exp(-0.5 * std::pow((latitude - 67.0) / width, 2));
  return 5.0 * (arc + wide);
}

sim::CubeFootprint<double> oval_map(int cells) {
  sim::CubeFootprint<double> map;
  map.face_cells = cells;
  sim::FootprintGrid<double>& grid = map.face[kOvalFace];
  grid.columns = grid.rows = cells + 2;
  grid.flux_mw_m2.resize(grid.cells());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.flux_mw_m2[static_cast<std::size_t>(row) * grid.columns + column] =
          oval((column - 0.5) * 2.0 / cells - 1.0, (row - 0.5) * 2.0 / cells - 1.0);
  return map;
}

/// Everything that a march needs, made beforehand.
struct Workload {
  std::string name;
  sim::Scene scene;
  sim::FilmGeometry film;
  std::shared_ptr<const sim::CubeFootprint<double>> map;
  sim::TexelStore texels;
  std::vector<sim::LitMap> lit;
  std::unique_ptr<sim::StepProfile> profile;
  std::unique_ptr<sim::MarchRays> rays;
  sim::FootprintKernel skipping, not_skipping;
  std::vector<std::vector<double>> direction[3];  ///< [axis][row][column]
  std::vector<std::vector<double>> end_km;
  std::unique_ptr<sim::Emitter<double>> emitter;

  Workload(const std::string& title, int width, int height, double step_km,
           std::shared_ptr<const sim::CubeFootprint<double>> footprint)
      : name(title), map(std::move(footprint)) {
    scene.site.latitude_deg = 65.0;
    scene.site.altitude_m = 400e3;
    scene.camera.width = width;
    scene.camera.height = height;
    scene.camera.elevation_deg = -22.0;
    scene.camera.azimuth_deg = 0.0;
    scene.march.step_km = step_km;
    sim::Footprint shell;
    shell.shape = sim::FootprintShape::shell;
    scene.footprints.push_back(shell);
    film = sim::film_for(scene, 0, 0, width, height, 1.0, 1.0);
    sim::ProfileTable profiles;
    profiles.of_energy.push_back(sim::maxwellian_profile(tests::glow(), {630.0, 557.7, 427.8}, 3.0));
    profile = std::make_unique<sim::StepProfile>(profiles, shell.top_km, step_km);
    rays = std::make_unique<sim::MarchRays>(scene, shell, profile->bottom_km());
    double least = 0.0;
    for (const double flux : map->face[kOvalFace].flux_mw_m2) least = std::max(least, flux * sim::kDarkShare);
    texels = sim::TexelStore(map->face[kOvalFace], least, false);
    std::array<std::vector<std::uint8_t>, 6> marks;
    marks[kOvalFace] = sim::lit_texels(map->face[kOvalFace], least);
    lit = sim::cube_lit_maps(map->face_cells, marks, 2);
    not_skipping.projection = sim::FootProjection::shell;
    not_skipping.texels = 0.5 * map->face_cells;
    not_skipping.first_x = not_skipping.first_y = 0.5 * map->face_cells + 0.5;
    not_skipping.window[kOvalFace] = texels.window();
    not_skipping.profile = profile.get();
    skipping = not_skipping;
    for (int face = 0; face < 6; ++face) skipping.lit[face] = &lit[face];
    aim();
  }

  void aim() {
    const sim::CameraView<double> view = sim::camera_view<double>(
        scene.camera, [&](sim::CameraNumber which) { return sim::camera_number(scene.camera, which); });
    for (auto& axis : direction) axis.resize(film.rows);
    end_km.resize(film.rows);
    for (int row = 0; row < film.rows; ++row)
      for (int column = 0; column < film.columns; ++column) {
        double enu[3];
        if (!sim::enu_of_cell(view, film, row, column, enu)) continue;
        for (int axis = 0; axis < 3; ++axis) direction[axis][row].push_back(enu[axis]);
        end_km[row].push_back(sim::ground_km(400.0, enu[2]));
      }
  }

  /// Cuts each row's rays and marches them. Returns the steps.
  template <class March>
  std::size_t run(int threads, const March& march) const {
    std::atomic<std::size_t> steps{0};
    sim::parallel_for(film.rows, threads, [&](std::size_t row, int) {
      thread_local std::vector<sim::MarchSpan> spans;
      thread_local std::vector<sim::SpanLight> light;
      spans.clear();
      for (std::size_t i = 0; i < end_km[row].size(); ++i) {
        const double enu[3] = {direction[0][row][i], direction[1][row][i], direction[2][row][i]};
        sim::MarchSpan cut[2];
        const int count = rays->cut(enu, end_km[row][i], cut);
        spans.insert(spans.end(), cut, cut + count);
      }
      light.resize(spans.size());
      steps += march(spans.data(), spans.size(), light.data());
    });
    return steps;
  }
  std::size_t run_product(int threads, bool skip) const {
    return run(threads, [&](const sim::MarchSpan* spans, std::size_t count, sim::SpanLight* light) {
      return sim::march_spans(skip ? skipping : not_skipping, spans, count, light);
    });
  }
  std::size_t run_floor(int threads) const {
    return run(threads, [&](const sim::MarchSpan* spans, std::size_t count, sim::SpanLight* light) {
      return bench::march_side_by_side(not_skipping, kOvalFace, spans, count, light);
    });
  }
  std::size_t run_cutting(int threads) const {
    return run(threads, [&](const sim::MarchSpan*, std::size_t, sim::SpanLight*) { return std::size_t{0}; });
  }

  void register_benchmarks(bool against_floor) {
    const auto add = [&](const char* what, const std::function<std::size_t()>& work) {
      benchmark::RegisterBenchmark((name + what).c_str(),
                                   [work](benchmark::State& state) {
                                     for (auto _ : state) benchmark::DoNotOptimize(work());
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    };
    add("/march_threads_2", [this] { return run_product(2, true); });
    if (!against_floor) return;
    add("/march_threads_1", [this] { return run_product(1, true); });
    add("/no_skip_threads_2", [this] { return run_product(2, false); });
    add("/floor_threads_2", [this] { return run_floor(2); });
    add("/cutting_threads_2", [this] { return run_cutting(2); });
  }

  void report(const bench::Timings& t) const {
    const std::string march = name + "/march_threads_2";
    if (!t.has(march)) return;
    const double steps = static_cast<double>(run_product(2, true)),
                 all = static_cast<double>(run_product(2, false));
    fmt::print("\n{}: {} x {} pixels, step {} km, faces of {} cells\n", name, film.columns, film.rows,
               scene.march.step_km, map->face_cells);
    fmt::print(
        "  march, 2 threads: {}\n    {:.1f} million steps of {:.1f} million; {:.0f} million of all steps/s, "
        "{:.0f} million marched ones/s\n",
        t.words(march), steps * 1e-6, all * 1e-6, all / t.median(march) * 1e-6,
        steps / t.median(march) * 1e-6);
    if (!t.has(name + "/floor_threads_2")) return;
    fmt::print("  the same on one thread: {}; gain of the second: {}\n", t.words(name + "/march_threads_1"),
               t.ratio(name + "/march_threads_1", march));
    fmt::print("  passing over nothing: {}; over the march: {}\n", t.words(name + "/no_skip_threads_2"),
               t.ratio(name + "/no_skip_threads_2", march));
    fmt::print("  sixteen rays side by side: {}; {:.0f} million steps/s; over the march (target > 1): {}\n",
               t.words(name + "/floor_threads_2"), all / t.median(name + "/floor_threads_2") * 1e-6,
               t.ratio(name + "/floor_threads_2", march));
    fmt::print("  of it the cutting of the rays into spans: {}\n", t.words(name + "/cutting_threads_2"));
  }

  /// The two must draw the same picture, but for where in their steps they read the profile.
  bool floor_agrees() const {
    double floor = 0.0, product = 0.0;
    const auto sum = [](const sim::SpanLight* light, std::size_t count, double& to) {
      for (std::size_t i = 0; i < count; ++i) to += light[i].rayleigh[1];
    };
    run(1, [&](const sim::MarchSpan* spans, std::size_t count, sim::SpanLight* light) {
      bench::march_side_by_side(not_skipping, kOvalFace, spans, count, light);
      sum(light, count, floor);
      sim::march_spans(skipping, spans, count, light);
      sum(light, count, product);
      return count;
    });
    return product > 0.0 && std::abs(floor / product - 1.0) < 0.02;
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = bench::take_flag(argc, argv, "--tiny");
  std::vector<std::unique_ptr<Workload>> workloads;
  const auto map = [&](int cells) {
    return std::make_shared<const sim::CubeFootprint<double>>(oval_map(tiny ? cells / 16 : cells));
  };
  const auto fine = map(4096), middle = map(2048), coarse = map(1024);
  const auto add = [&](const std::string& name, int width, int height, double step_km,
                       const auto& footprint) {
    workloads.push_back(std::make_unique<Workload>(name, tiny ? width / 16 : width,
                                                   tiny ? height / 16 : height, step_km, footprint));
  };
  add("orbit", 1280, 853, 2.0, fine);
  add("half_the_pixels_across", 640, 426, 2.0, fine);
  add("step_1", 1280, 853, 1.0, fine);
  add("step_4", 1280, 853, 4.0, fine);
  add("cells_2048", 1280, 853, 2.0, middle);
  add("cells_1024", 1280, 853, 2.0, coarse);
  if (!workloads.front()->floor_agrees()) {
    fmt::print("the floor's light differs from the march's\n");
    return 1;
  }
  for (const auto& workload : workloads) workload->register_benchmarks(workload == workloads.front());
  const bench::TimingsByClock timings = bench::run_interleaved(argc, argv);
  for (const auto& workload : workloads) workload->report(timings.wall);
  return 0;
}
