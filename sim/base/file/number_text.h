// Numbers as text, rounded to their known precision.
#pragma once

#include <optional>
#include <string>

namespace vegard::sim {

/// A value and its standard deviation as text for tables.
struct RoundedNumber {
  std::string value;     ///< "4.33"
  std::string sigma;     ///< "0.12"; empty if there is none
  std::string exponent;  ///< " × 10⁻⁷" for both; empty for numbers that need none
};

/// Rounds sigma to two significant digits and the value to the same decimal place; without a sigma (or if it
/// is not positive and finite) the value to three significant digits. Uses the minus sign U+2212. Values that
/// are not finite become "–".
RoundedNumber rounded(double value, std::optional<double> sigma);

/// Returns "4.33 ± 0.12", "(1.20 ± 0.34) × 10⁻⁷" or, without a sigma, "4.33".
std::string number_with_error(double value, std::optional<double> sigma);

/// Returns a number rounded to this many significant digits.
std::string short_number(double value, int significant_digits = 5);

}  // namespace vegard::sim
