#include <set>

#include "sim/scene/freedom/inert_parameter.h"
#include "sim/scene/freedom/keyframes.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace keyframe_check {

const char* const kMovable = "a number that the picture depends on, of the camera, the site or what shines";

void check_can_move(const Scene& scene, const KeyTrack& track) {
  const Origin origin{scene.file, track.line.front(), track.path.text};
  const Declaration& d = declaration_of(*track.path.row);
  if (track.path.row->kind != ParameterKind::real)
    throw scene_error(
        {"no spline goes through " + std::string(d.choices.empty() ? "a whole number or a text" : "words"),
         kMovable, ""},
        origin);
  const bool steers_fit = track.path.row->table == free_table;
  if (steers_fit || !d.stands_still.empty())
    throw scene_error({steers_fit ? "it steers a fit, which has no clock" : d.stands_still, kMovable, ""},
                      origin);
  if (const auto complaint = inert_number_complaint(scene, track.path)) throw scene_error(*complaint, origin);
}

void check_limits(const Scene& scene, const KeyTrack& track) {
  const Declaration& d = declaration_of(*track.path.row);
  const bool is_altitude = track.path.id == resolve(scene, "site.altitude_m").front().id;
  for (std::size_t key = 0; key < track.value.size(); ++key) {
    const auto [least, most] = track.range(key);
    for (const double extreme : {track.value[key], least, most}) {
      auto complaint = number_complaint(d, extreme);
      if (!complaint) continue;
      if (is_altitude && extreme < d.min)
        complaint->problem = "the camera is inside the " +
                             std::string(scene.body.name == "earth" ? "Earth" : "body") + ", " +
                             short_real_text(-1e-3 * extreme) + " km below its sphere";
      if (extreme != track.value[key] && extreme != track.value[std::min(key + 1, track.value.size() - 1)])
        complaint->hint = "the spline goes beyond its keys: ease = \"monotone\" does not";
      throw scene_error(*complaint, {scene.file, track.line[key], track.path.text});
    }
  }
}

}  // namespace keyframe_check

void check_keyframes(const Scene& scene) {
  if (scene.keys.empty()) return;
  std::set<double> times;
  for (const KeyTrack& track : key_tracks(scene)) {
    keyframe_check::check_can_move(scene, track);
    keyframe_check::check_limits(scene, track);
    times.insert(track.time_s.begin(), track.time_s.end());
  }
  // What no number shows by itself.
  for (const double time_s : times) {
    try {
      validate(scene_at(scene, time_s));
    } catch (const Error& error) {
      throw Error(error).problem("at " + short_real_text(time_s) +
                                 " s of the keys: " + error.details().problem);
    }
  }
}

}  // namespace vegard::sim
