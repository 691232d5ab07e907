#include "sim/view/sensor/expected_counts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim {
namespace {

/// Returns the angle between the axis and the farthest corner of the picture; a fisheye's counts as 90
/// degrees at most.
double corner_angle(const Camera& camera) {
  const Lens<double> lens = camera_view(camera).lens;
  double least = 1.0;
  for (const double x_px : {0.0, static_cast<double>(camera.width)})
    for (const double y_px : {0.0, static_cast<double>(camera.height)}) {
      double in_camera[3] = {0.0, 0.0, 0.0};
      unproject(lens, x_px, y_px, in_camera);
      least = std::min(least, std::max(in_camera[2], 0.0));
    }
  return std::acos(least);
}

/// Returns half the width of a range as a relative standard uncertainty.
double relative_sigma(double low, double high) { return (high - low) / (std::sqrt(3.0) * (high + low)); }

void add_calibrated(const Sensor& sensor, std::vector<UncertaintyPart>& parts) {
  parts.push_back(
      {"calibration", sensor.calibration_error,
       "sensor.calibration_error; for the order: certified sources agree within 2 % (Sigernes et al. "
       "2014, doi:10.5194/gi-3-241-2014), field and darkroom calibrations within about 10 % (Jackel "
       "et al. 2016, doi:10.5194/gi-5-493-2016)"});
}

void add_by_the_data_sheet(std::vector<UncertaintyPart>& parts) {
  parts.push_back({"lens transmission", relative_sigma(0.75, 0.95),
                   "0.75 to 0.95 taken for all lenses; a measured 85 mm f/1.4 is T/1.6, or 0.77 (DxOMark)"});
  parts.push_back({"quantum efficiency", relative_sigma(0.35, 0.60),
                   "estimated: 0.35 to 0.60 for a green pixel of today's sensors, filters included"});
  parts.push_back({"ISO", relative_sigma(std::exp2(-0.5), std::exp2(0.5)),
                   "half a stop either way: ISO 12232 leaves makers the choice, and DxOMark's measurements "
                   "differ from their figures by a fifth to a half of a stop and more"});
}

void add_around_the_camera(const Scene& scene, std::vector<UncertaintyPart>& parts) {
  const Sensor& sensor = scene.sensor;
  const bool corrected =
      sensor.vignetting_cos_power > 0.0 || sensor.vignetting != std::array<double, 3>{0.0, 0.0, 0.0};
  const double corner = std::pow(std::cos(corner_angle(scene.camera)), 4.0);
  if (corrected)
    parts.push_back({"vignetting", 0.02, "estimated, of a correction; nothing on the axis"});
  else
    parts.push_back({"vignetting", relative_sigma(corner, 1.0),
                     "uncorrected, from 1 on the axis to cos^4 in the corners; nothing on the axis"});
  constexpr double kLowest = 5.0, kMagnitudesPerAirmass = 0.05;
  const double elevation = std::max(std::abs(scene.camera.elevation_deg), kLowest) * kPi / 180.0;
  parts.push_back({"air", kMagnitudesPerAirmass / std::sin(elevation) * 0.4 * std::log(10.0),
                   "estimated: 0.05 magnitudes per airmass from night to night at the picture's middle, for "
                   "rayleighs above the air; Jackel et al. 2016 find the air to be the largest part"});
}

}  // namespace

ExpectedCounts expected_counts(const Scene& scene) {
  const SensorScale scale = sensor_scale(scene.sensor, scene.time);
  ExpectedCounts counts;
  counts.white_e = scale.white_e;
  counts.saturation_e = scale.saturation_e;
  counts.dn_per_electron = scale.dn_per_electron;
  counts.black_dn = scale.black_dn;
  counts.dark_e = scale.dark_e;
  counts.read_noise_e = scale.read_noise_e;
  counts.quantisation_e = 1.0 / (std::sqrt(12.0) * scale.dn_per_electron);

  const double gain = gain_per_kilorayleigh(scene);
  const std::vector<Vector3> raw_of_line = raw_lines_at_unit_gain(scene);
  for (std::size_t l = 0; l < raw_of_line.size(); ++l) {
    LineCounts line;
    line.wavelength_nm = scene.emission.lines[l];
    const Vector3& raw = raw_of_line[l];
    double most = 0.0;
    for (int c = 0; c < 3; ++c) {
      line.electrons_per_kilorayleigh[c] = std::max(raw[c], 0.0) * gain * scale.white_e;
      line.dn_per_kilorayleigh[c] = line.electrons_per_kilorayleigh[c] * scale.dn_per_electron;
      most = std::max(most, line.electrons_per_kilorayleigh[c]);
    }
    const double room_e = std::max(scale.saturation_e - scale.dark_e, 0.0);
    line.saturation_kilorayleigh = most > 0.0 ? room_e / most : std::numeric_limits<double>::infinity();
    counts.lines.push_back(line);
  }

  const bool calibrated = scene.sensor.calibration_error > 0.0;
  if (calibrated)
    add_calibrated(scene.sensor, counts.parts);
  else if (scene.sensor.exposure == ExposureRule::camera)
    add_by_the_data_sheet(counts.parts);
  add_around_the_camera(scene, counts.parts);
  if (calibrated || scene.sensor.exposure == ExposureRule::camera) {
    double squares = 0.0;
    for (const UncertaintyPart& part : counts.parts) squares += part.relative * part.relative;
    counts.relative_uncertainty = std::sqrt(squares);
  }
  return counts;
}

double signal_to_noise(const ExpectedCounts& counts, double electrons) {
  const double variance = electrons + counts.dark_e + counts.read_noise_e * counts.read_noise_e +
                          counts.quantisation_e * counts.quantisation_e;
  return variance > 0.0 ? electrons / std::sqrt(variance) : 0.0;
}

}  // namespace vegard::sim
