// The places of the steps of a ray through a footprint, sixteen side by side, and which stretches may be
// skipped.
#if defined(VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_BLOCK_INL_H_
#undef VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_BLOCK_INL_H_
#else
#define VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_BLOCK_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/emit/footprint/footprint_kernel_types.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

#define VEGARD_INLINE HWY_INLINE
#include "sim/light/field/field_body.h"
//
#include "sim/emit/footprint/foot_body.h"
#undef VEGARD_INLINE

/// Sixteen numbers take as many registers as the instruction set needs.
constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));
constexpr int kParts = 16 / kLanes;  ///< registers for sixteen lanes
HWY_INLINE Pack lane_numbers(int first) { return Pack(hn::Iota(FloatTag(), static_cast<float>(first))); }

/// A span with its numbers broadcast to all lanes.
struct SpanLanes {
  Pack place[3], direction[3], square, along;
  explicit SpanLanes(const MarchSpan& span) : square(span.square_km2), along(span.along_km) {
    for (int i = 0; i < 3; ++i) {
      place[i] = Pack(span.place_km[i]);
      direction[i] = Pack(span.direction[i]);
    }
  }
  HWY_INLINE AirPoint<Pack> at(Pack u) const { return point_of_ray(place, direction, square, along, u); }
};

struct Place {
  Pack x, y;  ///< texels of the grid
  PackMask is_there;
};

/// Returns the foot of a point, or the point itself if feet are vertically below. L is Pack or double.
template <FootProjection kProjection, class L>
HWY_INLINE AirPoint<L> foot_of_shell(const FootprintKernel& kernel, const AirPoint<L>& p, int face) {
  if constexpr (kProjection == FootProjection::shell_dipole) {
    const L axis[3] = {L(kernel.axis[0]), L(kernel.axis[1]), L(kernel.axis[2])};
    return foot_in_dipole_around_body(p, axis, kernel.sphere_km);
  } else if constexpr (kProjection == FootProjection::shell_reference) {
    const FieldPatch& patch = kernel.patches[face];
    return foot_in_patch_around_earth(p, face, patch.rounded.data(), L(patch.per_place));
  } else {
    return p;
  }
}

/// Returns the foot of a point in texels of the grid of the plane, or of a face.
template <FootProjection kProjection>
HWY_INLINE Place place_of(const FootprintKernel& kernel, const AirPoint<Pack>& p, int face) {
  const Pack texels(kernel.texels), first_x(kernel.first_x), first_y(kernel.first_y);
  if constexpr (is_shell_projection(kProjection)) {
    const FacePlace<Pack> at = place_on_face(foot_of_shell<kProjection>(kernel, p, face), face);
    return {at.u * texels + first_x, at.v * texels + first_y, Pack(1.0f) < at.ahead};
  } else {
    const Pack axis[3] = {Pack(kernel.axis[0]), Pack(kernel.axis[1]), Pack(kernel.axis[2])};
    PlaneFoot<Pack> foot;
    if constexpr (kProjection == FootProjection::vertical)
      foot = foot_below(p, kernel.sphere_km);
    else if constexpr (kProjection == FootProjection::field)
      foot = foot_along(p, axis, kernel.sphere_km);
    else if constexpr (kProjection == FootProjection::dipole)
      foot = foot_of_dipole(p, axis, kernel.sphere_km);
    else
      foot = foot_of_patch(p, kernel.patches[0].rounded.data(), Pack(kernel.patches[0].per_place));
    return {foot.east_km * texels + first_x, foot.north_km * texels + first_y, foot.is_there};
  }
}

HWY_INLINE PackMask on_face(const AirPoint<Pack>& p, int face) {
  const Pack number = face_number(p), middle(face);
  return middle - Pack(0.5f) < number && number < middle + Pack(0.5f);
}

/// Returns the face on which the foot of the ray's point at `u` from the reference lies.
template <FootProjection kProjection>
HWY_INLINE int face_at(const FootprintKernel& kernel, const MarchSpan& span, double u) {
  const AirPoint<double> p = point_of_ray(span.place_km, span.direction, span.square_km2, span.along_km, u);
  const int above = static_cast<int>(face_number(p));
  if constexpr (kProjection == FootProjection::shell)
    return above;
  else
    return static_cast<int>(face_number(foot_of_shell<kProjection>(kernel, p, above)));
}

/// Places of the middles of steps: texels of a window, and rows of the height profile.
struct StepPlaces {
  Pack x, y, row;
  PackMask shines;  ///< false if there is no foot or no such step
};

/// Data that all steps on a face share.
template <FootProjection kProjection>
struct FaceMarch {
  const FootprintKernel& kernel;
  const MarchSpan& span;
  const SpanLanes& lanes;
  int face;

  const TexelWindow& window() const { return kernel.window[face]; }
  /// Returns the row of the height profile.
  HWY_INLINE Pack row_of(const AirPoint<Pack>& p) const {
    return (altitude_km(p, kernel.sphere_km) - Pack(kernel.profile->bottom_km())) *
           Pack(1.0 / HeightProfile::kStepKm);
  }

  /// Returns the places of the steps from `number` on, each computed by itself. `several_faces`: only steps
  /// on this face have light.
  HWY_INLINE StepPlaces places(Pack number, bool several_faces) const {
    const AirPoint<Pack> p = lanes.at(Pack(span.first_km) + (number + Pack(0.5f)) * Pack(span.step_km));
    const Place at = place_of<kProjection>(kernel, p, face);
    PackMask shines = at.is_there && number < Pack(span.steps);
    if (several_faces) shines = shines && on_face(foot_of_shell<kProjection>(kernel, p, face), face);
    return {at.x - Pack(window().first_x), at.y - Pack(window().first_y), row_of(p), shines};
  }
};

/// Places of sixteen blocks, as a parabola over each block: x = c0 + k (c1 + k c2) with k from -1 at the
/// block's beginning to 1 at its end. A path bends so evenly over a block that the error is no more than the
/// rounding of floats; this is checked a quarter before the end, where the error is about the largest.
struct BlockCurves {
  HWY_ALIGN float x[3][16], y[3][16], row[3][16];
  std::uint32_t good = 0;  ///< a bit for each block for which the parabolas are exact enough

  HWY_INLINE StepPlaces places(int block, Pack k, Pack number, Pack steps) const {
    const auto value = [&](const float c[3][16]) {
      return Pack(c[0][block]) + k * (Pack(c[1][block]) + k * Pack(c[2][block]));
    };
    return {value(x), value(y), value(row), number < steps};
  }
};

/// Returns the bits of a mask, the first at bit `part`.
HWY_INLINE std::uint32_t bits_of(PackMask mask, int part) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask.m, bytes);
  return (bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8) << part;
}

/// Returns the radius around a place within which the footprint is dark, in texels.
HWY_INLINE Pack dark_texels(const LitMap& map, const Place& at) {
  const FloatTag d;
  const IntTag di;
  const auto cell = [&](Pack place, int first, int count) {
    const Pack cells = (place - Pack(first)) * Pack(1.0 / LitMap::kCellTexels);
    return hn::ConvertTo(di,
                         hn::Min(hn::Max(cells.v, hn::Zero(d)), hn::Set(d, static_cast<float>(count - 1))));
  };
  const auto index = hn::Add(hn::Mul(cell(at.y, map.first_y(), map.rows()), hn::Set(di, map.columns())),
                             cell(at.x, map.first_x(), map.columns()));
  return hn::GatherIndex(d, map.dark(), index);
}

/// The feet of both ends and the middle of sixteen stretches of a ray.
struct StretchFeet {
  Place low[kParts], middle[kParts], high[kParts];
};

/// Finds the feet of stretches from `from[i]` to `to[i]`, in blocks from the span's beginning.
template <FootProjection kProjection>
HWY_INLINE void find_feet(const FaceMarch<kProjection>& march, const float* from, const float* to,
                          StretchFeet& out) {
  const FloatTag d;
  const Pack first(march.span.first_km), block_km(kBlockSteps * march.span.step_km);
  for (int part = 0; part < kParts; ++part) {
    const Pack low = hn::Load(d, from + part * kLanes), high = hn::Load(d, to + part * kLanes);
    const auto at = [&](Pack block) {
      return place_of<kProjection>(march.kernel, march.lanes.at(first + block * block_km), march.face);
    };
    out.low[part] = at(low);
    out.middle[part] = at((low + high) * Pack(0.5f));
    out.high[part] = at(high);
  }
}

/// Returns a bit for each stretch that may have light. On a face the foot of a straight ray moves on a
/// straight line, so no place of it is farther from the middle than the ends are. On the plane the line
/// bends, by less than the margin used here. A stretch without feet may have light.
HWY_INLINE std::uint32_t feet_with_light(const LitMap& map, const StretchFeet& feet) {
  std::uint32_t lit = 0;
  for (int part = 0; part < kParts; ++part) {
    const Place &low = feet.low[part], &middle = feet.middle[part], &high = feet.high[part];
    const auto away2 = [&](const Place& end) {
      const Pack dx = end.x - middle.x, dy = end.y - middle.y;
      return dx * dx + dy * dy;
    };
    const Pack low2 = away2(low), high2 = away2(high);
    const Pack reach = square_root(select(low2 < high2, high2, low2)) * Pack(1.05f) + Pack(1.0f);
    const PackMask dark =
        reach < dark_texels(map, middle) && low.is_there && middle.is_there && high.is_there;
    lit |= bits_of({hn::Not(dark.m)}, part * kLanes);
  }
  return lit;
}

/// Computes the curves of sixteen blocks that begin at `blocks`.
template <FootProjection kProjection>
HWY_INLINE void find_curves(const FaceMarch<kProjection>& march, const float* blocks, const StretchFeet& feet,
                            BlockCurves& out) {
  const FloatTag d;
  const Pack first(march.span.first_km), block_km(kBlockSteps * march.span.step_km), half(0.5f);
  const TexelWindow& window = march.window();
  const Pack left(window.first_x), bottom(window.first_y);
  const double columns = std::fabs(window.first_x) + window.columns,
               rows = std::fabs(window.first_y) + window.rows;
  // The error of the altitude's parabola is known to be below 0.2 reach^3 / r^2.
  const double reach_km = 0.5 * kBlockSteps * march.span.step_km;
  const double sphere_km = march.kernel.sphere_km;
  const bool rows_are_good = reach_km * reach_km * reach_km * 0.2 / (sphere_km * sphere_km) < 1e-3;
  out.good = 0;
  for (int part = 0; part < kParts; ++part) {
    const int lane = part * kLanes;
    const auto at = [&](float share) {
      return march.lanes.at(first + (Pack(hn::Load(d, blocks + lane)) + Pack(share)) * block_km);
    };
    const AirPoint<Pack> checked = at(0.75f);
    const Place &low = feet.low[part], &middle = feet.middle[part], &high = feet.high[part];
    const Place check = place_of<kProjection>(march.kernel, checked, march.face);
    PackMask good = low.is_there && middle.is_there && check.is_there && high.is_there;
    const auto fit = [&](Pack a, Pack centre, Pack b, Pack there, Pack origin, double most, float to[3][16]) {
      const Pack slope = (b - a) * half, bend = (b + a) * half - centre;
      hn::Store((centre - origin).v, d, to[0] + lane);
      hn::Store(slope.v, d, to[1] + lane);
      hn::Store(bend.v, d, to[2] + lane);
      // Several roundings of a float.
      const Pack off = centre + half * (slope + half * bend) - there, error(1e-3 + 5e-7 * most);
      good = good && Pack(0.0f) - error < off && off < error;
    };
    fit(low.x, middle.x, high.x, check.x, left, columns, out.x);
    fit(low.y, middle.y, high.y, check.y, bottom, rows, out.y);
    // The derivatives of the altitude h along the ray are h' = (along + u) / r and h'' = (1 - h' h') / r.
    const Pack middle_u = first + (Pack(hn::Load(d, blocks + lane)) + half) * block_km;
    const AirPoint<Pack> p = march.lanes.at(middle_u);
    const Pack inverse = Pack(1.0f) / radius_km(p, sphere_km), reach = block_km * half;
    const Pack rise = (march.lanes.along + middle_u) * inverse;
    const Pack rows_per_km(1.0 / HeightProfile::kStepKm);
    hn::Store(march.row_of(p).v, d, out.row[0] + lane);
    hn::Store((rise * reach * rows_per_km).v, d, out.row[1] + lane);
    hn::Store(((Pack(1.0f) - rise * rise) * inverse * reach * reach * half * rows_per_km).v, d,
              out.row[2] + lane);
    if (rows_are_good) out.good |= bits_of(good, lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
