// How fast the renderer is: against a floor that only adds precomputed light at precomputed places, and on
// two threads. The floor takes the very points that the renderer splats, in the same order, onto a film of
// the same layout; the renderer does everything else inside the timed region: random numbers, geometry,
// tables, the clearing of its film and its merging, and in the whole renderings (from the scene to the
// rayleigh images) also the beams' layout, the memory and the blur. --tiny shrinks the work to a check that
// everything still runs.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "bench_scene.h"
#include "interleaved.h"
#include "sim/base/parallel.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/beams/beams.h"
#include "sim/render/beams/kernel.h"
#include "sim/render/film.h"
#include "sim/render/render.h"

namespace {

using namespace vegard;

constexpr int kStride = 4;  // of three lines on the film

/// One scene with everything that its benchmarks need, made beforehand.
struct Workload {
  std::string name;
  bool whole;  ///< from the scene to the blurred images; otherwise the exposure of a film alone, as a fit
               ///< repeats it
  double target;
  sim::Scene scene, empty_scene;
  sim::FilmGeometry film;
  sim::SplatRecord record;
  sim::LargeVector<std::int64_t> floor_film, second_floor_film;
  sim::Exposure exposure;
  std::uint64_t computed = 0;
  std::size_t beams = 0;
  // For the phases.
  std::vector<sim::HeightProfile> profiles;
  sim::KernelScene kernel;
  std::unique_ptr<sim::BeamLayout> layout;
  std::vector<sim::PackedChunk> packed;

  Workload(const std::string& title, int width, int height, int beams_per_layer, double path_step,
           bool whole_rendering, double ratio_target)
      : name(title),
        whole(whole_rendering),
        target(ratio_target),
        scene(bench::arc_scene(width, height, beams_per_layer, path_step)),
        empty_scene(scene) {
    empty_scene.sheets[0].beams = empty_scene.sheets[0].layers = 1;
    film = sim::film_for(scene, 0, 0, width, height, 1.0, 1.0);
    floor_film.assign(static_cast<std::size_t>(film.rows) * film.columns * kStride, 0);
    second_floor_film = floor_film;
    sim::BeamExposer exposer(scene, film, 1);
    exposer.expose(scene, exposure);
    computed = exposure.deflection_points;
    exposer.record_splats(scene, record);
    beams = static_cast<std::size_t>(beams_per_layer) * scene.sheets[0].layers;
    profiles = sim::height_profiles(scene);
    layout = std::make_unique<sim::BeamLayout>(scene, 0.0);
    kernel = sim::kernel_scene(scene, scene.sheets[0], layout->path_step(0), film, profiles);
    packed.resize(layout->chunks().size());
    run_packing();
  }

  void run_floor() {
    sim::splat_on_film(film, kStride, record.column.data(), record.row.data(), record.weights.data(),
                       record.points(), floor_film.data());
  }
  /// Two floors side by side, each with half of the points and a film of its own that nobody merges.
  void run_floor_on_two_threads() {
    sim::parallel_for(2, 2, [this](std::size_t half, int) {
      const std::size_t first = half * (record.points() / 2);
      const std::size_t count = half == 0 ? record.points() / 2 : record.points() - first;
      sim::splat_on_film(film, kStride, record.column.data() + first, record.row.data() + first,
                         record.weights.data() + first * kStride, count,
                         half == 0 ? floor_film.data() : second_floor_film.data());
    });
  }
  void run_packing() {
    for (std::size_t c = 0; c < packed.size(); ++c)
      layout->pack(scene, layout->chunks()[c], kernel, packed[c]);
  }
  void run_whole(int threads) {
    sim::Exposure fresh;
    {
      sim::BeamExposer exposer(scene, film, threads);
      exposer.expose(scene, fresh);
    }
    benchmark::DoNotOptimize(sim::rayleigh_image(scene, fresh, threads).data.data());
  }
  template <class Fall>
  void run_all(const Fall& fall) {
    for (const sim::PackedChunk& chunk : packed)
      benchmark::DoNotOptimize(fall(chunk.groups.data(), chunk.groups.size()));
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

  void add(const std::string& what, std::uint64_t items, const std::function<void()>& body) {
    benchmark::RegisterBenchmark(
        (name + what).c_str(),
        [body, items](benchmark::State& state) {
          body();
          for (auto _ : state) body();
          state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
        })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  }

  void register_benchmarks() {
    add("/floor", record.points(), [this] { run_floor(); });
    add("/floor_threads_2", record.points(), [this] { run_floor_on_two_threads(); });
    for (int threads : {1, 2}) {
      const auto exposing = [this, threads](const sim::Scene& of) {
        const auto exposer = std::make_shared<sim::BeamExposer>(of, film, threads);
        return [this, exposer, &of] { exposer->expose(of, exposure); };
      };
      if (whole)
        add(fmt::format("/render_threads_{}", threads), computed, [this, threads] { run_whole(threads); });
      else
        add(fmt::format("/render_threads_{}", threads), computed, exposing(scene));
      add(fmt::format("/film_threads_{}", threads), 0, exposing(empty_scene));
      if (whole)
        add(fmt::format("/blur_threads_{}", threads), 0, [this, threads] {
          benchmark::DoNotOptimize(sim::rayleigh_image(scene, exposure, threads).data.data());
        });
    }
    if (whole)
      add("/layout", beams, [this] { benchmark::DoNotOptimize(sim::BeamLayout(scene, 0.0).instants()); });
    add("/packing", beams, [this] { run_packing(); });
    const auto until = [this](sim::FallPhase phase) {
      return [this, phase] {
        run_all([&](const sim::BeamGroup* groups, std::size_t count) {
          return sim::fall_until(kernel, groups, count, phase);
        });
      };
    };
    add("/path", computed, until(sim::FallPhase::path));
    add("/samples", computed, until(sim::FallPhase::samples));
    add("/samples_and_splat", computed, [this] {
      run_all([&](const sim::BeamGroup* groups, std::size_t count) {
        return sim::fall_on_film(kernel, groups, count, floor_film.data());
      });
    });
  }

  void report(const bench::TimingsByClock& clocks) const {
    const bench::Timings &t = clocks.wall, &processor = clocks.processor;
    const auto named = [&](const char* what) { return name + what; };
    const std::string floor = named("/floor"), one = named("/render_threads_1"),
                      two = named("/render_threads_2");
    if (!t.has(floor) || !t.has(one) || !t.has(two)) return;
    const double splatted = static_cast<double>(record.points());
    const auto rates = [&](const std::string& what) {
      return fmt::format("{:.1f} million points computed/s, {:.1f} million splatted/s",
                         static_cast<double>(computed) / t.median(what) * 1e-6,
                         splatted / t.median(what) * 1e-6);
    };
    fmt::print("\n{}: film of {} x {} cells, {} beams, {} deflection points computed, {} of them splatted\n",
               name, film.columns, film.rows, beams, computed, record.points());
    fmt::print(
        "  floor: splat_on_film in sim/render/beams/kernel.cpp, {}\n    {:.1f} million points splatted/s\n",
        t.words(floor), splatted / t.median(floor) * 1e-6);
    fmt::print("  renderer, {}\n", whole ? "from the scene to the blurred images"
                                         : "exposure of a film whose beams are laid out, without the blur");
    fmt::print("  1 thread: {}\n    {}\n", t.words(one), rates(one));
    fmt::print("  2 threads: {}\n    {}\n", t.words(two), rates(two));
    fmt::print(
        "  renderer's rate / floor's rate, points splatted (the floor adds the same ones), 1 thread (target "
        ">= "
        "{}): {}; processor time: {}\n",
        target, t.ratio(floor, one), processor.ratio(floor, one));
    const std::string floor_two = named("/floor_threads_2");
    if (t.has(floor_two))
      fmt::print(
          "  the same on 2 threads, against two floors side by side on films that nobody merges (target >= "
          "{}; "
          "they take {}): {}\n",
          target, t.words(floor_two), t.ratio(floor_two, two));
    fmt::print("  rate on two threads / rate on one (target >= 1.8): {}\n", t.ratio(one, two));
    report_phases(t, "wall clock");
    report_phases(processor, "processor time");
  }

  /// Medians of the parts, each run alone on one thread.
  void report_phases(const bench::Timings& t, const char* clock) const {
    const auto ms = [&](const char* what) { return t.has(name + what) ? t.median(name + what) * 1e3 : 0.0; };
    const double path = ms("/path"), samples = ms("/samples"), all = ms("/samples_and_splat");
    fmt::print("  phases, 1 thread, {} in ms: ", clock);
    if (whole) fmt::print("layout {:.1f}, ", ms("/layout"));
    fmt::print("places and packing {:.1f}, path {:.1f}, projection and light {:.1f}, splat {:.1f}",
               ms("/packing"), path, samples - path, all - samples);
    fmt::print(", clearing and collecting the film (and tables) {:.1f}", ms("/film_threads_1"));
    if (whole) fmt::print(", blur {:.1f}", ms("/blur_threads_1"));
    fmt::print("; floor {:.1f}\n", ms("/floor"));
    // Whatever else is saved, every point is walked to, and lit and projected before it is known to be off
    // the film.
    const double walked = samples, blur = whole ? ms("/blur_threads_1") : 0.0;
    if (walked > 0.0)
      fmt::print("  bound: floor / (floor + path, projection and light of all points + blur) {:.2f}\n",
                 ms("/floor") / (ms("/floor") + walked + blur));
    if (clock == std::string("wall clock"))
      fmt::print("  on 2 threads: clearing and collecting {:.1f}, blur {:.1f}\n", ms("/film_threads_2"),
                 ms("/blur_threads_2"));
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bool tiny = vegard::bench::take_flag(argc, argv, "--tiny");
  std::vector<std::unique_ptr<Workload>> workloads;
  const auto add = [&](const char* name, int width, int height, int beams, double path_step, bool whole,
                       double target) {
    workloads.push_back(std::make_unique<Workload>(name, width, height, beams, path_step, whole, target));
  };
  if (tiny) {
    add("720x480", 720, 480, 20, 1.0 / 300.0, false, 0.5);
    add("whole/720x480", 720, 480, 20, 1.0 / 150.0, true, 0.6);
  } else {
    add("720x480", 720, 480, 4000, 1.0 / 300.0, false, 0.5);
    add("1280x853", 1280, 853, 33334, 1.0 / 300.0, false, 0.5);
    add("whole/1280x853", 1280, 853, 33334, 1.0 / 150.0, true, 0.6);
  }
  for (const auto& workload : workloads) {
    if (!workload->floor_matches_renderer()) {
      fmt::print("{}: the floor's film differs from the renderer's\n", workload->name);
      return 1;
    }
    workload->register_benchmarks();
  }
  const vegard::bench::TimingsByClock timings = vegard::bench::run_interleaved(argc, argv);
  fmt::print(
      "\nFloor: splat_on_film in sim/render/beams/kernel.cpp, precomputed weights at precomputed places, "
      "bilinear, "
      "three lines at stride {}, 64-bit integer film; instruction set {}.\n"
      "Its film is the renderer's, bit for bit.\n",
      kStride, vegard::sim::kernel_instruction_set());
  for (const auto& workload : workloads) workload->report(timings);
  return 0;
}
