#include "interleaved.h"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace vegard::bench {
namespace {

/// Keeps every repetition, shows the aggregates only.
class CollectingReporter : public benchmark::ConsoleReporter {
 public:
  explicit CollectingReporter(TimingsByClock& timings)
      : benchmark::ConsoleReporter(OO_Tabular), timings_(timings) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> shown;
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && run.iterations > 0) {
        const double iterations = static_cast<double>(run.iterations);
        timings_.wall.add(run.run_name.function_name, run.real_accumulated_time / iterations);
        timings_.processor.add(run.run_name.function_name, run.cpu_accumulated_time / iterations);
      } else {
        shown.push_back(run);
      }
    }
    if (!shown.empty()) benchmark::ConsoleReporter::ReportRuns(shown);
  }

 private:
  TimingsByClock& timings_;
};

}  // namespace

std::vector<double> Timings::sorted(const std::string& name) const {
  std::vector<double> all = seconds_.at(name);
  std::sort(all.begin(), all.end());
  return all;
}

double Timings::median(const std::string& name) const {
  const std::vector<double> all = sorted(name);
  return 0.5 * (all[(all.size() - 1) / 2] + all[all.size() / 2]);
}

double Timings::least(const std::string& name) const { return sorted(name).front(); }

std::string Timings::words(const std::string& name) const {
  const std::vector<double> all = sorted(name);
  return fmt::format("{:.2f} ms (median of {}, {:.2f} to {:.2f})", median(name) * 1e3, all.size(),
                     all.front() * 1e3, all.back() * 1e3);
}

std::string Timings::ratio(const std::string& numerator, const std::string& denominator) const {
  return fmt::format("{:.3f} from medians, {:.3f} from the fastest", median(numerator) / median(denominator),
                     least(numerator) / least(denominator));
}

bool take_flag(int& argc, char** argv, const std::string& flag) {
  char** end = std::remove_if(argv + 1, argv + argc, [&](const char* text) { return flag == text; });
  const bool found = end != argv + argc;
  argc = static_cast<int>(end - argv);
  argv[argc] = nullptr;
  return found;
}

TimingsByClock run_interleaved(int argc, char** argv) {
  // The later of two equal flags wins: these are only what is taken if the user says nothing.
  std::vector<std::string> defaults = {"--benchmark_repetitions=11",
                                       "--benchmark_enable_random_interleaving=true",
                                       "--benchmark_min_time=0.05"};
  std::vector<char*> arguments = {argv[0]};
  for (std::string& text : defaults) arguments.push_back(text.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) std::exit(2);
  TimingsByClock timings;
  CollectingReporter reporter(timings);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return timings;
}

}  // namespace vegard::bench
