// The tone "filmic": bright light rolls off as on film and becomes paler, and keeps its hue.
//
// Light whose largest channel m is up to kFilmicKnee stays as it is. Above, m becomes
//   f(m) = k + (1 - k) t / (1 + t),   t = (m - k) / (1 - k),
// which meets the knee with slope 1 and white at infinity; the colour is scaled by f / m, then mixed with
// grey of the same f by the share w = kFilmicPalest (t / (1 + t))^2, and scaled again so that its largest
// channel is f. The mixture is along a straight line towards grey in Oklab (Ottosson 2020, "A perceptual
// color space for image processing"), whose hue therefore stays; scaling keeps that hue too, because Oklab is
// homogeneous. Only where the mixture leaves the gamut is a channel set to 0 (tests: below 1 degree). The
// form of f is Reinhard's (Reinhard et al. 2002, doi:10.1145/566654.566575) above the knee; knee and palest
// share are ours.
//
// Unlike other tones it mixes the channels, so that it has no inverse channel by channel.
#pragma once

#include "sim/scene/structs/sensor.h"
#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

inline constexpr double kFilmicKnee = 0.5;
inline constexpr double kFilmicPalest = 0.7;

/// Returns f(m) of light of at least 0, and m of f below 1. What is below 0 stays.
double filmic_roll_off(double light);
double filmic_light(double shown);

class FilmicTone {
 public:
  explicit FilmicTone(Primaries primaries);

  /// Returns linear RGB to be shown, each from 0 to 1, for linear RGB of these primaries, white = 1; negative
  /// channels count as 0.
  Vector3 shown(const Vector3& light) const;

  /// The inverse of shown(), to 1e-9 where no channel was set to 0. Channels are limited to 0 to just below
  /// 1, whose light is 1e5 of white.
  Vector3 light(const Vector3& shown) const;

 private:
  Vector3 roots(const Vector3& rgb) const;  ///< cube roots of Oklab's cones, of white 1
  Vector3 rgb_of_roots(const Vector3& lms) const;

  Matrix3 cones_of_rgb_, rgb_of_cones_;
};

}  // namespace vegard::sim
