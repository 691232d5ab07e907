// One map of the electrons that explains several pictures of the same aurora, with the physics of electrons.
//
// Each picture has its camera, its mask, its sky and, but for the first, a gain of its own in the map; only
// one line's light is compared. The map takes the light to stand still: pictures are in it that the geometry
// could compare with each other, at most a minute apart.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "fit/measurement/main_curtain.h"
#include "fit/measurement/measure_run.h"
#include "fit/measurement/together/pair_height.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {

struct JointMap {
  std::vector<std::size_t> pictures;  ///< those in the map
  std::string
      missing;  ///< why there is no map, part of a sentence; empty: there is one, or it was interrupted
  std::vector<std::string>
      left_out;  ///< pictures that could have been in it but that nothing could be prepared of: "a.jpg: ..."
  std::string command;  ///< that makes it again
  bool is_interrupted = false;
  bool is_good = false;  ///< by the map's own verdicts, but that of the flux: no gain is known
  double chi2_per_value = 0.0;
  std::size_t pair = 0;                ///< of the measurement's pairs, of which the geometry is compared
  std::size_t home = 0;                ///< the picture from whose place distances count
  std::optional<MainCurtain> curtain;  ///< along the border of that picture; none without one in view
  WithError nearest_km{sim::kNaN, sim::kNaN};  ///< of that border by the map
};

/// Which pictures a map of all explains, by which pair it is compared; or why there is none.
/// `lacking`: why a picture can be in no map, part of a sentence, for each picture; empty: it can.
JointMap planned_map(const std::vector<PairOfPictures>& pairs, const std::vector<Measurement>& alone,
                     const std::vector<std::string>& lacking);

/// The scene of the map, for `vegard map`; its folder is that of the pictures' folders, and names in it are
/// relative to that. `pictures`: the measurements whose masks are made, with `map`.
std::string scene_of_joint_map(const JointMap& map, const std::deque<MeasureRun>& pictures,
                               const std::string& folder);

/// Makes the map in `folder`/map and writes `folder`/scene.toml. The masks of its pictures are there. Throws
/// Error(existing_output, unwritable_output); other errors are why there is no map.
void make_joint_map(JointMap& map, const std::deque<MeasureRun>& pictures, const PairOfPictures& pair,
                    const std::string& folder, const MeasureFollower& follower);

/// The distance of the nearest part of a border by a map's curtain along it: that of the border itself, times
/// the mean distance by the map over that of the border at the same azimuths. NaN for a curtain elsewhere.
WithError nearest_by(const MainCurtain& curtain, const MainBorder& border);

/// A quantity that geometry and the map have both, which differ by more than two standard errors.
struct Contradiction {
  std::string quantity;  ///< "height of the lower border"
  WithError geometry_km, map_km;
};

/// What the geometry of the compared pair (`height`, and the distance of the nearest part that follows) and
/// the map contradict each other in; nothing that one of both has no standard error of. Of a map that is not
/// good that is no word against the geometry.
std::vector<Contradiction> contradictions(const JointMap& map, const PairHeight& height,
                                          const BorderDistance& distance);

}  // namespace vegard::fit
