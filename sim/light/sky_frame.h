// The frame of a distant body in the sky, and rays in it.
//
// The frame's axes are right (towards increasing azimuth), up, and near (towards the observer), the first two
// rotated by an angle, anticlockwise as seen by the observer. Its origin is the body's centre, its unit of
// length the body's own; the observer is on the near axis.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

/// A ray, described by its point nearest to the body's centre; exact for any distance of the observer.
template <class T>
struct SkyRay {
  T nearest[3];    ///< right, up, near
  T direction[3];  ///< of length 1
  T observer;      ///< position of the observer along the ray, from `nearest`: negative if in front of it
  T aside;         ///< square of the distance from the centre to `nearest`
};

template <class T>
class SkyFrame {
 public:
  /// `distance`: of the observer from the centre, in the frame's unit.
  SkyFrame(const T& azimuth_deg, const T& elevation_deg, const T& angle_deg, const T& distance)
      : distance_(distance) {
    const T azimuth = azimuth_deg * kRadiansPerDegree, elevation = elevation_deg * kRadiansPerDegree,
            angle = angle_deg * kRadiansPerDegree;
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

  const T& observer_distance() const { return distance_; }
  /// East, north and up components of an axis; `which`: 0 right, 1 up, 2 near.
  const T* axis(int which) const { return axis_[which]; }

  void turn(const T enu[3], T direction[3]) const {
    for (int i = 0; i < 3; ++i)
      direction[i] = axis_[i][0] * enu[0] + axis_[i][1] * enu[1] + axis_[i][2] * enu[2];
  }

  SkyRay<T> ray(const T enu[3]) const {
    SkyRay<T> ray;
    turn(enu, ray.direction);
    const T* d = ray.direction;
    // The observer is at (0, 0, D), so the nearest place is D (-dz dx, -dz dy, 1 - dz²), and dx² + dy² keeps
    // its digits where 1 - dz² would lose them.
    const T aside = d[0] * d[0] + d[1] * d[1];
    ray.nearest[0] = T(0.0) - distance_ * d[2] * d[0];
    ray.nearest[1] = T(0.0) - distance_ * d[2] * d[1];
    ray.nearest[2] = distance_ * aside;
    ray.observer = distance_ * d[2];
    ray.aside = distance_ * distance_ * aside;
    return ray;
  }

 private:
  T distance_;
  T axis_[3][3];
};

}  // namespace vegard::sim
