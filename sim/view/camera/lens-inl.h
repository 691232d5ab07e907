// Projection of points of space on the film, with their weight and altitude, in SIMD lanes: through a pinhole
// and, by the series of sim/view/camera/lens.h, through any other lens.
#if defined(VEGARD_SIM_VIEW_LENS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_VIEW_LENS_INL_H_
#undef VEGARD_SIM_VIEW_LENS_INL_H_
#else
#define VEGARD_SIM_VIEW_LENS_INL_H_
#endif

#include "sim/base/number/arctangent-inl.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/light/sample.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/lens.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// The image of a point.
template <class P>
struct SeenPoint {
  P column, row;         ///< in cells, so that (0, 0) is the centre of the first cell
  P per_steradian_cell;  ///< 1 / (r^2 Omega), km^-2: weight of a volume in km^3 in its cell
};

/// Converts points in units of the lens's focal_px to the film. C is the type of numbers that all beams
/// share.
template <class C>
struct PlaceOnFilm {
  C column_scale, column_offset, row_scale, row_offset;  ///< column = x * scale + offset
  C cells_per_steradian;                                 ///< on the axis: f^2 / (width * height of a cell)

  /// `spread(number, to)` converts a number of the scene to one in SIMD lanes.
  template <class Spread>
  void set(const Lens<LocalDual>& lens, const FilmGeometry& film, const Spread& spread) {
    const double per_column = 1.0 / film.cell_width_px, per_row = 1.0 / film.cell_height_px;
    const LocalDual down_px = lens.focal_px * lens.aspect;
    spread(lens.focal_px * (lens.side * per_column), column_scale);
    spread(down_px * per_row, row_scale);
    spread((lens.principal_x_px - film.x0_px) * per_column - 0.5, column_offset);
    spread((lens.principal_y_px - film.y0_px) * per_row - 0.5, row_offset);
    spread(lens.focal_px * down_px * (per_column * per_row), cells_per_steradian);
  }

  template <class L, class P>
  HWY_INLINE SeenPoint<P> seen(const P& x, const P& y, const P& per_steradian) const {
    SeenPoint<P> point;
    point.column = x * column_scale + column_offset;
    point.row = y * row_scale + row_offset;
    point.per_steradian_cell = per_steradian * cells_per_steradian;
    return point;
  }
};

/// Projection through a pinhole without distortion.
template <class C>
class PinholeFilm {
 public:
  template <class Spread>
  void set(const Lens<LocalDual>& lens, const FilmGeometry& film, const Spread& spread) {
    place_.set(lens, film, spread);
  }

  /// Projects a point `in_camera_km` (right, down, forward). Omega = cos^3(theta) / f^2 per pixel, so
  /// 1 / (r^2 Omega) = f^2 r / Z^3 (docs/physics.md).
  template <class L, class P>
  HWY_INLINE SeenPoint<P> see(const P in_camera_km[3], decltype(L() < L())& in_front) const {
    in_front = L(1e-3f) < value_of(in_camera_km[2]);
    const P inverse = L(1.0f) / in_camera_km[2];
    const P x = in_camera_km[0] * inverse, y = in_camera_km[1] * inverse;
    return place_.template seen<L>(x, y, inverse * inverse * square_root(x * x + y * y + L(1.0f)));
  }

 private:
  PlaceOnFilm<C> place_;
};

/// The radius of a body, prepared for altitude_km().
struct SphereScale {
  double per_km, per_km2;  ///< 1/R, 1/R^2
  explicit SphereScale(double radius_km) : per_km(1.0 / radius_km), per_km2(1.0 / (radius_km * radius_km)) {}
};

/// Returns the altitude above the body's sphere from `excess_km2` = (distance from its centre)^2 - R^2,
/// without a root or a division: R (sqrt(1 + w) - 1), w = excess / R^2, by a polynomial through Chebyshev
/// nodes. Good to 2 cm from 0 to 650 km above the Earth or a larger body, and monotonic beyond, so that
/// points outside of the height profile stay outside.
template <class P>
HWY_INLINE P altitude_km(const P& excess_km2, const SphereScale& sphere) {
  using L = decltype(value_of(excess_km2));
  const P w = excess_km2 * L(sphere.per_km2);
  return excess_km2 * L(sphere.per_km) *
         (w * (w * (w * (w * L(0.018779819854331855) + L(-0.037586261512127024)) + L(0.06239117512593812)) +
               L(-0.1249971327886212)) +
          L(0.49999998774279175));
}

/// Computes `excess_km2` of altitude_km() for the points of a beam, given in an orthonormal frame whose
/// origin is the start of the beam.
template <class P>
struct BeamAltitude {
  P at_start_km2, slope_km[3];

  template <class L, class C>
  HWY_INLINE void start(const P start_in_enu_km[3], L observer_altitude_km, const C axes[3][3],
                        double sphere_km) {
    const L diameter(static_cast<float>(2.0 * sphere_km));
    const P& east = start_in_enu_km[0];
    const P& north = start_in_enu_km[1];
    const P up = start_in_enu_km[2] + observer_altitude_km;
    at_start_km2 = up * (up + diameter) + (east * east + north * north);
    const P from_centre = up * L(2.0f) + diameter;
    for (int a = 0; a < 3; ++a)
      slope_km[a] = east * L(2.0f) * axes[a][0] + north * L(2.0f) * axes[a][1] + from_centre * axes[a][2];
  }
  HWY_INLINE P excess_km2(const P way_km[3]) const {
    return at_start_km2 + way_km[0] * (way_km[0] + slope_km[0]) +
           (way_km[1] * (way_km[1] + slope_km[1]) + way_km[2] * (way_km[2] + slope_km[2]));
  }
};

/// Like PinholeFilm, for every lens.
template <class C>
class LensFilm {
 public:
  /// `spread(number, to)` converts a number of the scene to one in SIMD lanes.
  template <class Spread>
  void set(const Lens<LocalDual>& lens, const FilmGeometry& film, const Spread& spread) {
    place_.set(lens, film, spread);
    pinhole_ = lens.model == LensModel::pinhole;
    min_cosine_ = lens.min_cosine;
    spread(lens.k1, k1_);
    spread(lens.k2, k2_);
    spread(lens.k3, k3_);
    spread(lens.p1, p1_);
    spread(lens.p2, p2_);
    equirectangular_ = lens.model == LensModel::equirectangular;
    if (pinhole_ || equirectangular_) return;
    const LensSeries<LocalDual> series = lens_series(lens, widest_angle_rad(values_of(lens), film));
    terms_ = series.terms;
    max_q_ = series.max_q;
    for (int k = 0; k < terms_; ++k) {
      spread(series.value[k], value_[k]);
      spread(series.slope[k], slope_[k]);
    }
  }

  /// Projects a point `in_camera_km` (right, down, forward). `seen_at_all` is set to whether it has an image.
  template <class L, class P>
  HWY_INLINE SeenPoint<P> see(const P in_camera_km[3], decltype(L() < L())& seen_at_all) const {
    const P &right = in_camera_km[0], &down = in_camera_km[1], &forward = in_camera_km[2];
    const P length2 = right * right + down * down + forward * forward;
    const P length = square_root(length2);
    P x, y, per_steradian;
    if (equirectangular_) {
      // As if every row were as wide as the equator: close_turn() (sim/view/film/panorama.h) later divides
      // the light by the true width of the rows, which conserves the sum and has no singularity at the poles.
      seen_at_all = L(1e-6f) < value_of(length2);
      x = arctangent(right, forward);
      y = arctangent(down, square_root(right * right + forward * forward));
      per_steradian = P(L(1.0f)) / length2;
    } else if (pinhole_) {
      seen_at_all = L(1e-3f) < value_of(forward) && value_of(length) * L(min_cosine_) < value_of(forward);
      const P inverse = L(1.0f) / forward;
      x = right * inverse;
      y = down * inverse;
      per_steradian = inverse * inverse * inverse * length;
      const P r2 = x * x + y * y;
      const P radial = r2 * (r2 * (r2 * k3_ + k2_) + k1_) + L(1.0f);
      const P growth = (r2 * (r2 * k3_ * L(3.0f) + k2_ * L(2.0f)) + k1_) * L(2.0f);
      distort<L>(x, y, radial, growth, per_steradian);
    } else {
      const P q = (length - forward) / (length * L(2.0f));
      seen_at_all = value_of(q) <= L(max_q_);
      const P t = q * L(2.0 / max_q_) - L(1.0f);
      const P s = sum<L>(value_, t), by_q = sum<L>(slope_, t);
      const P scale = s / square_root(length * (length + forward) * L(2.0f));
      x = right * scale;
      y = down * scale;
      per_steradian = s * (s + q * by_q * L(2.0f)) / (length2 * L(4.0f));
      distort<L>(x, y, P(L(1.0f)), P(L(0.0f)), per_steradian);
    }
    return place_.template seen<L>(x, y, per_steradian);
  }

 private:
  /// Sums a Chebyshev series by Clenshaw's algorithm.
  template <class L, class P>
  HWY_INLINE P sum(const C* coefficient, const P& t) const {
    P after(L(0.0f)), after_next(L(0.0f));
    const P twice = t * L(2.0f);
    for (int k = terms_ - 1; k > 0; --k) {
      const P here = twice * after - after_next + coefficient[k];
      after_next = after;
      after = here;
    }
    return t * after - after_next + coefficient[0];
  }

  /// Multiplies (x, y) by `radial`, adds the decentring terms, and multiplies `area` by the determinant of
  /// the distortion. `growth` is twice d radial / d r^2.
  template <class L, class P>
  HWY_INLINE void distort(P& x, P& y, const P& radial, const P& growth, P& area) const {
    const P x2 = x * x, y2 = y * y, xy = x * y;
    const P cross = xy * growth + (x * p1_ + y * p2_) * L(2.0f);
    const P across = radial + x2 * growth + (y * p1_ * L(2.0f) + x * p2_ * L(6.0f));
    const P down = radial + y2 * growth + (y * p1_ * L(6.0f) + x * p2_ * L(2.0f));
    area = area * (across * down - cross * cross);
    const P shifted_x = x * radial + (xy * p1_ * L(2.0f) + (x2 * L(3.0f) + y2) * p2_);
    y = y * radial + ((x2 + y2 * L(3.0f)) * p1_ + xy * p2_ * L(2.0f));
    x = shifted_x;
  }

  PlaceOnFilm<C> place_;
  bool pinhole_ = false, equirectangular_ = false;
  int terms_ = 0;
  double min_cosine_ = 0.0, max_q_ = 0.0;
  C k1_, k2_, k3_, p1_, p2_;
  C value_[LensSeries<LocalDual>::kMax], slope_[LensSeries<LocalDual>::kMax];
};

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
