// Continuous spectra: black bodies and daylight.
//
// Sources: Planck's law with the SI's constants; CIE 15, the daylight components S0, S1, S2 and the formulas
// of their shares (Judd, MacAdam and Wyszecki 1964, doi:10.1364/JOSA.54.001031), data/cie.
#pragma once

namespace vegard::sim {

/// Returns the relative power per wavelength of a black body.
double black_body_power(double wavelength_nm, double temperature_k);

/// Returns the relative power per wavelength of a phase of daylight from 300 to 830 nm, else 0; 100 at 560
/// nm. Temperatures from 4000 to 25000 K; D65 is 6500 K with the second radiation constant of 1964, 6503.6 K
/// now.
double daylight_power(double wavelength_nm, double correlated_temperature_k);

inline constexpr double kD65Temperature_k = 6500.0 * 1.4388 / 1.438;

}  // namespace vegard::sim
