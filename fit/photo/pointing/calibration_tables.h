// A calibration as tables: of stars (CSV) and of everything (JSON).
#pragma once

#include <string>

#include "fit/photo/pointing/scene_camera.h"

namespace vegard::fit {

/// One line a star: where it stands, where it was seen, residuals, and whether it was used.
std::string residuals_csv(const Calibration& calibration);

/// Lenses compared, numbers with error bars and correlations, stars, warnings.
std::string calibration_json(const Calibration& calibration, const CalibrationOrigin& origin);

/// The lenses that were compared, for the terminal, the best first: "lens, numbers, rms, BIC over the
/// best's".
std::string candidates_text(const Calibration& calibration, int most);

}  // namespace vegard::fit
