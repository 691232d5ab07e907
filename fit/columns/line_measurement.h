// Line brightnesses as people write them: "427.8=2300±50".
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

/// A standard deviation: in rayleighs, as a share of the brightness, or both, added in quadrature.
struct BrightnessError {
  double rayleigh = 0.0;
  double relative = 0.0;

  bool given() const { return rayleigh > 0.0 || relative > 0.0; }
  /// Of a brightness, whose share counts as 0 below 0.
  double of(double brightness_rayleigh) const;
};

struct LineMeasurement {
  double wavelength_nm = 0.0;  ///< that of the list of lines
  double rayleigh = 0.0;
  std::optional<BrightnessError> error;
};

/// "NM=RAYLEIGHS", then ± or +- and the error, in rayleighs or with a % behind it. Throws sim::Error(usage)
/// about --line for anything else: no known line of the aurora, a brightness below 0, an error of 0 or below.
LineMeasurement line_measurement(const std::string& text);

/// "50" or "5%"; throws sim::Error(usage) about `option` unless it is above 0.
BrightnessError brightness_error(const std::string& text, const std::string& option);

/// "557.7=REST": the wavelength of the line of the aurora that is meant, and REST. Throws sim::Error(usage)
/// about `option`; `expected` is the form.
struct LineWord {
  double wavelength_nm = 0.0;
  std::string rest;
};
LineWord line_word(const std::string& text, const std::string& option, const std::string& expected);

/// Throws sim::Error(usage) about `option` if one line stands there twice, or more than eight lines.
void require_different_lines(const std::vector<double>& lines_nm, const std::string& option);

}  // namespace vegard::fit
