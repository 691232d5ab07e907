// The arctangent of y / x in all quadrants in SIMD lanes, compiled once per instruction set.
#if defined(VEGARD_SIM_BASE_NUMBER_ARCTANGENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_BASE_NUMBER_ARCTANGENT_INL_H_
#undef VEGARD_SIM_BASE_NUMBER_ARCTANGENT_INL_H_
#else
#define VEGARD_SIM_BASE_NUMBER_ARCTANGENT_INL_H_
#endif

#include <cmath>

#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// Returns the angle of the point (x, y) from the x axis, between -pi and pi; 0 at the origin. The error in
/// floats is 3e-7: a polynomial through Chebyshev nodes in the square of the argument (1e-8) in one octant,
/// and symmetry.
HWY_INLINE Pack arctangent(Pack y, Pack x) {
  const Pack nothing(0.0f);
  const Pack up = select(y < nothing, nothing - y, y), across = select(x < nothing, nothing - x, x);
  const PackMask steep = across < up;
  const Pack large = select(steep, up, across), small = select(steep, across, up);
  const Pack z = small / select(nothing < large, large, Pack(1.0f)), u = z * z;
  Pack sum(0.0027662835001714);
  for (const double coefficient :
       {-0.01573124911610971, 0.04213762357995513, -0.0745685482529788, 0.10618370636674229,
        -0.14197797794034392, 0.19991872029107, -0.3333303670928654, 0.9999999817886558})
    sum = sum * u + Pack(coefficient);
  const Pack octant = sum * z;
  const Pack quarter = select(steep, Pack(1.57079632679489662) - octant, octant);
  const Pack half = select(x < nothing, Pack(3.14159265358979324) - quarter, quarter);
  return select(y < nothing, nothing - half, half);
}
HWY_INLINE double arctangent(double y, double x) { return std::atan2(y, x); }

template <class L, class D>
HWY_INLINE Dual<L, D> arctangent(const Dual<L, D>& y, const Dual<L, D>& x) {
  const L inverse = L(1.0f) / (x.v * x.v + y.v * y.v);
  return Dual<L, D>(arctangent(y.v, x.v), y.d * (x.v * inverse) - x.d * (y.v * inverse));
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
