#include "sim/scene/freedom/keyframes.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/site_axes.h"
#include "sim/scene/structs/station.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {
namespace keyframes {

// Of the site, beyond which a tangent plane has no room for a sheet (it ends at 90).
constexpr double kFarthest_deg = 60.0;

double secant(const KeyTrack& track, std::size_t key) {
  return (track.value[key + 1] - track.value[key]) / (track.time_s[key + 1] - track.time_s[key]);
}

double monotone_slope(const KeyTrack& track, std::size_t key) {
  if (key == 0 || key + 1 == track.value.size()) return 0.0;
  const double before = secant(track, key - 1), after = secant(track, key);
  if (!(before * after > 0.0)) return 0.0;
  const double step_before = track.time_s[key] - track.time_s[key - 1],
               step_after = track.time_s[key + 1] - track.time_s[key];
  const double share = (step_before + 2.0 * step_after) / (3.0 * (step_before + step_after));
  return before * after / (share * after + (1.0 - share) * before);
}

double catmull_rom_slope(const KeyTrack& track, std::size_t key) {
  if (key == 0) return secant(track, 0);
  if (key + 1 == track.value.size()) return secant(track, key - 1);
  return (track.value[key + 1] - track.value[key - 1]) / (track.time_s[key + 1] - track.time_s[key - 1]);
}

/// A cubic a + b u + c u^2 + d u^3 of the way on from a key, u from 0 to 1.
struct Cubic {
  double a, b, c, d;
  double at(double u) const { return a + u * (b + u * (c + u * d)); }
};

Cubic way_on(const KeyTrack& track, std::size_t key) {
  const double from = track.value[key], to = track.value[key + 1],
               step = track.time_s[key + 1] - track.time_s[key];
  double slope_from = 0.0, slope_to = 0.0;
  switch (track.ease[key]) {
    case KeyEase::hold:
      return {from, 0.0, 0.0, 0.0};
    case KeyEase::linear:
      return {from, to - from, 0.0, 0.0};
    case KeyEase::smooth:
      break;
    case KeyEase::monotone:
      slope_from = monotone_slope(track, key) * step, slope_to = monotone_slope(track, key + 1) * step;
      break;
    case KeyEase::catmull_rom:
      slope_from = catmull_rom_slope(track, key) * step, slope_to = catmull_rom_slope(track, key + 1) * step;
      break;
  }
  return {from, slope_from, 3.0 * (to - from) - 2.0 * slope_from - slope_to,
          2.0 * (from - to) + slope_from + slope_to};
}

/// Keeps at their places what is placed about the scene's own site.
void carry_along(const Scene& scene, Scene& still) {
  const Station station(scene.site, still.site, scene.body.radius_km);
  if (!station.is_elsewhere()) return;
  const Origin origin{scene.file, scene.keys.front().line, "key"};
  const SiteAxes home = axes_at(scene.site), there = axes_at(still.site);
  double cosine = 0.0;
  for (int i = 0; i < 3; ++i) cosine += home.axis[2][i] * there.axis[2][i];
  const double away_deg = std::acos(std::clamp(cosine, -1.0, 1.0)) / kRadiansPerDegree;
  if (!still.sheets.empty() && away_deg > kFarthest_deg)
    throw scene_error({"the observer goes " + short_real_text(std::round(away_deg)) +
                           "° away from the site, about which the sheets are placed",
                       "at most " + short_real_text(kFarthest_deg) + "°",
                       "a footprint of the shape \"shell\" is seen from anywhere"},
                      origin);
  for (Sheet& sheet : still.sheets) station.carry(sheet);
  for (const EmitterKind& kind : emitter_kinds()) {
    if (!is_in_scene(kind, still)) continue;
    const auto complaint = kind.stay_at != nullptr
                               ? kind.stay_at(still, scene.site)
                               : std::optional<Complaint>(
                                     {"[" + kind.table + "] stands in the observer's sky, and would go along",
                                      "keys of its own place in place of the site's", ""});
    if (complaint) throw scene_error(*complaint, origin);
  }
}

}  // namespace keyframes

double KeyTrack::at(double seconds) const {
  if (!(seconds > time_s.front())) return value.front();
  if (seconds >= time_s.back()) return value.back();
  const auto key =
      static_cast<std::size_t>(std::upper_bound(time_s.begin(), time_s.end(), seconds) - time_s.begin() - 1);
  const double on_way =
      keyframes::way_on(*this, key).at((seconds - time_s[key]) / (time_s[key + 1] - time_s[key]));
  // By rounding alone it would leave the two keys' range.
  return ease[key] == KeyEase::catmull_rom
             ? on_way
             : std::clamp(on_way, std::min(value[key], value[key + 1]), std::max(value[key], value[key + 1]));
}

std::pair<double, double> KeyTrack::range(std::size_t key) const {
  if (key + 1 >= value.size()) return {value[key], value[key]};
  double least = std::min(value[key], value[key + 1]), most = std::max(value[key], value[key + 1]);
  if (ease[key] != KeyEase::catmull_rom) return {least, most};
  const keyframes::Cubic way = keyframes::way_on(*this, key);
  // Where b + 2 c u + 3 d u^2 = 0.
  const double root = way.c * way.c - 3.0 * way.b * way.d;
  if (root >= 0.0)
    for (const double side : {-std::sqrt(root), std::sqrt(root)})
      for (const double u : {(-way.c + side) / (3.0 * way.d), -way.b / (2.0 * way.c)}) {
        if (!(u > 0.0 && u < 1.0)) continue;
        least = std::min(least, way.at(u));
        most = std::max(most, way.at(u));
      }
  return {least, most};
}

std::vector<KeyTrack> key_tracks(const Scene& scene) {
  std::vector<KeyTrack> tracks;
  for (const Keyframe& key : scene.keys) {
    with_origin(scene, key.line, key.path, [&] {
      const std::vector<ParameterPath> paths = resolve(scene, key.path);
      if (paths.size() != key.value.size())
        throw scene_error({"a key with " + std::to_string(key.value.size()) + " values for " +
                               std::to_string(paths.size()) + " numbers",
                           "as many values as " + key.path + " has", ""},
                          {scene.file, key.line, key.path});
      for (std::size_t i = 0; i < paths.size(); ++i) {
        auto track = std::find_if(tracks.begin(), tracks.end(),
                                  [&](const KeyTrack& one) { return one.path.id == paths[i].id; });
        if (track == tracks.end()) track = tracks.insert(tracks.end(), {paths[i], {}, {}, {}, {}});
        if (!track->time_s.empty() && !(key.time_s > track->time_s.back()))
          throw scene_error({"a key at " + short_real_text(key.time_s) + " s stands behind one at " +
                                 short_real_text(track->time_s.back()) + " s" +
                                 (track->line.back() > 0 ? in_line(track->line.back()) : ""),
                             "the keys of a path in order of time", ""},
                            {scene.file, key.line, key.path});
        track->time_s.push_back(key.time_s);
        track->value.push_back(key.value[i]);
        track->ease.push_back(key.ease);
        track->line.push_back(key.line);
      }
    });
  }
  return tracks;
}

Scene scene_at(const Scene& scene, double seconds) {
  Scene still = scene;
  still.keys.clear();
  if (scene.keys.empty()) return still;
  for (const KeyTrack& track : key_tracks(scene)) *real_value(still, track.path) = track.at(seconds);
  keyframes::carry_along(scene, still);
  return still;
}

Scene still_scene(const Scene& scene) { return scene_at(scene, scene.time.start_s); }

}  // namespace vegard::sim
