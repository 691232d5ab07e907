// Sixteen steps of a ray through a footprint, side by side; and which blocks of sixteen may be passed over.
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

#include "sim/base/earth.h"
#include "sim/base/lanes-inl.h"
#include "sim/emit/footprint/footprint_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

#define VEGARD_INLINE HWY_INLINE
#include "sim/emit/footprint/foot_body.h"
#undef VEGARD_INLINE

/// Sixteen numbers take as many registers as the instruction set needs.
HWY_INLINE int lanes_at_once() { return static_cast<int>(hn::Lanes(FloatTag())); }
HWY_INLINE Pack lane_numbers(int first) { return Pack(hn::Iota(FloatTag(), static_cast<float>(first))); }

/// A span with its numbers in all lanes.
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

/// The foot of a point in texels of the plane's grid, or of a face's.
template <FootWay kWay>
HWY_INLINE Place place_of(const FootprintKernel& kernel, const AirPoint<Pack>& p, int face) {
  const Pack texels(kernel.texels), first_x(kernel.first_x), first_y(kernel.first_y);
  if constexpr (kWay == FootWay::shell) {
    const FacePlace<Pack> at = place_on_face(p, face);
    return {at.u * texels + first_x, at.v * texels + first_y, Pack(1.0f) < at.ahead};
  } else {
    const Pack axis[3] = {Pack(kernel.axis[0]), Pack(kernel.axis[1]), Pack(kernel.axis[2])};
    PlaneFoot<Pack> foot;
    if constexpr (kWay == FootWay::vertical)
      foot = foot_below(p);
    else if constexpr (kWay == FootWay::field)
      foot = foot_along(p, axis);
    else
      foot = foot_of_dipole(p, axis);
    return {foot.east_km * texels + first_x, foot.north_km * texels + first_y, foot.is_there};
  }
}

HWY_INLINE PackMask on_face(const AirPoint<Pack>& p, int face) {
  const Pack number = face_number(p), middle(face);
  return middle - Pack(0.5f) < number && number < middle + Pack(0.5f);
}

/// The face of the ray's point, from the reference on.
HWY_INLINE int face_at(const MarchSpan& span, double u) {
  AirPoint<double> p;
  for (int i = 0; i < 3; ++i) p.x[i] = span.place_km[i] + u * span.direction[i];
  return static_cast<int>(face_number(p));
}

/// What a block hands on to be lit: weights of four texels (0 where there is no light to be), where they are,
/// and where in the height profile.
struct BlockPlaces {
  HWY_ALIGN float weight[kBlockSteps][4];
  HWY_ALIGN std::int32_t texel[kBlockSteps];
  HWY_ALIGN std::int32_t row[kBlockSteps];
  HWY_ALIGN float above_row[kBlockSteps];
};

/// A whole number of texels or rows and what is left, from a place between 0 and `most`.
struct Split {
  hn::Vec<IntTag> whole;
  Pack rest;
};
HWY_INLINE Split split(Pack place, int most) {
  const FloatTag d;
  const IntTag di;
  const auto inside = hn::Min(hn::Max(place.v, hn::Zero(d)), hn::Set(d, static_cast<float>(most)));
  const auto whole = hn::Min(hn::ConvertTo(di, inside), hn::Set(di, most - 1));
  return {whole, Pack(hn::Sub(inside, hn::ConvertTo(d, whole)))};
}

template <FootWay kWay>
HWY_INLINE void find_places(const FootprintKernel& kernel, const MarchSpan& span, const SpanLanes& lanes,
                            int first_step, int face, bool several_faces, BlockPlaces& out) {
  const FloatTag d;
  const IntTag di;
  const TexelWindow& window = kernel.window[face];
  const StepProfile& profile = *kernel.profile;
  const Pack zero(0.0f), one(1.0f), step(span.step_km);
  const Pack rows_per_km(1.0 / HeightProfile::kStepKm), bottom(profile.bottom_km());
  const int at_once = lanes_at_once();
  for (int part = 0; part < kBlockSteps; part += at_once) {
    const Pack number = lane_numbers(first_step + part);
    const AirPoint<Pack> p = lanes.at(Pack(span.first_km) + (number + Pack(0.5f)) * step);
    const Split row = split((altitude_km(p) - bottom) * rows_per_km, profile.rows() - 1);
    const Place place = place_of<kWay>(kernel, p, face);
    const Split x = split(place.x - Pack(window.first_x), window.columns - 1);
    const Split y = split(place.y - Pack(window.first_y), window.rows - 1);
    PackMask shines = place.is_there && number < Pack(span.steps);
    if (kWay == FootWay::shell && several_faces) shines = shines && on_face(p, face);
    const Pack upper = select(shines, y.rest, zero), lower = select(shines, one - y.rest, zero);
    const Pack right = x.rest, left = one - x.rest;
    hn::StoreInterleaved4((left * lower).v, (right * lower).v, (left * upper).v, (right * upper).v, d,
                          out.weight[part]);
    hn::Store(hn::Add(hn::Mul(y.whole, hn::Set(di, window.columns)), x.whole), di, out.texel + part);
    hn::Store(hn::Mul(row.whole, hn::Set(di, profile.stride())), di, out.row + part);
    hn::Store(row.rest.v, d, out.above_row + part);
  }
}

/// The face that a stretch of steps lies on; -1 if it crosses an edge.
template <FootWay kWay>
HWY_INLINE int face_of_steps(const MarchSpan& span, int first_step, int steps) {
  if constexpr (kWay != FootWay::shell) return 0;
  const double from = span.first_km + first_step * span.step_km;
  const int face = face_at(span, from);
  return face_at(span, from + steps * span.step_km) == face ? face : -1;
}

/// Of up to sixteen blocks from `first_block` on, those that may have light: a bit each. `face` is theirs, or
/// -1.
template <FootWay kWay>
HWY_INLINE std::uint32_t blocks_with_light(const FootprintKernel& kernel, const MarchSpan& span,
                                           const SpanLanes& lanes, int first_block, int count, int face) {
  const double block_km = kBlockSteps * span.step_km;
  const int at_once = lanes_at_once();
  HWY_ALIGN float x[16], y[16], reach[16];
  std::uint32_t lit = 0;
  const auto look = [&](int of_face, bool several) {
    const FloatTag d;
    std::uint32_t here = 0;
    for (int part = 0; part < count; part += at_once) {
      const Pack middle =
          Pack(span.first_km) + (lane_numbers(first_block + part) + Pack(0.5f)) * Pack(block_km);
      const AirPoint<Pack> p = lanes.at(middle);
      const Place at = place_of<kWay>(kernel, p, of_face);
      const Place low = place_of<kWay>(kernel, lanes.at(middle - Pack(0.5 * block_km)), of_face);
      const Place high = place_of<kWay>(kernel, lanes.at(middle + Pack(0.5 * block_km)), of_face);
      const auto away2 = [&](const Place& end) {
        const Pack dx = end.x - at.x, dy = end.y - at.y;
        return dx * dx + dy * dy;
      };
      const Pack low2 = away2(low), high2 = away2(high);
      // On a face the foot of a straight ray runs straight. On the plane it bends, by less than that. Where
      // there is no foot nothing is known.
      const Pack far = square_root(select(low2 < high2, high2, low2)) * Pack(1.05f) + Pack(1.0f);
      const Pack reach_here = select(at.is_there && low.is_there && high.is_there, far, Pack(1e9f));
      hn::Store(at.x.v, d, x + part);
      hn::Store(at.y.v, d, y + part);
      hn::Store(reach_here.v, d, reach + part);
      if (several)
        for (int i = 0; i < at_once; ++i)
          if (hn::ExtractLane(hn::IfThenElseZero(on_face(p, of_face).m, hn::Set(d, 1.0f)), i) != 0.0f)
            here |= 1u << (part + i);
    }
    if (!several) here = 0xffffu;
    for (int i = 0; i < count; ++i)
      if ((here >> i & 1u) != 0 && !(reach[i] < kernel.lit[of_face]->dark_texels(x[i], y[i]))) lit |= 1u << i;
  };
  if (face >= 0)
    look(face, false);
  else
    for (int f = 0; f < 6; ++f) look(f, true);
  return lit;
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
