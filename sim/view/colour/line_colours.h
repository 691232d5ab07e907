// The colours of emission lines in a scene's sensor.
#pragma once

#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {

/// Returns the linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm: the scene's number, or
/// for the exposure "camera" the value from the electrons of a green pixel (sim/view/colour/sensor_scale.h).
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

}  // namespace vegard::sim
