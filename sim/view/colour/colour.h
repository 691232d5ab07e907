// Conversion of rayleighs per line to linear RGB.
//
// Source: CIE 15 (1931 2 degree observer, data/cie); Baranoski et al. 2000, section 4.2, equations (5)-(7);
// docs/optics.md row B24. A rayleigh is a number of photons, but colour depends on power: each line is
// weighted by 1 / wavelength.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/sensor.h"
#include "sim/view/colour/matrix3.h"

namespace vegard::sim {

enum class Primaries;

/// Returns the colour matching functions at a wavelength: cubic splines through the 5 nm table, zero outside
/// 380-780 nm.
Vector3 colour_matching(double wavelength_nm);

/// Returns the matrix from XYZ to linear RGB, with equal RGB for white D65 (x 0.3127, y 0.3290), for a set of
/// primaries: srgb (IEC 61966-2-1, = ITU-R BT.709), smpte_c (SMPTE RP 145), rec2020 (ITU-R BT.2020), or
/// acescg (AP1, Academy S-2014-004). ACES has its own white, x 0.32168, y 0.33767 (SMPTE ST 2065-1): D65 is
/// adapted to it by the Bradford transform (Lam 1985).
Matrix3 rgb_from_xyz(Primaries primaries);

/// Returns linear RGB of light of one wavelength and unit power (in units of the matching functions);
/// negative components mean out of gamut.
Vector3 rgb_of_line(double wavelength_nm, Primaries primaries);

/// Computes linear, signed RGB of cells [cell][channel] from their rayleighs [cell][line]; `weights` are the
/// colours of the lines per kilorayleigh.
void colour_cells(const float* rayleigh, std::size_t cells, const std::vector<Vector3>& weights, float* rgb);

/// The same for an image of rayleighs whose channels are the lines of `weights` in their order.
Image rgb_from_rayleigh(const Image& rayleigh, const std::vector<Vector3>& weights);

// Continuous spectra: black bodies and daylight.
//
// Sources: Planck's law with the SI's constants; CIE 15, the daylight components S0, S1, S2 and the formulas
// of their shares (Judd, MacAdam and Wyszecki 1964, doi:10.1364/JOSA.54.001031), data/cie.

/// Returns the relative power per wavelength of a black body.
double black_body_power(double wavelength_nm, double temperature_k);

/// Returns the relative power per wavelength of a phase of daylight from 300 to 830 nm, else 0; 100 at 560
/// nm. Temperatures from 4000 to 25000 K; D65 is 6500 K with the second radiation constant of 1964, 6503.6 K
/// now.
double daylight_power(double wavelength_nm, double correlated_temperature_k);

inline constexpr double kD65Temperature_k = 6500.0 * 1.4388 / 1.438;

}  // namespace vegard::sim
