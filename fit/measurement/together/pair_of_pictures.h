// What two photographs of the same aurora from different places say of its height.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/measurement/measure.h"
#include "fit/triangulation/border_match.h"
#include "fit/triangulation/clock_offsets.h"
#include "fit/triangulation/curtain_profiles.h"
#include "fit/triangulation/shell_correlation.h"

namespace vegard::fit {

struct TogetherRequest {
  std::vector<MeasureRequest> pictures;  ///< two or more; their folders are chosen in `out`
  std::string out;                       ///< the folder to write
  EarthShape earth = EarthShape::wgs84;
  double clock_error_s = 2.0;                ///< of each camera
  double drift_km_s = 0.5;                   ///< standard deviation of each horizontal component
  std::optional<double> pointing_error_deg;  ///< none: as the cameras' files say
  bool overwrite = false;
  bool no_map = false;  ///< the geometry alone
  bool resume = false;  ///< of an interrupted measurement: the finished steps of its maps are taken
  std::string command;
};

/// Pictures farther apart in time are not measured together.
inline constexpr double kLongestApart_s = 60.0;

/// What two of the pictures say.
struct PairOfPictures {
  std::size_t first = 0, second = 0;
  std::string refusal;               ///< why there is no height; empty: it was looked for
  double base_km, base_azimuth_deg;  ///< from the first camera to the second; NaN if not known
  double apart_s;                    ///< the middles of the exposures; NaN if a time is not known
  double later_s = 0.0;              ///< the second picture, by the clocks; 0 if a time is not known
  double exposures_s = 0.0;          ///< half the difference of the exposures; one not known counts as 0
  double smeared_km = 0.0;           ///< standard deviation of the light's movement in that time
  double shared_share;               ///< of the first picture's sky, at 110 km
  BorderMatches borders;
  bool is_peak_cut = false;  ///< the brightest light above a compared border is clipped or hidden
  std::optional<ShellCorrelation> pattern;
  ProfileMatch profiles;           ///< by the light along the field lines
  ClockSolution clocks;            ///< by `profiles`, of the two pictures alone
  std::vector<ViewPoint> cameras;  ///< both

  PairOfPictures();
};

/// The height of the lower border by a pair's best match; none if there is none.
const BorderMatch* best_border(const PairOfPictures& pair);
/// The height of the densest light, if one height is clearly the most probable and known to 20 km.
const ShellHeight* clear_pattern(const PairOfPictures& pair);
/// The trace of a picture, 0 or 1 of the pair, whose light is compared: of the best match, or else the
/// picture's main border; none without.
std::optional<std::size_t> compared_trace(const PairOfPictures& pair, const Measurement& alone,
                                          std::size_t which);
/// Whether the light along the field lines gives a height that is clearly the most probable.
bool has_clear_profiles(const PairOfPictures& pair);
/// What the profiles of a pair say of its clocks and height together.
MovedPair moved_pair(const PairOfPictures& pair);

/// The folder of one picture's own measurement.
std::string folder_of(const TogetherRequest& request, std::size_t picture);

/// Compares two pictures that have been measured by themselves.
PairOfPictures pair_of(const TogetherRequest& request, const std::vector<Measurement>& alone,
                       std::size_t first, std::size_t second);

}  // namespace vegard::fit
