// The integral of the density of one straight segment of a strand along a ray.
//
// The segment is the space between the planes of its two joints (strand.h), within its radius of the
// axis between them. With h0 and h1 the distances from those planes, measured along the axis, the fraction of
// the length from joint to joint is w = h0 / (h0 + h1): on a circular arc this is the fraction of the nearest
// point, and it is continuous across a plane. Density is along(w) falloff(d / r), d the distance to the axis:
// falling on planes that bisect the angle between segments, it is continuous there.
//
// A ray uses a single radius r, that at the middle of its path through the segment; so q² = d² / r² is a
// polynomial of second degree along the ray, and (1 - q²)² times a linear `along` one of fifth degree: three
// Gauss-Legendre nodes are exact for it. A Gaussian has seven nodes (error below 3e-4 of it), and 1 - q four
// on each side of the point nearest to the axis, where its slope jumps.
//
// Thin strands: a segment narrower than `blur` times the distance to the observer is widened to this, and its
// density is reduced by the square of the ratio, so that its light is kept.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sim/base/number/gauss_quadrature.h"
#include "sim/emit/sun/strand/strand.h"
#include "sim/light/sky_frame.h"

namespace vegard::sim {

template <class T>
struct PlacedJoint {
  StrandJoint<T> joint;
  T distance;  ///< to the observer
};

template <class T>
struct SegmentLight {
  T column;           ///< integral of the density over the path
  double weighted_s;  ///< integral of density times place along the ray
  double entry_s;     ///< s at which the ray enters
};

namespace segment_detail {

inline constexpr double kParallel = 1e-12;

inline const GaussLegendre<3> kThree;
inline const GaussLegendre<4> kFour;
inline const GaussLegendre<7> kSeven;

template <class T>
T falloff_at(RadialFalloff falloff, const T& square) {
  if (falloff == RadialFalloff::gaussian) return exponential(square * -4.5);
  const double value = value_of(square);
  if (falloff == RadialFalloff::linear)
    return value > 1e-30 ? T(1.0) - square_root(square) : T(1.0);  // no tangent at the axis
  const T left = T(1.0) - square;
  return left * left;
}

/// Returns a joint's radius and its density, both after a thin strand is widened.
template <class T>
T widened_radius(const PlacedJoint<T>& at, double blur, T& density) {
  const T least = at.distance * blur;
  density = at.joint.along;
  if (value_of(at.joint.radius) >= value_of(least)) return at.joint.radius;
  const T ratio = at.joint.radius / least;
  density = density * ratio * ratio;
  return least;
}

/// Cuts the path from `low` to `high` at a plane, from which the ray is at + by s away, and keeps the part on
/// the plane's side; false if there is none.
template <class T>
bool clip_at_plane(const T& at, const T& by, double side, T& low, T& high) {
  const double rise = value_of(by) * side;
  if (std::abs(rise) < kParallel) return side > 0.0 ? value_of(at) >= 0.0 : value_of(at) < 0.0;
  const T cut = (T(0.0) - at) / by;
  if (rise > 0.0) {
    if (value_of(cut) > value_of(low)) low = cut;
  } else if (value_of(cut) < value_of(high)) {
    high = cut;
  }
  return true;
}

}  // namespace segment_detail

/// Integrates from s = `first` to `last` along the ray. Returns false if the ray misses the segment.
template <class T>
bool segment_light(const PlacedJoint<T>& a, const PlacedJoint<T>& b, RadialFalloff falloff, double blur,
                   const Vec3<T>& nearest, const Vec3<T>& direction, const T& first, const T& last,
                   SegmentLight<T>& out) {
  using namespace segment_detail;
  constexpr double kGrazing = 1e-12;
  const Vec3<T> way = minus3(b.joint.place, a.joint.place);
  const T square = dot3(way, way);
  if (!(value_of(square) > 0.0)) return false;
  T density_a, density_b;
  const T radius_a = widened_radius(a, blur, density_a), radius_b = widened_radius(b, blur, density_b);
  const double most = std::max(value_of(radius_a), value_of(radius_b));

  // The ray's square distance from the axis is miss + slant (s - closest)².
  const Vec3<T> from_a = minus3(nearest, a.joint.place);
  const Vec3<T> normal = cross3(direction, way);
  const T normal_square = dot3(normal, normal), aside = dot3(from_a, normal);
  const bool parallel = value_of(normal_square) < kParallel * value_of(square);
  // Most tested segments are missed.
  if (!parallel && !(value_of(aside) * value_of(aside) < most * most * value_of(normal_square))) return false;
  const T forth = dot3(from_a, way), per_length = T(1.0) / square;
  const T slant = normal_square * per_length;
  const T miss = parallel ? dot3(from_a, from_a) - forth * forth * per_length : aside * aside / normal_square;
  if (!(value_of(miss) < most * most)) return false;
  const T closest =
      parallel ? T(0.0) : (forth * dot3(direction, way) * per_length - dot3(from_a, direction)) / slant;

  // Between the planes. Both segments at a plane compute the same numbers for it; a ray that lies in the
  // plane belongs to the segment that begins there.
  const T at_a = dot3(from_a, a.joint.normal), by_a = dot3(direction, a.joint.normal),
          at_b = dot3(minus3(nearest, b.joint.place), b.joint.normal), by_b = dot3(direction, b.joint.normal);
  T low = first, high = last;
  if (!clip_at_plane(at_a, by_a, 1.0, low, high) || !clip_at_plane(at_b, by_b, -1.0, low, high)) return false;
  if (!(value_of(low) < value_of(high))) return false;

  // Distances along the axis times both of its products with the planes' normals: only their ratio counts.
  const T to_plane_a = dot3(way, b.joint.normal), to_plane_b = dot3(way, a.joint.normal);
  const auto share = [&](const T& s) {
    const T h0 = (at_a + by_a * s) * to_plane_a, h1 = T(0.0) - (at_b + by_b * s) * to_plane_b;
    const T sum = h0 + h1;
    if (!(value_of(sum) > 0.0)) return T(0.5);
    const T w = h0 / sum;
    return value_of(w) < 0.0 ? T(0.0) : value_of(w) > 1.0 ? T(1.0) : w;
  };
  // Finds the part of the path within a radius; false if there is none.
  const auto within = [&](const T& radius, T& from, T& to) {
    from = low;
    to = high;
    const T left = radius * radius - miss;
    if (!(value_of(left) > kGrazing * value_of(radius) * value_of(radius))) return false;
    if (parallel) return true;
    const T half = square_root(left / slant);
    if (value_of(closest) - value_of(half) > value_of(from)) from = closest - half;
    if (value_of(closest) + value_of(half) < value_of(to)) to = closest + half;
    return value_of(from) < value_of(to);
  };
  T from, to;
  if (!within(value_of(radius_a) > value_of(radius_b) ? radius_a : radius_b, from, to)) return false;
  T radius = radius_a;
  if (!std::is_same_v<T, double> || value_of(radius_a) != value_of(radius_b)) {
    radius = radius_a + (radius_b - radius_a) * share((from + to) * 0.5);
    if (!within(radius, from, to)) return false;
  }

  const T per_square = T(1.0) / (radius * radius);
  out.column = T(0.0);
  out.weighted_s = 0.0;
  out.entry_s = value_of(from);
  const auto add = [&](const auto& rule, const T& begin, const T& end) {
    const T way_through = end - begin;
    for (std::size_t n = 0; n < rule.place.size(); ++n) {
      const T s = begin + way_through * rule.place[n];
      const T past = s - closest;
      const T q_square = (miss + (parallel ? T(0.0) : slant * past * past)) * per_square;
      const T here = (density_a + (density_b - density_a) * share(s)) * falloff_at(falloff, q_square) *
                     way_through * rule.weight[n];
      out.column = out.column + here;
      out.weighted_s += value_of(here) * value_of(s);
    }
  };
  if (falloff == RadialFalloff::smooth) {
    add(kThree, from, to);
  } else if (falloff == RadialFalloff::gaussian) {
    add(kSeven, from, to);
  } else if (!parallel && value_of(closest) > value_of(from) && value_of(closest) < value_of(to)) {
    add(kFour, from, closest);
    add(kFour, closest, to);
  } else {
    add(kFour, from, to);
  }
  return true;
}

}  // namespace vegard::sim
