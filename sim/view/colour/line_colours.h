// The colours of emission lines and of continuous spectra in a scene's sensor.
#pragma once

#include <functional>
#include <vector>

#include "sim/view/colour/colour.h"

namespace vegard::sim {

struct Scene;

/// Returns the linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm: the scene's number, or
/// for the exposure "camera" the value from the electrons of a green pixel (sim/view/colour/radiometry.h).
double gain_per_kilorayleigh(const Scene& scene);

/// Returns the luminance in cd m^-2 of a linear sensor value of 1 in every channel, by that scale.
double white_luminance_cd_m2(const Scene& scene);

/// Returns linear, signed RGB per kilorayleigh of every line of the scene, at a gain_per_kilorayleigh of 1.
std::vector<Vector3> line_colours_at_unit_gain(const Scene& scene);

/// Returns linear, signed RGB per kilorayleigh of light of any one wavelength, at the scene's gain.
Vector3 line_colour(const Scene& scene, double wavelength_nm);

/// Returns linear, signed RGB per kilorayleigh of every line of the scene, at the scene's gain.
std::vector<Vector3> line_colours(const Scene& scene);

/// Returns the matrix from the sensor's raw channels, all on one scale, to the linear RGB of pictures: white
/// balance, then sensor.matrix (docs/optics.md, "Cameras"). The identity for sensor.response = "cie", which
/// has no raw channels.
Matrix3 rgb_from_raw(const Scene& scene);

/// Returns the inverse of rgb_from_raw().
Matrix3 raw_from_rgb(const Scene& scene);

/// Returns the linear raw channels of 1 kR of every line of the scene at a gain_per_kilorayleigh of 1,
/// independent of the exposure.
std::vector<Vector3> raw_lines_at_unit_gain(const Scene& scene);

/// Spectral radiance in W m^-2 sr^-1 nm^-1 as a function of wavelength in nm.
using Spectrum = std::function<double(double wavelength_nm)>;

/// Returns linear, signed RGB at the scene's gain: the sum of the colours of single wavelengths
/// (line_colour()) over 380 to 780 nm, in steps of 5 nm.
Vector3 colour_of_continuum(const Scene& scene, const Spectrum& radiance);

/// Returns the luminance in cd m^-2, summed over the same wavelengths.
double luminance_of_continuum(const Spectrum& radiance);

/// Returns the spectrum of a black body, normalised to 1 at 560 nm.
Spectrum black_body(double temperature_k);

}  // namespace vegard::sim
