// Where a nebula stands, and a ray in its frame: that of sim/light/sky_frame.h, turned by the position angle,
// with `unit_pc` for its unit.
#pragma once

#include "sim/emit/nebula/node_shapes.h"
#include "sim/light/emitter.h"
#include "sim/light/sky_frame.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

inline constexpr double kKmPerParsec = 3.0856775814913673e13;  // IAU 2015, resolution B2

template <class T>
struct NebulaRay : SkyRay<T> {
  T half_chord;  ///< half its way through the bound; only where `meets`
  bool meets;    ///< whether it goes through the bound
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
