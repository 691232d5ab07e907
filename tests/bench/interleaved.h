// Repetitions of several benchmarks in turns, so that a machine that slows down for a while slows all of
// them, and what is said about them afterwards: medians and their ratios.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace vegard::bench {

/// Seconds per iteration of every repetition, by the benchmark's name: of the clock on the wall, or of the
/// processor (the calling thread's), which the other users of a busy machine disturb less. Only the former
/// says anything of work on several threads.
class Timings {
 public:
  void add(const std::string& name, double seconds) { seconds_[name].push_back(seconds); }
  bool has(const std::string& name) const { return seconds_.count(name) != 0; }
  double median(const std::string& name) const;
  double least(const std::string& name) const;
  /// "71.2 ms (median of 7, 70.9 to 73.0)"
  std::string words(const std::string& name) const;
  /// "0.61 from medians, 0.62 from the fastest": the time of `numerator` over that of `denominator`.
  std::string ratio(const std::string& numerator, const std::string& denominator) const;

 private:
  std::vector<double> sorted(const std::string& name) const;
  std::map<std::string, std::vector<double>> seconds_;
};

/// Takes `flag` out of the command line; true if it was there.
bool take_flag(int& argc, char** argv, const std::string& flag);

/// Of the clock on the wall, and of the calling thread's processor, which the other users of a busy machine
/// disturb less. Only the former says anything of work on several threads.
struct TimingsByClock {
  Timings wall, processor;
};

/// Runs the registered benchmarks in random turns, eleven repetitions each unless the command line says
/// otherwise, and prints Google Benchmark's table of aggregates.
TimingsByClock run_interleaved(int argc, char** argv);

}  // namespace vegard::bench
