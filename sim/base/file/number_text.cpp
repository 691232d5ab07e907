#include "sim/base/file/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/text.h"

namespace vegard::sim {
namespace {

const char* const kNothing = "\u2013";

std::string with_true_minus(std::string text) {
  if (text.empty() || text.front() != '-') return text;
  if (text.find_first_of("123456789") == std::string::npos) return text.substr(1);
  return "\u2212" + text.substr(1);
}

/// Power of ten of the leading digit, after rounding to so many digits.
int leading_power(double size, int digits) {
  const std::string text = fmt::format("{:.{}e}", size, digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

/// Returns a number with this many decimals; a negative number of decimals rounds to tens or hundreds.
std::string at_place(double value, int decimals) {
  if (decimals >= 0) return with_true_minus(fmt::format("{:.{}f}", value, decimals));
  const double unit = std::pow(10.0, -decimals);
  return with_true_minus(fmt::format("{:.0f}", std::round(value / unit) * unit));
}

std::string power_text(int power) {
  static const char* const kDigits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                        "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = " \u00d7 10";
  for (const char c : std::to_string(power)) text += c == '-' ? "\u207b" : kDigits[c - '0'];
  return text;
}

/// Outside of these a power of ten is easier to read.
bool everyday(int power, int decimals) { return power < 7 && decimals <= 7; }

}  // namespace

RoundedNumber rounded(double value, std::optional<double> sigma) {
  RoundedNumber number;
  if (!std::isfinite(value)) {
    number.value = kNothing;
    return number;
  }
  if (!sigma || !std::isfinite(*sigma) || *sigma <= 0.0) {
    constexpr int kDigitsUnknown = 3;
    number.value = short_number(value, kDigitsUnknown);
    return number;
  }
  const int decimals = 1 - leading_power(*sigma, 2);
  const int power = value == 0.0 ? 1 - decimals : std::max(leading_power(std::abs(value), 2), 1 - decimals);
  if (everyday(power, decimals)) {
    number.value = at_place(value, decimals);
    number.sigma = at_place(*sigma, decimals);
    return number;
  }
  const double unit = std::pow(10.0, power);
  number.value = at_place(value / unit, decimals + power);
  number.sigma = at_place(*sigma / unit, decimals + power);
  number.exponent = power_text(power);
  return number;
}

std::string number_with_error(double value, std::optional<double> sigma) {
  const RoundedNumber number = rounded(value, sigma);
  if (number.sigma.empty()) return number.value;
  const std::string both = number.value + " \u00b1 " + number.sigma;
  return number.exponent.empty() ? both : "(" + both + ")" + number.exponent;
}

std::string short_number(double value, int significant_digits) {
  if (!std::isfinite(value)) return kNothing;
  if (value == 0.0) return "0";
  const int power = leading_power(std::abs(value), significant_digits);
  if (power >= 7 || power <= -5)
    return with_true_minus(fmt::format("{:.{}g}", value / std::pow(10.0, power), significant_digits)) +
           power_text(power);
  return without_trailing_zeros(at_place(value, significant_digits - 1 - power));
}

}  // namespace vegard::sim
