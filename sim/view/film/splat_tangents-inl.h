// Splatting of derivatives: adds the tangents of a sample to the four cells of the film around it.
#if defined(VEGARD_SIM_VIEW_SPLAT_TANGENTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_VIEW_SPLAT_TANGENTS_INL_H_
#undef VEGARD_SIM_VIEW_SPLAT_TANGENTS_INL_H_
#else
#define VEGARD_SIM_VIEW_SPLAT_TANGENTS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "sim/base/number/dual-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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
