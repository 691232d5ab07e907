#include "sim/view/colour/sensor_scale.h"

#include <algorithm>

#include "sim/view/colour/radiometry.h"

namespace vegard::sim {

SensorScale sensor_scale(const Sensor& sensor, const Time& time) {
  SensorScale scale;
  scale.white_e = sensor.full_well_e * sensor.base_iso / sensor.iso;
  // Below the base ISO a pixel is full before its number is.
  scale.saturation_e = std::min(scale.white_e, sensor.full_well_e);
  scale.dark_e = sensor.dark_e_s * time.exposure_s;
  scale.read_noise_e = sensor.read_noise_e;
  scale.largest_dn = (1 << sensor.bits) - 1;
  scale.black_dn = sensor.black_level * scale.largest_dn;
  scale.dn_per_electron = (scale.largest_dn - scale.black_dn) / scale.white_e;
  return scale;
}

double green_electrons_per_kilorayleigh(const Sensor& sensor, const Time& time) {
  const Optics optics{sensor.f_number, sensor.lens_transmission, sensor.pixel_um};
  return 1e3 * pixel_photons_s_per_rayleigh(optics) * time.exposure_s * sensor.quantum_efficiency;
}

}  // namespace vegard::sim
