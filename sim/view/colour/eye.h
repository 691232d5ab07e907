// A picture as a dark-adapted eye sees it: rods, cones, and the loss of colour between them.
//
// Rods: the luminous efficiency V' of the CIE 1951 (data/cie/cie1951_scotopic_5nm.csv) and 1700 lm/W at its
// peak (CIE 18.2-1983), so that a scotopic and a photopic candela are the same at 540 THz. Cones: CIE 1931.
// Between them, Krawczyk, Myszkowski and Seidel 2005, "Perceptual effects in real-time tone mapping",
// doi:10.1145/1090122.1090154, per point of the picture: the rods' share (their equation 7, after Hunt 1995)
// and the blue-grey that represents vision by rods (equation 15). The rods' signal is the scotopic luminance,
// as in Jensen et al. 2000, "Night rendering" (the tone mapping paper only has photopic pictures): hence the
// Purkinje shift, and red light that rods do not see. Acuity, noise and the time of adaptation are left out.
// docs/optics.md, "What the eye sees".
#pragma once

#include <vector>

#include "sim/scene/lines/emission_lines.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {

inline constexpr double kScotopicEfficacy_lm_w = 1700.0;
inline constexpr double kRodHalfLuminance_cd_m2 = 0.04;  ///< at which rods and cones have equal shares

/// Range of mesopic vision: below it only rods see, above it only cones. CIE 191:2010.
inline constexpr double kMesopicFrom_cd_m2 = 0.005, kMesopicTo_cd_m2 = 5.0;

/// Returns V'(lambda): a cubic spline through the 5 nm table, 0 outside 380-780 nm.
double scotopic_efficiency(double wavelength_nm);

/// The signals of light for the two kinds of receptors.
struct EyeLight {
  Vector3 xyz_cd_m2{};          ///< CIE 1931; the second is the luminance
  double scotopic_cd_m2 = 0.0;  ///< of the rods
};

/// Return one rayleigh of light of one wavelength, and of an emission line with all its components.
EyeLight eye_light_per_rayleigh(double wavelength_nm);
EyeLight eye_light_per_rayleigh(const std::vector<LineComponent>& components);

/// Returns light whose spectrum is unknown, such as a picture's: the scotopic luminance is the approximation
/// of Larson, Rushmeier and Piatko 1997, doi:10.1109/2945.646233, Y (1.33 (1 + (Y + Z)/X) - 1.68), at least
/// 0.
EyeLight eye_light_of_colour(const Vector3& xyz_cd_m2);

EyeLight operator+(const EyeLight& a, const EyeLight& b);

/// Returns the share of the rods in vision at a luminance, 0.04 / (0.04 + Y): 1 in the dark, 0 in bright
/// light.
double rod_share(double luminance_cd_m2);

/// Returns the light that looks by day as `light` does by night, in linear, signed sRGB scaled to cd m^-2: (1
/// - s) times the colour of `light` plus s times a blue-grey of its scotopic luminance, s = rod_share(Y). The
/// blue-grey is (1.05, 0.97, 1.27) of the paper, divided by its luminance.
Vector3 seen_linear_srgb(const EyeLight& light);

/// Converts the result of seen_linear_srgb() to a display, 0 to 1: the luminance L becomes L^n / (L^n +
/// L_half^n), the response of receptors (Naka and Rushton 1966; n = 0.73, Hunt 1995), white = 1; colours out
/// of gamut are clipped. The scale is fixed: it does not depend on the picture.
Vector3 displayed_as_seen(const Vector3& seen_cd_m2, double half_cd_m2);

/// The luminance that becomes half of a display's white: about 100 kR of 557.7 nm.
inline constexpr double kSeenHalf_cd_m2 = 0.02;

}  // namespace vegard::sim
