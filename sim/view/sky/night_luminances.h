// Familiar luminances and astronomical magnitudes, to compare an aurora with.
#pragma once

#include <cmath>

namespace vegard::sim {

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
