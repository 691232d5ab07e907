// Objections to a calibration that follow from its own stars.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/star_table.h"

namespace vegard::fit {

/// What is known beside the calibration.
struct StarEvidence {
  SkyOfPicture sky;
  const Photo* photo = nullptr;  ///< the picture; null: there is none
  std::vector<char> usable;      ///< per pixel of it, whether the mask leaves it; empty: all are
  bool is_table = false;         ///< whether the stars are those of a table
  std::string why_level;  ///< what says that the camera looks to the zenith, "--camera looks to the zenith";
                          ///< empty: nothing but a fisheye's circle, which is looked for
  double faintest = 4.0, min_elevation_deg = 5.0, min_signal = 4.0;  ///< as stars were found
};

/// Appends to the warnings of a calibration by stars: bright stars in view that match nothing in the picture,
/// an axis away from the zenith where something says that it is there, and what stars cannot tell. Of one by
/// maps there are none.
void add_star_doubts(Calibration& calibration, const StarEvidence& evidence);

}  // namespace vegard::fit
