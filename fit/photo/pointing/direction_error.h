// How well the direction of a pixel is known by a calibration, at any place of the picture.
//
// Two errors are added in quadrature. The first follows from the covariance of all fitted numbers, and grows
// where no stars are. The second is of the lens's form, which no covariance contains: every other lens of the
// calibration that foretells the stars about as well (leave-one-out residuals up to 1.2 times as large) is a
// second opinion, and the root of the mean square of their differences from the chosen one is its error.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "fit/photo/pointing/calibration.h"

namespace vegard::fit {

struct DirectionError {
  double by_stars_deg = 0.0;  ///< standard deviation along the larger axis of the error ellipse
  double by_lens_deg = 0.0;   ///< by other lenses
  double total_deg() const;
};

/// Returns the error of a pixel's direction; none outside of the lens's picture.
std::optional<DirectionError> direction_error(const Calibration& calibration, double x_px, double y_px);

/// The same for a direction in the observer's sky (east, north, up).
std::optional<DirectionError> direction_error(const Calibration& calibration,
                                              const std::array<double, 3>& enu);

/// How well the directions of a picture's pixels are known.
struct DirectionErrors {
  double typical_deg = 0.0;  ///< median over the picture's sky
  double worst_deg = 0.0;    ///< largest error in the picture's sky
  double worst_x_px = 0.0, worst_y_px = 0.0;
  int opinions = 0;  ///< number of other lenses that foretell the stars about as well
};

/// Returns the errors over a grid of the picture's places that look above the observer's horizon.
DirectionErrors direction_errors(const Calibration& calibration);

/// How the sentence of words_of() begins.
inline constexpr const char* kDirectionsKnown = "directions are known to ";

/// Returns "directions are known to 0.05 deg typically, to 0.4 deg at (12, 300), where it is worst".
std::string words_of(const DirectionErrors& errors);

}  // namespace vegard::fit
