#include "sim/render/brightness_report.h"

#include <algorithm>

#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/eye.h"
#include "sim/view/colour/line_spectrum.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim {
namespace {

EyeReport eye_report(double luminance_cd_m2) {
  constexpr double kEyeLimitRayleigh = 1e3;  // of green light: docs/physics.md, row B21
  EyeReport eye;
  eye.vision = luminance_cd_m2 < kMesopicFrom_cd_m2 ? "scotopic"
               : luminance_cd_m2 > kMesopicTo_cd_m2 ? "photopic"
                                                    : "mesopic";
  eye.cone_share = 1.0 - rod_share(luminance_cd_m2);
  eye.above_eye_limit = luminance_cd_m2 >= kEyeLimitRayleigh * luminance_cd_m2_per_rayleigh(557.7);
  return eye;
}

SpotCounts counts_of(const ExpectedCounts& counts, const std::vector<double>& rayleigh) {
  SpotCounts spot;
  const double room_e = std::max(counts.saturation_e - counts.dark_e, 0.0);
  for (int c = 0; c < 3; ++c) {
    double electrons = 0.0;
    for (std::size_t l = 0; l < rayleigh.size(); ++l)
      electrons += 1e-3 * rayleigh[l] * counts.lines[l].electrons_per_kilorayleigh[c];
    spot.saturated = spot.saturated || electrons > room_e;
    spot.electrons[c] = std::min(electrons, room_e);
    spot.dn[c] = spot.electrons[c] * counts.dn_per_electron;
    spot.signal_to_noise[c] = signal_to_noise(counts, spot.electrons[c]);
  }
  return spot;
}

}  // namespace

BrightnessReport brightness_report(const Scene& scene, const Rendering& rendering) {
  BrightnessReport report;
  report.lines_nm = scene.emission.lines;
  report.exposure_s = scene.time.exposure_s;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    report.sheets.push_back(sheet_brightness(scene, static_cast<int>(s)));
    report.layers.push_back(scene.sheets[s].layers);
  }
  const std::size_t lines = scene.emission.lines.size();
  std::vector<double> luminance;
  for (std::size_t l = 0; l < lines; ++l) {
    std::vector<double> this_one(lines, 0.0);
    this_one[l] = 1.0;
    report.brightest.push_back(brightest_spot(rendering.rayleigh, this_one, scene.camera));
    luminance.push_back(luminance_cd_m2_per_rayleigh(components_of_line(scene, scene.emission.lines[l])));
  }
  report.most_luminous = brightest_spot(rendering.rayleigh, luminance, scene.camera);
  report.eye = eye_report(report.most_luminous.value);
  report.sensor_exposure = word_of(scene.sensor.exposure);
  report.counts = expected_counts(scene);
  report.spot_counts = counts_of(report.counts, report.most_luminous.rayleigh);
  return report;
}

}  // namespace vegard::sim
