#include "fit/report/table/validation_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include "sim/base/file/number_text.h"
#include "sim/base/shown_text.h"

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
      "the inflation squared has risen by 1 (68\u00a0%) and by 4 (95\u00a0%). The scatter of the bands, by "
      "which the fit\u2019s own error bars are widened, is not in it.");
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

bool has_a_shift(const FitResult& result, std::size_t derived) {
  for (const StabilityRow& row : *result.stability)
    if (derived < row.derived.size() && std::isfinite(row.derived[derived].by)) return true;
  return false;
}

/// Of the derived numbers those that one wants to see first, without what follows from the others.
std::vector<std::size_t> shown_first(const FitResult& result) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < result.derived.size(); ++i)
    if (const DerivedNumber& d = result.derived[i]; !d.is_detail && d.sigma &&
                                                    d.quantity != Quantity::ratio &&
                                                    d.quantity != Quantity::place && has_a_shift(result, i))
      shown.push_back(i);
  return shown;
}

/// Without the name of the only sheet.
std::string short_name(const FitResult& result, std::string name) {
  if (result.best.sheets.size() != 1) return name;
  const std::string suffix = " of the " + result.best.sheets[0].name + " sheet";
  if (const std::size_t at = name.find(suffix); at != std::string::npos) name.erase(at, suffix.size());
  return name;
}

std::string signed_number(double value) {
  return (value < 0.0 ? "\u2212" : "+") + sim::short_number(std::abs(value), 2);
}

std::string unit_of(const DerivedNumber& number) {
  return number.unit.empty() ? "" : " (" + sim::html_text(number.unit) + ")";
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

std::string stability_table(const FitResult& result) {
  if (!result.stability) return {};
  const std::vector<std::size_t> shown = shown_first(result);
  std::string html = "<table class=\"wide compact\">\n<thead><tr><th>Choice</th><th>made otherwise</th>";
  for (const std::size_t i : shown)
    html += "<th class=\"number\">" + sim::html_text(short_name(result, result.derived[i].name)) +
            unit_of(result.derived[i]) + "</th>";
  html += "<th class=\"number\">\u03c7\u00b2 / dof</th></tr></thead>\n<tbody>\n";
  for (const StabilityRow& row : *result.stability) {
    html += "<tr><td>" + sim::html_text(row.choice) + "</td><td>" + sim::html_text(row.name);
    if (!row.problem.empty()) html += "<div class=\"soft\">" + sim::html_text(row.problem) + "</div>";
    if (row.is_refuted)
      html += "<div class=\"soft\">refuted by the picture: \u03c7\u00b2 is more than twice as large</div>";
    html += "</td>";
    for (const std::size_t i : shown)
      html +=
          cell(i < row.derived.size() && std::isfinite(row.derived[i].by) ? signed_number(row.derived[i].by)
                                                                          : "\u2013");
    html +=
        cell(std::isfinite(row.chi2_per_dof) ? sim::short_number(row.chi2_per_dof, 3) : "\u2013") + "</tr>\n";
  }
  const auto errors = [&](const char* name, const auto& error_of) {
    html += std::string("<tr class=\"strong\"><td colspan=\"2\">") + name + "</td>";
    for (const std::size_t i : shown) {
      const std::optional<double> error = error_of(result.derived[i]);
      html += cell(error ? "\u00b1\u00a0" + sim::short_number(*error, 2) : "\u2013");
    }
    html += "<td></td></tr>\n";
  };
  errors("Statistical error", [](const DerivedNumber& d) { return d.sigma; });
  errors("Systematic error, by the choices above", [](const DerivedNumber& d) { return d.systematic; });
  errors("Both", [](const DerivedNumber& d) { return d.error(); });
  return html + "</tbody>\n</table>\n";
}

}  // namespace vegard::fit
