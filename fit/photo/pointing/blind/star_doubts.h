// Objections to a calibration that follow from its own stars.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/star_finder.h"
#include "fit/photo/pointing/star_table.h"

namespace vegard::fit {

/// The evidence beside the calibration.
struct StarEvidence {
  SkyOfPicture sky;
  const Photo* photo = nullptr;   ///< the picture; null: there is none
  std::vector<char> usable;       ///< per pixel, 0 if the mask excludes it; empty: all are usable
  std::vector<FoundStar> points;  ///< the picture's, if they have been found; empty: they are found again
  bool is_table = false;          ///< true if the stars are those of a table
  std::string why_level;  ///< the evidence that the camera looks to the zenith, "--camera looks to the
                          ///< zenith"; empty: only a fisheye's circle, if there is one
  double faintest = 4.0, min_elevation_deg = 5.0,
         min_signal = 4.0;  ///< the settings with which stars were found
};

/// Sets Calibration::explained, and appends to the warnings of a calibration by stars: bright stars in view
/// that match nothing in the picture, an axis away from the zenith in spite of the evidence, and what stars
/// cannot determine. A calibration by maps gets none.
void add_star_doubts(Calibration& calibration, const StarEvidence& evidence);

}  // namespace vegard::fit
