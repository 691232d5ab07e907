// Beams falling: the deflection points of sixteen beams, step by step.
//
// Source: Baranoski et al. 2000, section 3.2, equations (3) and (4); rows B12-B16 of docs/physics.md. A step
// of length L d_t nu along the field is turned by the pitch angle alpha and the azimuth beta. A point stands
// for the stretch from half-way to its neighbours (the trapezium rule on the random nodes), which leaves the
// light of a beam unbiased. nu is uniform in (0, 1); or it is 1/2 for all steps but the first, which is a
// fraction of it such that the points of neighbouring beams are evenly spaced. This gives the same light with
// much less grain.
//
// In the mean over all draws a beam is a tube about the field line. Where nothing is drawn, the path is
// instead evaluated at the nodes of a quadrature, for each beam at its own place in the tube's cross-section.
#if defined(VEGARD_SIM_EMIT_AURORA_FALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_EMIT_AURORA_FALL_INL_H_
#undef VEGARD_SIM_EMIT_AURORA_FALL_INL_H_
#else
#define VEGARD_SIM_EMIT_AURORA_FALL_INL_H_
#endif

#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/emit/aurora/place_in_tube.h"
#include "sim/light/sample.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// A deflection point of a group of beams, in the beams' own frame (FallFrame), relative to their start. L is
/// the lane type, P a position: L or a dual number over L.
template <class L, class P>
struct FallenPoint {
  P along_km, across1_km, across2_km;
  L stretch;  ///< part of the path that the point represents, as a fraction of the path
  L t;        ///< place along the path, 0 to 1
};

/// The mean of a path over all draws, in units of its length L. After the fraction t a beam has moved by L ∫
/// cos(pitch) dt along the field, and by a normal deviate in either direction across, of the variance L² d_t
/// / 3 ∫ sin²(pitch) dt: the variance per step is half of the mean of (L step sin(pitch))², which is d_t² / 3
/// L² sin²(pitch), and a step takes d_t / 2 of the path. The pitch angle is linear in t under every law, and
/// small: cosine and squared sine are expanded to its fourth power.
template <class C>
class MeanPath {
 public:
  MeanPath() = default;
  HWY_INLINE explicit MeanPath(const Deflection<C>& d) {
    const C none = C(0.0f);
    C at_start = none, growth = none;
    switch (d.law) {
      case PitchLaw::product:
        growth = d.loss_cone_rad * d.pitch_step_rad;
        break;
      case PitchLaw::increment:
        growth = d.pitch_step_rad;
        break;
      case PitchLaw::constant:
        at_start = d.loss_cone_rad;
        break;
      case PitchLaw::reduced:
        at_start = d.loss_cone_rad - d.pitch_step_rad;
        growth = d.pitch_step_rad;
        break;
    }
    // Integrals of the pitch's square and fourth power: coefficients of t, t², ...
    const C aa = at_start * at_start, ab = at_start * growth, bb = growth * growth;
    const C square[kTerms] = {aa, ab, bb * C(1.0f / 3.0f), none, none};
    const C fourth[kTerms] = {aa * aa, aa * ab * C(2.0f), aa * bb * C(2.0f), ab * bb, bb * bb * C(0.2f)};
    const float per_axis = static_cast<float>(d.path_step / 3.0);
    for (int i = 0; i < kTerms; ++i) {
      along_[i] = fourth[i] * C(1.0f / 24.0f) - square[i] * C(0.5f);
      variance_[i] = (square[i] - fourth[i] * C(1.0f / 3.0f)) * C(per_axis);
    }
    along_[0] = along_[0] + C(1.0f);
  }

  template <class L>
  HWY_INLINE C along(L t) const {
    return at(along_, t);
  }
  /// Returns the variance in either direction across; never 0, where its root would have no derivative.
  template <class L>
  HWY_INLINE C variance(L t) const {
    return at(variance_, t) + C(1e-12f);
  }

 private:
  static constexpr int kTerms = 5;
  template <class L>
  static HWY_INLINE C at(const C (&term)[kTerms], L t) {
    C sum = term[kTerms - 1];
    for (int i = kTerms - 2; i >= 0; --i) sum = sum * t + term[i];
    return sum * t;
  }
  C along_[kTerms], variance_[kTerms];
};

/// A quadrature along the paths of beams that share it.
template <class C>
struct NodesOfPaths {
  PathNodes nodes;
  MeanPath<C> mean;
  double log_shrink = 0.0;  ///< ln(1 / nodes.shrink)
};

/// Beams on their way down. C is the type of the numbers that all beams share.
template <class L, class P, class C>
class FallingBeams {
 public:
  using Traits = LaneTraits<L>;

  HWY_INLINE void start(const P& length_km, typename Traits::Indices beams, std::uint32_t layer,
                        const PhiloxKeys& keys) {
    length_ = length_km;
    t_ = L(0.0f);
    along_ = across1_ = across2_ = P(L(0.0f));
    quad_ = 0;
    random_.start(beams, layer, keys);
    random_.draw(quad_, keys, ahead_);
    first_step_ = upper_uniform(golden_ratio_word(beams, keys[0][0] + keys[0][1] * (layer + 1)));
  }

  /// Starts beams that are evaluated at quadrature nodes. `left`: the rest of the path at the first node,
  /// plus the offset.
  HWY_INLINE void start_in_nodes(const P& length_km, L left, const PlaceInTube<L>& place) {
    length_ = length_km;
    left_ = left;
    in_tube_ = place;
  }

  /// Passes the next four deflection points, one after the other, to `take(i, point)`, i from 0 to 3.
  template <class Take>
  HWY_INLINE void next_four(const Deflection<C>& deflection, const PhiloxKeys& keys, const Take& take) {
    typename Traits::Words now[4];
    for (int i = 0; i < 4; ++i) now[i] = ahead_[i];
    ++quad_;
    random_.draw(quad_, keys, ahead_);
    const L path_step(static_cast<float>(deflection.path_step));
    if (deflection.rule == PathRule::even) {
      const L even = L(0.5f) * path_step;
      L step = first_step_ * even;
      first_step_ = L(1.0f);
      for (int i = 0; i < 4; ++i) {
        // The mean square of a random step is 4/3 of that of an even one.
        deflect(deflection, step, now[i], L(1.1547005f));
        take(i, FallenPoint<L, P>{along_, across1_, across2_, (step + even) * L(0.5f), t_});
        step = even;
      }
      return;
    }
    L step = upper_uniform(now[0]) * path_step;
    for (int i = 0; i < 4; ++i) {
      const L next_step = upper_uniform(i < 3 ? now[i + 1] : ahead_[0]) * path_step;
      deflect(deflection, step, now[i], L(1.0f));
      take(i, FallenPoint<L, P>{along_, across1_, across2_, (step + next_step) * L(0.5f), t_});
      step = next_step;
    }
  }

  /// Does the same with quadrature nodes.
  template <class Take>
  HWY_INLINE void next_four_nodes(const NodesOfPaths<C>& paths, const Take& take) {
    const L beyond(static_cast<float>(1.0 + paths.nodes.offset));
    const L shrink(static_cast<float>(paths.nodes.shrink)), stretch(static_cast<float>(paths.log_shrink));
    for (int i = 0; i < 4; ++i) {
      const L t = beyond - left_;
      const P variance = length_ * length_ * paths.mean.variance(t);
      const P along_sheet = square_root(variance);
      const P across_sheet =
          variance / (square_root(variance + in_tube_.width_km * in_tube_.width_km) + in_tube_.width_km);
      L stands_for = left_ * stretch;
      if (paths.nodes.spread > 0.0) {  // share of the beams that reach this node
        const L come = (L(1.0f) - t) * L(static_cast<float>(1.0 / paths.nodes.spread));
        stands_for = stands_for * select(come < L(1.0f), come, L(1.0f));
      }
      take(i, FallenPoint<L, P>{length_ * paths.mean.along(t),
                                along_sheet * in_tube_.along[0] + across_sheet * in_tube_.across[0],
                                along_sheet * in_tube_.along[1] + across_sheet * in_tube_.across[1],
                                stands_for, t});
      left_ = left_ * shrink;
    }
  }

 private:
  HWY_INLINE void deflect(const Deflection<C>& deflection, L step_fraction, typename Traits::Words word,
                          L wider) {
    t_ = t_ + step_fraction;
    const P step = length_ * step_fraction;
    const C alpha = pitch(deflection);
    L sin_beta, cos_beta;
    random_direction(word, cos_beta, sin_beta);
    const P aside = step * sine_of_small(alpha) * wider;
    along_ = along_ + step * cosine_of_small(alpha);
    across1_ = across1_ + aside * cos_beta;
    across2_ = across2_ + aside * sin_beta;
  }

  HWY_INLINE C pitch(const Deflection<C>& d) const {
    switch (d.law) {
      case PitchLaw::product:
        return d.loss_cone_rad * (d.pitch_step_rad * t_);
      case PitchLaw::increment:
        return d.pitch_step_rad * t_;
      case PitchLaw::constant:
        return d.loss_cone_rad;
      case PitchLaw::reduced:
        break;
    }
    return d.loss_cone_rad - d.pitch_step_rad * (L(1.0f) - t_);
  }

  P length_, along_, across1_, across2_;
  L t_;
  L first_step_;  ///< first step as a fraction of an even step; 1 from then on
  L left_;
  PlaceInTube<L> in_tube_;
  typename Traits::PathWords random_;
  typename Traits::Words ahead_[4];
  std::uint32_t quad_;
};

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
