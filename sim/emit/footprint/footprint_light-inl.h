// The light of sixteen steps side by side.
//
// A step's light is flux * (lower row + part * (upper row - lower row)). Fluxes are found sixteen at a time;
// then the rows of the profile, which lie in memory side by side, are added up with the weights flux (1 -
// part) and flux part in sixteen lanes, two steps at a time (one, if there are more than four lines).
// Gathering numbers lane by lane takes several times as long on current processors.
#if defined(VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_LIGHT_INL_H_
#undef VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_LIGHT_INL_H_
#else
#define VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_LIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "sim/emit/footprint/footprint_block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// Sixteen numbers: for each of 2 / kQuartets steps, kQuartets * 4 lines of the lower and of the upper row.
using Sixteen = FloatVector[kParts];

/// The sum over the steps of a block, and the sum of its partial sums.
struct BlockSum {
  Sixteen plain, running;
};

/// The integer and the fractional part of a place, limited to between 0 and `most` texels or rows.
struct Split {
  hn::Vec<IntTag> whole;
  Pack rest;
};
HWY_INLINE Split split(Pack place, int most) {
  const FloatTag d;
  const auto inside = hn::Min(hn::Max(place.v, hn::Zero(d)), hn::Set(d, static_cast<float>(most)));
  const auto whole = hn::ConvertTo(IntTag(), inside);
  return {whole, Pack(hn::Sub(inside, hn::ConvertTo(d, whole)))};
}

/// Steps of up to sixteen blocks. Each kind of operation is done for all blocks before the next kind, so that
/// the processor need not wait for one block's light before it begins with the next.
struct Steps {
  HWY_ALIGN std::int32_t texel[16][kBlockSteps], row[16][kBlockSteps];  ///< index of a float in its table
  HWY_ALIGN float right[16][kBlockSteps], upper[16][kBlockSteps], above_row[16][kBlockSteps];
};

/// Stores the places of steps. Steps without light refer to the window's first texel, which is dark.
HWY_INLINE void keep_places(const StepPlaces& at, const TexelWindow& window, const StepProfile& profile,
                            int slot, int part, Steps& out) {
  const FloatTag d;
  const IntTag di;
  const auto shines = hn::RebindMask(di, at.shines.m);
  const Split x = split(at.x, window.columns - 1), y = split(at.y, window.rows - 1);
  const Split row = split(at.row, profile.rows() - 1);
  const auto texel = hn::Add(hn::Mul(y.whole, hn::Set(di, window.columns)), x.whole);
  hn::Store(hn::IfThenElseZero(shines, texel), di, out.texel[slot] + part);
  hn::Store(hn::IfThenElseZero(at.shines.m, x.rest.v), d, out.right[slot] + part);
  hn::Store(hn::IfThenElseZero(at.shines.m, y.rest.v), d, out.upper[slot] + part);
  hn::Store(hn::Mul(row.whole, hn::Set(di, profile.stride())), di, out.row[slot] + part);
  hn::Store(row.rest.v, d, out.above_row[slot] + part);
}

/// Loads two neighbouring texels of a row and the two of the next row.
HWY_INLINE hn::Vec<hn::FixedTag<float, 4>> four_texels(const float* texels, int columns) {
  const hn::FixedTag<float, 2> two;
  return hn::Combine(hn::FixedTag<float, 4>(), hn::LoadU(two, texels + columns), hn::LoadU(two, texels));
}

/// Interpolates between the texels around one place per lane.
HWY_INLINE Pack bilinear(const float* texels, int columns, const std::int32_t* at, Pack right, Pack upper) {
  const FloatTag d;
  const auto texels_at = [&](int i) { return four_texels(texels + at[i], columns); };
  FloatVector v[4];
  for (int j = 0; j < 4; ++j) {
#if HWY_MAX_BYTES >= 64
    const hn::FixedTag<float, 8> half;
    v[j] = hn::Combine(d, hn::Combine(half, texels_at(12 + j), texels_at(8 + j)),
                       hn::Combine(half, texels_at(4 + j), texels_at(j)));
#elif HWY_MAX_BYTES >= 32
    v[j] = hn::Combine(d, texels_at(4 + j), texels_at(j));
#else
    v[j] = texels_at(j);
#endif
  }
  // From a step's four texels to sixteen steps' texel, within each four lanes.
  const auto a = hn::InterleaveLower(d, v[0], v[2]), b = hn::InterleaveLower(d, v[1], v[3]);
  const auto c = hn::InterleaveUpper(d, v[0], v[2]), e = hn::InterleaveUpper(d, v[1], v[3]);
  const Pack lower_left = hn::InterleaveLower(d, a, b), lower_right = hn::InterleaveUpper(d, a, b);
  const Pack upper_left = hn::InterleaveLower(d, c, e), upper_right = hn::InterleaveUpper(d, c, e);
  const Pack low = lower_left + right * (lower_right - lower_left);
  const Pack high = upper_left + right * (upper_right - upper_left);
  return low + upper * (high - low);
}

/// The weights of the rows: one pair per step, or two if there are several energies.
template <bool kEnergies>
struct RowWeights {
  static constexpr int kPairs = kEnergies ? 2 : 1;
  /// [step][lower, upper], and padding that is read beyond the last.
  HWY_ALIGN float of[kPairs][16][2 * kBlockSteps + 16];
};

template <bool kEnergies>
HWY_INLINE void find_weights(const TexelWindow& window, const StepProfile& profile, int slot, Steps& steps,
                             RowWeights<kEnergies>& out) {
  const FloatTag d;
  const IntTag di;
  for (int part = 0; part < kBlockSteps; part += kLanes) {
    const Pack right = hn::Load(d, steps.right[slot] + part), upper = hn::Load(d, steps.upper[slot] + part);
    const Pack above = hn::Load(d, steps.above_row[slot] + part);
    const std::int32_t* texel = steps.texel[slot] + part;
    const Pack flux = bilinear(window.flux, window.columns, texel, right, upper);
    const auto keep = [&](int pair, Pack light) {
      const Pack upper_light = light * above;
      hn::StoreInterleaved2((light - upper_light).v, upper_light.v, d, out.of[pair][slot] + 2 * part);
    };
    if constexpr (kEnergies) {
      const Pack ln = bilinear(window.ln_energy, window.columns, texel, right, upper);
      const Pack place = (ln - Pack(profile.ln_first())) * Pack(1.0 / profile.ln_step());
      const int most = profile.energies() - 1;
      const Split energy = split(place, most);
      const auto lower = hn::Min(energy.whole, hn::Set(di, most - 1));
      const Pack share = energy.rest + Pack(hn::ConvertTo(d, hn::Sub(energy.whole, lower)));
      const Pack next = flux * share;
      keep(0, flux - next);
      keep(1, next);
      std::int32_t* row = steps.row[slot] + part;
      hn::Store(hn::Add(hn::Load(di, row), hn::Mul(lower, hn::Set(di, profile.energy_stride()))), di, row);
    } else {
      keep(0, flux);
    }
  }
}

/// Distributes the weights of 2 / kQuartets steps to sixteen lanes.
template <int kQuartets>
class WeightLanes {
 public:
  HWY_INLINE WeightLanes() {
    HWY_ALIGN std::int32_t index[16];
    for (int i = 0; i < 16; ++i) index[i] = i / (4 * kQuartets) % kLanes;
    for (int p = 0; p < kParts; ++p) of_[p] = hn::SetTableIndices(FloatTag(), index + p * kLanes);
  }
  HWY_INLINE FloatVector spread(const float* weights, int p) const {
    return hn::TableLookupLanes(hn::LoadDup128(FloatTag(), weights), of_[p]);
  }

 private:
  decltype(hn::SetTableIndices(FloatTag(), static_cast<const std::int32_t*>(nullptr))) of_[kParts];
};

/// Loads the rows of the steps from `at` on for one unit of sixteen lanes.
template <int kQuartets>
HWY_INLINE void load_rows(const float* rate, const std::int32_t* at, Sixteen& out) {
  const FloatTag d;
#if HWY_MAX_BYTES >= 64
  if constexpr (kQuartets == 1) {
    const hn::FixedTag<float, 8> half;
    out[0] = hn::Combine(d, hn::LoadU(half, rate + at[1]), hn::LoadU(half, rate + at[0]));
    return;
  }
#endif
  for (int part = 0; part < kParts; ++part) {
    const int lane = part * kLanes, step = kQuartets == 1 ? lane / 8 : 0;
    out[part] = hn::LoadU(d, rate + at[step] + (kQuartets == 1 ? lane % 8 : lane));
  }
}

template <int kQuartets, bool kEnergies>
HWY_INLINE void add_rows(const StepProfile& profile, int width, int slot, const Steps& steps,
                         const RowWeights<kEnergies>& weights, const WeightLanes<kQuartets>& lanes,
                         BlockSum& sum) {
  const FloatTag d;
  const float* rate[2] = {profile.rate(0, width), profile.rate(0, width) + profile.energy_stride()};
  for (int p = 0; p < kParts; ++p) sum.plain[p] = sum.running[p] = hn::Zero(d);
  constexpr int kSteps = 2 / kQuartets;
  for (int i = 0; i < kBlockSteps; i += kSteps) {
    for (int pair = 0; pair < RowWeights<kEnergies>::kPairs; ++pair) {
      Sixteen rows;
      load_rows<kQuartets>(rate[pair], steps.row[slot] + i, rows);
      for (int p = 0; p < kParts; ++p)
        sum.plain[p] =
            hn::Add(sum.plain[p], hn::Mul(rows[p], lanes.spread(weights.of[pair][slot] + 2 * i, p)));
    }
    for (int p = 0; p < kParts; ++p) sum.running[p] = hn::Add(sum.running[p], sum.plain[p]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
