// Column-ratio inversion of maps: every pixel by itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/columns/column_inversion.h"
#include "fit/columns/line_measurement.h"

namespace vegard::fit {

/// One line's brightness and its errors, row by row. `known_error` may be empty: then the error is that of
/// BrightnessError alone.
struct LineMap {
  std::vector<float> rayleigh;     ///< NaN: not measured
  std::vector<float> known_error;  ///< in rayleighs; added in quadrature
  BrightnessError error;
};

/// As the line maps. NaN where a pixel has no answer, and an error where the answer is at an edge of the
/// tables.
struct ColumnMaps {
  std::size_t width = 0, height = 0;
  std::vector<float> energy_kev, flux_mw_m2, oxygen_factor;
  std::vector<float> ln_energy_error, relative_flux_error, ln_oxygen_error;
  std::vector<float> other_energy_kev;  ///< of a second solution, else NaN
  std::vector<float> chi2;
  std::vector<std::uint8_t> quality;  ///< a ColumnVerdict
};

/// Of the lines of chi2's model, in its order. Errors are by the covariance at the minimum; what an interval
/// by the likelihood would add is in `quality`: at an edge (or within two standard deviations of it), with a
/// second valley, with a chi2 that contradicts. Pixels without a line above three of its errors have no
/// light. `threads` (0: all) changes nothing.
ColumnMaps invert_maps(const ColumnChi2& chi2, const std::vector<LineMap>& lines, std::size_t width,
                       std::size_t height, int threads);

}  // namespace vegard::fit
