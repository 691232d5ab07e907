// Compiled once for every instruction set that is worth it; chosen when the program runs.
#include "sim/emit/footprint/footprint_kernel.h"

#include <cmath>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/emit/footprint/footprint_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/emit/footprint/footprint_block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

// The light of a block goes step by step, four texels or four lines in one small vector: on the processors
// that we know, to gather them lane by lane takes several times as long.
using Four = hn::FixedTag<float, 4>;
using FourVector = hn::Vec<Four>;

constexpr int kGroupBlocks = 16;  ///< that are judged together

/// The weighted sum of four texels, in all four lanes.
HWY_INLINE FourVector bilinear(const float* texels, int columns, const float* weight) {
  const Four d;
  const hn::FixedTag<float, 2> two;
  const auto four = hn::Combine(d, hn::LoadU(two, texels + columns), hn::LoadU(two, texels));
  const auto parts = hn::Mul(four, hn::Load(d, weight));
  const auto pairs = hn::Add(parts, hn::Shuffle2301(parts));
  return hn::Add(pairs, hn::Shuffle1032(pairs));
}

HWY_INLINE FourVector between(const float* row, int stride, FourVector part) {
  const Four d;
  const auto low = hn::LoadU(d, row), high = hn::LoadU(d, row + stride);
  return hn::Add(low, hn::Mul(hn::Sub(high, low), part));
}

/// The sum over steps i of a block, and that of the sums so far: sum of (16 - i) of step i.
template <int kQuartets>
struct BlockSum {
  FourVector plain[kQuartets], running[kQuartets];
};

template <int kQuartets, bool kEnergies>
HWY_INLINE void light_block(const TexelWindow& window, const StepProfile& profile, int width,
                            const BlockPlaces& places, BlockSum<kQuartets>& sum) {
  const Four d;
  constexpr int kStride = 4 * kQuartets;
  for (int q = 0; q < kQuartets; ++q) sum.plain[q] = sum.running[q] = hn::Zero(d);
  const float* rate = profile.rate(0, width);
  for (int i = 0; i < kBlockSteps; ++i) {
    const auto flux = bilinear(window.flux + places.texel[i], window.columns, places.weight[i]);
    const auto part = hn::Set(d, places.above_row[i]);
    FourVector next_share = hn::Zero(d);
    const float* next_rate = rate;
    if constexpr (kEnergies) {
      const float ln =
          hn::GetLane(bilinear(window.ln_energy + places.texel[i], window.columns, places.weight[i]));
      const float most = static_cast<float>(profile.energies() - 1);
      float at = (ln - static_cast<float>(profile.ln_first())) / static_cast<float>(profile.ln_step());
      at = at > 0.0f ? at : 0.0f;
      at = at < most ? at : most;
      const int energy = at < most - 1.0f ? static_cast<int>(at) : profile.energies() - 2;
      rate = profile.rate(energy, width);
      next_rate = profile.rate(energy + 1, width);
      next_share = hn::Set(d, at - static_cast<float>(energy));
    }
    for (int q = 0; q < kQuartets; ++q) {
      auto of_lines = between(rate + places.row[i] + 4 * q, kStride, part);
      if constexpr (kEnergies) {
        const auto of_next = between(next_rate + places.row[i] + 4 * q, kStride, part);
        of_lines = hn::Add(of_lines, hn::Mul(hn::Sub(of_next, of_lines), next_share));
      }
      sum.plain[q] = hn::Add(sum.plain[q], hn::Mul(flux, of_lines));
      sum.running[q] = hn::Add(sum.running[q], sum.plain[q]);
    }
  }
}

template <FootWay kWay, int kQuartets, bool kEnergies>
std::size_t march_span(const FootprintKernel& kernel, const MarchSpan& span, SpanLight& out) {
  const Four d;
  const StepProfile& profile = *kernel.profile;
  const SpanLanes lanes(span);
  FourVector light[kQuartets], moment[kQuartets];
  for (int q = 0; q < kQuartets; ++q) light[q] = moment[q] = hn::Zero(d);
  const int blocks = (span.steps + kBlockSteps - 1) / kBlockSteps;
  std::size_t marched = 0;
  out.entry_km = std::numeric_limits<double>::infinity();
  const WidthOfBlock width_of_block(profile, span);
  const auto take = [&](int block, int face_of_all) {
    const int first = block * kBlockSteps;
    const double from_km = span.at_km + span.first_km + first * span.step_km;
    if (marched == 0) out.entry_km = from_km;
    marched += kBlockSteps;
    const int width = width_of_block(first);
    const auto add = [&](int face, bool several) {
      const TexelWindow& window = kernel.window[face];
      if (window.flux == nullptr) return;
      BlockPlaces places;
      find_places<kWay>(kernel, span, lanes, first, face, several, places);
      BlockSum<kQuartets> sum;
      light_block<kQuartets, kEnergies>(window, profile, width, places, sum);
      const auto step = hn::Set(d, static_cast<float>(span.step_km));
      const auto last = hn::Set(d, static_cast<float>(from_km + (kBlockSteps + 0.5) * span.step_km));
      for (int q = 0; q < kQuartets; ++q) {
        light[q] = hn::Add(light[q], sum.plain[q]);
        moment[q] = hn::Add(moment[q], hn::Sub(hn::Mul(sum.plain[q], last), hn::Mul(sum.running[q], step)));
      }
    };
    const int face = face_of_all >= 0 ? face_of_all : face_of_steps<kWay>(span, first, kBlockSteps);
    if (face >= 0)
      add(face, false);
    else
      for (int f = 0; f < 6; ++f) add(f, true);
  };
  for (int group = 0; group < blocks; group += kGroupBlocks) {
    const int count = blocks - group < kGroupBlocks ? blocks - group : kGroupBlocks;
    const int face = face_of_steps<kWay>(span, group * kBlockSteps, count * kBlockSteps);
    std::uint32_t lit = (1u << count) - 1u;
    if (kernel.lit[0] != nullptr) lit = blocks_with_light<kWay>(kernel, span, lanes, group, count, face);
    for (; lit != 0; lit &= lit - 1)
      take(group + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(lit)), face);
  }
  HWY_ALIGN float of_line[kMostLines] = {}, moment_of_line[kMostLines] = {};
  for (int q = 0; q < kQuartets; ++q) {
    hn::Store(light[q], d, of_line + 4 * q);
    hn::Store(moment[q], d, moment_of_line + 4 * q);
  }
  const double scale = kRayleighsPerKm * span.step_km;
  out.weighted_km = 0.0;
  for (int l = 0; l < kMostLines; ++l) {
    out.rayleigh[l] = scale * of_line[l];
    out.weighted_km += scale * moment_of_line[l];
  }
  return marched;
}

template <FootWay kWay, int kQuartets, bool kEnergies>
std::size_t march_all(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                      SpanLight* out) {
  std::size_t marched = 0;
  for (std::size_t i = 0; i < count; ++i)
    marched += march_span<kWay, kQuartets, kEnergies>(kernel, spans[i], out[i]);
  return marched;
}

template <FootWay kWay>
std::size_t march_way(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                      SpanLight* out) {
  const bool wide = kernel.profile->stride() > 4, energies = kernel.profile->energies() > 1;
  if (energies)
    return wide ? march_all<kWay, 2, true>(kernel, spans, count, out)
                : march_all<kWay, 1, true>(kernel, spans, count, out);
  return wide ? march_all<kWay, 2, false>(kernel, spans, count, out)
              : march_all<kWay, 1, false>(kernel, spans, count, out);
}

std::size_t MarchSpans(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                       SpanLight* out) {
  switch (kernel.way) {
    case FootWay::vertical:
      return march_way<FootWay::vertical>(kernel, spans, count, out);
    case FootWay::field:
      return march_way<FootWay::field>(kernel, spans, count, out);
    case FootWay::dipole:
      return march_way<FootWay::dipole>(kernel, spans, count, out);
    case FootWay::shell:
      break;
  }
  return march_way<FootWay::shell>(kernel, spans, count, out);
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
