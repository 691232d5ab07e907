// Column-ratio inversion of maps of line brightness, pixel by pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/columns/column_inversion.h"
#include "fit/columns/line_measurement.h"

namespace vegard::fit {

/// The brightness of one line and its errors, row by row. If `known_error` is empty, the error is that of
/// BrightnessError alone.
struct LineMap {
  std::vector<float> rayleigh;     ///< NaN: not measured
  std::vector<float> known_error;  ///< in rayleighs; added in quadrature
  BrightnessError error;
};

/// Results, row by row as the line maps. NaN where a pixel has no answer, or its lines contradict each other
/// (but chi2 and consistency are there); an error is also NaN where the answer is at an edge of the tables.
struct ColumnMaps {
  std::size_t width = 0, height = 0;
  std::vector<float> energy_kev, flux_mw_m2, oxygen_factor;
  std::vector<float> ln_energy_error, relative_flux_error, ln_oxygen_error;
  std::vector<float> soft_ratio, ln_soft_error;  ///< of a free soft component; else NaN
  std::vector<float> other_energy_kev;           ///< of a second solution, else NaN
  std::vector<float> chi2;
  /// Probability of so large a chi2 by chance; without a degree of freedom exp(-chi2/2).
  std::vector<float> consistency;
  std::vector<std::uint8_t> quality;  ///< a ColumnVerdict
};

/// Returns whether most of the pixels that have light contradict the tables, or ask for another spectrum.
bool most_contradict(const ColumnMaps& maps);

/// Inverts the maps of the lines of chi2's model, in its order. Errors are by the covariance at the minimum.
/// What a likelihood interval would add is in `quality`: an answer at an edge (or within two standard
/// deviations of it), a second minimum, a chi2 that contradicts the model. Pixels in which no line exceeds
/// three of its errors have no light. `with_soft` is of the same electrons with a soft component, by which
/// pixels that ask for another spectrum are found (spectrum_trials.h); null: they are not. `threads` (0: all)
/// does not change the result.
ColumnMaps invert_maps(const ColumnChi2& chi2, const ColumnChi2* with_soft, const std::vector<LineMap>& lines,
                       std::size_t width, std::size_t height, int threads);

/// Returns up to `most` of the pixels with light, evenly through the maps.
std::vector<ColumnData> lit_sample(const std::vector<LineMap>& lines, std::size_t most);

}  // namespace vegard::fit
