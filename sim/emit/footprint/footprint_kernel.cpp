// Compiled once for every instruction set that is worth it; chosen when the program runs.
#include "sim/emit/footprint/footprint_kernel_types.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/emit/footprint/footprint_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/emit/footprint/footprint_block-inl.h"
#include "sim/emit/footprint/footprint_queue-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

constexpr int kBentBlocks = 16;    ///< over which feet along a field run straight enough
constexpr int kStretchBlocks = 8;  ///< that are passed over together, if all are dark

/// A span's way through the faces, to the blocks with light.
template <FootProjection kProjection>
class SpanMarch {
 public:
  HWY_INLINE SpanMarch(const FootprintKernel& kernel, const MarchSpan& span, std::size_t number,
                       LightQueue& queue)
      : kernel_(kernel),
        span_(span),
        number_(number),
        queue_(queue),
        lanes_(span),
        width_of_block_(*kernel.profile, span, kernel.sphere_km) {}

  HWY_INLINE void run() {
    const int blocks = (span_.steps + kBlockSteps - 1) / kBlockSteps;
    if constexpr (is_shell_projection(kProjection))
      through_faces(0, blocks, face_at_block(0), face_at_block(blocks));
    else
      along_face(0, blocks, 0);
  }

 private:
  int face_at_block(int block) const {
    return face_at<kProjection>(kernel_, span_, span_.first_km + block * kBlockSteps * span_.step_km);
  }

  /// Faces are convex: a stretch with both ends on one is there as a whole. Along a field the feet of a ray
  /// run in a bow, which is flat over a few blocks.
  void through_faces(int first, int last, int face, int last_face) {
    if (face == last_face && (kProjection == FootProjection::shell || last - first <= kBentBlocks))
      return along_face(first, last, face);
    if (last - first == 1) return across_faces(first);
    const int middle = first + (last - first) / 2, middle_face = face_at_block(middle);
    through_faces(first, middle, face, middle_face);
    through_faces(middle, last, middle_face, last_face);
  }

  void across_faces(int block) {
    for (int face = 0; face < 6; ++face) {
      if (kernel_.window[face].flux == nullptr) continue;
      const FaceMarch<kProjection> march{kernel_, span_, lanes_, face};
      push(march.window(), block, [&](int part) { return march.places(step_numbers(block, part), true); });
    }
  }

  HWY_INLINE void along_face(int first, int last, int face) {
    if (kernel_.window[face].flux == nullptr) return;
    const FaceMarch<kProjection> march{kernel_, span_, lanes_, face};
    Blocks blocks;
    const auto add = [&](int begin, int end) {
      for (int block = begin; block < end; ++block) {
        blocks.from[blocks.count] = static_cast<float>(block);
        blocks.to[blocks.count] = static_cast<float>(block + 1);
        if (++blocks.count == 16) take(march, blocks);
      }
    };
    if (kernel_.lit[face] == nullptr || last - first <= 16)
      add(first, last);
    else
      for (int at = first; at < last; at += 16 * kStretchBlocks)
        for (std::uint32_t lit = stretches_with_light(march, at, last); lit != 0; lit &= lit - 1) {
          const int begin = at + kStretchBlocks * first_of(lit);
          add(begin, std::min(last, begin + kStretchBlocks));
        }
    if (blocks.count > 0) take(march, blocks);
  }

  /// Of up to sixteen stretches of blocks from `first` on: a bit each.
  HWY_INLINE std::uint32_t stretches_with_light(const FaceMarch<kProjection>& march, int first,
                                                int last) const {
    HWY_ALIGN float from[16], to[16];
    for (int i = 0; i < 16; ++i) {
      from[i] = static_cast<float>(std::min(last, first + i * kStretchBlocks));
      to[i] = static_cast<float>(std::min(last, first + (i + 1) * kStretchBlocks));
    }
    const int stretches = std::min(16, (last - first + kStretchBlocks - 1) / kStretchBlocks);
    StretchFeet feet;
    find_feet(march, from, to, feet);
    return feet_with_light(*kernel_.lit[march.face], feet) & ((1u << stretches) - 1u);
  }

  /// Up to sixteen blocks: where they begin and end, counted from the span's beginning.
  struct Blocks {
    HWY_ALIGN float from[16], to[16];
    int count = 0;
  };

  HWY_INLINE void take(const FaceMarch<kProjection>& march, Blocks& blocks) {
    std::uint32_t lit = (1u << blocks.count) - 1u;
    for (int i = blocks.count; i < 16; ++i) {
      blocks.from[i] = blocks.from[i - 1];
      blocks.to[i] = blocks.to[i - 1];
    }
    blocks.count = 0;
    StretchFeet feet;
    find_feet(march, blocks.from, blocks.to, feet);
    if (kernel_.lit[march.face] != nullptr) lit &= feet_with_light(*kernel_.lit[march.face], feet);
    if (lit == 0) return;
    BlockCurves curves;
    find_curves(march, blocks.from, feet, curves);
    const Pack all(span_.steps);
    for (; lit != 0; lit &= lit - 1) {
      const int i = first_of(lit), block = static_cast<int>(blocks.from[i]);
      if ((curves.good >> i & 1u) != 0)
        push(march.window(), block, [&](int part) {
          const Pack k = (lane_numbers(part) - Pack(0.5f * (kBlockSteps - 1))) * Pack(2.0f / kBlockSteps);
          return curves.places(i, k, step_numbers(block, part), all);
        });
      else
        push(march.window(), block, [&](int part) { return march.places(step_numbers(block, part), false); });
    }
  }

  template <class PlacesOf>
  HWY_INLINE void push(const TexelWindow& window, int block, const PlacesOf& places_of) {
    queue_.push(window, number_, block, width_of_block_(block * kBlockSteps), places_of);
  }

  static HWY_INLINE Pack step_numbers(int block, int part) {
    return lane_numbers(block * kBlockSteps + part);
  }
  static HWY_INLINE int first_of(std::uint32_t bits) {
    return static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
  }

  const FootprintKernel& kernel_;
  const MarchSpan& span_;
  const std::size_t number_;
  LightQueue& queue_;
  const SpanLanes lanes_;
  const WidthOfBlock width_of_block_;
};

template <FootProjection kProjection>
void march_projection(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                      LightQueue& queue) {
  for (std::size_t i = 0; i < count; ++i) SpanMarch<kProjection>(kernel, spans[i], i, queue).run();
}

void march_all(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count, LightQueue& queue) {
  switch (kernel.projection) {
    case FootProjection::vertical:
      return march_projection<FootProjection::vertical>(kernel, spans, count, queue);
    case FootProjection::field:
      return march_projection<FootProjection::field>(kernel, spans, count, queue);
    case FootProjection::dipole:
      return march_projection<FootProjection::dipole>(kernel, spans, count, queue);
    case FootProjection::reference:
      return march_projection<FootProjection::reference>(kernel, spans, count, queue);
    case FootProjection::shell_dipole:
      return march_projection<FootProjection::shell_dipole>(kernel, spans, count, queue);
    case FootProjection::shell_reference:
      return march_projection<FootProjection::shell_reference>(kernel, spans, count, queue);
    case FootProjection::shell:
      break;
  }
  march_projection<FootProjection::shell>(kernel, spans, count, queue);
}

template <int kQuartets, bool kEnergies>
std::size_t march_lines(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                        SpanLight* out) {
  std::fill(out, out + count, SpanLight{{}, 0.0, std::numeric_limits<double>::infinity()});
  LightQueueOf<kQuartets, kEnergies> queue(*kernel.profile, spans, out);
  march_all(kernel, spans, count, queue);
  return queue.finish();
}

std::size_t MarchSpans(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                       SpanLight* out) {
  const bool wide = kernel.profile->stride() > 4;
  if (kernel.profile->energies() > 1)
    return wide ? march_lines<2, true>(kernel, spans, count, out)
                : march_lines<1, true>(kernel, spans, count, out);
  return wide ? march_lines<2, false>(kernel, spans, count, out)
              : march_lines<1, false>(kernel, spans, count, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::sim {

HWY_EXPORT(MarchSpans);

std::size_t march_spans(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                        SpanLight* out) {
  return HWY_DYNAMIC_DISPATCH(MarchSpans)(kernel, spans, count, out);
}

}  // namespace vegard::sim
#endif
