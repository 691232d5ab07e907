#include "sim/emit/footprint/map/bulge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/smooth_step.h"
#include "sim/scene/structs/bulge_points.h"

namespace vegard::sim {
namespace bulge {

using Place = std::array<double, 3>;

template <class T>
Place place_of(const CurveNode<T, 3>& node) {
  return {value_of(node.at[0]), value_of(node.at[1]), value_of(node.at[2])};
}

double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// Nodes along the curve, and their distances from its beginning.
template <class T>
struct Course {
  std::vector<CurveNode<T, 3>> nodes;
  std::vector<double> along_km, place;
  double length_km = 0.0;
  bool closed = false;
};

template <class T>
Course<T> course_of(const Footprint& f, const std::vector<CurveNode<T, 3>>& points, double longest_km) {
  const double step_km = f.bulge_length_km / kBulgePointsPerLength;
  const CurvePieces<T, 3> curve = curve_pieces<T, 3>(points, f.closed, std::min(longest_km, step_km), true);
  Course<T> course;
  course.closed = curve.is_closed;
  const auto add = [&](const CurveNode<T, 3>& node, double place) {
    course.nodes.push_back(node);
    course.place.push_back(place);
    course.along_km.push_back(course.length_km);
  };
  if (!curve.is_closed && !curve.pieces.empty()) add(points.front(), 0.0);
  double since_km = std::numeric_limits<double>::infinity();
  int pieces = 0;
  for (const CurvePiece<T, 3>& piece : curve.pieces) {
    const double half_km = 0.5 * value_of(piece.length);
    course.length_km += half_km;
    since_km += half_km;
    if (++pieces >= kBulgePiecesToPoint || since_km >= step_km) {
      add(piece.middle, piece.place);
      since_km = 0.0;
      pieces = 0;
    }
    course.length_km += half_km;
    since_km += half_km;
  }
  if (!curve.is_closed && !curve.pieces.empty()) add(points.back(), static_cast<double>(points.size() - 1));
  return course;
}

/// Of node i, to the next and from the one before.
template <class T>
Place direction_at(const Course<T>& course, std::size_t i) {
  const std::size_t n = course.nodes.size();
  const std::size_t before = i > 0           ? i - 1
                             : course.closed ? n - 1
                                             : 0,
                    after = i + 1 < n       ? i + 1
                            : course.closed ? 0
                                            : n - 1;
  const Place from = place_of(course.nodes[before]), to = place_of(course.nodes[after]);
  const double length = std::max(distance(from, to), 1e-9);
  return {(to[0] - from[0]) / length, (to[1] - from[1]) / length, (to[2] - from[2]) / length};
}

}  // namespace bulge

double bulge_level(const Substorm& s, double instant_s) {
  const double since_s = instant_s - s.onset_s;
  if (since_s <= 0.0) return 0.0;
  return smooth_step(since_s / s.expansion_s) * (1.0 - smooth_step((since_s - s.expansion_s) / s.recovery_s));
}

double bulge_strength(const Footprint& f, const Substorm& substorm, double instant_s, double west_km,
                      double farthest_km) {
  const double front_km = std::min(f.bulge_speed_km_s * (instant_s - substorm.onset_s), farthest_km);
  return bulge_level(substorm, instant_s) * smooth_step((front_km - west_km) / f.bulge_length_km) *
         smooth_step((west_km + f.bulge_length_km) / f.bulge_length_km);
}

double bulge_change_s(const Footprint& f, const Substorm& s) {
  constexpr double kPart = 0.25;
  const double phases_s = kPart * std::min(s.expansion_s, s.recovery_s);
  return f.bulge_speed_km_s > 0.0 ? std::min(phases_s, kPart * f.bulge_length_km / f.bulge_speed_km_s)
                                  : phases_s;
}

template <class T>
std::vector<CurveNode<T, 3>> with_bulge(const Footprint& f, const Substorm& substorm, double instant_s,
                                        const std::vector<CurveNode<T, 3>>& points, double longest_km,
                                        std::vector<double>* places) {
  using namespace bulge;
  if (places != nullptr) places->clear();
  if (!(f.bulge_km > 0.0) || !(bulge_level(substorm, instant_s) > 0.0)) return points;
  Course<T> course = course_of(f, points, longest_km);
  const std::size_t count = course.nodes.size();
  if (count < 2) return points;
  const double longitude = f.bulge_longitude_deg * kRadiansPerDegree;
  std::size_t onset = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const Place at = place_of(course.nodes[i]);
    const double off = std::abs(std::remainder(std::atan2(at[1], at[0]) - longitude, kTwoPi));
    if (off < nearest) {
      nearest = off;
      onset = i;
    }
  }
  // To the west is against the growing longitude.
  const Place begin = place_of(course.nodes[onset]), way = direction_at(course, onset);
  const double westwards = begin[0] * way[1] - begin[1] * way[0] > 0.0 ? -1.0 : 1.0;
  // Around a closed curve the front comes as far as the tail's end, not into it.
  const double farthest_km =
      course.closed ? course.length_km - f.bulge_length_km : std::numeric_limits<double>::infinity();
  std::vector<CurveNode<T, 3>> moved = course.nodes;
  for (std::size_t i = 0; i < count; ++i) {
    double west_km = westwards * (course.along_km[i] - course.along_km[onset]);
    if (course.closed) {
      // Once around, from where the tail ends.
      const double from_tail = west_km + f.bulge_length_km;
      west_km = from_tail - course.length_km * std::floor(from_tail / course.length_km) - f.bulge_length_km;
    }
    const double strength = bulge_strength(f, substorm, instant_s, west_km, farthest_km);
    if (!(strength > 0.0)) continue;
    const Place at = place_of(course.nodes[i]), along = direction_at(course, i);
    const double radius = std::hypot(at[0], at[1], at[2]);
    Place aside = {(at[1] * along[2] - at[2] * along[1]) / radius,
                   (at[2] * along[0] - at[0] * along[2]) / radius,
                   (at[0] * along[1] - at[1] * along[0]) / radius};
    const double to_pole = aside[2] * at[2] > 0.0 ? 1.0 : -1.0;
    const double angle = f.bulge_km * strength / radius;
    for (int a = 0; a < 3; ++a)
      moved[i].at[a] = T(at[a] * std::cos(angle) + to_pole * aside[a] * radius * std::sin(angle));
    moved[i].flux = moved[i].flux * (1.0 + (f.bulge_gain - 1.0) * strength);
  }
  if (places != nullptr) *places = std::move(course.place);
  return moved;
}

template std::vector<CurveNode<double, 3>> with_bulge(const Footprint&, const Substorm&, double,
                                                      const std::vector<CurveNode<double, 3>>&, double,
                                                      std::vector<double>*);
template std::vector<CurveNode<FreeDual, 3>> with_bulge(const Footprint&, const Substorm&, double,
                                                        const std::vector<CurveNode<FreeDual, 3>>&, double,
                                                        std::vector<double>*);

}  // namespace vegard::sim
