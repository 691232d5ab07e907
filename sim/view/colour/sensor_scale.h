// The relation of electrons, digital numbers and linear values of a scene's sensor.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The conversion of a pixel's electrons.
struct SensorScale {
  double white_e = 0.0;       ///< electrons of the linear raw value 1 = the largest digital number
  double saturation_e = 0.0;  ///< the smaller of white_e and the full well
  double dark_e = 0.0;        ///< mean dark electrons of the exposure
  double read_noise_e = 0.0;
  int largest_dn = 0;
  double black_dn = 0.0;
  double dn_per_electron = 0.0;
};

SensorScale sensor_scale(const Sensor& sensor, const Time& time);

/// Returns the electrons of a green pixel on the axis per kilorayleigh of 557.7 nm, from lens, pixel, time
/// and quantum efficiency.
double green_electrons_per_kilorayleigh(const Sensor& sensor, const Time& time);

}  // namespace vegard::sim
