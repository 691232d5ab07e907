#include "fit/report/table/validation_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/file/html_text.h"
#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace {

constexpr double kWider = 1.5;  // than the curvature's interval, or narrower by as much: flagged

using End = std::optional<double>;

/// Rounded to what their distance, or where one is open the scale, makes worth telling.
std::string interval_text(const End& low, const End& high, double scale) {
  const double half = low && high ? 0.5 * std::abs(*high - *low) : scale;
  const auto end = [&](double x) {
    const sim::RoundedNumber r = sim::rounded(x, half > 0.0 ? End(half) : End());
    return r.value + r.exponent;
  };
  if (low && high) return end(*low) + " to " + end(*high);
  if (low) return "above " + end(*low);
  return high ? "below " + end(*high) : "no bound";
}

std::string factor_text(const End& low, const End& high, const FittedParameter& p) {
  if (!low || !high || !p.interval68) return {};
  const double factor = (*high - *low) / (p.interval68->second - p.interval68->first);
  if (!std::isfinite(factor) || (factor <= kWider && factor >= 1.0 / kWider)) return {};
  return " <span class=\"flag\">\u00d7&#160;" + sim::html_text(sim::short_number(factor, 2)) + "</span>";
}

std::string cell(const std::string& text) { return "<td class=\"number\">" + text + "</td>"; }

std::string interval_cell(const End& low, const End& high, const FittedParameter& p, bool compare) {
  const double scale = p.sigma.value_or(0.0);
  return cell(sim::html_text(interval_text(low, high, scale)) + (compare ? factor_text(low, high, p) : ""));
}

std::string interval_cell(const std::vector<std::pair<double, double>>& intervals, std::size_t j,
                          const FittedParameter& p) {
  if (j >= intervals.size()) return cell("\u2013");
  return interval_cell(intervals[j].first, intervals[j].second, p, true);
}

const ProfiledInterval* profiled(const FitResult& result, std::size_t j) {
  for (const ProfiledInterval& p : result.profile_intervals)
    if (p.parameter == j) return &p;
  return nullptr;
}

std::string rows(const FitResult& result) {
  std::string html;
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    const FittedParameter& p = result.parameters[j];
    if (p.of_profile) continue;
    html += "<tr><td><code>" + sim::html_text(p.path) + "</code></td>";
    html +=
        p.interval68 ? interval_cell(p.interval68->first, p.interval68->second, p, false) : cell("\u2013");
    if (!result.profile_intervals.empty()) {
      const ProfiledInterval* const own = profiled(result, j);
      html += own ? interval_cell(own->lower68, own->upper68, p, true) +
                        interval_cell(own->lower95, own->upper95, p, false)
                  : cell("\u2013") + cell("\u2013");
    }
    if (result.bootstrap) html += interval_cell(result.bootstrap->interval68, j, p);
    if (result.chain) html += interval_cell(result.chain->interval68, j, p);
    html += "</tr>\n";
  }
  return html;
}

std::string note(const std::string& text) { return "<p class=\"soft\">" + text + "</p>\n"; }

std::string profile_notes(const FitResult& result) {
  if (result.profile_intervals.empty()) return {};
  std::string html = note(
      "Profile likelihood: how far a parameter can go, with all others fitted again, until \u03c7\u00b2 over "
      "the inflation squared has risen by 1 (68\u00a0%) and by 4 (95\u00a0%).");
  for (const ProfiledInterval& p : result.profile_intervals) {
    const std::string path = "<code>" + sim::html_text(result.parameters[p.parameter].path) + "</code>: ";
    if (p.found_better)
      html +=
          note(path +
               "on the way \u03c7\u00b2 fell below the answer\u2019s. The answer was not the minimum; start "
               "the fit again from there.");
    if (!p.whole) html += note(path + "the walk was cut short.");
  }
  return html;
}

std::string bootstrap_note(const BootstrapErrors& b) {
  if (b.sigma.empty())
    return note(fmt::format("Bootstrap over bands: {} bands are too few to be drawn from.", b.bands));
  std::string text = fmt::format(
      "Bootstrap over bands: {} draws of {} bands, {}. It does not use the inflation.", b.replicates, b.bands,
      b.refitted ? "a refit for each" : "refitted with the model linear about the answer");
  if (b.failed > 0) text += fmt::format(" {} more draws gave no answer.", b.failed);
  return note(text);
}

std::string chain_note(const ChainErrors& c) {
  if (c.effective.empty()) return note("Markov chain: no samples.");
  const double fewest = *std::min_element(c.effective.begin(), c.effective.end());
  std::string text = fmt::format(
      "Markov chain: {} walkers, {} steps each after {} of burn-in; {:.0f}&#160;% of the moves accepted; "
      "the effective sample size of the slowest parameter is {:.0f}.",
      c.walkers, c.steps, c.burn_in, 100.0 * c.acceptance, fewest);
  if (!c.r_hat.empty())
    text += fmt::format(" Split R-hat is at most {:.3f} (1: all walkers have the same distribution).",
                        *std::max_element(c.r_hat.begin(), c.r_hat.end()));
  if (!c.long_enough)
    text +=
        " <span class=\"flag\">too short</span> Less than fifty autocorrelation times: its intervals are not "
        "reliable yet; run a longer chain.";
  return note(text);
}

}  // namespace

std::string validation_table(const FitResult& result) {
  if (result.profile_intervals.empty() && !result.bootstrap && !result.chain) return {};
  std::string html =
      "<table class=\"wide\">\n<thead><tr><th>Parameter</th><th class=\"number\">Curvature, 68\u00a0%</th>";
  const auto column = [&](const char* name) {
    html += std::string("<th class=\"number\">") + name + "</th>";
  };
  if (!result.profile_intervals.empty()) {
    column("Profile likelihood, 68\u00a0%");
    column("95\u00a0%");
  }
  if (result.bootstrap) column("Bootstrap, 68\u00a0%");
  if (result.chain) column("Chain, 68\u00a0%");
  html += "</tr></thead>\n<tbody>\n" + rows(result) + "</tbody>\n</table>\n" + profile_notes(result);
  if (result.bootstrap) html += bootstrap_note(*result.bootstrap);
  if (result.chain) html += chain_note(*result.chain);
  return html;
}

}  // namespace vegard::fit
