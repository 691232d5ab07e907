// The colour of a continuous spectrum in a scene's sensor.
#pragma once

#include <functional>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {

/// Spectral radiance in W m^-2 sr^-1 nm^-1 as a function of wavelength in nm.
using Spectrum = std::function<double(double wavelength_nm)>;

/// Returns linear, signed RGB at the scene's gain: the sum of the colours of single wavelengths
/// (sim/view/colour/line_colours.h) over 380 to 780 nm, in steps of 5 nm.
Vector3 colour_of_continuum(const Scene& scene, const Spectrum& radiance);

/// Returns the luminance in cd m^-2, summed over the same wavelengths.
double luminance_of_continuum(const Spectrum& radiance);

/// Returns the spectrum of a black body, normalised to 1 at 560 nm.
Spectrum black_body(double temperature_k);

}  // namespace vegard::sim
