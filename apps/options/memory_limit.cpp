#include "apps/options/memory_limit.h"

#include <optional>

#include "apps/options/standard_streams.h"
#include "fit/needed_memory.h"
#include "sim/base/memory_limit.h"

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

sim::MemoryLimit limit_of_words(const std::string& words) {
  return {memory_limit_bytes(words), !words.empty(), "--memory-limit"};
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
  return words.empty() ? sim::usable_memory_bytes() : bytes_of_words(words).value_or(0.0);
}

int threads_to_render(const sim::Scene& scene, int threads, const sim::RenderingUse& use,
                      const std::string& memory_words) {
  return sim::threads_to_render(scene, threads, use, limit_of_words(memory_words));
}

void check_memory_of_fit(const sim::Scene& scene, int threads, const std::string& memory_words) {
  constexpr double kWorthAWord = 2.0 * kGigabyte;
  const double bytes = fit::require_memory_of_fit(scene, threads, limit_of_words(memory_words));
  if (bytes > kWorthAWord)
    tell("vegard: %s will take up to about %s of memory, and its time; %s\n",
         fit::fit_in_words(scene).c_str(), sim::memory_text(bytes).c_str(), fit::kLighterFit);
}

}  // namespace vegard::apps
