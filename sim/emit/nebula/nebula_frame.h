// Where a nebula stands, and a ray in its frame.
//
// The frame's axes are right (towards increasing azimuth), up, and near (towards the observer), the first two
// turned by the position angle anticlockwise as the observer sees it. Its origin is the nebula's middle, its
// unit `unit_pc`; the observer stands on the near axis, at distance_pc / unit_pc.
#pragma once

#include "sim/emit/nebula/node_shapes.h"
#include "sim/light/emitter.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

inline constexpr double kKmPerParsec = 3.0856775814913673e13;  // IAU 2015, resolution B2

/// A ray by its place nearest to the middle, which is exact however far the observer is.
template <class T>
struct NebulaRay {
  T nearest[3];    ///< right, up, near
  T direction[3];  ///< of length 1
  T half_chord;    ///< half its way through the bound; only where `meets`
  T observer;      ///< where on the ray the observer is, from `nearest`: negative in front of it
  bool meets;      ///< whether it goes through the bound
};

template <class T>
class NebulaFrame {
 public:
  NebulaFrame(const Nebula& nebula, const NumberAs<T>& number)
      : distance_(number(nebula.distance_pc) / number(nebula.unit_pc)),
        unit_km_(value_of(number(nebula.unit_pc)) * kKmPerParsec),
        bound_(nebula.bound) {
    constexpr double kRadian = 3.14159265358979323846 / 180.0;
    const T azimuth = number(nebula.azimuth_deg) * kRadian,
            elevation = number(nebula.elevation_deg) * kRadian,
            angle = number(nebula.position_angle_deg) * kRadian;
    const T east = sine(azimuth), north = cosine(azimuth), high = sine(elevation), level = cosine(elevation);
    const T right[3] = {north, T(0.0) - east, T(0.0)};
    const T up[3] = {T(0.0) - east * high, T(0.0) - north * high, level};
    const T near[3] = {T(0.0) - east * level, T(0.0) - north * level, T(0.0) - high};
    const T c = cosine(angle), s = sine(angle);
    for (int i = 0; i < 3; ++i) {
      axis_[0][i] = right[i] * c + up[i] * s;
      axis_[1][i] = up[i] * c - right[i] * s;
      axis_[2][i] = near[i];
    }
  }

  double unit_km() const { return unit_km_; }
  const T& observer_distance() const { return distance_; }

  void turn(const T enu[3], T direction[3]) const {
    for (int i = 0; i < 3; ++i)
      direction[i] = axis_[i][0] * enu[0] + axis_[i][1] * enu[1] + axis_[i][2] * enu[2];
  }

  NebulaRay<T> ray(const T enu[3]) const {
    NebulaRay<T> ray;
    turn(enu, ray.direction);
    const T* d = ray.direction;
    // The observer is at (0, 0, D), so the nearest place is D (-dz dx, -dz dy, 1 - dz²), and dx² + dy² keeps
    // its digits where 1 - dz² would lose them.
    const T aside = d[0] * d[0] + d[1] * d[1];
    ray.nearest[0] = T(0.0) - distance_ * d[2] * d[0];
    ray.nearest[1] = T(0.0) - distance_ * d[2] * d[1];
    ray.nearest[2] = distance_ * aside;
    ray.observer = distance_ * d[2];
    const T square = T(bound_ * bound_) - distance_ * distance_ * aside;
    ray.meets = value_of(square) > 0.0;
    ray.half_chord = root(square);
    return ray;
  }

 private:
  T distance_;
  double unit_km_, bound_;
  T axis_[3][3];
};

}  // namespace vegard::sim
