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

#include "sim/base/dual-inl.h"
#include "sim/base/lanes-inl.h"
#include "sim/light/sample.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// A deflection point of a group of beams. L is the lane type, P a position: L or a dual number over L.
template <class L, class P>
struct FallenPoint {
  P position_in_enu_km[3];
  P stretch_km;  ///< of the path that the point stands for
  L t;           ///< along the path, 0 to 1
};

/// Beams on their way down. C is the type of what all beams share.
template <class L, class P, class C>
class FallingBeams {
 public:
  using Traits = LaneTraits<L>;
  using Indices = typename Traits::Indices;

  HWY_INLINE void start(const P start_in_enu_km[3], const P& length_km, Indices beams, std::uint32_t layer,
                        const PhiloxKeys& keys) {
    for (int i = 0; i < 3; ++i) start_[i] = start_in_enu_km[i];
    length_ = length_km;
    beams_ = beams;
    layer_ = layer;
    t_ = L(0.0f);
    axial_ = across1_ = across2_ = P(L(0.0f));
    pair_ = 0;
    Traits::uniforms(beams_, 0, layer_, keys, ahead_);
  }

  /// The next two deflection points.
  HWY_INLINE void next_two(const FallFrame<C>& frame, const Deflection<C>& deflection, const PhiloxKeys& keys,
                           FallenPoint<L, P> out[2]) {
    L now[4];
    for (int i = 0; i < 4; ++i) now[i] = ahead_[i];
    ++pair_;
    Traits::uniforms(beams_, pair_, layer_, keys, ahead_);
    deflect(frame, deflection, now[0], now[1], now[2], out[0]);
    deflect(frame, deflection, now[2], now[3], ahead_[0], out[1]);
  }

 private:
  HWY_INLINE void deflect(const FallFrame<C>& frame, const Deflection<C>& deflection, L nu, L mu, L next_nu,
                          FallenPoint<L, P>& out) {
    const L step_fraction = nu * L(static_cast<float>(deflection.path_step));
    t_ = t_ + step_fraction;
    const P step = length_ * step_fraction;
    const C alpha = pitch(deflection);
    L sin_beta, cos_beta;
    sine_cosine_of_turns(mu, sin_beta, cos_beta);
    const P aside = step * sine_of_small(alpha);
    axial_ = axial_ + step * cosine_of_small(alpha);
    across1_ = across1_ + aside * cos_beta;
    across2_ = across2_ + aside * sin_beta;
    for (int i = 0; i < 3; ++i)
      out.position_in_enu_km[i] =
          start_[i] + axial_ * frame.along[i] + across1_ * frame.across1[i] + across2_ * frame.across2[i];
    out.stretch_km = length_ * ((nu + next_nu) * L(static_cast<float>(0.5 * deflection.path_step)));
    out.t = t_;
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

  P start_[3], length_, axial_, across1_, across2_;
  L t_, ahead_[4];
  Indices beams_;
  std::uint32_t layer_, pair_;
};

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
