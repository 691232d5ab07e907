// Conversion of rayleighs to radiance, luminance, photons on a pixel, and the electrons and digital numbers
// of a sensor; familiar luminances to compare an aurora with.
//
// Sources: Hunten, Roach and Chamberlain 1956, J. Atmos. Terr. Phys. 8, 345 (a rayleigh is an apparent
// emission of 10^6 photons cm^-2 s^-1 of column, so a radiance of 10^10 / 4 pi photons m^-2 s^-1 sr^-1); the
// luminous efficacy of the SI, 683 lm/W at 540 THz, and the camera equation E = pi L T / (4 N^2) of an object
// far away on the axis.
#pragma once

#include <cmath>
#include <vector>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {

struct Sensor;
struct Time;

inline constexpr double kPhotonsPerRayleigh_m2_s_sr = 1e10 / (4.0 * 3.14159265358979323846);
inline constexpr double kPlanckTimesLight_j_m = 6.62607015e-34 * 299792458.0;
inline constexpr double kLuminousEfficacy_lm_w = 683.002;  ///< of the CIE 1931 observer's peak

/// Returns the radiance of one rayleigh at a wavelength in W m^-2 sr^-1.
double radiance_w_m2_sr_per_rayleigh(double wavelength_nm);

/// Returns the luminance of one rayleigh at a wavelength in cd m^-2, for the CIE 1931 observer.
double luminance_cd_m2_per_rayleigh(double wavelength_nm);

/// The same for one rayleigh of a line with all its components.
double luminance_cd_m2_per_rayleigh(const std::vector<LineComponent>& components);

/// A lens and the pixels of the sensor.
struct Optics {
  double f_number = 1.4;      ///< N
  double transmission = 0.9;  ///< T of the lens
  double pixel_um = 6.0;      ///< edge of a square pixel
};

/// Returns the photons on a pixel per second and rayleigh, on the axis: 10^10 / 4 pi times pi / (4 N^2) T
/// p^2.
double pixel_photons_s_per_rayleigh(const Optics& optics);

/// The relation of electrons, digital numbers and linear values of a scene's sensor.
struct SensorScale {
  double white_e = 0.0;       ///< electrons of the linear raw value 1 = the largest digital number
  double saturation_e = 0.0;  ///< the smaller of white_e and the full well
  double dark_e = 0.0;        ///< mean dark electrons of the exposure
  double read_noise_e = 0.0;
  int largest_dn = 0;
  double black_dn = 0.0;
  double dn_per_electron = 0.0;
};

SensorScale sensor_scale(const Sensor& sensor, const Time& time);

/// Returns the electrons of a green pixel on the axis per kilorayleigh of 557.7 nm, from lens, pixel, time
/// and quantum efficiency.
double green_electrons_per_kilorayleigh(const Sensor& sensor, const Time& time);

/// Luminance of the darkest natural sky at the zenith without Moon, aurora and cities: Falchi et al. 2016,
/// doi:10.1126/sciadv.1600377.
inline constexpr double kNaturalSky_cd_m2 = 174e-6;

/// Illuminance of the ground under a typical full Moon, 0.05 to 0.1 lx at high latitudes: Kyba, Mohar and
/// Posch 2017, doi:10.1093/astrogeo/atx025.
inline constexpr double kFullMoon_lx = 0.1;

/// Luminance of a perfectly white, matt surface under that Moon: illuminance over pi. Snow is nearly as
/// bright.
inline constexpr double kMoonlitWhite_cd_m2 = kFullMoon_lx / 3.14159265358979323846;

/// Converts a luminance to AB magnitudes per square arcsecond in the band V(lambda): 109600 cd m^-2 is
/// magnitude 0 (Bara 2017, arXiv:1710.06755). Johnson's V differs by some tenths, depending on the spectrum.
inline double magnitudes_per_square_arcsecond(double cd_m2) { return -2.5 * std::log10(cd_m2 / 109600.0); }

}  // namespace vegard::sim
