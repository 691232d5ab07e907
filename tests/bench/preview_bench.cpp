// What a preview's frame costs: 640 x 360 of an aurora by its footprint, from the ground and from orbit, on
// two threads, the camera turning by half a degree a frame. --tiny shrinks the work to a check that
// everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <string>
#include <utility>
#include <vector>

#include "apps/preview/preview_painter.h"
#include "interleaved.h"

namespace {

using namespace vegard;

sim::Scene folded_arc(bool from_orbit) {
  sim::Scene scene;
  scene.camera.width = 1280;
  scene.camera.height = 720;
  scene.camera.hfov_deg = from_orbit ? 60.0 : 75.0;
  scene.camera.elevation_deg = from_orbit ? -19.0 : 28.0;
  if (from_orbit) scene.site.altitude_m = 400e3;
  sim::Footprint arc;
  arc.center_km = {0.0, from_orbit ? 1100.0 : 220.0};
  arc.size_km = {1200.0, 600.0};
  arc.east_km = {-550.0, -300.0, -120.0, 0.0, 80.0, 300.0, 550.0};
  arc.north_km = {40.0, -30.0, 60.0, -60.0, 40.0, -20.0, 30.0};
  arc.width_km = 4.0;
  scene.footprints.push_back(arc);
  return scene;
}

/// Seconds of a frame that can be had at the rate that is aimed at.
constexpr double kTarget = 0.05;

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = vegard::bench::take_flag(argc, argv, "--tiny");
  sim::Reduction reduction;
  if (tiny) reduction.most = {64, 36};
  const std::vector<std::pair<std::string, bool>> views = {{"ground", false}, {"orbit", true}};
  for (const auto& [name, from_orbit] : views)
    benchmark::RegisterBenchmark((name + "/threads_2").c_str(),
                                 [reduction, from_orbit = from_orbit](benchmark::State& state) {
                                   sim::Scene scene = folded_arc(from_orbit);
                                   apps::PreviewPainter painter(2);
                                   painter.paint(scene, reduction);
                                   for (auto _ : state) {
                                     scene.camera.azimuth_deg += 0.5;
                                     if (scene.camera.azimuth_deg > 15.0) scene.camera.azimuth_deg = -15.0;
                                     benchmark::DoNotOptimize(painter.paint(scene, reduction).rgb.data());
                                   }
                                 })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  const vegard::bench::TimingsByClock timings = vegard::bench::run_interleaved(argc, argv);
  for (const auto& view : views) {
    const std::string name = view.first + "/threads_2";
    if (timings.wall.has(name))
      fmt::print("{}: {} a frame, {:.1f} frames per second (target 20): {:.2f} of the time that there is\n",
                 view.first, timings.wall.words(name), 1.0 / timings.wall.median(name),
                 timings.wall.median(name) / kTarget);
  }
}
