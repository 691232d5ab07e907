// The strands of a flux rope ([[ejection]] of kind "rope"). A model of our own: the source only names mass
// ejections.
//
// With the age A = age_s + the instant (before 0: 0), the front stands at the height
//   h = start + (v A + a A² / 2) / unit_km,   v = speed_km_s, a = acceleration_m_s2 / 1000,
// above the photosphere of radius R; for a < 0, A is limited to -v / a, when the front comes to rest. As the
// Sun rotates, the whole rope moves with its place of origin. The rope's axis lies in the plane through the
// Sun's middle, the place of origin, and the bearing; with e from -90° to 90° from foot to foot, its distance
// from the Sun's middle and its angle from the vertical of the place of origin are
//   R - a_f + (H + a_f) cos e,   (width / 2) sin e (1 + c cos e),   c = 0.6 H / (H + R width / 2):
// half an ellipse in height and angle, which bulges above its feet, like a balloon, the more the higher it
// is. Its cross-section is a disc of radius
//   a_f + (a_t - a_f) cos e,   a_t = aspect h,   a_f = 0.3 aspect start,
// so that the anchored legs keep their places and radii; they begin a_f below the photosphere. H = h - a_t,
// so that the front is at h.
//
// Strands fill the disc evenly, the k-th of n at sqrt((k + 1/2) / n) of its radius, separated by the golden
// angle (H. Vogel 1979, Math. Biosciences 44, 179), and wind about the axis by `turns` from foot to foot,
// evenly in e. Their own radius is strand_radius times that of the disc.
//
// Density is the same all along the rope, since plasma can flow along it. Mass is conserved: the density is
// `density` times the ratio of the sum of ∫ radius² dl over the strands at age 0 to that now.
#pragma once

#include "sim/emit/sun/strand/strand.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

/// Returns the height of an ejection's front above the photosphere at an instant of the scene's clock, in
/// units of the Sun's frame.
template <class T>
T front_height(const Sun& sun, double instant_s, const Ejection& ejection, const NumberAs<T>& number);

/// Returns the heliographic longitude of its place of origin at the instant, in degrees.
template <class T>
T ejection_longitude_deg(const Sun& sun, double instant_s, const Ejection& ejection,
                         const NumberAs<T>& number);

/// Returns the strands of a rope. Every winding is cut into pieces, each of which is a strand, since the
/// radius of a strand is linear.
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
