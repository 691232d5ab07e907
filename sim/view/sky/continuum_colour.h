// What a scene's sensor makes of a continuous spectrum.
#pragma once

#include <functional>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {

/// Radiance by wavelength in nm, W m^-2 sr^-1 nm^-1.
using Spectrum = std::function<double(double wavelength_nm)>;

/// Linear, signed RGB at the scene's gain: the sum over 380 to 780 nm of what the sensor makes of each
/// wavelength (sim/view/colour/line_colours.h), in steps of 5 nm.
Vector3 colour_of_continuum(const Scene& scene, const Spectrum& radiance);

/// cd m^-2, over the same wavelengths.
double luminance_of_continuum(const Spectrum& radiance);

/// The shape of a black body's spectrum, 1 at 560 nm.
Spectrum black_body(double temperature_k);

}  // namespace vegard::sim
