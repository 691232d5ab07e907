// The spectra of catalogued stars above the air, from their magnitude and colour alone.
//
//   F(nm) = F5556 10^(-0.4 (V - 0.03)) 10^(0.4 0.07 (B - V)) s(nm, B - V)
//
// F5556 = 3.44e-11 W m^-2 nm^-1 at 555.6 nm is that of Vega, V = 0.03 (Hayes 1985, IAU Symposium 111, 225:
// 1.5 %). The term in B - V corrects for the mean over the band V, which is larger for blue than for red
// stars: the means over Bessell's V (1990, PASP 102, 1181) of an A0 and a K0 spectrum that is 1 at 555.6 nm
// are 1.045 and 0.980. s is the spectrum over that at 555.6 nm. At 427.8, 557.7 and 630.0 nm it is a mean
// over 2.5 nm of the library of Pickles (1998, PASP 110, 863), log-linear in B - V between its types. At
// other wavelengths it is a black body (colour_temperature_k()) times a log-linear factor that gives the
// library's values at these three.
//
// The library's ratios agree with copies of its files within 0.5 %. Bessell's V in steps of 10 nm has means
// of 1.043 and 0.974 for these files. Stars of one colour differ (metallicity, giants and dwarfs, dust):
// star_flux_error() is ESTIMATED from the differences between neighbouring types of the library.
#pragma once

namespace vegard::sim {

/// Valid range of B - V: cooler stars have molecular bands.
inline constexpr double kBluestStar = -0.3, kReddestStar = 1.25;

/// Returns the photons cm^-2 s^-1 nm^-1 of a star of magnitude V and colour index B - V at a wavelength from
/// 400 to 900 nm.
double star_photons_cm2_s_nm(double magnitude, double colour_index, double wavelength_nm);

/// Returns the relative standard uncertainty that all stars have in common and that does not average out: 2 %
/// at 557.7 nm, 3 % at 630.0 and 4 % at 427.8 nm, growing to 10 % away from these, and 12 % beyond them.
double star_flux_error(double wavelength_nm);

}  // namespace vegard::sim
