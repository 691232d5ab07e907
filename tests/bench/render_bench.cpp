// How fast the renderer is: against a floor that only adds precomputed light at precomputed places, and on
// two threads. The floor takes the very points that the renderer splats, in the same order, onto a film of
// the same layout; the renderer does random numbers, geometry, tables, the clearing of its film and its
// merging inside the timed region. --tiny shrinks the work to a check that everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "bench_scene.h"
#include "interleaved.h"
#include "sim/render/film.h"
#include "sim/render/kernel.h"

namespace {

using namespace vegard;

constexpr int kStride = 4;  // of three lines on the film

/// One scene with everything that its benchmarks need, made beforehand.
struct Workload {
  std::string name;
  sim::Scene scene, empty_scene;
  sim::FilmGeometry film;
  sim::SplatRecord record;
  std::vector<std::int64_t> floor_film;
  sim::Exposure exposure;
  std::uint64_t computed = 0;

  Workload(const std::string& title, int width, int height, int beams)
      : name(title), scene(bench::arc_scene(width, height, beams)), empty_scene(scene) {
    empty_scene.sheets[0].beams = empty_scene.sheets[0].layers = 1;
    film = sim::film_for(scene, 0, 0, width, height, 1.0, 1.0);
    floor_film.assign(static_cast<std::size_t>(film.rows) * film.columns * kStride, 0);
    sim::Exposer exposer(scene, film, 1);
    exposer.expose(scene, exposure);
    computed = exposure.deflection_points;
    exposer.record_splats(scene, record);
  }

  void run_floor() {
    sim::splat_on_film(film, kStride, record.column.data(), record.row.data(), record.weights.data(),
                       record.points(), floor_film.data());
  }

  /// The floor would be no floor of this renderer if it did not give the same picture.
  bool floor_matches_renderer() {
    std::fill(floor_film.begin(), floor_film.end(), 0);
    run_floor();
    const std::size_t cells = exposure.cells();
    for (std::size_t i = 0; i < cells; ++i)
      for (int l = 0; l < exposure.lines; ++l)
        if (exposure.rayleigh[l * cells + i] !=
            static_cast<float>(static_cast<double>(floor_film[i * kStride + l]) / sim::kFilmUnitsPerRayleigh))
          return false;
    return true;
  }

  void register_benchmarks() {
    const auto add = [&](const std::string& what, auto body) {
      benchmark::RegisterBenchmark((name + what).c_str(), body)->UseRealTime()->Unit(benchmark::kMillisecond);
    };
    add("/floor", [this](benchmark::State& state) {
      for (auto _ : state) run_floor();
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(record.points()));
    });
    for (int threads : {1, 2}) {
      add(fmt::format("/render_threads_{}", threads), [this, threads](benchmark::State& state) {
        sim::Exposer exposer(scene, film, threads);
        exposer.expose(scene, exposure);
        for (auto _ : state) exposer.expose(scene, exposure);
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(computed));
      });
      add(fmt::format("/film_only_threads_{}", threads), [this, threads](benchmark::State& state) {
        sim::Exposer exposer(empty_scene, film, threads);
        exposer.expose(empty_scene, exposure);
        for (auto _ : state) exposer.expose(empty_scene, exposure);
      });
    }
  }

  void report(const bench::TimingsByClock& clocks) const {
    const bench::Timings &t = clocks.wall, &processor = clocks.processor;
    const std::string floor = name + "/floor", one = name + "/render_threads_1",
                      two = name + "/render_threads_2", film_one = name + "/film_only_threads_1",
                      film_two = name + "/film_only_threads_2";
    if (!t.has(floor) || !t.has(one) || !t.has(two)) return;
    const double splatted = static_cast<double>(record.points());
    const auto rates = [&](const std::string& what) {
      return fmt::format("{:.1f} million points computed/s, {:.1f} million splatted/s",
                         static_cast<double>(computed) / t.median(what) * 1e-6,
                         splatted / t.median(what) * 1e-6);
    };
    fmt::print("\n{}: film of {} x {} cells, {} deflection points computed, {} of them splatted\n", name,
               film.columns, film.rows, computed, record.points());
    fmt::print("  floor: splat_on_film in sim/render/kernel.cpp, {}\n    {:.1f} million points splatted/s\n",
               t.words(floor), splatted / t.median(floor) * 1e-6);
    fmt::print("  renderer, 1 thread: {}\n    {}\n", t.words(one), rates(one));
    fmt::print("  renderer, 2 threads: {}\n    {}\n", t.words(two), rates(two));
    if (t.has(film_one) && t.has(film_two))
      fmt::print("  of which film clearing, merging and tables: 1 thread {}, 2 threads {}\n",
                 t.words(film_one), t.words(film_two));
    fmt::print(
        "  renderer's rate / floor's rate, same points, 1 thread (target >= 0.5): {}; processor time: {}\n",
        t.ratio(floor, one), processor.ratio(floor, one));
    fmt::print("  rate on two threads / rate on one (target >= 1.8): {}\n", t.ratio(one, two));
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = vegard::bench::take_flag(argc, argv, "--tiny");
  std::vector<std::unique_ptr<Workload>> workloads;
  workloads.push_back(std::make_unique<Workload>("720x480", 720, 480, tiny ? 20 : 4000));
  if (!tiny) workloads.push_back(std::make_unique<Workload>("1280x853", 1280, 853, 33334));
  for (const auto& workload : workloads) {
    if (!workload->floor_matches_renderer()) {
      fmt::print("{}: the floor's film differs from the renderer's\n", workload->name);
      return 1;
    }
    workload->register_benchmarks();
  }
  const vegard::bench::TimingsByClock timings = vegard::bench::run_interleaved(argc, argv);
  fmt::print(
      "\nFloor: splat_on_film in sim/render/kernel.cpp, precomputed weights at precomputed places, bilinear, "
      "three lines at stride {}, 64-bit integer film; instruction set {}.\n"
      "Its film is the renderer's, bit for bit.\n",
      kStride, vegard::sim::kernel_instruction_set());
  for (const auto& workload : workloads) workload->report(timings);
  return 0;
}
