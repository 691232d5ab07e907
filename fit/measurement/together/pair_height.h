// The height of the border that a pair of pictures gives, what speaks against it, and what one picture alone
// had said of the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/measurement/together/pair_of_pictures.h"

namespace vegard::fit {

struct PairHeight {
  double km = 0.0, error_km = 0.0;
  bool is_by_profiles = false;      ///< by the light along the field lines; else by the borders alone
  int points = 0;                   ///< of the borders' match
  std::vector<std::string> doubts;  ///< parts of sentences; empty: the height is good
  bool is_wide = false;             ///< the last doubt is the width of the error
};

/// The height by the light along the field lines where that is clear, else by the borders alone; none if
/// neither has one.
std::optional<PairHeight> height_of(const PairOfPictures& pair);

/// The height of the brightest light along the field lines and its standard error, with the border's doubts;
/// none if that is not clear, or the brightest light is clipped or hidden in a picture.
std::optional<PairHeight> peak_of(const PairOfPictures& pair);

/// Whether the light along the field lines gives a height, and nothing speaks against it but the width of its
/// error.
bool has_sound_profiles(const PairOfPictures& pair);

/// The height of the border by all sound pairs; none by fewer than two of them, or if they contradict each
/// other. `clocks`: by the same pairs.
std::optional<PairHeight> common_border(const std::vector<PairOfPictures>& pairs,
                                        const ClockSolution& clocks);

/// Whether two of these heights differ by more than three standard deviations: pictures of one aurora do not.
bool contradict(const std::vector<PairHeight>& heights);

/// The distance of a picture's main border along the ground, by the pair's height; NaN if the pair is not of
/// that border. `which`: 0 or 1, of the pair.
struct BorderDistance {
  double km, error_km;
};
BorderDistance distance_by(const PairOfPictures& pair, const PairHeight& height, const Measurement& alone,
                           std::size_t which);

/// A point of a border as a camera sees it: apparent directions.
struct SeenBorder {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
  double error_deg = 0.0;  ///< of the elevation, with both cameras' pointing; 0 of what is predicted
};

/// What the first picture alone says of the second: where that shows the border if its height is anything
/// between the limits of kBorderAltitudesKm (fit/border/border_distance.h), as the first one's own distance
/// supposes.
struct CrossCheck {
  std::vector<SeenBorder> lowest, highest;  ///< predicted, in the order of the first picture's border
  std::vector<SeenBorder> shown;            ///< by the second picture
  int compared = 0, covered = 0;            ///< points of `shown` where there is a prediction; within it
  std::string sentence;                     ///< with the quantity that has to change, if it does not cover
};
CrossCheck cross_check(const PairOfPictures& pair, const Measurement& first, const Measurement& second);

}  // namespace vegard::fit
