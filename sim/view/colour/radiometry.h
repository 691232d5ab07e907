// Conversion of rayleighs to radiance, luminance and photons on a pixel.
//
// Sources: Hunten, Roach and Chamberlain 1956, J. Atmos. Terr. Phys. 8, 345 (a rayleigh is an apparent
// emission of 10^6 photons cm^-2 s^-1 of column, so a radiance of 10^10 / 4 pi photons m^-2 s^-1 sr^-1); the
// luminous efficacy of the SI, 683 lm/W at 540 THz, and the camera equation E = pi L T / (4 N^2) of an object
// far away on the axis.
#pragma once

namespace vegard::sim {

inline constexpr double kPhotonsPerRayleigh_m2_s_sr = 1e10 / (4.0 * 3.14159265358979323846);
inline constexpr double kPlanckTimesLight_j_m = 6.62607015e-34 * 299792458.0;
inline constexpr double kLuminousEfficacy_lm_w = 683.002;  ///< of the CIE 1931 observer's peak

/// Returns the radiance of one rayleigh at a wavelength in W m^-2 sr^-1.
double radiance_w_m2_sr_per_rayleigh(double wavelength_nm);

/// Returns the luminance of one rayleigh at a wavelength in cd m^-2, for the CIE 1931 observer.
double luminance_cd_m2_per_rayleigh(double wavelength_nm);

/// The same for one rayleigh of an emission line with all its components.
double line_luminance_cd_m2_per_rayleigh(double line_nm);

/// A lens and the pixels of the sensor.
struct Optics {
  double f_number = 1.4;      ///< N
  double transmission = 0.9;  ///< T of the lens
  double pixel_um = 6.0;      ///< edge of a square pixel
};

/// Returns the photons on a pixel per second and rayleigh, on the axis: 10^10 / 4 pi times pi / (4 N^2) T
/// p^2.
double pixel_photons_s_per_rayleigh(const Optics& optics);

}  // namespace vegard::sim
