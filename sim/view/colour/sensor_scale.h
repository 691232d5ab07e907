// Electrons, digital numbers and linear values of a scene's sensor.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What a pixel's electrons become.
struct SensorScale {
  double white_e = 0.0;       ///< electrons of linear raw value 1, which is the largest digital number
  double saturation_e = 0.0;  ///< the smaller of that and the full well
  double dark_e = 0.0;        ///< mean dark electrons of the exposure
  double read_noise_e = 0.0;
  int largest_dn = 0;
  double black_dn = 0.0;
  double dn_per_electron = 0.0;
};

SensorScale sensor_scale(const Sensor& sensor, const Time& time);

/// Electrons of a green pixel on the axis per kilorayleigh of 557.7 nm, by lens, pixel, time and quantum
/// efficiency.
double green_electrons_per_kilorayleigh(const Sensor& sensor, const Time& time);

}  // namespace vegard::sim
