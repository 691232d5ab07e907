// Writes a calibration as text: its stars (CSV), everything (JSON), and its lenses for the terminal.
#pragma once

#include <string>

#include "fit/photo/pointing/scene_camera.h"

namespace vegard::fit {

/// Returns a table with a line per star: its direction, its place in the picture, residuals, and whether it
/// was used.
std::string residuals_csv(const Calibration& calibration);

/// Returns the stars with right ascension and declination, their residuals by fits with and without them, and
/// what is held out in comments: a table that `vegard calibrate` reads. Stars that data/stars does not have
/// are left out.
std::string stars_csv(const Calibration& calibration);

/// Returns the lenses compared, the numbers with error bars and correlations, the stars and the warnings.
std::string calibration_json(const Calibration& calibration, const CalibrationOrigin& origin);

/// Returns a list of the `most` best lenses, the best first: "lens, numbers, rms, BIC over the best's".
std::string candidates_text(const Calibration& calibration, int most);

}  // namespace vegard::fit
