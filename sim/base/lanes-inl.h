// Lane types: what the simulator's kernel computes with. A Pack holds as many floats as a vector register of
// the instruction set (at most 16) and renders fast; double is the reference. The kernel is written once over
// either, with masks in place of branches. Multiplication and addition are never fused, so every instruction
// set gives the same bits.
//
// Included once per instruction set by Highway's foreach_target: the guard is toggled, as Highway's manual
// asks.
#if defined(VEGARD_SIM_BASE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_BASE_LANES_INL_H_
#undef VEGARD_SIM_BASE_LANES_INL_H_
#else
#define VEGARD_SIM_BASE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>

#include "sim/base/random.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using WordTag = hn::RebindToUnsigned<FloatTag>;
using IntTag = hn::RebindToSigned<FloatTag>;
using FloatVector = hn::Vec<FloatTag>;
using WordVector = hn::Vec<WordTag>;

struct Pack {
  FloatVector v;
  Pack() = default;
  HWY_INLINE Pack(FloatVector vector) : v(vector) {}          // NOLINT: a vector is a pack
  HWY_INLINE Pack(float x) : v(hn::Set(FloatTag(), x)) {}     // NOLINT: a constant fills all lanes
  HWY_INLINE Pack(double x) : Pack(static_cast<float>(x)) {}  // NOLINT
  HWY_INLINE Pack(int x) : Pack(static_cast<float>(x)) {}     // NOLINT
};
struct PackMask {
  hn::Mask<FloatTag> m;
};

HWY_INLINE Pack operator+(Pack a, Pack b) { return hn::Add(a.v, b.v); }
HWY_INLINE Pack operator-(Pack a, Pack b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Pack operator*(Pack a, Pack b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Pack operator/(Pack a, Pack b) { return hn::Div(a.v, b.v); }
HWY_INLINE PackMask operator<(Pack a, Pack b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE PackMask operator<=(Pack a, Pack b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE PackMask operator&&(PackMask a, PackMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE Pack select(PackMask m, Pack yes, Pack no) { return hn::IfThenElse(m.m, yes.v, no.v); }
HWY_INLINE bool none(PackMask m) { return hn::AllFalse(FloatTag(), m.m); }
HWY_INLINE int count(PackMask m) { return static_cast<int>(hn::CountTrue(FloatTag(), m.m)); }
HWY_INLINE Pack square_root(Pack a) { return hn::Sqrt(a.v); }
HWY_INLINE Pack round_to_nearest(Pack a) { return hn::Round(a.v); }
HWY_INLINE Pack value_of(Pack a) { return a; }

HWY_INLINE double select(bool m, double yes, double no) { return m ? yes : no; }
HWY_INLINE bool none(bool m) { return !m; }
HWY_INLINE int count(bool m) { return m ? 1 : 0; }
HWY_INLINE double square_root(double a) { return std::sqrt(a); }
HWY_INLINE double round_to_nearest(double a) { return std::nearbyint(a); }
HWY_INLINE double value_of(double a) { return a; }

/// The keys of all rounds, which hang on the seed alone.
using PhiloxKeys = std::uint32_t[philox::kRounds][2];
HWY_INLINE void philox_keys(std::uint64_t seed, PhiloxKeys& keys) {
  auto key = random_key(seed);
  for (auto& of_round : keys) {
    of_round[0] = key[0];
    of_round[1] = key[1];
    key[0] += philox::kWeyl0;
    key[1] += philox::kWeyl1;
  }
}

/// philox4x32 of sim/base/random.h for every lane, the same bits. The even and the odd lanes travel apart,
/// one to 64 bits, so that a product's high word is one shift away; what stands in the upper halves of its
/// operands a multiplication does not see.
struct PhiloxLanes {
  using Wide = hn::RepartitionToWide<WordTag>;
  hn::Vec<Wide> c[4];

  HWY_INLINE void turn(const std::uint32_t key[2]) {
    const Wide d;
    const WordTag words;
    const auto product = [&](hn::Vec<Wide> x, std::uint32_t factor) {
      return hn::MulEven(hn::BitCast(words, x), hn::Set(words, factor));
    };
    const auto p0 = product(c[0], philox::kMultiplier0), p1 = product(c[2], philox::kMultiplier1);
    c[0] = hn::Xor(hn::Xor(hn::ShiftRight<32>(p1), c[1]), hn::BitCast(d, hn::Set(words, key[0])));
    c[2] = hn::Xor(hn::Xor(hn::ShiftRight<32>(p0), c[3]), hn::BitCast(d, hn::Set(words, key[1])));
    c[1] = p1;
    c[3] = p0;
  }
};

/// What the kernel needs to know of a lane type.
template <class L>
struct LaneTraits;

template <>
struct LaneTraits<Pack> {
  using Scalar = float;
  using Indices = WordVector;
  static HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(FloatTag())); }
  static HWY_INLINE Pack load(const double* from) {
    HWY_ALIGN float narrow[16];
    for (int i = 0; i < lanes(); ++i) narrow[i] = static_cast<float>(from[i]);
    return hn::Load(FloatTag(), narrow);
  }
  static HWY_INLINE void store(Pack p, float* to) { hn::StoreU(p.v, FloatTag(), to); }
  static HWY_INLINE WordVector load_indices(const std::uint32_t* from) { return hn::LoadU(WordTag(), from); }

  /// The uniform numbers of two steps: {length, azimuth} of step 2*pair and of step 2*pair + 1.
  static HWY_INLINE void uniforms(WordVector beams, std::uint32_t pair, std::uint32_t layer,
                                  const PhiloxKeys& keys, Pack out[4]) {
    const WordTag d;
    const PhiloxLanes::Wide wide;
    const WordVector stream = hn::Set(d, static_cast<std::uint32_t>(Stream::path));
    PhiloxLanes even{{hn::BitCast(wide, hn::Set(d, pair)), hn::BitCast(wide, beams),
                      hn::BitCast(wide, hn::Set(d, layer)), hn::BitCast(wide, stream)}};
    PhiloxLanes odd = even;
    odd.c[1] = hn::ShiftRight<32>(even.c[1]);
    for (int round = 0; round < philox::kRounds; ++round) {
      even.turn(keys[round]);
      odd.turn(keys[round]);
    }
    for (int i = 0; i < 4; ++i)
      out[i] =
          unit_interval(hn::OddEven(hn::BitCast(d, hn::ShiftLeft<32>(odd.c[i])), hn::BitCast(d, even.c[i])));
  }

 private:
  static HWY_INLINE Pack unit_interval(WordVector w) {
    const auto integer = hn::BitCast(IntTag(), hn::ShiftRight<8>(w));
    // In (0, 1]: above one half the added half step rounds to the even neighbour.
    return Pack(hn::ConvertTo(FloatTag(), integer)) * Pack(1.0f / 16777216.0f) + Pack(0.5f / 16777216.0f);
  }
};

template <>
struct LaneTraits<double> {
  using Scalar = double;
  using Indices = std::uint32_t;
  static HWY_INLINE int lanes() { return 1; }
  static HWY_INLINE double load(const double* from) { return *from; }
  static HWY_INLINE void store(double p, double* to) { *to = p; }
  static HWY_INLINE std::uint32_t load_indices(const std::uint32_t* from) { return *from; }
  static HWY_INLINE void uniforms(std::uint32_t beam, std::uint32_t pair, std::uint32_t layer,
                                  const PhiloxKeys& keys, double out[4]) {
    const Words words =
        philox4x32({pair, beam, layer, static_cast<std::uint32_t>(Stream::path)}, {keys[0][0], keys[0][1]});
    // Rounded to float as the packs have it, so that both follow the same path.
    for (int i = 0; i < 4; ++i)
      out[i] = static_cast<float>(words[i] >> 8) * (1.0f / 16777216.0f) + 0.5f / 16777216.0f;
  }
};

/// Sine and cosine of 2 pi * turns for turns in [0, 1]: absolute error below 3e-7 in floats. Minimax-like
/// truncated Taylor series on an eighth of a turn, the same operations on every CPU.
template <class L>
HWY_INLINE void sine_cosine_of_turns(L turns, L& sine, L& cosine) {
  const L quarter = round_to_nearest(turns * L(4.0f));
  const L x = (turns * L(4.0f) - quarter) * L(1.57079632679489662);
  const L x2 = x * x;
  const L s =
      x * (L(1.0f) - x2 * (L(1.0 / 6) - x2 * (L(1.0 / 120) - x2 * (L(1.0 / 5040) - x2 * L(1.0 / 362880)))));
  const L c = L(1.0f) - x2 * (L(0.5f) - x2 * (L(1.0 / 24) - x2 * (L(1.0 / 720) - x2 * L(1.0 / 40320))));
  // quarter is 0, 1, 2, 3 or 4: odd ones swap, signs follow.
  const L half = quarter * L(0.5f);
  const L odd = half - round_to_nearest(half - L(0.25f));  // 0 or 1/2
  const auto even = odd < L(0.25f);
  const L sin_size = select(even, s, c), cos_size = select(even, c, s);
  sine = select(L(1.5f) < quarter && quarter < L(3.5f), L(0.0f) - sin_size, sin_size);
  cosine = select(L(0.5f) < quarter && quarter < L(2.5f), L(0.0f) - cos_size, cos_size);
}

/// Sine and cosine of an angle below a third of a radian; relative error below 1e-7.
template <class T>
HWY_INLINE T sine_of_small(const T& x) {
  const T x2 = x * x;
  return x * (T(1.0f) - x2 * (T(1.0f / 6) - x2 * (T(1.0f / 120) - x2 * T(1.0f / 5040))));
}
template <class T>
HWY_INLINE T cosine_of_small(const T& x) {
  const T x2 = x * x;
  return T(1.0f) - x2 * (T(0.5f) - x2 * (T(1.0f / 24) - x2 * T(1.0f / 720)));
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
