// What a dark-adapted eye sees: rods, cones, and how colour fades between them.
//
// Rods: the luminous efficiency V' of the CIE 1951 (data/cie/cie1951_scotopic_5nm.csv) and 1700 lm/W at its
// peak (CIE 18.2-1983), so that a scotopic and a photopic candela are the same at 540 THz. Cones: CIE 1931.
// Between them, Krawczyk, Myszkowski and Seidel 2005, "Perceptual effects in real-time tone mapping",
// doi:10.1145/1090122.1090154, per point of the picture: the rods' share (their equation 7, after Hunt 1995)
// and the blue-grey that vision by rods is shown in (equation 15). What the rods see is the scotopic
// luminance, as in Jensen et al. 2000, "Night rendering" (the tone mapping paper has photopic pictures only):
// hence the Purkinje shift, and red light that rods do not see. Nothing of acuity, noise or the time that
// adaptation takes is in it. docs/optics.md, "What the eye sees".
#pragma once

#include "sim/view/colour/colour.h"

namespace vegard::sim {

inline constexpr double kScotopicEfficacy_lm_w = 1700.0;
inline constexpr double kRodHalfLuminance_cd_m2 = 0.04;  ///< at which rods and cones share alike

/// Where vision is mesopic: below it rods alone see, above it cones alone. CIE 191:2010.
inline constexpr double kMesopicFrom_cd_m2 = 0.005, kMesopicTo_cd_m2 = 5.0;

/// V'(lambda): cubic spline through the 5 nm table, 0 outside 380-780 nm.
double scotopic_efficiency(double wavelength_nm);

/// Light as the two kinds of receptors take it.
struct EyeLight {
  Vector3 xyz_cd_m2{};          ///< CIE 1931; the second is the luminance
  double scotopic_cd_m2 = 0.0;  ///< of the rods
};

/// One rayleigh of light of one wavelength, and of an emission line with all its components.
EyeLight eye_light_per_rayleigh(double wavelength_nm);
EyeLight line_eye_light_per_rayleigh(double line_nm);

/// Light whose spectrum is not known, such as a picture's: its scotopic luminance by the approximation of
/// Larson, Rushmeier and Piatko 1997, doi:10.1109/2945.646233, Y (1.33 (1 + (Y + Z)/X) - 1.68), at least 0.
EyeLight eye_light_of_colour(const Vector3& xyz_cd_m2);

EyeLight operator+(const EyeLight& a, const EyeLight& b);

/// Share of the rods in what is seen at a luminance, 0.04 / (0.04 + Y): 1 in the dark, 0 in bright light.
double rod_share(double luminance_cd_m2);

/// Linear sRGB, in cd m^-2 of its luminance and signed, of the light that looks by day as this one does by
/// night: (1 - s) times its colour and s times blue-grey of its scotopic luminance, s = rod_share(Y). The
/// blue-grey (1.05, 0.97, 1.27) of the paper is divided by its own luminance.
Vector3 seen_linear_srgb(const EyeLight& light);

/// The same on a display, 0 to 1: its luminance L becomes L^n / (L^n + L_half^n), the response of receptors
/// (Naka and Rushton 1966; n = 0.73, Hunt 1995), white = 1; then what is out of gamut is clipped. The scale
/// is fixed: it does not follow the picture.
Vector3 displayed_as_seen(const Vector3& seen_cd_m2, double half_cd_m2);

/// Half of a display's white: about 100 kR of 557.7 nm.
inline constexpr double kSeenHalf_cd_m2 = 0.02;

}  // namespace vegard::sim
