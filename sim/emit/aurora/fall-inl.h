// Beams falling: the deflection points of sixteen beams, step by step.
//
// Source: Baranoski et al. 2000, section 3.2, equations (3) and (4); rows B12-B16 of docs/physics.md. A step
// of length L d_t nu along the field is turned by the pitch angle alpha and the azimuth beta. A point stands
// for the stretch from half-way to its neighbours (the trapezium rule on the random nodes), which leaves the
// light of a beam unbiased.
#if defined(VEGARD_SIM_EMIT_AURORA_FALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_EMIT_AURORA_FALL_INL_H_
#undef VEGARD_SIM_EMIT_AURORA_FALL_INL_H_
#else
#define VEGARD_SIM_EMIT_AURORA_FALL_INL_H_
#endif

#include "sim/base/number/dual-inl.h"
#include "sim/base/number/lanes-inl.h"
#include "sim/light/sample.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// A deflection point of a group of beams, in the beams' own frame (FallFrame) from where they start. L is
/// the lane type, P a position: L or a dual number over L.
template <class L, class P>
struct FallenPoint {
  P along_km, across1_km, across2_km;
  L stretch;  ///< of the path that the point stands for, as a fraction of it
  L t;        ///< along the path, 0 to 1
};

/// Beams on their way down. C is the type of what all beams share.
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
  }

  /// The next four deflection points, one after the other to `take(i, point)`, i from 0 to 3.
  template <class Take>
  HWY_INLINE void next_four(const Deflection<C>& deflection, const PhiloxKeys& keys, const Take& take) {
    typename Traits::Words now[4];
    for (int i = 0; i < 4; ++i) now[i] = ahead_[i];
    ++quad_;
    random_.draw(quad_, keys, ahead_);
    const L path_step(static_cast<float>(deflection.path_step));
    L step = upper_uniform(now[0]) * path_step;
    for (int i = 0; i < 4; ++i) {
      const L next_step = upper_uniform(i < 3 ? now[i + 1] : ahead_[0]) * path_step;
      deflect(deflection, step, now[i]);
      take(i, FallenPoint<L, P>{along_, across1_, across2_, (step + next_step) * L(0.5f), t_});
      step = next_step;
    }
  }

 private:
  HWY_INLINE void deflect(const Deflection<C>& deflection, L step_fraction, typename Traits::Words word) {
    t_ = t_ + step_fraction;
    const P step = length_ * step_fraction;
    const C alpha = pitch(deflection);
    L sin_beta, cos_beta;
    random_direction(word, cos_beta, sin_beta);
    const P aside = step * sine_of_small(alpha);
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
  typename Traits::PathWords random_;
  typename Traits::Words ahead_[4];
  std::uint32_t quad_;
};

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
