#include "fit/report/table/stability_table.h"

#include <cmath>

#include "sim/base/file/html_text.h"
#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace {

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
  const std::string of = " of the " + result.best.sheets[0].name + " sheet";
  if (const std::size_t at = name.find(of); at != std::string::npos) name.erase(at, of.size());
  return name;
}

std::string signed_number(double value) {
  return (value < 0.0 ? "\u2212" : "+") + sim::short_number(std::abs(value), 2);
}

std::string number_cell(const std::string& text) { return "<td class=\"number\">" + text + "</td>"; }

std::string unit_of(const DerivedNumber& number) {
  return number.unit.empty() ? "" : " (" + sim::html_text(number.unit) + ")";
}

}  // namespace

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
      html += number_cell(i < row.derived.size() && std::isfinite(row.derived[i].by)
                              ? signed_number(row.derived[i].by)
                              : "\u2013");
    html += number_cell(std::isfinite(row.chi2_per_dof) ? sim::short_number(row.chi2_per_dof, 3) : "\u2013") +
            "</tr>\n";
  }
  const auto errors = [&](const char* name, const auto& error_of) {
    html += std::string("<tr class=\"strong\"><td colspan=\"2\">") + name + "</td>";
    for (const std::size_t i : shown) {
      const std::optional<double> error = error_of(result.derived[i]);
      html += number_cell(error ? "\u00b1\u00a0" + sim::short_number(*error, 2) : "\u2013");
    }
    html += "<td></td></tr>\n";
  };
  errors("Statistical error", [](const DerivedNumber& d) { return d.sigma; });
  errors("Systematic error, by the choices above", [](const DerivedNumber& d) { return d.systematic; });
  errors("Both", [](const DerivedNumber& d) { return d.error(); });
  return html + "</tbody>\n</table>\n";
}

}  // namespace vegard::fit
