// From rayleighs per line to linear RGB.
//
// Source: CIE 15 (1931 2 degree observer, data/cie); Baranoski et al. 2000, section 4.2, equations (5)-(7);
// docs/physics.md row B24. A rayleigh counts photons; colour needs power: each line is weighted by 1 / wavelength.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/base/image.h"

namespace vegard::sim {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;

/// The colour matching functions at a wavelength: cubic splines through the 5 nm table, zero outside 380-780
/// nm.
Vector3 colour_matching(double wavelength_nm);

/// Linear RGB from XYZ for a set of primaries with white D65: "srgb" (IEC 61966-2-1, = BT.709) or "smpte-c"
/// (SMPTE RP 145).
Matrix3 rgb_from_xyz(const std::string& primaries);

/// Linear RGB of light of one wavelength and unit power (in units of the matching functions). Out of gamut:
/// signed.
Vector3 rgb_of_line(double wavelength_nm, const std::string& primaries);

/// RGB per kilorayleigh for every line, scaled so that 1 kR of 557.7 nm has luminance
/// `gain_per_kilorayleigh`.
std::vector<Vector3> rgb_per_kilorayleigh(const std::vector<double>& wavelengths_nm,
                                          const std::string& primaries, double gain_per_kilorayleigh);

/// Linear, signed RGB of an image of rayleighs whose channels are the lines of `weights` in their order.
Image rgb_from_rayleigh(const Image& rayleigh, const std::vector<Vector3>& weights);

}  // namespace vegard::sim
