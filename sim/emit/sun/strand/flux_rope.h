// The strands of a flux rope ([[ejection]] of kind "rope"). A model of our own: the source only names mass
// ejections.
//
// With the age A = age_s + the instant (before 0: 0), the front stands at the height
//   h = start + (v A + a A² / 2) / unit_km,   v = speed_km_s, a = acceleration_m_s2 / 1000,
// over the photosphere, radius R; of a < 0, A is at most -v / a, when it comes to rest. As the Sun turns, the
// whole of it goes with the place that it leaves. The rope's axis lies in the plane through the Sun's middle,
// the place that the rope leaves, and the bearing; with e from -90° to 90° from foot to foot, its distance
// from the Sun's middle and its angle from the vertical of that place are
//   R - a_f + (H + a_f) cos e,   (width / 2) sin e (1 + c cos e),   c = 0.6 H / (H + R width / 2):
// half an ellipse in height and angle, which bulges above its feet the more, the higher it stands, as a
// balloon does. Its cross-section is a disc of radius
//   a_f + (a_t - a_f) cos e,   a_t = aspect h,   a_f = 0.3 aspect start,
// so that legs, anchored, stay where and as thin as they are; they begin a_f below the photosphere. H = h -
// a_t, so that the front is at h.
//
// Strands fill the disc evenly, the k-th of n at sqrt((k + 1/2) / n) of its radius, golden angles apart
// (H. Vogel 1979, Math. Biosciences 44, 179), and wind about the axis by `turns` from foot to foot, evenly in
// e. Their own radius is strand_radius of the disc's.
//
// Density is the same all along the rope: its plasma is free to flow along it. Mass is kept: density is
// `density` times (sum of ∫ radius² dl over the strands at age 0) over the same now.
#pragma once

#include "sim/emit/sun/strand/strand.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Height of an ejection's front over the photosphere at an instant of the scene's clock, in units of the
/// Sun's frame.
template <class T>
T front_height(const Sun& sun, double instant_s, const Ejection& ejection, const NumberAs<T>& number);

/// Heliographic longitude of the place that it leaves, in degrees, at the instant.
template <class T>
T ejection_longitude_deg(const Sun& sun, double instant_s, const Ejection& ejection,
                         const NumberAs<T>& number);

/// Every winding is cut into pieces, each a strand of its own, since a strand's radius is linear.
template <class T>
Strands<T> rope_strands(const Sun& sun, double instant_s, const Ejection& ejection,
                        const NumberAs<T>& number);

extern template double front_height(const Sun&, double, const Ejection&, const NumberAs<double>&);
extern template FreeDual front_height(const Sun&, double, const Ejection&, const NumberAs<FreeDual>&);
extern template double ejection_longitude_deg(const Sun&, double, const Ejection&, const NumberAs<double>&);
extern template FreeDual ejection_longitude_deg(const Sun&, double, const Ejection&,
                                                const NumberAs<FreeDual>&);
extern template Strands<double> rope_strands(const Sun&, double, const Ejection&, const NumberAs<double>&);
extern template Strands<FreeDual> rope_strands(const Sun&, double, const Ejection&,
                                               const NumberAs<FreeDual>&);

}  // namespace vegard::sim
