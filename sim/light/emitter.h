// The interface of emitters: volumes that emit light, which the renderer integrates along rays from the
// camera.
//
// Beams are projected forwards into the picture (sim/light/sample.h). All other sources of light (a
// footprint's aurora, a nebula, a grid) are emitters: they get rays and return the light along them. Each
// emitter chooses its own steps along a ray, since it knows where it is empty.
//
// The frame is the observer's east, north, up in km, with the observer at its origin; every ray begins there.
// T is double for light alone, or FreeDual for light with its derivatives.
#pragma once

#include <cstddef>
#include <functional>

#include "sim/light/sample.h"

namespace vegard::sim {

inline constexpr int kMaxLines = 8;  ///< emission lines of a scene

/// Neighbouring rays, such as those of a row of the film.
template <class T>
struct RayBundle {
  std::size_t count = 0;
  const T* direction[3] = {nullptr, nullptr, nullptr};  ///< [axis][ray], of length 1
  const double* end_km = nullptr;  ///< [ray] distance at which the Earth, the Sun or an object of the scene
                                   ///< stops the ray; or infinity
  double cell_rad = 0.0;           ///< angle between neighbouring rays: thinner structures would be aliased
  const T* end_moving = nullptr;   ///< [ray] end_km with its derivatives; null if it has none

  T end(std::size_t ray) const { return end_moving != nullptr ? end_moving[ray] : T(end_km[ray]); }
};

/// The light that rays bring to the camera. All arrays belong to the caller, who also initialises them.
template <class T>
struct BundleLight {
  int lines = 0;
  T* rayleigh = nullptr;       ///< [line][ray] rayleighs; initially 0
  T* kept = nullptr;           ///< [line][ray] transmission for light from behind the emitter; initially 1
  double* entry_km = nullptr;  ///< [ray] distance at which the emitter begins; initially infinity
  double* depth_km = nullptr;  ///< [ray] mean distance of the light, weighted by it; initially infinity
  /// [ray] entry_km with its derivatives, from emitters that absorb and compute them; initially infinity.
  /// Null if the caller does not need them.
  T* entry_moving = nullptr;
};

template <class T>
class Emitter {
 public:
  virtual ~Emitter() = default;

  /// Integrates the light along the rays. Any number of threads may call this at once. The result for a ray
  /// does not depend on the other rays of its bundle.
  virtual void march(const RayBundle<T>& rays, const BundleLight<T>& out) const = 0;

  /// True if the emitter absorbs light; otherwise `kept` stays 1.
  virtual bool absorbs() const { return false; }

  /// True if the emitter's light may lie in front of, within and behind an absorbing emitter, so that a
  /// second march up to the absorber's beginning is needed and cheap enough. False for every emitter that
  /// absorbs.
  virtual bool is_mixed() const { return false; }
};

/// Converts a number of the scene to T: with tangent 1 if the number is a free parameter.
template <class T>
using NumberAs = std::function<T(const double& number)>;

/// A box in an emitter's frame.
struct Box3 {
  double low[3], high[3];
};

/// An emitter as a field in space, for sampling on grids. Its frame is that of this header, in km, or a
/// nebula's own (right, up, towards the observer, in its unit of length); `unit_cm` gives the unit.
class LightField {
 public:
  virtual ~LightField() = default;

  virtual double unit_cm() const { return 1e5; }  ///< length of the frame's unit
  virtual Box3 bounds() const = 0;                ///< box outside of which the field is dark
  /// True only if the box contains neither light nor absorbing matter.
  virtual bool is_dark(const Box3& box) const = 0;
  /// Computes at the points [axis][point] the volume emission rate, photons cm^-3 s^-1, [line][point], and
  /// the density of the absorbing matter, [point], in the emitter's own unit (0 if nothing absorbs). Any
  /// number of threads may call this at once.
  virtual void sample(std::size_t count, const double* const point[3], float* const emission[],
                      float* density) const = 0;
};

/// Column brightness, in rayleighs, of 1 photon cm^-3 s^-1 over one kilometre.
inline constexpr double kRayleighsPerKm = 0.1;

/// The NumberAs for values without derivatives.
inline const NumberAs<double> plain_number = [](const double& number) { return number; };

// Conversion from rayleighs along a path to the volume emission rate that LightField gives.
inline constexpr double kCmPerKm = 1e5;
inline constexpr double kPhotonsPerRayleigh_cm2_s = 1e6;  ///< emitted by a column, in all directions

/// Returns the volume emission rate, photons cm^-3 s^-1, that adds `rayleigh` to a path one unit long.
inline double photons_per_volume(double rayleigh, double unit_cm) {
  return rayleigh * kPhotonsPerRayleigh_cm2_s / unit_cm;
}

}  // namespace vegard::sim
