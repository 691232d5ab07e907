// Lenses: project a direction in camera axes to a point of the picture, and back.
//
// A lens with an axis projects a direction at the angle theta off the axis to the distance focal_px
// rho(theta) from the principal point: rho = tan theta (pinhole), theta (equidistant), 2 sin(theta / 2)
// (equisolid), 2 tan(theta / 2) (stereographic), sin theta (orthographic) or theta (1 + k1 theta^2 + k2
// theta^4 + k3 theta^6) (polynomial). A pinhole may have Brown's distortion, with the five coefficients and
// signs of OpenCV (D. C. Brown, "Decentering distortion of lenses", Photogrammetric Engineering 32, 1966):
// its radial terms multiply rho by 1 + k1 r^2 + k2 r^4 + k3 r^6, r = tan theta. In every lens, the decentring
// terms p1 and p2 shift the point (x, y), in units of focal_px and before the radial terms of a pinhole, by
// (2 p1 x y + p2 (r^2 + 2 x^2), p1 (r^2 + 2 y^2) + 2 p2 x y).
//
// Two panoramas contain every direction. Equirectangular: x is proportional to the longitude, to the right of
// the camera's forward direction, and y to the latitude, below the camera's horizontal plane. The picture is
// 360 degrees wide and 180 high and continues beyond its edges: on the right with its left side, above with
// the other side of the pole. Cube: six pinholes of 90 degrees (sim/view/camera/cube_map.h).
//
// Camera axes are right, down, forward; pixels are those of docs/architecture.md: the centre of the first one
// is at (0.5, 0.5). T is double or a dual number over it (sim/base/number/dual.h).
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/view/camera/cube_map.h"

namespace vegard::sim {

template <class T>
struct Lens {
  LensModel model = LensModel::pinhole;
  T focal_px;                        ///< horizontally, on the axis
  T aspect;                          ///< vertical over horizontal scale
  T principal_x_px, principal_y_px;  ///< from the picture's upper left corner
  T k1, k2, k3, p1, p2;
  double side = 1.0;  ///< -1: left and right are exchanged
  /// Cosine of the largest angle off the axis that has an image: the limit of the model, or where the radial
  /// terms would fold the picture back.
  double min_cosine = 0.0;
  CubeLayout cube_layout = CubeLayout::cross;  ///< of a cube, whose focal_px is half of a face's edge
};

/// True if a picture contains every direction.
inline bool is_panorama(LensModel model) {
  return model == LensModel::equirectangular || model == LensModel::cube;
}

/// True if the lens is a pinhole without any distortion.
template <class T>
bool is_plain_pinhole(const Lens<T>& lens) {
  return lens.model == LensModel::pinhole && value_of(lens.k1) == 0.0 && value_of(lens.k2) == 0.0 &&
         value_of(lens.k3) == 0.0 && value_of(lens.p1) == 0.0 && value_of(lens.p2) == 0.0;
}

/// Returns Lens::min_cosine, which depends only on the model and the radial terms. The angle is at most 170
/// degrees.
double min_cosine(LensModel model, double k1, double k2, double k3);

/// Returns rho(theta), with the radial terms for a pinhole too. Not for panoramas.
template <class T>
T radius_of_angle(const Lens<T>& lens, const T& theta) {
  switch (lens.model) {
    case LensModel::equisolid:
      return sine(theta * 0.5) * 2.0;
    case LensModel::stereographic:
      return tangent(theta * 0.5) * 2.0;
    case LensModel::orthographic:
      return sine(theta);
    case LensModel::pinhole:
    case LensModel::polynomial: {
      const T r = lens.model == LensModel::pinhole ? tangent(theta) : theta;
      const T r2 = r * r;
      return r * (r2 * (r2 * (r2 * lens.k3 + lens.k2) + lens.k1) + T(1.0));
    }
    case LensModel::equidistant:
    case LensModel::equirectangular:
    case LensModel::cube:
      break;
  }
  return theta;
}

/// Computes the shift of a point (x, y) by the decentring terms, in units of focal_px.
template <class T>
void decentring(const Lens<T>& lens, const T& x, const T& y, T& shift_x, T& shift_y) {
  const T xy = x * y * 2.0, r2 = x * x + y * y;
  shift_x = lens.p1 * xy + lens.p2 * (r2 + x * x * 2.0);
  shift_y = lens.p1 * (r2 + y * y * 2.0) + lens.p2 * xy;
}

/// project() for panoramas.
template <class T>
void project_panorama(const Lens<T>& lens, const T in_camera[3], T& x_px, T& y_px) {
  const T &right = in_camera[0], &down = in_camera[1], &forward = in_camera[2];
  if (lens.model == LensModel::cube) {
    const double towards[3] = {value_of(right), value_of(down), value_of(forward)};
    const CubeFace face = face_towards(lens.cube_layout, towards);
    const auto along = [&](const std::array<double, 3>& axis) {
      return right * axis[0] + down * axis[1] + forward * axis[2];
    };
    const T depth = along(face.forward);
    x_px = (along(face.right) / depth + (2.0 * face.column + 1.0)) * lens.focal_px;
    y_px = (along(face.down) / depth + (2.0 * face.row + 1.0)) * lens.focal_px;
    return;
  }
  const T level2 = right * right + forward * forward;
  const bool at_pole = !(value_of(level2) > 0.0);
  const T longitude = at_pole ? T(0.0) : arctangent(right, forward);
  const T below =
      at_pole ? T(value_of(down) > 0.0 ? 0.5 * kPi : -0.5 * kPi) : arctangent(down, square_root(level2));
  x_px = lens.principal_x_px + longitude * lens.focal_px * lens.side;
  y_px = lens.principal_y_px + below * lens.focal_px * lens.aspect;
}

/// Computes the pixel of a direction (of any length but 0); returns false, and sets nothing, if the lens has
/// no image of it.
template <class T>
bool project(const Lens<T>& lens, const T in_camera[3], T& x_px, T& y_px) {
  if (is_panorama(lens.model)) {
    project_panorama(lens, in_camera, x_px, y_px);
    return true;
  }
  const T &right = in_camera[0], &down = in_camera[1], &forward = in_camera[2];
  const T across2 = right * right + down * down;
  const double length = std::sqrt(value_of(across2) + value_of(forward) * value_of(forward));
  if (!(value_of(forward) > lens.min_cosine * length)) return false;
  T x, y, shift_x, shift_y;
  if (lens.model == LensModel::pinhole) {
    x = right / forward;
    y = down / forward;
    decentring(lens, x, y, shift_x, shift_y);
    const T r2 = x * x + y * y;
    const T radial = r2 * (r2 * (r2 * lens.k3 + lens.k2) + lens.k1) + T(1.0);
    x = x * radial;
    y = y * radial;
  } else {
    // On the axis itself every lens is a pinhole.
    const bool on_axis = value_of(across2) < 1e-24 * length * length;
    T scale;
    if (on_axis) {
      scale = T(1.0) / forward;
    } else {
      const T across = square_root(across2);
      scale = radius_of_angle(lens, arctangent(across, forward)) / across;
    }
    x = right * scale;
    y = down * scale;
    decentring(lens, x, y, shift_x, shift_y);
  }
  x_px = lens.principal_x_px + (x + shift_x) * lens.focal_px * lens.side;
  y_px = lens.principal_y_px + (y + shift_y) * lens.focal_px * lens.aspect;
  return true;
}

/// Computes the unit vector of the direction of a pixel; returns false, and sets nothing, outside of the
/// lens's picture. The inverse of project() to 1e-12 of a radian.
bool unproject(const Lens<double>& lens, double x_px, double y_px, double in_camera[3]);

/// The same with exact derivatives, for lenses whose numbers are dual numbers.
template <class T>
bool unproject(const Lens<T>& lens, double x_px, double y_px, T in_camera[3]);

/// Returns the solid angle of a pixel at this place in steradians: |d direction / d (x, y)|. 0 outside of the
/// lens's picture.
double pixel_steradians(const Lens<double>& lens, double x_px, double y_px);

// ---------------------------------------------------------------------------------------------------------

/// Returns the lens with each of its numbers converted by `convert`.
template <class To, class T, class Convert>
Lens<To> converted(const Lens<T>& lens, const Convert& convert) {
  return {lens.model,
          convert(lens.focal_px),
          convert(lens.aspect),
          convert(lens.principal_x_px),
          convert(lens.principal_y_px),
          convert(lens.k1),
          convert(lens.k2),
          convert(lens.k3),
          convert(lens.p1),
          convert(lens.p2),
          lens.side,
          lens.min_cosine,
          lens.cube_layout};
}

/// Returns the lens without derivatives.
template <class T>
Lens<double> values_of(const Lens<T>& lens) {
  return converted<double>(lens, [](const T& number) { return value_of(number); });
}

/// Two vectors a, b across a direction, and the change of its pixel along each of them: d (x, y) / d (a, b).
struct PlaceSlopes {
  double across[2][3];
  double slope[2][2];  ///< [x or y][a or b]
  double determinant() const { return slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0]; }
};
/// Returns the slopes at a unit vector that has an image.
PlaceSlopes place_slopes(const Lens<double>& lens, const double direction[3]);

template <class T>
bool unproject(const Lens<T>& lens, double x_px, double y_px, T in_camera[3]) {
  const Lens<double> plain = values_of(lens);
  double at[3];
  if (!unproject(plain, x_px, y_px, at)) return false;
  // By the implicit function theorem: the direction changes so that its pixel stays the same.
  const PlaceSlopes slopes = place_slopes(plain, at);
  const T there[3] = {T(at[0]), T(at[1]), T(at[2])};
  T x, y;
  if (!project(lens, there, x, y)) return false;
  // The value is bitwise that without derivatives.
  const T off_x = x - value_of(x), off_y = y - value_of(y);
  const double inverse = 1.0 / slopes.determinant();
  const T a = (off_y * slopes.slope[0][1] - off_x * slopes.slope[1][1]) * inverse;
  const T b = (off_x * slopes.slope[1][0] - off_y * slopes.slope[0][0]) * inverse;
  for (int i = 0; i < 3; ++i) in_camera[i] = a * slopes.across[0][i] + b * slopes.across[1][i] + at[i];
  return true;
}

// A lens as a series, for the beam kernel: one polynomial for every lens with an axis, without angles and
// branches.
//
// With Q = sin^2(theta / 2) = (1 - cos theta) / 2, rho(theta) / sin(theta / 2) is an even function of the
// angle that is analytic in Q wherever the lens has an image (Q < 1): S(Q). A direction (x, y, z) of length l
// has its image at S(Q) (x, y) / (2 l sqrt(1 - Q)), and the picture's area per steradian is (S^2 + 2 Q S S')
// / 4, in units of focal_px^2: an equisolid lens has S = 2.

template <class T>
struct LensSeries {
  static constexpr int kMax = 24;
  int terms = 0;
  double max_q = 0.0;  ///< the series is valid for Q from 0 to max_q
  T value[kMax];       ///< S = sum of value[k] T_k(2 Q / max_q - 1), Chebyshev's polynomials
  T slope[kMax];       ///< the coefficients of dS/dQ
};

/// Returns the series up to the angle `widest_rad` off the axis, at most up to the edge of the lens's picture
/// and 134 degrees. Terms below 1e-9 of the first are dropped. kMax terms may not be enough for 1e-9: beyond
/// 100 degrees the error is 1e-7.
template <class T>
LensSeries<T> lens_series(const Lens<T>& lens, double widest_rad) {
  constexpr double kFarthest = 0.85;
  constexpr int n = LensSeries<T>::kMax;
  LensSeries<T> series;
  const double sine_of_half = std::sin(0.5 * std::min(widest_rad, std::acos(lens.min_cosine)));
  series.max_q = std::clamp(sine_of_half * sine_of_half, 1e-6, kFarthest);
  T at_node[n];
  for (int i = 0; i < n; ++i) {
    const double q = 0.5 * series.max_q * (1.0 + std::cos(kPi * (i + 0.5) / n));
    const double half = std::asin(std::sqrt(q));
    at_node[i] = radius_of_angle(lens, T(2.0 * half)) * (1.0 / std::sin(half));
  }
  for (int k = 0; k < n; ++k) {
    T sum(0.0);
    for (int i = 0; i < n; ++i) sum = sum + at_node[i] * std::cos(kPi * k * (i + 0.5) / n);
    series.value[k] = sum * ((k == 0 ? 1.0 : 2.0) / n);
  }
  series.terms = n;
  const double small = 1e-9 * std::abs(value_of(series.value[0]));
  while (series.terms > 1 && std::abs(value_of(series.value[series.terms - 1])) < small) --series.terms;
  // Coefficients of the derivative, from the last to the first.
  T after(0.0), after_next(0.0);
  for (int k = series.terms - 1; k >= 0; --k) {
    const T here = k + 1 < series.terms ? after_next + series.value[k + 1] * (2.0 * (k + 1)) : T(0.0);
    series.slope[k] = here * ((k == 0 ? 0.5 : 1.0) * 2.0 / series.max_q);
    after_next = after;
    after = here;
  }
  return series;
}

}  // namespace vegard::sim
