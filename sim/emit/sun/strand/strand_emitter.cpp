#include "sim/emit/sun/strand/strand_emitter.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim {
namespace {

/// Least radius of a strand, in pixels. The wave of a pixel's length that is left of the projected strand is
/// 1 % of its mean for smooth and linear ones and 2 % for Gaussians, which end at three standard deviations.
double min_radius_px(RadialFalloff falloff) { return falloff == RadialFalloff::gaussian ? 1.5 : 1.0; }

template <class T>
PlacedJoint<double> values_of(const PlacedJoint<T>& at) {
  return {{values3(at.joint.place), values3(at.joint.normal), value_of(at.joint.radius),
           value_of(at.joint.along)},
          value_of(at.distance)};
}

template <class T>
bool is_dark(const std::vector<T>& gains) {
  return std::none_of(gains.begin(), gains.end(), [](const T& gain) { return value_of(gain) > 0.0; });
}

SegmentBox box_of(const PlacedJoint<double>& a, const PlacedJoint<double>& b) {
  // Where segments meet at an angle their outer sides reach past the joint.
  constexpr double kMinCosine = 0.05;
  const Vec3<double> way = minus3(b.joint.place, a.joint.place);
  const double length = std::max(length3(way), 1e-300);
  const double cosine =
      std::clamp(std::min(dot3(way, a.joint.normal), dot3(way, b.joint.normal)) / length, kMinCosine, 1.0);
  const double radius = std::max(a.joint.radius, b.joint.radius) / cosine;
  SegmentBox box;
  for (int i = 0; i < 3; ++i) {
    box.low[i] = std::min(a.joint.place[i], b.joint.place[i]) - radius;
    box.high[i] = std::max(a.joint.place[i], b.joint.place[i]) + radius;
  }
  box.min_radius = std::min(a.joint.radius, b.joint.radius);
  box.max_distance = std::max(a.distance, b.distance) / cosine;
  return box;
}

}  // namespace

template <class T>
StrandEmitter<T>::StrandEmitter(const Strands<T>& strands, const Sun& sun, const SunFrame<T>& frame,
                                std::vector<T> light)
    : frame_(frame), radius_(sun.radius), falloff_(strands.falloff), light_(std::move(light)) {
  Vec3<T> observer;
  frame_.observer(observer.data());
  std::vector<StrandJoint<T>> joints;
  std::vector<SegmentBox> boxes;
  std::uint32_t shining = 0;
  for (const Strand<T>& strand : strands.all) {
    if (!strand.line_gain.empty()) {
      if (is_dark(strand.line_gain)) continue;
      gain_.insert(gain_.end(), strand.line_gain.begin(), strand.line_gain.end());
      ++shining;
    }
    joints.clear();
    add_joints(strand, joints);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const PlacedJoint<T> placed{joints[j], length3(minus3(joints[j].place, observer))};
      plain_.push_back(values_of(placed));
      if constexpr (!std::is_same_v<T, double>) joints_.push_back(placed);
      if (j == 0) continue;
      segments_.push_back(static_cast<std::uint32_t>(plain_.size() - 2));
      if (shining > 0) strand_of_.push_back(shining - 1);
      boxes.push_back(box_of(plain_[plain_.size() - 2], plain_.back()));
    }
  }
  tree_ = SegmentTree(boxes);
}

template <class T>
void StrandEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  if (light_.empty()) return;
  const double blur = rays.cell_rad * min_radius_px(falloff_);
  for (std::size_t i = 0; i < rays.count; ++i) {
    const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    march_ray(enu, rays.end(i), blur, i, rays.count, out);
  }
}

template <class T>
void StrandEmitter<T>::march_ray(const T enu[3], const T& end_km, double blur, std::size_t index,
                                 std::size_t rays, const BundleLight<T>& out) const {
  const SkyRay<T> ray = frame_.ray(enu);
  const Vec3<T> nearest = {ray.nearest[0], ray.nearest[1], ray.nearest[2]},
                direction = {ray.direction[0], ray.direction[1], ray.direction[2]};
  const Vec3<double> plain_nearest = values3(nearest), plain_direction = values3(direction);
  const T stop = ray_stop(frame_, ray, radius_, end_km);
  const double first = value_of(ray.observer), last = value_of(stop);
  T column(0.0), of_line[kMaxLines];
  if (!gain_.empty())
    for (T& one : of_line) one = T(0.0);
  double weighted = 0.0, weight = 0.0, entry = last;
  bool met = false;
  // Adds a segment's column to every line's, with its strand's factors.
  const auto add_lines = [&](std::uint32_t segment, const T& more, double weighted_s) {
    const T* gain = gains_of(segment);
    double bright = 0.0;
    for (std::size_t l = 0; l < light_.size(); ++l) {
      of_line[l] = of_line[l] + more * gain[l];
      bright += value_of(gain[l]) * value_of(light_[l]);
    }
    weighted += bright * weighted_s;
    weight += bright * value_of(more);
  };
  tree_.visit(plain_nearest, plain_direction, first, last, blur, [&](std::uint32_t segment) {
    const std::uint32_t j = segments_[segment];
    SegmentLight<double> plain;
    if (!segment_light(plain_[j], plain_[j + 1], falloff_, blur, plain_nearest, plain_direction, first, last,
                       plain))
      return;
    met = true;
    if (gain_.empty()) weighted += plain.weighted_s;
    entry = std::min(entry, plain.entry_s);
    if constexpr (std::is_same_v<T, double>) {
      if (gain_.empty())
        column += plain.column;
      else
        add_lines(segment, plain.column, plain.weighted_s);
    } else {
      SegmentLight<T> whole;
      if (segment_light(joints_[j], joints_[j + 1], falloff_, blur, nearest, direction, ray.observer, stop,
                        whole)) {
        if (gain_.empty())
          column = column + whole.column;
        else
          add_lines(segment, whole.column, plain.weighted_s);
      }
    }
  });
  if (!met) return;
  for (int l = 0; l < out.lines; ++l)
    out.rayleigh[static_cast<std::size_t>(l) * rays + index] =
        (gain_.empty() ? column : of_line[l]) * light_[l];
  out.entry_km[index] = (entry - first) * frame_.unit_km();
  const double value = gain_.empty() ? value_of(column) : weight;
  if (value > 0.0) out.depth_km[index] = (weighted / value - first) * frame_.unit_km();
}

template class StrandEmitter<double>;
template class StrandEmitter<FreeDual>;

}  // namespace vegard::sim
