// One sheet's light by its beams and by the march through its footprint.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sim/render/film.h"
#include "tests/support/exposed.h"

namespace vegard::sim {
namespace {

/// An arc across the view, 250 km off, whose electrons do not stray from their field lines: a footprint knows
/// nothing of how far those do.
Scene arc(std::uint64_t seed) {
  Scene scene;
  scene.seed = seed;
  scene.camera.width = 96;
  scene.camera.height = 128;
  scene.camera.hfov_deg = 36.0;
  scene.camera.elevation_deg = 32.0;
  scene.field.inclination_deg = 76.0;
  scene.field.declination_deg = 9.0;
  Sheet sheet;
  sheet.center_km = {10.0, 240.0};
  sheet.bearing_deg = 82.0;
  sheet.length_km = 420.0;
  sheet.thickness_km = 4.0;
  sheet.width_km = 3.0;
  sheet.beams = 4000;
  sheet.loss_cone_deg = 0.01;
  sheet.pitch_step_rad = 1e-5;
  sheet.top_km = 300.0;
  scene.sheets.push_back(sheet);
  return scene;
}

Scene by_its_footprint(Scene scene) {
  Footprint footprint;
  footprint.source = "sheets";
  footprint.center_km = scene.sheets[0].center_km;
  footprint.size_km = {560.0, 160.0};
  footprint.cell_km = 0.5;
  footprint.energy_kev = scene.sheets[0].energy_kev;
  footprint.top_km = scene.sheets[0].top_km;
  scene.footprints.push_back(footprint);
  scene.march.step_km = 0.5;
  return scene;
}

/// Mean over the columns, [line][row].
std::vector<double> profile(const Scene& scene) {
  const Exposure exposure = tests::exposed(scene);
  std::vector<double> mean(static_cast<std::size_t>(exposure.lines) * exposure.geometry.rows, 0.0);
  for (std::size_t i = 0; i < mean.size(); ++i)
    for (int c = 0; c < exposure.geometry.columns; ++c)
      mean[i] += exposure.rayleigh[i * exposure.geometry.columns + c] / exposure.geometry.columns;
  return mean;
}

// The beams' own noise is what eight seeds leave: their mean has an eighth of their variance, and each of the
// 384 numbers may lie four standard errors off (once in 40 runs by chance, were the seeds not fixed) beside
// the 1 % of the peak that is asked for.
TEST(VolumeAgreement, AFootprintOfASheetHasTheProfileOfItsBeams) {
  constexpr int kSeeds = 8;
  std::vector<std::vector<double>> beams;
  for (int s = 0; s < kSeeds; ++s) beams.push_back(profile(arc(100 + s)));
  const std::vector<double> footprint = profile(by_its_footprint(arc(100)));
  const std::size_t rows = footprint.size() / 3;
  for (std::size_t l = 0; l < 3; ++l) {
    const double peak = *std::max_element(footprint.begin() + l * rows, footprint.begin() + (l + 1) * rows);
    ASSERT_GT(peak, 100.0);
    double total = 0.0, total_of_beams = 0.0;
    for (std::size_t i = l * rows; i < (l + 1) * rows; ++i) {
      double mean = 0.0, square = 0.0;
      for (const auto& one : beams) mean += one[i] / kSeeds;
      for (const auto& one : beams) square += (one[i] - mean) * (one[i] - mean) / (kSeeds - 1);
      EXPECT_NEAR(footprint[i], mean, 0.01 * peak + 4.0 * std::sqrt(square / kSeeds))
          << "line " << l << ", row " << i % rows;
      total += footprint[i];
      total_of_beams += mean;
    }
    EXPECT_NEAR(total, total_of_beams, 0.003 * total_of_beams);
  }
}

}  // namespace
}  // namespace vegard::sim
