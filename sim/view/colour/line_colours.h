// What a scene's sensor makes of each of its emission lines.
#pragma once

#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {

/// Linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm: the scene's number, or of the
/// exposure "camera" that which gives a green pixel its electrons (sim/view/colour/sensor_scale.h).
double gain_per_kilorayleigh(const Scene& scene);

/// cd m^-2 of a linear sensor value of 1 in every channel, by that scale.
double white_luminance_cd_m2(const Scene& scene);

/// Linear, signed RGB per kilorayleigh of every line of the scene, at a gain_per_kilorayleigh of 1.
std::vector<Vector3> line_colours_at_unit_gain(const Scene& scene);

/// The same of light of any one wavelength, at the scene's own gain.
Vector3 line_colour(const Scene& scene, double wavelength_nm);

/// Those of the scene's lines at its own gain.
std::vector<Vector3> line_colours(const Scene& scene);

/// The 3 x 3 that leads from the sensor's raw channels, all on one scale, to the linear RGB of pictures:
/// white balance, then the matrix (docs/optics.md, "Cameras"). The identity for sensor.response = "cie",
/// which has no raw channels of its own.
Matrix3 rgb_from_raw(const Scene& scene);

/// Its inverse.
Matrix3 raw_from_rgb(const Scene& scene);

/// Linear raw channels of 1 kR of every line of the scene at a gain_per_kilorayleigh of 1. The exposure does
/// not enter.
std::vector<Vector3> raw_lines_at_unit_gain(const Scene& scene);

}  // namespace vegard::sim
