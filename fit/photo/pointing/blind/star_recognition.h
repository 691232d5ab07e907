// Recognises stars in a picture of an unknown camera: its pointing, field of view, roll, lens and parity are
// unknown, and so are the time and the place.
//
// An assumed lens turns four neighbouring points into an asterism of directions, which is looked up among
// those of the stars (asterisms.h). The assumed lenses are pinholes, stereographic, equidistant and equisolid
// ones of 16 to 230 degrees across the picture's longer side, in steps that change an asterism's code by less
// than the tolerance; mirrored and not; with the centre in the middle and, for crops of a wide picture
// (`off_centre`), at eight places around it. Each match gives a rotation and a scale; stars around it are
// searched for, and the best matches are grown to a camera (growing_camera.h). The search proceeds from the
// few brightest points to many and ends with the first camera that cannot be by chance. What is not found so
// may be a narrow field (narrow_search.h).
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/blind/growing_camera.h"
#include "fit/photo/pointing/star_finder.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct RecognitionSettings {
  bool off_centre = true;  ///< true: centres off the middle are tried if nothing else is found
  int max_points = 300;    ///< number of points that are used
  SkyPixels pixels;        ///< where the picture shows sky
  /// The observer's zenith in the axes of equatorial_sky(), if time and place are known: what is not found
  /// under the whole sky is looked for among the stars above the horizon, also by pairs (pair_search.h).
  std::optional<Eigen::Vector3d> zenith;
  /// Told the share of the longest search that is done, 0 to 1: most end earlier.
  std::function<void(double share)> progress;
};

struct StarRecognition {
  bool found = false;             ///< is_certain() of `best`
  GrownCamera best;               ///< its matches have the indices of deep_equatorial_sky()
  std::vector<FoundStar> points;  ///< the points that were used, in the order of `best.agreement.matches`
  int figures = 0;                ///< number of the picture's asterisms that were looked up
  double cameras = 0.0;           ///< number of cameras that were tried
  /// Degrees across the longer side: a narrower picture shows, on average, fewer than eight of the
  /// catalogue's stars.
  double narrowest_deg = 0.0;

  /// Returns the recognised stars with x_px, y_px; directions as in equatorial_sky(), J2000.
  std::vector<StarSighting> stars() const;
};

/// Recognises the stars among the points, the brightest of which come first. The result is deterministic.
StarRecognition recognise_stars(const std::vector<FoundStar>& points, const Frame& frame,
                                const RecognitionSettings& settings = {});

/// Returns the result in words and, after a failed search, what would help; one sentence per line.
std::string words_of(const StarRecognition& recognition);

/// The stars of a picture, found and recognised at the scale at which they are points. In a large photograph
/// a star is many pixels wide, but the finder's weight has a width of 1.2 px: the picture is reduced by one
/// integer factor after another, from 1 on, until the stars are recognised.
struct PictureStars {
  StarRecognition recognition;   ///< that of the first certain scale, or of the best
  std::vector<FoundStar> found;  ///< all points at that scale, in the picture's own pixels
  int smaller = 1;               ///< the factor by which the picture was reduced
};

/// Returns the points of light of the picture reduced by a factor, in its own pixels.
std::vector<FoundStar> points_of_smaller(const sim::Image& linear, const StarFinderSettings& finder,
                                         const std::vector<char>& usable, int smaller);

/// Recognises the stars; `linear`, `finder` and `usable` as for find_stars().
PictureStars recognise_picture(const sim::Image& linear, const StarFinderSettings& finder = {},
                               const std::vector<char>& usable = {},
                               const RecognitionSettings& settings = {});

}  // namespace vegard::fit
