// Several photographs of the same aurora measured together: each by itself, then heights by geometry alone.
//
// Each picture is measured as `vegard measure` does it, without a map. The lower borders of each pair are
// matched as curves (fit/triangulation/border_match.h), which gives the border's height, and the pictures'
// patterns are laid on shells (fit/triangulation/shell_correlation.h), which gives the height of the densest
// light, and their light along the field lines is compared (fit/triangulation/curtain_profiles.h), which
// gives the border's height best. No physics of electrons is used for that. A difference of the clocks moves
// the light between the pictures by an unknown drift: an error of the second camera, or what
// fit/triangulation/clock_offsets.h makes of it. Then, unless it is not wanted, one map of the electrons
// explains all pictures (joint_map.h), another each of them alone, and geometry and map check each other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/measurement/together/joint_map.h"
#include "fit/measurement/together/pair_height.h"
#include "fit/measurement/together/pair_of_pictures.h"

namespace vegard::fit {

struct TogetherMeasurement {
  std::vector<Measurement> alone;
  std::vector<PairOfPictures> pairs;
  ClockSolution clocks;  ///< of all pictures, by the pairs whose light along the field lines is sound
  std::optional<PairHeight> common_border;
  std::optional<JointMap> joint_map;          ///< none where none is wanted, or before it is made
  std::vector<Contradiction> contradictions;  ///< between geometry and map
  bool is_map_interrupted = false;            ///< that of all, or of one alone
  Trust trust = Trust::unconstrained;
  std::string word;
  std::vector<std::string> answer;
  std::string command, out;
};

/// Throws Error(usage) for the same picture twice, and as measure() does for each picture, before anything is
/// measured or written. The report of the geometry is there while the maps are made.
TogetherMeasurement measure_together(const TogetherRequest& request, const MeasureFollower& follower = {});

/// The geometry's height that is compared with that of the map of all pictures.
std::optional<PairHeight> compared_height(const TogetherMeasurement& measurement);

/// The report, which shows pictures in its own folder, and its numbers.
std::string together_page(const TogetherMeasurement& measurement);
std::string together_json(const TogetherMeasurement& measurement);

}  // namespace vegard::fit
