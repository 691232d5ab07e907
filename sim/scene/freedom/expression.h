// A formula of named numbers, such as "0.8 * sheet.a.energy_kev" or "distance * sin_deg(17)".
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
  /// `known`: the names that it may use. They may hold dots and hyphens: where a known name stands, it is
  /// meant, and no difference of two. Throws Error(scene), which names neither file nor key: an unknown name
  /// (with the nearest as a hint), or a formula that cannot be understood (with the place).
  Expression(const std::string& text, const std::vector<std::string>& known);

  const std::string& text() const { return text_; }

  /// Those of `known` that it uses, in the order of their first appearance.
  const std::vector<std::string>& names() const { return names_; }

  /// `values` in the order of names(). Not finite where the formula has no value (the root of -1). May be
  /// called from several threads at a time.
  double value(const std::vector<double>& values) const;

  /// d value / d name. Central differences with steps h and h / 2, h = 2^-12 of the value (at least 2^-12 of
  /// a thousandth), and one step of Richardson's extrapolation, whose error is of the order of h^4: about as
  /// small as rounding leaves it, 1e-12 of the formula's value over that of the name.
  std::vector<double> slopes(const std::vector<double>& values) const;

  /// Words that a name must not be: functions and constants.
  static const std::vector<std::string>& reserved_words();

 private:
  class Formula;
  std::string text_;
  std::vector<std::string> names_;
  std::shared_ptr<const Formula> formula_;
};

}  // namespace vegard::sim
