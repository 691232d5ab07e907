// Parses line brightnesses from a command line: "427.8=2300±50".
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
  /// The error of a brightness; the relative part is 0 for a brightness below 0.
  double of(double brightness_rayleigh) const;
};

struct LineMeasurement {
  double wavelength_nm = 0.0;  ///< wavelength in the list of lines
  double rayleigh = 0.0;
  std::optional<BrightnessError> error;
};

/// Parses "NM=RAYLEIGHS", which may be followed by ±, +- or +/- and the error, in rayleighs or, with % behind
/// it, relative. Throws sim::Error(usage) about --line for anything else: an unknown line, a brightness below
/// 0, an error of 0 or below.
LineMeasurement line_measurement(const std::string& text);

/// Parses "50" or "5%"; throws sim::Error(usage) about `option` unless it is above 0.
BrightnessError brightness_error(const std::string& text, const std::string& option);

/// The parts of "557.7=REST".
struct LineWord {
  double wavelength_nm = 0.0;
  std::string rest;
};
/// Parses "NM=REST", where NM is a wavelength near that of a line of the aurora. Throws sim::Error(usage)
/// about `option`; `expected` is the form that the message asks for.
LineWord line_word(const std::string& text, const std::string& option, const std::string& expected);

/// Throws sim::Error(usage) about `option` if a line occurs twice, or if there are more than eight lines.
void require_different_lines(const std::vector<double>& lines_nm, const std::string& option);

}  // namespace vegard::fit
