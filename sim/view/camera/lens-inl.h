// Projection through any lens in SIMD lanes: the same as in sim/view/camera/lens.h, by the series of
// sim/view/camera/lens_series.h.
#if defined(VEGARD_SIM_VIEW_LENS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_VIEW_LENS_INL_H_
#undef VEGARD_SIM_VIEW_LENS_INL_H_
#else
#define VEGARD_SIM_VIEW_LENS_INL_H_
#endif

#include "sim/base/number/arctangent-inl.h"
#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/light/sample.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/lens_series.h"
#include "sim/view/camera/project-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

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
