#include "fit/report/table/curtain_steps_table.h"

#include <cmath>

#include <fmt/format.h>

#include "fit/answer/information_criteria.h"
#include "sim/base/file/number_text.h"
#include "sim/base/shown_text.h"

namespace vegard::fit {
namespace {

std::string plain_amount(double bic) {
  return bic >= 1e4 ? fmt::format("{:.0f}", bic) : sim::short_number(bic, 3);
}

}  // namespace

const char* change_name(CurtainStep::Change change) {
  switch (change) {
    case CurtainStep::Change::start:
      return "start";
    case CurtainStep::Change::drop:
      return "drop";
    case CurtainStep::Change::add:
      return "add";
  }
  return "";
}

std::string curtain_step_in_words(const CurtainStep& step) {
  if (step.change == CurtainStep::Change::start)
    return fmt::format(
        "{} of the map, settled together",
        step.curtains == 1 ? std::string("the curtain") : fmt::format("the {} curtains", step.curtains));
  const bool drops = step.change == CurtainStep::Change::drop;
  const char* what = drops ? (step.kept ? "is not needed" : "stays")
                           : (step.kept ? "belongs to the picture" : "is left out");
  const double by = std::abs(step.bic_lower_by);
  return fmt::format("{} {}: BIC {} {} {} {} it ({})", step.curtain, what, step.kept ? "is" : "would be",
                     plain_amount(by), step.kept ? "lower" : "higher", drops ? "without" : "with",
                     evidence_words(by));
}

std::string curtain_steps_table(const FitResult& result) {
  if (result.curtain_steps.empty()) return {};
  std::string html =
      "<table>\n<thead><tr><th>step</th><th class=\"number\">curves</th><th "
      "class=\"number\">\u03c7\u00b2</th><th class=\"number\">unknowns</th><th class=\"number\">BIC "
      "changes by</th></tr></thead>\n<tbody>\n";
  for (const CurtainStep& step : result.curtain_steps) {
    const std::string change =
        step.change == CurtainStep::Change::start
            ? std::string("\u2013")
            : (step.bic_lower_by > 0.0 ? "\u2212" : "+") + plain_amount(std::abs(step.bic_lower_by));
    html += fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
        "class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
        sim::html_text(curtain_step_in_words(step)), step.curtains,
        sim::html_text(sim::short_number(step.chi2, 6)), step.unknowns, change);
  }
  return html + "</tbody>\n</table>\n";
}

}  // namespace vegard::fit
