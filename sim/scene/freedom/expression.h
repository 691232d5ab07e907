// Formulas with named numbers, such as "0.8 * sheet.a.energy_kev" or "distance * sin_deg(17)".
//
// Numbers, names, + - * / ^, parentheses; sin, cos, tan of radians and sin_deg, cos_deg, tan_deg of degrees;
// exp, log (natural), sqrt, abs, pow(x, y), min(x, y), max(x, y), atan2(y, x); pi.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace vegard::sim {

class Expression {
 public:
  /// Parses a formula with names out of `known`. Names may contain dots and hyphens: text that matches a
  /// known name is that name, not a difference. Throws Error(scene) without file and key for an unknown name
  /// (with the nearest one as a hint) and for a syntax error (with its position).
  Expression(const std::string& text, const std::vector<std::string>& known);

  const std::string& text() const { return text_; }

  /// Returns the names in the formula, in the order of their first appearance.
  const std::vector<std::string>& names() const { return names_; }

  /// Returns the value for `values` in the order of names(); not finite where the formula is undefined (the
  /// root of -1). May be called from several threads at the same time.
  double value(const std::vector<double>& values) const;

  /// Returns the derivatives of the formula by each of names(): central differences with steps h and h / 2,
  /// h = 2^-12 max(|value of the name|, 0.001), and one step of Richardson's extrapolation, whose error is of
  /// the order of h^4. The rounding error is about 1e-12 of the formula's value over the name's.
  std::vector<double> slopes(const std::vector<double>& values) const;

  /// Returns the words that are not allowed as names: functions and constants.
  static const std::vector<std::string>& reserved_words();

 private:
  class Formula;
  std::string text_;
  std::vector<std::string> names_;
  std::shared_ptr<const Formula> formula_;
};

}  // namespace vegard::sim
