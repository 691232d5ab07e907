#include "fit/map/sequence/curtain_tracks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kBeside_km = 12.0, kBesideShare = 0.06;  // of the distance: one curtain lies along another
constexpr double kAlongShare = 0.5;                       // of its length
constexpr std::size_t kMayMiss = 2, kFewestFrames = 3;

std::vector<sim::EastNorth> course_of(const Curtain& curtain) {
  std::vector<sim::EastNorth> course;
  for (const CurtainPoint& p : curtain.points) course.push_back(p.foot_km);
  return course;
}

double length_of(const std::vector<sim::EastNorth>& course) {
  double sum = 0.0;
  for (std::size_t i = 1; i < course.size(); ++i)
    sum += std::hypot(course[i].east - course[i - 1].east, course[i].north - course[i - 1].north);
  return sum;
}

/// The share of a course's points that lie beside another.
double share_along(const std::vector<sim::EastNorth>& course, const std::vector<sim::EastNorth>& other) {
  std::size_t along = 0;
  for (const sim::EastNorth a : course) {
    const double reach = std::max(kBeside_km, kBesideShare * std::hypot(a.east, a.north));
    along += std::any_of(other.begin(), other.end(), [&](const sim::EastNorth b) {
      return std::hypot(a.east - b.east, a.north - b.north) < reach;
    });
  }
  return course.empty() ? 0.0 : static_cast<double>(along) / static_cast<double>(course.size());
}

/// The mean of a number along a curtain by flux, with its error by the same weights.
class MeanAlong {
 public:
  void add(const WithError& number, double weight) {
    if (!std::isfinite(number.value)) return;
    value_ += weight * number.value;
    error_ += weight * number.error;
    weight_ += weight;
  }
  WithError mean() const {
    return weight_ > 0.0 ? WithError{value_ / weight_, error_ / weight_} : WithError{sim::kNaN, sim::kNaN};
  }

 private:
  double value_ = 0.0, error_ = 0.0, weight_ = 0.0;
};

TrackedCurtain tracked(const MapOfFrame& frame, const Curtain& curtain, std::size_t number) {
  TrackedCurtain t;
  t.frame = frame.number;
  t.curtain = number;
  t.length_km = curtain.length_km;
  const CurtainPoint* nearest = nullptr;
  MeanAlong border, energy, flux, east, north, across, along;
  const std::vector<CurtainPoint>& points = curtain.points;
  const bool westwards = points.back().foot_km.east < points.front().foot_km.east;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CurtainPoint& p = points[i];
    if (!p.border_in_view) continue;
    if (nearest == nullptr || p.distance_km < nearest->distance_km) nearest = &p;
    const double weight = std::max(1e-12, p.flux_mw_m2.value);
    border.add(p.lower_border_km, weight);
    energy.add(p.energy_kev, weight);
    flux.add(p.flux_mw_m2, weight);
    if (!frame.drift.moves()) continue;
    const CurtainPoint &before = points[i == 0 ? 0 : i - 1],
                       &after = points[std::min(i + 1, points.size() - 1)];
    Eigen::Vector2d course(after.foot_km.east - before.foot_km.east,
                           after.foot_km.north - before.foot_km.north);
    course *= (westwards ? -1.0 : 1.0) / std::max(1e-9, course.norm());
    const Eigen::Vector2d left(-course(1), course(0));
    const Drift drift = frame.drift.at(p.foot_km);
    const Eigen::Vector2d velocity(drift.east_km_s, drift.north_km_s);
    const Eigen::Matrix2d covariance = frame.drift.covariance_at(p.foot_km);
    const auto put = [&](MeanAlong& mean, const Eigen::Vector2d& way) {
      mean.add({way.dot(velocity), std::sqrt(way.dot(covariance * way))}, weight);
    };
    put(east, {1.0, 0.0});
    put(north, {0.0, 1.0});
    put(along, course);
    put(across, left);
  }
  if (nearest == nullptr) {
    t.nearest_km = {sim::kNaN, sim::kNaN};
    t.distance_km = {sim::kNaN, sim::kNaN};
    t.azimuth_deg = sim::kNaN;
  } else {
    t.nearest_km = nearest->foot_km;
    t.distance_km = {nearest->distance_km, nearest->distance_error_km};
    t.azimuth_deg = nearest->azimuth_deg;
  }
  t.lower_border_km = border.mean();
  t.energy_kev = energy.mean();
  t.flux_mw_m2 = flux.mean();
  t.east_km_s = east.mean();
  t.north_km_s = north.mean();
  t.along_km_s = along.mean();
  t.across_km_s = across.mean();
  return t;
}

/// A track and a curtain that lie along each other.
struct Pair {
  std::size_t track = 0, curtain = 0;
  double overlap_km = 0.0;
};

}  // namespace

void CurtainTracker::add(const MapOfFrame& frame, const std::vector<Curtain>& curtains, double seconds) {
  std::vector<std::vector<sim::EastNorth>> courses;
  for (const Curtain& curtain : curtains) courses.push_back(course_of(curtain));
  if (frames_ > 0 && !frame.drift.moves())  // over a gap nothing is the same
    for (Live& live : all_) live.ended = true;
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < all_.size(); ++t) {
    if (all_[t].ended) continue;
    for (sim::EastNorth& p : all_[t].course_km) {
      const Drift drift = frame.drift.at(p);
      p.east += drift.east_km_s * seconds;
      p.north += drift.north_km_s * seconds;
    }
    for (std::size_t c = 0; c < courses.size(); ++c) {
      const double of_track = share_along(all_[t].course_km, courses[c]),
                   of_curtain = share_along(courses[c], all_[t].course_km);
      if (std::max(of_track, of_curtain) >= kAlongShare)
        pairs.push_back(
            {t, c, std::max(of_track * length_of(all_[t].course_km), of_curtain * length_of(courses[c]))});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.overlap_km > b.overlap_km; });
  std::map<std::size_t, std::size_t> track_of, curtain_of;
  for (const Pair& pair : pairs)
    if (track_of.count(pair.curtain) == 0 && curtain_of.count(pair.track) == 0) {
      track_of[pair.curtain] = pair.track;
      curtain_of[pair.track] = pair.curtain;
    }
  const std::size_t before = all_.size();
  for (std::size_t c = 0; c < curtains.size(); ++c) {
    if (curtains[c].points.empty()) continue;
    if (track_of.count(c) == 0) {
      Live born;
      born.track.seen_first = frames_ == 0;
      for (const Pair& pair : pairs)
        if (pair.curtain == c && born.track.split_from == 0)
          born.track.split_from = all_[pair.track].track.number;
      born.track.number = static_cast<int>(all_.size()) + 1;
      track_of[c] = all_.size();
      all_.push_back(std::move(born));
    }
    Live& live = all_[track_of[c]];
    live.track.frames.push_back(tracked(frame, curtains[c], c));
    live.course_km = courses[c];
    live.missed = 0;
  }
  for (std::size_t t = 0; t < before; ++t) {
    Live& live = all_[t];
    if (live.ended || curtain_of.count(t) > 0) continue;
    for (const Pair& pair : pairs)
      if (pair.track == t && live.track.merged_into == 0)
        live.track.merged_into = all_[track_of[pair.curtain]].track.number;
    ++live.missed;
    live.ended = live.track.merged_into != 0 || live.missed > kMayMiss;
  }
  ++frames_;
}

void CurtainTracker::drop_passing(std::vector<CurtainTrack>& tracks) const {
  const std::size_t fewest = std::min(kFewestFrames, frames_);
  // Pieces that come out of a track and go back into it belong to it. What pieces had to do with others,
  // their track has.
  std::map<int, int> instead;
  for (const CurtainTrack& t : tracks)
    if ((t.split_from != 0 && t.split_from == t.merged_into) || t.frames.size() < fewest)
      instead[t.number] = t.split_from != 0 ? t.split_from : t.merged_into;
  const auto kept = [&](int number) {
    for (std::size_t i = 0; i <= tracks.size() && instead.count(number) > 0; ++i) number = instead[number];
    return number;
  };
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                              [&](const CurtainTrack& t) { return instead.count(t.number) > 0; }),
               tracks.end());
  for (CurtainTrack& t : tracks) {
    t.split_from = kept(t.split_from);
    t.merged_into = kept(t.merged_into);
    if (t.split_from == t.number) t.split_from = 0;
    if (t.merged_into == t.number) t.merged_into = 0;
  }
}

std::vector<CurtainTrack> CurtainTracker::tracks() const {
  std::vector<CurtainTrack> tracks;
  for (const Live& live : all_) {
    tracks.push_back(live.track);
    tracks.back().seen_last = !live.ended && live.missed == 0;
  }
  drop_passing(tracks);
  std::map<int, int> number{{0, 0}};
  for (CurtainTrack& t : tracks) number[t.number] = static_cast<int>(number.size());
  for (CurtainTrack& t : tracks) {
    t.number = number[t.number];
    t.split_from = number.count(t.split_from) > 0 ? number[t.split_from] : 0;
    t.merged_into = number.count(t.merged_into) > 0 ? number[t.merged_into] : 0;
  }
  return tracks;
}

}  // namespace vegard::fit
