// Several photographs of the same aurora measured together: each by itself, then heights by geometry alone.
//
// Each picture is measured as `vegard measure` does it, without a map. The lower borders of each pair are
// matched as curves (fit/triangulation/border_match.h), which gives the border's height, and the pictures'
// patterns are laid on shells (fit/triangulation/shell_correlation.h), which gives the height of the densest
// light, and their light along the field lines is compared (fit/triangulation/curtain_profiles.h), which
// gives the border's height best. No physics of electrons is used. A difference of the clocks moves the light
// between the pictures by an unknown drift: an error of the second camera, or what
// fit/triangulation/clock_offsets.h makes of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/measurement/together/pair_height.h"
#include "fit/measurement/together/pair_of_pictures.h"

namespace vegard::fit {

struct TogetherMeasurement {
  std::vector<Measurement> alone;
  std::vector<PairOfPictures> pairs;
  ClockSolution clocks;  ///< of all pictures, by the pairs whose light along the field lines is sound
  std::optional<PairHeight> common_border;
  Trust trust = Trust::unconstrained;
  std::string word;
  std::vector<std::string> answer;
  std::string command, out;
};

/// Throws Error(usage) for the same picture twice, and as measure() does for each picture, before anything is
/// measured or written.
TogetherMeasurement measure_together(const TogetherRequest& request, const MeasureFollower& follower = {});

/// The report, which shows pictures in its own folder, and its numbers.
std::string together_page(const TogetherMeasurement& measurement);
std::string together_json(const TogetherMeasurement& measurement);

}  // namespace vegard::fit
