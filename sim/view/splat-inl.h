// Light on the film: one sample into the four cells around it, all its emission lines at once.
#if defined(VEGARD_SIM_VIEW_SPLAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_VIEW_SPLAT_INL_H_
#undef VEGARD_SIM_VIEW_SPLAT_INL_H_
#else
#define VEGARD_SIM_VIEW_SPLAT_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FourFloats = hn::FixedTag<float, 4>;
using FourDoubles = hn::CappedTag<double, 4>;

/// Adds 4 floats (in film units) to 4 integers, rounding to the nearest. Adding 1.5 * 2^52 leaves the integer
/// in the low bits of the double, on every instruction set alike; good for |x| < 2^51.
HWY_INLINE void add_rounded(hn::Vec<FourFloats> light, std::int64_t* cell) {
  const FourDoubles d;
  const hn::RebindToSigned<FourDoubles> i;
  const auto magic = hn::Set(d, 6755399441055744.0);
  const auto magic_bits = hn::BitCast(i, magic);
#if HWY_TARGET <= HWY_AVX2
  const auto wide = hn::PromoteTo(d, light);
  const auto units = hn::Sub(hn::BitCast(i, hn::Add(wide, magic)), magic_bits);
  hn::StoreU(hn::Add(hn::LoadU(i, cell), units), i, cell);
#else
  const hn::Half<FourFloats> half;
  const auto low = hn::Add(hn::PromoteTo(d, hn::LowerHalf(half, light)), magic);
  const auto high = hn::Add(hn::PromoteTo(d, hn::UpperHalf(half, light)), magic);
  hn::StoreU(hn::Add(hn::LoadU(i, cell), hn::Sub(hn::BitCast(i, low), magic_bits)), i, cell);
  hn::StoreU(hn::Add(hn::LoadU(i, cell + 2), hn::Sub(hn::BitCast(i, high), magic_bits)), i, cell + 2);
#endif
}

/// Spreads the light of a sample over four cells. column and row are in cells, at least 0 and below the last
/// one; `light` is a function of the quartet (0 or 1) that gives 4 lines in film units.
template <int kQuartets, class Light>
HWY_INLINE void splat(float column, float row, int film_columns, std::int64_t* film, const Light& light) {
  const FourFloats d;
  const int c = static_cast<int>(column), r = static_cast<int>(row);
  const float right = column - static_cast<float>(c), lower = row - static_cast<float>(r);
  const float left = 1.0f - right, upper = 1.0f - lower;
  constexpr int kStride = 4 * kQuartets;
  std::int64_t* cell = film + (static_cast<std::int64_t>(r) * film_columns + c) * kStride;
  std::int64_t* below = cell + static_cast<std::int64_t>(film_columns) * kStride;
  for (int q = 0; q < kQuartets; ++q) {
    const auto all = light(q);
    const auto in_left = hn::Mul(all, hn::Set(d, left)), in_right = hn::Mul(all, hn::Set(d, right));
    add_rounded(hn::Mul(in_left, hn::Set(d, upper)), cell + 4 * q);
    add_rounded(hn::Mul(in_right, hn::Set(d, upper)), cell + kStride + 4 * q);
    add_rounded(hn::Mul(in_left, hn::Set(d, lower)), below + 4 * q);
    add_rounded(hn::Mul(in_right, hn::Set(d, lower)), below + kStride + 4 * q);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
