// Splatting: adds the light of a sample, and its derivatives, to the four cells of the film around it, for
// all emission lines at once.
#if defined(VEGARD_SIM_VIEW_SPLAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_VIEW_SPLAT_INL_H_
#undef VEGARD_SIM_VIEW_SPLAT_INL_H_
#else
#define VEGARD_SIM_VIEW_SPLAT_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "sim/base/number/dual-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FourFloats = hn::FixedTag<float, 4>;
using FourDoubles = hn::CappedTag<double, 4>;

/// Adds 4 floats (in film units) to 4 integers, rounded to the nearest. Adding 1.5 * 2^52 leaves the integer
/// in the low bits of the double, identically on every instruction set; valid for |x| < 2^51.
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

/// The weights of a sample's light in the two columns and the two rows.
struct Shares {
  float left, right, upper, lower;
};

/// Adds the light of a sample to `cell`, its right neighbour and the two cells below. light(quartet) returns
/// 4 lines in film units, for the quartets 0 and 1.
template <int kQuartets, class Light>
HWY_INLINE void splat(const Shares& shares, int film_columns, std::int64_t* cell, const Light& light) {
  const FourFloats d;
  constexpr int kStride = 4 * kQuartets;
  std::int64_t* below = cell + static_cast<std::int64_t>(film_columns) * kStride;
  for (int q = 0; q < kQuartets; ++q) {
    const auto all = light(q);
    const auto in_left = hn::Mul(all, hn::Set(d, shares.left)),
               in_right = hn::Mul(all, hn::Set(d, shares.right));
    const auto upper = hn::Set(d, shares.upper), lower = hn::Set(d, shares.lower);
    add_rounded(hn::Mul(in_left, upper), cell + 4 * q);
    add_rounded(hn::Mul(in_right, upper), cell + kStride + 4 * q);
    add_rounded(hn::Mul(in_left, lower), below + 4 * q);
    add_rounded(hn::Mul(in_right, lower), below + kStride + 4 * q);
  }
}

/// The same for a sample that is completely in the left column.
template <int kQuartets, class Light>
HWY_INLINE void splat_in_column(const Shares& shares, int film_columns, std::int64_t* cell,
                                const Light& light) {
  const FourFloats d;
  std::int64_t* below = cell + static_cast<std::int64_t>(film_columns) * 4 * kQuartets;
  for (int q = 0; q < kQuartets; ++q) {
    const auto all = light(q);
    add_rounded(hn::Mul(all, hn::Set(d, shares.upper)), cell + 4 * q);
    add_rounded(hn::Mul(all, hn::Set(d, shares.lower)), below + 4 * q);
  }
}

/// The same for a point of the film: column and row are in cells, at least 0 and below the last one.
template <int kQuartets, class Light>
HWY_INLINE void splat(float column, float row, int film_columns, std::int64_t* film, const Light& light) {
  const int c = static_cast<int>(column), r = static_cast<int>(row);
  const float right = column - static_cast<float>(c), lower = row - static_cast<float>(r);
  splat<kQuartets>(Shares{1.0f - right, right, 1.0f - lower, lower}, film_columns,
                   film + (static_cast<std::int64_t>(r) * film_columns + c) * 4 * kQuartets, light);
}

/// The derivatives of one number by sixteen free parameters: the tangent part of Dual<float, Wide>.
struct Wide {
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));
  static constexpr int kParts = 16 / kLanes;
  FloatVector part[kParts];

  static HWY_INLINE Wide zero() {
    Wide r;
    for (int i = 0; i < kParts; ++i) r.part[i] = hn::Zero(FloatTag());
    return r;
  }
  static HWY_INLINE Wide load(const float* from) {
    Wide r;
    for (int i = 0; i < kParts; ++i) r.part[i] = hn::LoadU(FloatTag(), from + i * kLanes);
    return r;
  }
  HWY_INLINE Wide operator+(const Wide& o) const {
    Wide r;
    for (int i = 0; i < kParts; ++i) r.part[i] = hn::Add(part[i], o.part[i]);
    return r;
  }
  HWY_INLINE Wide operator-(const Wide& o) const {
    Wide r;
    for (int i = 0; i < kParts; ++i) r.part[i] = hn::Sub(part[i], o.part[i]);
    return r;
  }
  HWY_INLINE Wide operator*(float s) const {
    Wide r;
    const auto scale = hn::Set(FloatTag(), s);
    for (int i = 0; i < kParts; ++i) r.part[i] = hn::Mul(part[i], scale);
    return r;
  }
  HWY_INLINE void add_to(float* to) const {
    for (int i = 0; i < kParts; ++i)
      hn::Store(hn::Add(hn::Load(FloatTag(), to + i * kLanes), part[i]), FloatTag(), to + i * kLanes);
  }
};

using WideDual = Dual<float, Wide>;

/// Adds the tangents of a sample's light to four cells, bilinearly as in splat(). `cell_at(column, row)`
/// returns a cell's tangents, [line][16], 64-byte aligned; those of the cell below are `row_pitch` floats
/// further.
template <int kLines, class CellAt>
HWY_INLINE void splat_tangents(const WideDual& column, const WideDual& row, const WideDual* light,
                               std::ptrdiff_t row_pitch, const CellAt& cell_at) {
  const int c = static_cast<int>(column.v), r = static_cast<int>(row.v);
  const float right = column.v - static_cast<float>(c), lower = row.v - static_cast<float>(r);
  float *const here = cell_at(c, r), *const beside = cell_at(c + 1, r);
  for (int l = 0; l < kLines; ++l) {
    // The shares of the two columns, and of the two rows, sum to 1.
    const float light_right = light[l].v * right, light_left = light[l].v - light_right;
    const Wide in_right = light[l].d * right + column.d * light[l].v, in_left = light[l].d - in_right;
    const Wide low_right = in_right * lower + row.d * light_right,
               low_left = in_left * lower + row.d * light_left;
    (in_left - low_left).add_to(here + 16 * l);
    (in_right - low_right).add_to(beside + 16 * l);
    low_left.add_to(here + row_pitch + 16 * l);
    low_right.add_to(beside + row_pitch + 16 * l);
  }
}

/// The same for a sample that is completely in the left column, with no derivative of the column.
template <int kLines, class CellAt>
HWY_INLINE void splat_tangents_in_column(const WideDual& column, const WideDual& row, const WideDual* light,
                                         std::ptrdiff_t row_pitch, const CellAt& cell_at) {
  const int r = static_cast<int>(row.v);
  const float lower = row.v - static_cast<float>(r);
  float* const here = cell_at(static_cast<int>(column.v), r);
  for (int l = 0; l < kLines; ++l) {
    const Wide low = light[l].d * lower + row.d * light[l].v;
    (light[l].d - low).add_to(here + 16 * l);
    low.add_to(here + row_pitch + 16 * l);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
