// Several photographs of the same aurora measured together: each by itself, then heights by geometry alone.
//
// Each picture is measured as `vegard measure` does it, without a map. The lower borders of each pair are
// matched as curves (fit/triangulation/border_match.h), which gives the border's height, and the pictures'
// patterns are laid on shells (fit/triangulation/shell_correlation.h), which gives the height of the densest
// light. No physics of electrons is used. A difference of the clocks moves the light between the pictures by
// an unknown drift, which is an error of the second camera.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/measurement/measure.h"
#include "fit/triangulation/border_match.h"
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
  double shared_share;               ///< of the first picture's sky, at 110 km
  BorderMatches borders;
  std::optional<ShellCorrelation> pattern;
  std::vector<ViewPoint> cameras;  ///< both

  PairOfPictures();
};

struct TogetherMeasurement {
  std::vector<Measurement> alone;
  std::vector<PairOfPictures> pairs;
  Trust trust = Trust::unconstrained;
  std::string word;
  std::vector<std::string> answer;
  std::string command, out;
};

/// The height of the lower border by a pair's best match; none if there is none.
const BorderMatch* best_border(const PairOfPictures& pair);
/// Whether two of these heights differ by more than three standard deviations: pictures of one aurora do not.
bool contradict(const std::vector<MeanHeight>& heights);
/// The height of the densest light, if one height is clearly the most probable and known to 20 km.
const ShellHeight* clear_pattern(const PairOfPictures& pair);

/// Throws Error(usage) for the same picture twice, and as measure() does for each picture, before anything is
/// measured or written.
TogetherMeasurement measure_together(const TogetherRequest& request, const MeasureFollower& follower = {});

/// The report, which shows pictures in its own folder, and its numbers.
std::string together_page(const TogetherMeasurement& measurement);
std::string together_json(const TogetherMeasurement& measurement);

}  // namespace vegard::fit
