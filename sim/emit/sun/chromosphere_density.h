// The density of a chromosphere: turbulence with a cutoff, plus a bias from a map (rows C2 to C5 of the
// source).
//
//   x(place)  = sum over octaves i of roughness^i |n(1.99^i p)|,   p = place / scale + shift,
//   F(x)      = amplitude (1 - exp(-(x - coverage) sharpness)), 0 where that is negative,
//   density   = F(x) + peak texel(latitude, longitude), 0 where that is negative;
// without the cutoff F(x) is x. The turbulence is that of M. Pharr and G. Humphreys, "Physically based
// rendering" (2004), chapter 11, whose lattice becomes finer by 1.99 and not 2 per octave, so that the zeros
// of the lattices do not coincide; n is the gradient noise of sim/base/number/noise.h. Where the Sun
// turns (solar_rotation.h), noise and map are evaluated at the place that has moved to this point by the
// instant.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "sim/base/image.h"
#include "sim/base/number/dual.h"
#include "sim/base/number/noise.h"
#include "sim/emit/sun/solar_rotation.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// An equirectangular picture as a function of heliographic latitude and longitude: rows from the north pole
/// to the south pole, columns from longitude -180° to 180°; pixels are areas whose values apply at their
/// middles. The interpolation is linear, and periodic in longitude; between the middles of the first and last
/// rows and the poles these rows' values are used.
class LatitudeMap {
 public:
  /// `picture` has one channel and must outlive this object.
  explicit LatitudeMap(const Image& picture) : picture_(picture) {}

  /// Returns the value at a place in the Sun's frame (sim/emit/sun/sun_frame.h), at any distance but 0 from
  /// the middle.
  template <class T>
  T at(const T place[3]) const {
    constexpr double kTurn = 6.28318530717958647693;
    const T level = place[0] * place[0] + place[1] * place[1];
    if (!(value_of(level) > 0.0)) return T(pixel(0, value_of(place[2]) > 0.0 ? 0 : picture_.height - 1));
    const T latitude = arctangent(place[2], square_root(level)), longitude = arctangent(place[1], place[0]);
    const T column = (longitude * (1.0 / kTurn) + 0.5) * static_cast<double>(picture_.width) - 0.5;
    T row = (T(0.25) - latitude * (1.0 / kTurn)) * (2.0 * picture_.height) - 0.5;
    const double last = picture_.height - 1.0;
    if (value_of(row) < 0.0 || value_of(row) > last) row = T(value_of(row) < 0.0 ? 0.0 : last);
    const double left = std::floor(value_of(column)), above = std::floor(value_of(row));
    const T across = column - left, down = row - above;
    const int x = static_cast<int>(left), y = static_cast<int>(above);
    const T upper = mixed(pixel(x, y), pixel(x + 1, y), across),
            lower = mixed(pixel(x, y + 1), pixel(x + 1, y + 1), across);
    return upper + (lower - upper) * down;
  }

 private:
  template <class T>
  static T mixed(double a, double b, const T& share) {
    return share * (b - a) + a;
  }
  double pixel(int x, int y) const {
    const int column = (x % picture_.width + picture_.width) % picture_.width;
    return static_cast<double>(picture_.at(column, std::min(y, picture_.height - 1), 0));
  }

  const Image& picture_;
};

/// The function F of this file's first comment.
template <class T>
T cloud_cutoff(const T& x, const T& coverage, const T& sharpness, const T& amplitude) {
  const T over = (x - coverage) * sharpness;
  if (!(value_of(over) > 0.0)) return T(0.0);
  return amplitude * (T(1.0) - exponential(T(0.0) - over));
}

template <class T>
class ChromosphereDensity {
 public:
  /// The density of chromosphere `index` of the scene at an instant of its clock; by default at time.start_s.
  /// `biasmap` is its picture, with one channel, or null; it must outlive this object.
  ChromosphereDensity(const Scene& scene, int index, const Image* biasmap, const NumberAs<T>& number,
                      std::optional<double> instant_s = std::nullopt);

  /// Returns the density at a place in the Sun's frame, without regard to the inner and outer radius.
  T at(const T place[3]) const;

 private:
  /// Returns the turbulence x; if x is certain to be below `least`, it may return any number below `least`.
  T turbulence(const T place[3], double least) const;

  T at_first(const T place[3]) const;

  NoiseLattice lattice_;
  SolarTurn turn_;
  int octaves_;
  bool cutoff_;
  T roughness_, per_scale_, shift_[3], coverage_, sharpness_, amplitude_, peak_;
  std::optional<LatitudeMap> biasmap_;
};

extern template class ChromosphereDensity<double>;
extern template class ChromosphereDensity<FreeDual>;

}  // namespace vegard::sim
