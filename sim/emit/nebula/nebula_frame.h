// The frame of a nebula, and rays in it. It is the frame of sim/light/sky_frame.h, turned by the position
// angle, with the unit `unit_pc`.
#pragma once

#include "sim/emit/nebula/node_shapes.h"
#include "sim/light/emitter.h"
#include "sim/light/sky_frame.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

inline constexpr double kKmPerParsec = 3.0856775814913673e13;  // IAU 2015, resolution B2

template <class T>
struct NebulaRay : SkyRay<T> {
  T half_chord;  ///< half the length of its path through the bound; only if `meets`
  bool meets;    ///< true if it goes through the bound
};

template <class T>
class NebulaFrame {
 public:
  NebulaFrame(const Nebula& nebula, const NumberAs<T>& number)
      : sky_(number(nebula.azimuth_deg), number(nebula.elevation_deg), number(nebula.position_angle_deg),
             number(nebula.distance_pc) / number(nebula.unit_pc)),
        unit_km_(value_of(number(nebula.unit_pc)) * kKmPerParsec),
        bound_(nebula.bound) {}

  double unit_km() const { return unit_km_; }
  const T& observer_distance() const { return sky_.observer_distance(); }

  void turn(const T enu[3], T direction[3]) const { sky_.turn(enu, direction); }

  NebulaRay<T> ray(const T enu[3]) const {
    NebulaRay<T> ray;
    static_cast<SkyRay<T>&>(ray) = sky_.ray(enu);
    const T square = T(bound_ * bound_) - ray.aside;
    ray.meets = value_of(square) > 0.0;
    ray.half_chord = root(square);
    return ray;
  }

 private:
  SkyFrame<T> sky_;
  double unit_km_, bound_;
};

}  // namespace vegard::sim
