// Recognises stars in a picture of an unknown camera: its pointing, field of view, roll, lens and parity are
// unknown, and so are the time and the place.
//
// Figures of four neighbouring points are made directions by an assumed lens and looked up among those of
// the stars (asterisms.h). Lenses assumed: pinholes, stereographic, equidistant and equisolid ones of 16 to
// 230 degrees across the picture's longer side, in steps that change a figure's shape by less than the
// tolerance; both ways round; the centre in the middle, and for crops of a wide picture (`off_centre`) at
// eight places about it. Each hit gives rotation and scale; the stars around it are looked for, and the best
// hits are grown to a camera (growing_camera.h). The search goes from the few brightest points to many and
// ends with the first camera that cannot be chance.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/blind/growing_camera.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

struct RecognitionSettings {
  bool off_centre = true;  ///< if it is not found otherwise
  int max_points = 300;    ///< of these the picture's figures and counts are made
};

struct StarRecognition {
  bool found = false;             ///< is_certain() of `best`
  GrownCamera best;               ///< by the stars of equatorial_sky(), whose indices its matches have
  std::vector<FoundStar> points;  ///< those that were looked at, in the order of `best.matches`
  int figures = 0;                ///< of the picture that were looked up
  double cameras = 0.0;           ///< that were thought of

  /// Recognised stars with x_px, y_px; directions as in equatorial_sky(), J2000.
  std::vector<StarSighting> stars() const;
};

/// `points`: the brightest first. The same input gives the same answer.
StarRecognition recognise_stars(const std::vector<FoundStar>& points, const Frame& frame,
                                const RecognitionSettings& settings = {});

/// What was seen, and of a failed search what would help; one sentence a line.
std::string words_of(const StarRecognition& recognition);

}  // namespace vegard::fit
