// The brightness and colour of stars in a sensor, above and below the air. docs/optics.md, "Stars".
#pragma once

#include <array>
#include <vector>

#include "sim/view/colour/sensor_response.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {

struct Scene;

/// Returns the photons cm^-2 s^-1 of 557.7 nm that are as bright to the eye as a star of a V magnitude:
/// 1.05e6 at magnitude 0, which is 2.54e-6 lx (Crumey 2014, MNRAS 442, 2600, doi:10.1093/mnras/stu992). AB
/// magnitudes in the eye's own band have 2.58e-6 lx (Bara 2017, arXiv:1710.06755); a star's colour changes it
/// by some hundredths. In the band V itself a star of magnitude 0 has 9.0e5 photons.
double star_photons_cm2_s(double magnitude);

/// Returns the temperature of the black body with a colour index B - V: Ballesteros 2012,
/// doi:10.1209/0295-5075/97/34008.
double colour_temperature_k(double colour_index);

/// Returns linear RGB, in a sensor, of light of luminance 1 from the black body of a colour index.
std::array<double, 3> star_tint(double colour_index, const SensorResponse& response);

/// Returns the linear value, at the scene's gain, of one photon cm^-2 s^-1 sr^-1 with a star_tint() of 1: the
/// scale of star_light(). 1 R = 1e6 / 4 pi photons cm^-2 s^-1 sr^-1.
double luminance_per_photon(const Scene& scene);

/// The transmission of the air for R, G and B in a direction.
class StarExtinction {
 public:
  explicit StarExtinction(const Scene& scene);
  std::array<double, 3> towards(double sine_of_elevation) const;

 private:
  AirAbove air_;
  std::vector<LineDepths<double>> depths_;
};

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

/// Valid range of B - V: cooler stars have molecular bands.
inline constexpr double kBluestStar = -0.3, kReddestStar = 1.25;

/// Returns the photons cm^-2 s^-1 nm^-1 of a star of magnitude V and colour index B - V at a wavelength from
/// 400 to 900 nm.
double star_photons_cm2_s_nm(double magnitude, double colour_index, double wavelength_nm);

/// Returns the relative standard uncertainty that all stars have in common and that does not average out: 2 %
/// at 557.7 nm, 3 % at 630.0 and 4 % at 427.8 nm, growing to 10 % away from these, and 12 % beyond them.
double star_flux_error(double wavelength_nm);

}  // namespace vegard::sim
