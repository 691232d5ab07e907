// Numbers as text, rounded to their known precision.
#pragma once

#include <optional>
#include <string>

namespace vegard::sim {

/// A value and its standard deviation, as a table shows them.
struct RoundedNumber {
  std::string value;     ///< "4.33"
  std::string sigma;     ///< "0.12"; empty if there is none
  std::string exponent;  ///< " × 10⁻⁷" for both; empty for numbers of everyday size
};

/// Rounds sigma to two significant digits and the value to the same place; without a sigma (or one that is
/// not positive and finite) the value to three significant digits, which claim no more than is known. With a
/// true minus sign. What is not finite is "–".
RoundedNumber rounded(double value, std::optional<double> sigma);

/// "4.33 ± 0.12", "(1.20 ± 0.34) × 10⁻⁷", "4.33".
std::string number_with_error(double value, std::optional<double> sigma);

/// Rounded to this many significant digits.
std::string short_number(double value, int significant_digits = 5);

}  // namespace vegard::sim
