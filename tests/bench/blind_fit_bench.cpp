// What a blind fit costs: photographs of the scorecard's kind, 720 x 480 pixels, noise and JPEG, of one sheet
// each, fitted from the scorecard's wide start with ten free non-linear parameters. The work is counted in
// residual evaluations at full resolution of the same scene on one thread: processor time of the whole fit
// over the median of such evaluations at its answer. --tiny shrinks the work to a check that everything
// still runs.
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "apps/options/command.h"
#include "fit/compare/observation.h"
#include "fit/fit.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/recovery/scorecard/photograph.h"
#include "tests/recovery/scorecard/truth.h"

namespace {

using namespace vegard;

constexpr int kEvaluations = 11;  // before the fit on two threads, and after it
constexpr int kFree = 10;
constexpr double kTarget = 400.0, kTargetSeconds = 15.0;

/// Of all threads of this program.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Case {
  scorecard::Truth truth;
  sim::Scene start;
  fit::Photo photo;
};

fit::Photo photographed(const scorecard::Truth& truth) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("vegard-blind-fit-{}.jpg", getpid());
  std::ofstream(file, std::ios::binary) << scorecard::photograph(truth, 1).bytes;
  fit::Photo photo = fit::read_photo(file.string(), fit::Decoding::automatic);
  std::filesystem::remove(file);
  return photo;
}

/// The scorecard's start of a larger picture, and the lens' blur in green free beside what is free there.
Case made(scorecard::Truth truth, int beams, bool tiny) {
  truth.scene.camera.width = tiny ? 72 : 720;
  truth.scene.camera.height = tiny ? 48 : 480;
  Case made_case{truth, scorecard::wide_start(truth), photographed(truth)};
  sim::Scene& start = made_case.start;
  sim::FreeParameter blur;
  blur.path = "blur.width_deg.5577";
  blur.min = 0.02;
  blur.max = 0.5;
  start.blur.width_deg[1] = 0.15;
  start.fit.free.push_back(blur);
  start.sheets[0].beams = beams;
  if (tiny) {
    start.fit.bands = 6;
    start.fit.overall_trials = 2;
    start.fit.scan_descents = 1;
  }
  sim::validate(start);
  return made_case;
}

/// Processor times of evaluations at full resolution.
struct Evaluations {
  std::vector<double> residuals, jacobian;  ///< the latter with the residuals
};

/// At an answer: what is seen of a sheet, and so the work, is not the same everywhere.
void time_evaluations(const Case& of, const fit::FitResult& answer, Evaluations& seconds) {
  std::vector<fit::Observation> observations;
  observations.push_back(fit::observed(of.start, of.photo, 1));
  const std::vector<fit::FreeNumber> free = fit::free_numbers(of.start);
  fit::EvaluationLog log;
  const fit::ProfileCost cost(free, fit::cost_terms(observations, free, fit::Detail::full), log);
  std::vector<double> values, residuals(cost.num_residuals()), jacobian(residuals.size() * free.size());
  for (const fit::FittedParameter& parameter : answer.parameters) values.push_back(parameter.value);
  const std::vector<double> coordinates = cost.coordinates(values);
  const double* blocks[] = {coordinates.data()};
  double* jacobians[] = {jacobian.data()};
  cost.Evaluate(blocks, residuals.data(), jacobians);  // tables and films come into being
  for (int i = 0; i < kEvaluations; ++i) {
    const double first = processor_seconds();
    cost.Evaluate(blocks, residuals.data(), nullptr);
    const double second = processor_seconds();
    cost.Evaluate(blocks, residuals.data(), jacobians);
    seconds.residuals.push_back(second - first);
    seconds.jacobian.push_back(processor_seconds() - second);
  }
}

/// Seconds of a fit's parts: what comes before the polish, the polish, and error bars with all that follows.
struct Parts {
  double search = 0.0, polish = 0.0, error_bars = 0.0;
  double sum() const { return search + polish + error_bars; }
};

struct Timed {
  Parts wall, processor;
  int before_polish = 0;  ///< evaluations
  fit::FitResult result;
};

Timed timed_fit(const Case& of, int threads) {
  Timed timed;
  double Parts::*part = &Parts::search;
  double wall = wall_seconds(), processor = processor_seconds();
  const auto close = [&] {
    const double wall_now = wall_seconds(), processor_now = processor_seconds();
    timed.wall.*part += wall_now - wall;
    timed.processor.*part += processor_now - processor;
    wall = wall_now;
    processor = processor_now;
  };
  fit::FitOptions options;
  options.threads = threads;
  options.progress = [&](const std::string& stage, int evaluations, double, double) {
    close();
    if (stage.rfind("polish", 0) == 0 && part == &Parts::search) {
      part = &Parts::polish;
      timed.before_polish = evaluations;
    }
    if (stage == "error bars") part = &Parts::error_bars;
  };
  timed.result = fit::fit_photo(of.start, of.photo, options);
  close();
  return timed;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

std::string against_truth(const Case& of, const fit::FitResult& result) {
  std::string words;
  for (const fit::FittedParameter& p : result.parameters) {
    if (p.path != "sheet.first.energy_kev" && p.path != "sheet.first.center_km.north" &&
        p.path != "sheet.first.wavelength_km")
      continue;
    const double truth = *sim::real_value(of.truth.scene, sim::resolve(of.truth.scene, p.path).front());
    words += fmt::format("; {} {:.2f} for {:.2f} {}", p.path.substr(p.path.rfind("first.") + 6), p.value,
                         truth, p.unit);
  }
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  apps::Program program("blind_fit_bench",
                        "What a blind fit costs, in residual evaluations at full resolution and in seconds.",
                        {}, argc, argv);
  const apps::Command app = program.root();
  bool tiny = false;
  std::uint64_t set = 2024;
  int photographs = 3, beams = 4000;
  app.flag("--tiny", tiny, "a check that everything still runs");
  app.option("--set", set, "seed of the truths, as in recovery_scorecard");
  app.option("--photographs", photographs, "how many, of the set's first with one sheet drawn by beams");
  app.option("--beams", beams, "of a layer, in the fit; a photograph has 3000");
  program.takes_more();  // what the other benchmarks take
  if (const std::optional<int> end = program.read()) return *end;
  if (tiny) {
    photographs = 1;
    beams = 40;
  }

  std::vector<double> units;
  std::vector<double> seconds;
  for (int scene = 0; static_cast<int>(units.size()) < photographs; ++scene) {
    const scorecard::Truth truth = scorecard::truth(set, scene);
    if (truth.line_of_sight || truth.scene.sheets.size() != 1) continue;
    const Case one = made(truth, beams, tiny);
    if (static_cast<int>(one.start.fit.free.size()) != kFree) {
      fmt::print("{} parameters are free\n", one.start.fit.free.size());
      return 1;
    }
    const Timed alone = timed_fit(one, 1);
    Evaluations evaluations;
    time_evaluations(one, alone.result, evaluations);
    const Timed two = timed_fit(one, 2);
    time_evaluations(one, alone.result, evaluations);
    if (alone.result.chi2 != two.result.chi2) {
      fmt::print("1 and 2 threads differ\n");
      return 1;
    }
    const double unit = median(evaluations.residuals);
    const Parts& work = alone.processor;
    units.push_back(work.sum() / unit);
    seconds.push_back(two.wall.sum());
    const fit::FitResult& r = alone.result;
    fmt::print("scene {} of set {}, {} x {}, {} x {} beams, {} free\n", scene, set, one.start.camera.width,
               one.start.camera.height, one.start.sheets[0].layers, one.start.sheets[0].beams, kFree);
    fmt::print(
        "  one evaluation of the residuals, 1 thread: {:.2f} ms (median of {}); with the Jacobian {:.1f} "
        "times that\n",
        unit * 1e3, evaluations.residuals.size(), median(evaluations.jacobian) / unit);
    fmt::print("  1 thread: {:.2f} s, processor {:.2f} s; 2 threads: {:.2f} s, processor {:.2f} s\n",
               alone.wall.sum(), work.sum(), two.wall.sum(), two.processor.sum());
    fmt::print(
        "  search {:.0f}, polish {:.0f}, error bars {:.0f} evaluations' worth; {} evaluations, {} of them "
        "with "
        "derivatives, {} before the polish\n",
        work.search / unit, work.polish / unit, work.error_bars / unit, r.evaluations, r.jacobian_evaluations,
        alone.before_polish);
    fmt::print("  {}{}\n", r.verdict_line, against_truth(one, r));
    std::fflush(stdout);
  }
  fmt::print(
      "blind fit, {} photographs: {:.0f} evaluations' worth in the median, {:.0f} at most (target <= "
      "{:.0f}); "
      "{:.1f} s on 2 threads in the median, {:.1f} s at most (target < {:.0f} s)\n",
      photographs, median(units), *std::max_element(units.begin(), units.end()), kTarget, median(seconds),
      *std::max_element(seconds.begin(), seconds.end()), kTargetSeconds);
  return 0;
}
