#include "apps/options/memory_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/needed_memory.h"
#include "sim/base/available_memory.h"
#include "sim/base/parallel.h"
#include "sim/render/needed_memory.h"

namespace vegard::apps {
namespace {

constexpr double kGigabyte = 1024.0 * 1024.0 * 1024.0;

/// Bytes, if the words are a size.
std::optional<double> bytes_of_words(const std::string& words) {
  std::size_t used = 0;
  double number = 0.0;
  try {
    number = std::stod(words, &used);
  } catch (const std::exception&) {
    return {};
  }
  std::string unit = words.substr(used);
  if (unit.size() > 1 && (unit.substr(1) == "B" || unit.substr(1) == "iB")) unit.resize(1);
  const double factor = unit.empty() || unit == "G" || unit == "g" ? kGigabyte
                        : unit == "T" || unit == "t"               ? 1024.0 * kGigabyte
                        : unit == "M" || unit == "m"               ? kGigabyte / 1024.0
                        : unit == "K" || unit == "k"               ? kGigabyte / (1024.0 * 1024.0)
                                                                   : 0.0;
  const double bytes = number * factor;
  if (!(bytes >= 1e-6 * kGigabyte && bytes <= 1e6 * kGigabyte)) return {};
  return bytes;
}

}  // namespace

Option add_memory_option(const Command& command, std::string& words, const std::string& meaning) {
  return command.option("--memory-limit", words, meaning)
      .check(
          [](const std::string& word) {
            return bytes_of_words(word) ? std::string()
                                        : "'" + word + "' is no size of memory: 4G, 500M, or a number of GB";
          },
          "SIZE");
}

double memory_limit_bytes(const std::string& words) {
  if (!words.empty()) return bytes_of_words(words).value_or(0.0);
  const std::uint64_t available = sim::available_memory();
  return available == 0 ? std::numeric_limits<double>::infinity() : 0.8 * static_cast<double>(available);
}

void require_memory(const std::string& words, double bytes, const std::string& what,
                    const std::string& hint) {
  const double limit = memory_limit_bytes(words);
  if (bytes <= limit) return;
  throw usage_error(
      "--memory-limit", what + " would take about " + sim::memory_text(bytes) + " of memory",
      "at most " + sim::memory_text(limit) + (words.empty() ? ", four fifths of what is free" : ", as given"),
      hint);
}

int threads_to_render(const sim::Scene& scene, int threads, double bytes_per_px, bool sheet_layers,
                      const std::string& memory_words) {
  const double limit = memory_limit_bytes(memory_words);
  const auto bytes = [&](int count) {
    return sim::kProgramBytes + sim::render_bytes(scene, count, {sheet_layers, bytes_per_px});
  };
  int count = sim::thread_count(threads);
  while (count > 1 && bytes(count) > limit) --count;
  require_memory(memory_words, bytes(count),
                 fmt::format("a picture of {} x {} pixels", scene.camera.width, scene.camera.height),
                 "a smaller camera.width and camera.height need less");
  return count;
}

void check_memory_of_fit(const sim::Scene& scene, int threads, const std::string& memory_words) {
  constexpr double kWorthAWord = 2.0 * kGigabyte;
  const double bytes = sim::kProgramBytes + fit::fit_bytes(scene, threads);
  const std::string what = fmt::format("a fit of {} x {} pixels", scene.camera.width, scene.camera.height);
  const std::string hint =
      "A part of the picture (fit.roi_px), a smaller picture with its camera.width and camera.height, or "
      "fewer "
      "--threads need less";
  constexpr double kHalfDark = 0.5;
  require_memory(memory_words, memory_words.empty() ? kHalfDark * bytes : bytes, what, hint);
  if (bytes > kWorthAWord)
    tell("vegard: %s will take up to about %s of memory, and its time; %s\n", what.c_str(),
         sim::memory_text(bytes).c_str(), hint.c_str());
}

}  // namespace vegard::apps
