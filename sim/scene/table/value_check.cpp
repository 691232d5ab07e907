#include "sim/scene/table/value_check.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

std::string expected_text(const Declaration& d) {
  const ParameterRow& row = first_row_of(d);
  std::string limits = limits_text(row);
  if (row.kind == ParameterKind::boolean) return limits;
  if (row.kind == ParameterKind::text) return limits.empty() ? "a text in quotes" : limits;
  std::string text = row.kind == ParameterKind::integer ? "a whole number" : "a number";
  // "from 0.1 to 20", but "at least 0".
  if (!limits.empty())
    text += (std::isfinite(row.min) && std::isfinite(row.max) ? " from " : " of ") + limits;
  return row.unit.empty() ? text : text + " (" + row.unit + ")";
}

std::optional<Complaint> number_complaint(const Declaration& d, double number) {
  if (!std::isfinite(number))
    return Complaint{real_text(number) + " is no usable number", expected_text(d), ""};
  if (number < d.min || number > d.max) {
    return Complaint{short_real_text(number) + " is outside the limits", expected_text(d), ""};
  }
  return d.number_rule ? d.number_rule(number) : std::nullopt;
}

std::optional<Complaint> text_complaint(const Declaration& d, const std::string& text) {
  if (!d.choices.empty() && std::find(d.choices.begin(), d.choices.end(), text) == d.choices.end()) {
    const std::string nearest = nearest_name(text, d.choices);
    return Complaint{"\"" + text + "\" is not one of the choices", expected_text(d),
                     is_near(text, nearest) ? "did you mean \"" + nearest + "\"?" : ""};
  }
  return d.text_rule ? d.text_rule(text) : std::nullopt;
}

}  // namespace vegard::sim
