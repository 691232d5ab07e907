#include "fit/report/report_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fit/answer/derived.h"
#include "fit/answer/result_numbers.h"
#include "fit/answer/tables_correction.h"
#include "fit/version.h"
#include "sim/base/file/number_text.h"
#include "sim/base/shown_text.h"
#include "sim/base/version.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

/// "a space and the unit"; degrees without the space, as one writes them.
std::string with_unit(const std::string& number, const std::string& unit) {
  if (unit.empty()) return sim::html_text(number);
  if (unit == "deg") return sim::html_text(number) + "\u00b0";
  return sim::html_text(number) + "&#160;<span class=\"unit\">" + sim::html_text(unit) + "</span>";
}

/// Digits enough to see the width of the interval.
std::string interval_text(const FittedParameter& p) {
  if (!p.interval68) return "\u2013";
  const double half = 0.5 * std::abs(p.interval68->second - p.interval68->first);
  const sim::RoundedNumber low = sim::rounded(p.interval68->first, half),
                           high = sim::rounded(p.interval68->second, half);
  return low.value + low.exponent + " to " + high.value + high.exponent;
}

std::string limits_text(const FittedParameter& p) {
  const bool has_min = std::isfinite(p.min), has_max = std::isfinite(p.max);
  if (!has_min && !has_max) return "none";
  if (!has_min) return "at most " + sim::short_number(p.max, 4);
  if (!has_max) return "at least " + sim::short_number(p.min, 4);
  return sim::short_number(p.min, 4) + " to " + sim::short_number(p.max, 4);
}

std::string row(const std::string& name, const std::string& value, const std::string& meaning) {
  return "<tr><th scope=\"row\">" + name + "</th><td class=\"number\">" + value + "</td><td>" + meaning +
         "</td></tr>\n";
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.2f}&#160;%", 100.0 * share) : "\u2013";
}

/// What the table of correlations is made from. A free-form profile's neighbouring coefficients are
/// correlated and would fill pages.
FitResult without_coefficients(const FitResult& whole) {
  FitResult result;
  result.best = whole.best;
  std::vector<std::size_t> kept;
  for (std::size_t j = 0; j < whole.parameters.size() && whole.correlation.size() == whole.parameters.size();
       ++j)
    if (!whole.parameters[j].of_profile) kept.push_back(j);
  for (const std::size_t j : kept) {
    result.parameters.push_back(whole.parameters[j]);
    result.correlation.emplace_back();
    for (const std::size_t k : kept)
      if (k < whole.correlation[j].size()) result.correlation.back().push_back(whole.correlation[j][k]);
  }
  return result;
}

std::string shown_number(const ResultNumber& number, const std::optional<double>& value) {
  if (!value) return "\u2013";
  switch (number.form) {
    case ResultForm::count:
      return fmt::format("{:.0f}", *value);
    case ResultForm::share:
      return percent(*value);
    case ResultForm::factor:
      return "\u00d7&#160;" + sim::html_text(sim::short_number(*value, 3));
    case ResultForm::number:
      break;
  }
  return sim::html_text(sim::short_number(*value, 3));
}

}  // namespace

std::string derived_cards(const FitResult& result) {
  std::string cards;
  for (const DerivedNumber& d : result.derived) {
    if (d.is_detail || !d.why_none.empty()) continue;
    // The colour of a number's edge says how far it may be leaned on.
    cards += std::string("<div class=\"card ") + trust_name(d.trust) + "\"><div class=\"big\">" +
             with_unit(sim::number_with_error(d.value, d.error()), d.unit) + "</div><div>" +
             sim::html_text(d.name) + "</div><div class=\"trust\"><b>" + trust_name(d.trust) + "</b> " +
             sim::html_text(d.trust_reason) + "</div></div>\n";
  }
  return cards.empty() ? cards : "<div class=\"cards\">\n" + cards + "</div>\n";
}

std::string answer_sentence(const FitResult& result) {
  constexpr std::size_t kMaxNumbers = 3;
  for (const Trust trust : {Trust::good, Trust::doubtful}) {
    std::vector<const DerivedNumber*> numbers;
    for (const DerivedNumber& d : result.derived)
      if (!d.is_detail && d.why_none.empty() && d.trust == trust && numbers.size() < kMaxNumbers)
        numbers.push_back(&d);
    if (numbers.empty()) continue;
    // "of the main sheet" once, where all are its.
    const std::string& first = numbers.front()->name;
    std::string whose = first.substr(std::min(first.size(), first.rfind(" of ")));
    for (const DerivedNumber* d : numbers)
      if (d->name.size() < whose.size() || d->name.substr(d->name.size() - whose.size()) != whose)
        whose.clear();
    std::string sentence = trust == Trust::good ? "By this fit" : "By this fit, with doubt";
    if (!whose.empty()) sentence += ", for" + sim::html_text(whose.substr(3)) + ",";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const DerivedNumber& d = *numbers[i];
      sentence += (i == 0                    ? " the "
                   : i + 1 == numbers.size() ? " and the "
                                             : ", the ") +
                  sim::html_text(d.name.substr(0, d.name.size() - whose.size())) + " is <b>" +
                  with_unit(sim::number_with_error(d.value, d.error()), d.unit) + "</b>";
    }
    return sentence + ".";
  }
  const bool is_of_others = result.derived.empty() || result.verdict == Verdict::good;  // a camera, say
  return is_of_others
             ? std::string()
             : "This fit determines no number of the " + light_noun(result.best) + " well enough to be used.";
}

std::string derived_table(const FitResult& result) {
  std::string rows;
  for (const DerivedNumber& d : result.derived) {
    if (!d.is_detail && d.why_none.empty()) continue;
    rows += "<tr><td>" + sim::html_text(d.name) + "</td><td class=\"number\">" +
            (d.why_none.empty() ? with_unit(sim::number_with_error(d.value, d.error()), d.unit) : "\u2013") +
            "</td><td>" + trust_name(d.trust) + "</td><td class=\"soft\">" + sim::html_text(d.trust_reason) +
            "</td></tr>\n";
  }
  if (rows.empty()) return rows;
  return "<table class=\"wide\">\n<thead><tr><th>Also</th><th class=\"number\">Value \u00b1 \u03c3</th>"
         "<th>Trust</th><th></th></tr></thead>\n<tbody>\n" +
         rows + "</tbody>\n</table>\n";
}

std::string corrections_list(const std::vector<TablesCorrection>& corrections, const std::string& before) {
  std::string items;
  for (const TablesCorrection& correction : corrections)
    items += "<li>" + sim::html_text(correction_words(correction)) + "</li>\n";
  return items.empty() ? items
                       : "<p class=\"soft\">" + before + "</p>\n<ul class=\"soft\">\n" + items + "</ul>\n";
}

std::string tables_list(const FitResult& result) {
  return corrections_list(result.tables,
                          "What it says about the emission tables, which the answer does not use:");
}

std::string parameter_table_html(const FitResult& result) {
  std::string html =
      "<table class=\"wide\">\n<thead><tr><th>Parameter</th><th class=\"number\">Value \u00b1 \u03c3</th>"
      "<th class=\"number\">68\u00a0% interval</th><th class=\"number\">Start</th>"
      "<th class=\"number\">Limits</th></tr></thead>\n<tbody>\n";
  int coefficients = 0;
  for (const FittedParameter& p : result.parameters) {
    coefficients += p.of_profile;
    if (p.of_profile && p.sigma && !p.at_limit) continue;
    html += "<tr><td><code>" + sim::html_text(p.path) + "</code><div class=\"soft\">" +
            sim::html_text(p.meaning) + "</div></td><td class=\"number strong\">" +
            with_unit(sim::number_with_error(p.value, p.sigma), p.unit);
    if (!p.sigma)
      html += "<div class=\"soft\">no error bar" +
              (p.why_no_sigma.empty() ? std::string() : ": " + sim::html_text(p.why_no_sigma)) + "</div>";
    html += "</td><td class=\"number\">" + sim::html_text(interval_text(p)) + "</td><td class=\"number\">" +
            sim::html_text(sim::short_number(p.initial, 4)) + "</td><td class=\"number\">" +
            sim::html_text(limits_text(p));
    if (p.at_limit) html += "<div class=\"flag\">at a limit</div>";
    html += "</td></tr>\n";
  }
  html += "</tbody>\n</table>\n";
  if (coefficients == 0) return html;
  return html + fmt::format(
                    "<p class=\"soft\">{} coefficients of free-form profiles are shown as curves instead; "
                    "their numbers are in <code>result.json</code>.</p>\n",
                    coefficients);
}

std::string tied_table(const FitResult& result) {
  if (result.tied.empty()) return {};
  std::string html =
      "<table class=\"wide\">\n<thead><tr><th>Tied parameter</th><th class=\"number\">Value \u00b1 "
      "\u03c3</th><th>Equals</th></tr></thead>\n<tbody>\n";
  for (const TiedNumber& t : result.tied)
    html += "<tr><td><code>" + sim::html_text(t.path) + "</code><div class=\"soft\">" +
            sim::html_text(t.meaning) + "</div></td><td class=\"number strong\">" +
            with_unit(sim::number_with_error(t.value, t.sigma), t.unit) + "</td><td>= <code>" +
            sim::html_text(t.equals) + "</code></td></tr>\n";
  return html + "</tbody>\n</table>\n";
}

std::string solved_table(const FittedPhoto& fitted) {
  std::string html = "<div class=\"many\">\n";
  for (const SolvedNumber& s : fitted.solved)
    html += "<div><code>" + sim::html_text(s.name) + "</code><span>" +
            sim::html_text(sim::number_with_error(s.value, s.sigma)) + "</span></div>\n";
  return html + "</div>\n";
}

std::string radars_table(const FitResult& result) {
  const auto head = [](const char* name) { return "<th class=\"number\">" + std::string(name) + "</th>"; };
  std::string html = "<table>\n<thead><tr><th>Radar</th>" + head("\u03c7\u00b2") + head("Densities") +
                     head("Scale") + head("Foot, latitude") + head("longitude") + head("Q there") +
                     head("E0 there") + "</tr></thead>\n<tbody>\n";
  for (const FittedRadar& radar : result.radars) {
    html += "<tr><th scope=\"row\">" + sim::html_text(radar.name) + "</th>";
    for (const std::string& cell :
         {sim::short_number(radar.chi2, 3), std::to_string(radar.values),
          radar.scale_sigma ? sim::number_with_error(radar.scale, radar.scale_sigma) : std::string("1, held"),
          sim::short_number(radar.foot_latitude_deg, 4) + " \u00b0",
          sim::short_number(radar.foot_longitude_deg, 4) + " \u00b0",
          sim::short_number(radar.energy_flux_mw_m2, 3) + " mW m\u207b\u00b2",
          sim::short_number(radar.energy_kev, 3) + " keV"})
      html += "<td class=\"number\">" + sim::html_text(cell) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string photos_table(const FitResult& result) {
  std::string html =
      "<table>\n<thead><tr><th>Photograph</th><th class=\"number\">\u03c7\u00b2</th>"
      "<th class=\"number\">Values</th><th class=\"number\">rms / peak</th></tr></thead>\n<tbody>\n";
  for (const FittedPhoto& photo : result.photos) {
    const auto values =
        std::count_if(photo.sigma.begin(), photo.sigma.end(), [](double sigma) { return sigma > 0.0; });
    html += "<tr><th scope=\"row\">" + sim::html_text(photo.name) + "</th><td class=\"number\">" +
            sim::html_text(sim::short_number(photo.chi2, 6)) + "</td><td class=\"number\">" +
            std::to_string(values) + "</td><td class=\"number\">" + percent(photo.rms_over_peak) +
            "</td></tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string correlation_table(const FitResult& whole) {
  const FitResult result = without_coefficients(whole);
  const std::size_t n = result.parameters.size();
  if (n < 2 || result.correlation.size() != n) return {};
  const bool one_sheet = result.best.sheets.size() == 1;
  std::string html = "<table class=\"matrix\">\n<thead><tr><td></td>";
  for (std::size_t j = 0; j < n; ++j) html += fmt::format("<th>{}</th>", j + 1);
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < n; ++i) {
    html += fmt::format("<tr><th scope=\"row\">{} <code>{}</code></th>", i + 1,
                        sim::html_text(sim::short_path(result.parameters[i].path, one_sheet)));
    for (std::size_t j = 0; j < std::min(n, result.correlation[i].size()); ++j) {
      const double r = result.correlation[i][j];
      if (!std::isfinite(r) || !result.parameters[i].sigma || !result.parameters[j].sigma) {
        html += "<td>\u2013</td>";
        continue;
      }
      // The colours of the picture of what is left: red above zero, blue below.
      const double strength = 0.75 * std::min(1.0, std::abs(r));
      html += fmt::format("<td style=\"background:rgba({},{:.2f})\">{}</td>",
                          r > 0 ? "178,24,43" : "33,102,172", i == j ? 0.08 : strength,
                          i == j ? "1" : (r < 0 ? "\u2212" : "") + fmt::format("{:.2f}", std::abs(r)));
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string statistics_table(const FitResult& result) {
  const std::string reduced = result.dof > 0 ? sim::short_number(result.chi2 / result.dof, 3) : "\u2013";
  std::string html = "<table class=\"statistics\">\n<tbody>\n";
  html += row(
      "\u03c7\u00b2 / degree of freedom", reduced,
      "About 1 where model and photograph agree within the errors; well above, the model misses something; "
      "well below, the errors were set too large.");
  html += row("\u03c7\u00b2", sim::html_text(sim::short_number(result.chi2, 6)),
              "Sum of the squared residuals, each in units of its \u03c3; at the start it was " +
                  sim::html_text(sim::short_number(result.chi2_initial, 6)) + ".");
  if (result.statistics.size() > 1)
    for (const ComparedStatistic& s : result.statistics)
      html +=
          row("\u03c7\u00b2 of the " + sim::html_text(s.name), sim::html_text(sim::short_number(s.chi2, 6)),
              fmt::format("From {} residuals, with the weight {}.", s.residuals,
                          sim::html_text(sim::short_number(s.weight, 3))));
  for (const ResultNumber& number : result_numbers())
    if (number.title != nullptr)
      html += row(number.title, shown_number(number, number.value(result)), number.explanation);
  for (const FittedPhoto& photo : result.photos)
    if (photo.model_error)
      html += row("Model error" + (photo.name.empty() ? "" : " of " + sim::html_text(photo.name)),
                  percent(*photo.model_error),
                  "The share of the light above the sky that the model misses, by the residuals themselves; "
                  "fit.model_error was taken as " +
                      percent(photo.best.fit.model_error) + ".");
  html += row(
      "Evaluations", fmt::format("{} ({})", result.evaluations, result.jacobian_evaluations),
      "How often the search computed the model; in brackets, how many of these times with its derivatives.");
  html += row("Ended because", "", sim::html_text(result.termination));
  return html + "</tbody>\n</table>\n";
}

std::string provenance_table(const FitResult& result) {
  const auto entry = [](const std::string& name, const std::string& value) {
    return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>\n";
  };
  std::string html = "<table class=\"provenance\">\n<tbody>\n";
  html +=
      entry("Made with", sim::html_text("vegard " + sim::version() + ", Ceres " + ceres_version() +
                                        ", OpenCV " + opencv_version() + ", Eigen " + sim::eigen_version()));
  html += entry("Command", "<code>" + sim::html_text(result.command) + "</code>");
  html += entry("Seed", std::to_string(result.seed));
  for (const InputFile& input : result.inputs)
    html += entry("Input: " + sim::html_text(input.role), sim::html_text(input.name) +
                                                              "<div class=\"hash\">SHA-256 " +
                                                              sim::html_text(input.sha256) + "</div>");
  for (const PhotoFact& fact : result.from_photograph)
    html += entry("From the photograph", sim::html_text(fact_text(fact)));
  for (const FittedPhoto& photo : result.photos)
    html += entry("Decoding" + (photo.name.empty() ? std::string() : ": " + sim::html_text(photo.name)),
                  sim::html_text(photo.decoding));
  return html + "</tbody>\n</table>\n";
}

}  // namespace vegard::fit
