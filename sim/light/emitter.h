// What passes from where light is born in a volume to the march along rays: emitters.
//
// Beams are mapped forwards (sim/light/sample.h). Whatever else shines (a footprint's aurora, a nebula, a
// grid) is asked from the camera: rays in, light out. How an emitter marches is its own affair, since it
// knows where it is empty.
//
// The frame is the observer's east, north, up in km, with the observer at its origin; every ray begins there.
// T is double where light is wanted, or FreeDual where its derivatives are too.
#pragma once

#include <cstddef>
#include <functional>

#include "sim/light/sample.h"

namespace vegard::sim {

inline constexpr int kMaxLines = 8;  ///< emission lines of a scene

/// Rays side by side, such as those of a row of the film.
template <class T>
struct RayBundle {
  std::size_t count = 0;
  const T* direction[3] = {nullptr, nullptr, nullptr};  ///< [axis][ray], of length 1
  const double* end_km = nullptr;  ///< [ray] where it is stopped, by the Earth, the Sun or by what stands in
                                   ///< the scene; or infinity
  double cell_rad = 0.0;           ///< angle between neighbouring rays: what is thinner would show in steps
  const T* end_moving = nullptr;   ///< [ray] end_km with its derivatives, where it has any; else null

  T end(std::size_t ray) const { return end_moving != nullptr ? end_moving[ray] : T(end_km[ray]); }
};

/// What comes out of the rays at the camera. All arrays belong to the caller.
template <class T>
struct BundleLight {
  int lines = 0;
  T* rayleigh = nullptr;  ///< [line][ray] rayleighs; zero when an emitter gets it
  T* kept = nullptr;  ///< [line][ray] share of the light behind that comes through; 1 when an emitter gets it
  double* entry_km =
      nullptr;  ///< [ray] where along the ray the emitter begins; infinity when an emitter gets it
  double* depth_km =
      nullptr;  ///< [ray] mean distance of the light, weighed by it; infinity when an emitter gets it
  /// [ray] entry_km with its derivatives, from what absorbs and knows them; null: nobody asks. Infinity when
  /// an emitter gets it.
  T* entry_moving = nullptr;
};

template <class T>
class Emitter {
 public:
  virtual ~Emitter() = default;

  /// To be called by any number of threads at once. What comes out of a ray does not depend on its bundle.
  virtual void march(const RayBundle<T>& rays, const BundleLight<T>& out) const = 0;

  /// Whether anything is absorbed: else `kept` stays 1.
  virtual bool absorbs() const { return false; }

  /// Whether its light may lie before, within and behind something that absorbs, and its march up to there is
  /// worth its while. Only of what absorbs nothing itself.
  virtual bool is_mixed() const { return false; }
};

/// Gives a number of the scene as T: with tangent 1 where it is a free parameter.
template <class T>
using NumberAs = std::function<T(const double& number)>;

/// A box in an emitter's frame.
struct Box3 {
  double low[3], high[3];
};

/// An emitter as a field in space, for grids. Its frame: as above, in km, or a nebula's own (right, up,
/// towards the observer, in its unit of length), as `unit_cm` says.
class LightField {
 public:
  virtual ~LightField() = default;

  virtual double unit_cm() const { return 1e5; }  ///< length of the frame's unit
  virtual Box3 bounds() const = 0;                ///< outside of which it is dark
  /// True only if there is neither light nor anything that absorbs in the box.
  virtual bool is_dark(const Box3& box) const = 0;
  /// Volume emission rate, photons cm^-3 s^-1, [line][point], and density, [point]: what absorbs, in the
  /// emitter's own measure, 0 if nothing does. Points [axis][point]. To be called by any number of threads at
  /// once.
  virtual void sample(std::size_t count, const double* const point[3], float* const emission[],
                      float* density) const = 0;
};

/// Rayleighs of a column of 1 photon cm^-3 s^-1, a kilometre long.
inline constexpr double kRayleighsPerKm = 0.1;

/// For those that want values alone.
inline const NumberAs<double> plain_number = [](const double& number) { return number; };

// From rayleighs along a path to light in space, as LightField gives it.
inline constexpr double kCmPerKm = 1e5;
inline constexpr double kPhotonsPerRayleigh_cm2_s = 1e6;  ///< through a column, to all sides

/// Photons cm^-3 s^-1 of what adds so many rayleighs to a path of one unit.
inline double photons_per_volume(double rayleigh, double unit_cm) {
  return rayleigh * kPhotonsPerRayleigh_cm2_s / unit_cm;
}

}  // namespace vegard::sim
