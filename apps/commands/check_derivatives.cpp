#include "apps/commands/check_derivatives.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/derivative_check.h"
#include "sim/base/file/number_text.h"

namespace vegard::apps {
namespace {

std::string share_text(double share) { return std::isfinite(share) ? fmt::format("{:.1e}", share) : "-"; }

void print(const std::vector<fit::DerivativeCheck>& checks) {
  std::size_t widest = 9;
  for (const fit::DerivativeCheck& check : checks) widest = std::max(widest, check.name.size());
  say_result(
      "Of each column of the Jacobian: its length (sigmas per natural step: the parameter itself, or one of "
      "its unit),\nand how far central differences are from it, relative, by step (share of a natural "
      "step).\n\n");
  json_answer()["steps"] = fit::derivative_steps();
  json_answer()["parameters"] = Json::array();
  std::string header = fmt::format("{:<{}}  {:>8}", "parameter", widest, "length");
  for (const double step : fit::derivative_steps()) header += fmt::format("  {:>7.0e}", step);
  say_result(header + "  best at  verdict\n");
  for (const fit::DerivativeCheck& check : checks) {
    std::string line = fmt::format("{:<{}}  {:>8}", check.name, widest, share_text(check.effect));
    for (const double difference : check.differences) line += fmt::format("  {:>7}", share_text(difference));
    const char* const verdict = fit::derivative_verdict_name(check.verdict);
    say_result(line + fmt::format("  {:7.0e}  {}\n", check.best_step, verdict));
    Json differences = Json::array();
    for (const double difference : check.differences) differences.push_back(json_number(difference));
    json_answer()["parameters"].push_back({{"name", check.name},
                                           {"length", json_number(check.effect)},
                                           {"differences", differences},
                                           {"best_step", json_number(check.best_step)},
                                           {"verdict", verdict}});
  }
}

}  // namespace

ExitCode print_derivative_check(const sim::Scene& scene, const fit::Photo& photo, int threads) {
  const std::atomic<bool>& stop = watch_for_interrupt();
  std::vector<fit::DerivativeCheck> checks;
  {
    ProgressBar bar("differences");
    checks = placing_errors(scene, [&] {
      return fit::check_derivatives(
          scene, photo, threads, [&bar](double share) { bar.update(share); }, &stop);
    });
  }
  print(checks);
  if (stop.load()) return interrupted;
  const auto count = [&](fit::DerivativeVerdict verdict) {
    return std::count_if(checks.begin(), checks.end(),
                         [verdict](const fit::DerivativeCheck& check) { return check.verdict == verdict; });
  };
  const long differ = count(fit::DerivativeVerdict::differ), inert = count(fit::DerivativeVerdict::no_effect);
  if (differ == 0 && inert == 0) {
    say_result("All derivatives agree with differences.\n");
    return good;
  }
  if (differ > 0)
    say_result(fmt::format("{} of {} derivatives differ from differences.\n", differ, checks.size()));
  if (inert > 0)
    say_result(fmt::format("{} of {} parameters have no effect on what is fitted.\n", inert, checks.size()));
  if (inert == static_cast<long>(checks.size()))
    say_result(
        "Is the model's light anywhere near the photograph's at this start? Where it is not, the gains are "
        "held at 0:\ncheck the best.toml of a run instead.\n");
  return doubted;
}

}  // namespace vegard::apps
