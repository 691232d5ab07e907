// Lane types: the number types of the simulator's kernel. A Pack holds as many floats as a vector register of
// the instruction set (at most 16) and is fast; double is the reference. The kernel is a template of the lane
// type, with masks instead of branches. Multiplication and addition are never fused, so every instruction set
// gives the same bits.
//
// Included once per instruction set by Highway's foreach_target, with the toggled include guard of Highway's
// manual.
#if defined(VEGARD_SIM_BASE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_BASE_LANES_INL_H_
#undef VEGARD_SIM_BASE_LANES_INL_H_
#else
#define VEGARD_SIM_BASE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>

#include "sim/base/number/random.h"

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

/// The keys of all rounds, which only depend on the seed.
using PhiloxKeys = std::uint32_t[philox::kRounds][2];
HWY_INLINE void philox_keys(std::uint64_t seed, PhiloxKeys& keys) {
  auto key = random_key(seed);
  for (auto& round_key : keys) {
    round_key[0] = key[0];
    round_key[1] = key[1];
    key[0] += philox::kWeyl0;
    key[1] += philox::kWeyl1;
  }
}

/// Computes random_words(seed, Stream::path, quad, beam, layer) of sim/base/number/random.h, bit by bit the
/// same, for the beams of a pack, one quad after the other. Even and odd lanes are kept separately, one per
/// 64 bits, so that one shift gives the high word of a product; multiplications ignore the upper halves of
/// their operands.
///
/// Only the beam's index differs between lanes, and it enters the first round by XOR. So the products of the
/// first round are the same for all lanes. In the second round, the product that depends on the beam is the
/// same for all quads; in the third, only one product depends on the beam. Two of the rounds therefore cost
/// very little.
class PathWords {
 public:
  HWY_INLINE void start(WordVector beams, std::uint32_t layer, const PhiloxKeys& keys) {
    const WordTag d;
    const std::uint64_t product = static_cast<std::uint64_t>(philox::kMultiplier1) * layer;
    of_layer_ = static_cast<std::uint32_t>(product);
    const auto c0 = hn::Xor(beams, hn::Set(d, static_cast<std::uint32_t>(product >> 32) ^ keys[0][0]));
    of_beams_[0] = times(hn::BitCast(Wide(), c0), philox::kMultiplier0);
    of_beams_[1] = times(hn::ShiftRight<32>(hn::BitCast(Wide(), c0)), philox::kMultiplier0);
  }

  HWY_INLINE void draw(std::uint32_t quad, const PhiloxKeys& keys, WordVector out[4]) const {
    const std::uint64_t first = static_cast<std::uint64_t>(philox::kMultiplier0) * quad;
    const std::uint32_t c2 = high(first) ^ static_cast<std::uint32_t>(Stream::path) ^ keys[0][1];
    const std::uint64_t second = static_cast<std::uint64_t>(philox::kMultiplier1) * c2;
    const std::uint64_t third =
        static_cast<std::uint64_t>(philox::kMultiplier0) * (high(second) ^ of_layer_ ^ keys[1][0]);
    hn::Vec<Wide> c[2][4];
    for (int part = 0; part < 2; ++part) {
      const auto p1 = times(
          hn::Xor(hn::ShiftRight<32>(of_beams_[part]), all(static_cast<std::uint32_t>(first) ^ keys[1][1])),
          philox::kMultiplier1);
      c[part][0] = hn::Xor(hn::ShiftRight<32>(p1), all(static_cast<std::uint32_t>(second) ^ keys[2][0]));
      c[part][1] = p1;
      c[part][2] = hn::Xor(of_beams_[part], all(high(third) ^ keys[2][1]));
      c[part][3] = all(static_cast<std::uint32_t>(third));
      for (int round = 3; round < philox::kRounds; ++round) turn(c[part], keys[round]);
    }
    const WordTag d;
    for (int i = 0; i < 4; ++i)
      out[i] = hn::OddEven(hn::BitCast(d, hn::ShiftLeft<32>(c[1][i])), hn::BitCast(d, c[0][i]));
  }

 private:
  using Wide = hn::RepartitionToWide<WordTag>;

  static HWY_INLINE std::uint32_t high(std::uint64_t product) {
    return static_cast<std::uint32_t>(product >> 32);
  }
  static HWY_INLINE hn::Vec<Wide> all(std::uint32_t word) {
    return hn::BitCast(Wide(), hn::Set(WordTag(), word));
  }
  static HWY_INLINE hn::Vec<Wide> times(hn::Vec<Wide> x, std::uint32_t factor) {
    return hn::MulEven(hn::BitCast(WordTag(), x), hn::Set(WordTag(), factor));
  }
  static HWY_INLINE void turn(hn::Vec<Wide> c[4], const std::uint32_t key[2]) {
    const auto p0 = times(c[0], philox::kMultiplier0), p1 = times(c[2], philox::kMultiplier1);
    c[0] = hn::Xor3(hn::ShiftRight<32>(p1), c[1], all(key[0]));
    c[2] = hn::Xor3(hn::ShiftRight<32>(p0), c[3], all(key[1]));
    c[1] = p1;
    c[3] = p0;
  }

  hn::Vec<Wide> of_beams_[2];  ///< products of the second round
  std::uint32_t of_layer_;
};

/// PathWords for one beam.
class PathWordsOfOne {
 public:
  HWY_INLINE void start(std::uint32_t beam, std::uint32_t layer, const PhiloxKeys&) {
    beam_ = beam;
    layer_ = layer;
  }
  HWY_INLINE void draw(std::uint32_t quad, const PhiloxKeys& keys, std::uint32_t out[4]) const {
    const Words words =
        philox4x32({quad, beam_, layer_, static_cast<std::uint32_t>(Stream::path)}, {keys[0][0], keys[0][1]});
    for (int i = 0; i < 4; ++i) out[i] = words[i];
  }

 private:
  std::uint32_t beam_, layer_;
};

// The random numbers of a step, see sim/base/number/random.h. Length and azimuth are exact in floats, so that
// packs and double agree.
HWY_INLINE Pack upper_uniform(WordVector word) {
  const auto integer = hn::BitCast(IntTag(), hn::ShiftRight<16>(word));
  return (Pack(hn::ConvertTo(FloatTag(), integer)) + Pack(0.5f)) * Pack(1.0f / 65536.0f);
}
HWY_INLINE double upper_uniform(std::uint32_t word) { return sim::upper_uniform(word); }

/// Returns one word per beam: Weyl's sequence of the golden ratio, starting at `from`. The upper halves of
/// neighbouring beams' words fill 0 to 1 evenly.
HWY_INLINE WordVector golden_ratio_word(WordVector beams, std::uint32_t from) {
  return hn::Add(hn::Mul(beams, hn::Set(WordTag(), 0x9E3779B9u)), hn::Set(WordTag(), from));
}
HWY_INLINE std::uint32_t golden_ratio_word(std::uint32_t beam, std::uint32_t from) {
  return beam * 0x9E3779B9u + from;
}

HWY_INLINE Pack place_in_quarter(WordVector word) {
  const auto integer = hn::BitCast(IntTag(), hn::And(word, hn::Set(WordTag(), azimuth_bits::kPlace)));
  return Pack(hn::ConvertTo(FloatTag(), integer)) * Pack(azimuth_bits::kCell) + Pack(azimuth_bits::kFirst);
}
HWY_INLINE double place_in_quarter(std::uint32_t word) {
  return static_cast<double>(word & azimuth_bits::kPlace) * azimuth_bits::kCell + azimuth_bits::kFirst;
}

/// Returns -x where the word has the bit kBit, else x.
template <std::uint32_t kBit>
HWY_INLINE Pack with_sign(Pack x, WordVector word) {
  constexpr int kUp = kBit == azimuth_bits::kCosineSign ? 16 : 17;
  static_assert(kBit << kUp == 0x80000000u, "the bit of a float's sign");
  const auto sign = hn::And(hn::ShiftLeft<kUp>(word), hn::Set(WordTag(), 0x80000000u));
  return hn::Xor(x.v, hn::BitCast(FloatTag(), sign));
}
template <std::uint32_t kBit>
HWY_INLINE double with_sign(double x, std::uint32_t word) {
  return (word & kBit) != 0 ? -x : x;
}

/// The properties of a lane type that the kernel needs.
template <class L>
struct LaneTraits;

template <>
struct LaneTraits<Pack> {
  using Scalar = float;
  using Indices = WordVector;
  using Words = WordVector;
  using PathWords = HWY_NAMESPACE::PathWords;
  static HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(FloatTag())); }
  static HWY_INLINE Pack load(const double* from) {
    HWY_ALIGN float narrow[16];
    for (int i = 0; i < lanes(); ++i) narrow[i] = static_cast<float>(from[i]);
    return hn::Load(FloatTag(), narrow);
  }
  static HWY_INLINE void store(Pack p, float* to) { hn::StoreU(p.v, FloatTag(), to); }
  static HWY_INLINE WordVector load_indices(const std::uint32_t* from) { return hn::LoadU(WordTag(), from); }
};

template <>
struct LaneTraits<double> {
  using Scalar = double;
  using Indices = std::uint32_t;
  using Words = std::uint32_t;
  using PathWords = PathWordsOfOne;
  static HWY_INLINE int lanes() { return 1; }
  static HWY_INLINE double load(const double* from) { return *from; }
  static HWY_INLINE void store(double p, double* to) { *to = p; }
  static HWY_INLINE std::uint32_t load_indices(const std::uint32_t* from) { return *from; }
};

/// Computes cosine and sine of the azimuth in the lower half of a word, with an absolute error below 3e-7 in
/// floats. c and s are polynomials through the Chebyshev nodes of a quarter turn around its middle, where
/// sine and cosine are (c + s) / sqrt(2) and (c - s) / sqrt(2); the coefficients include the root.
template <class L, class W>
HWY_INLINE void random_direction(W word, L& cosine, L& sine) {
  const L x = place_in_quarter(word) * L(1.57079632679489662);
  const L x2 = x * x;
  const L s =
      x * (L(0.7071067790070349) +
           x2 * (L(-0.11785101711250609) + x2 * (L(0.005891639005092336) + x2 * L(-0.00013791342956252575))));
  const L c = L(0.7071067616198383) + x2 * (L(-0.35355237532357464) +
                                            x2 * (L(0.029454543523812313) + x2 * L(-0.0009606596645877552)));
  cosine = with_sign<azimuth_bits::kCosineSign>(c - s, word);
  sine = with_sign<azimuth_bits::kSineSign>(c + s, word);
}

/// Return sine and cosine of an angle below a third of a radian, with a relative error below 1e-7.
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
