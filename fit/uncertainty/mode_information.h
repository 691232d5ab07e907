// What one picture says of the uncertainty of the emission tables.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

/// How the column of a line over that of a reference line follows the modes.
struct LineByModes {
  double wavelength_nm = 0.0, over_nm = 0.0;
  std::vector<double> ln_ratio;  ///< change of the ratio's logarithm by one standard deviation of each mode
};

/// ln L(a) = -a^T A a / 2 + b^T a + a constant for the coefficients a of the modes of the tables' uncertainty
/// (sim/light/tables/light_modes.h), from those of the scene, with everything else of the picture
/// marginalised. Several pictures with the same physics have the sum of their A and b.
struct ModeInformation {
  std::string tables;      ///< SHA-256 of the table of the modes: pictures with another have other modes
  std::vector<int> modes;  ///< from 0; none if nothing is known
  std::vector<double> information;  ///< A, row-major
  std::vector<double> towards;      ///< b
  std::vector<LineByModes> lines;   ///< for the answer's electrons
};

}  // namespace vegard::fit
