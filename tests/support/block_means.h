// Pictures of a sheet without deflections as means over blocks of pixels: by beams, and by the integral along
// lines of sight.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "tests/support/exposed.h"
#include "tests/support/line_of_sight.h"
#include "tests/support/small_scene.h"

namespace vegard::tests {

inline void fall_straight(sim::Sheet& sheet) {
  sheet.loss_cone_deg = 0.0;
  sheet.pitch_law = sim::PitchLaw::constant;
}

/// A smooth sheet without deflections, in front of a small camera.
inline sim::Scene undeflected_scene(int beams) {
  sim::Scene scene = small_scene();
  scene.camera.width = 64;
  scene.camera.height = 48;
  sim::Sheet& sheet = scene.sheets[0];
  sheet.width_km = 6.0;
  sheet.thickness_km = 9.0;
  sheet.wavelength_km = 130.0;
  sheet.beams = beams;
  fall_straight(sheet);
  return scene;
}

inline constexpr int kBlock = 8;

/// Means of blocks of pixels, the border's blocks left out.
inline std::vector<double> blocks_by_lines_of_sight(const sim::Scene& scene, int line) {
  const LineOfSight sight(scene, 1.0);
  std::vector<double> blocks;
  constexpr int kFine = 2;
  for (int by = 1; by + 1 < scene.camera.height / kBlock; ++by) {
    for (int bx = 1; bx + 1 < scene.camera.width / kBlock; ++bx) {
      double sum = 0.0;
      for (int y = 0; y < kBlock * kFine; ++y) {
        for (int x = 0; x < kBlock * kFine; ++x) {
          const sim::Direction d = sim::direction_of_pixel(scene.camera, bx * kBlock + (x + 0.5) / kFine,
                                                           by * kBlock + (y + 0.5) / kFine);
          const double az = d.azimuth_deg * sim::kRadiansPerDegree,
                       el = d.elevation_deg * sim::kRadiansPerDegree;
          const double unit[3] = {std::sin(az) * std::cos(el), std::cos(az) * std::cos(el), std::sin(el)};
          sum += sight.rayleigh(unit, line);
        }
      }
      blocks.push_back(sum / (kBlock * kFine * kBlock * kFine));
    }
  }
  return blocks;
}

inline std::vector<double> blocks_by_beams(const sim::Scene& scene, int line, int pixels_per_pixel = 1) {
  sim::Scene finer = scene;
  finer.camera.width *= pixels_per_pixel;
  finer.camera.height *= pixels_per_pixel;
  const sim::FilmGeometry film = whole_picture(finer);
  const sim::Exposure exposure = exposed(finer, film);
  const int block = kBlock * pixels_per_pixel;
  std::vector<double> blocks;
  for (int by = 1; by + 1 < scene.camera.height / kBlock; ++by)
    for (int bx = 1; bx + 1 < scene.camera.width / kBlock; ++bx) {
      double sum = 0.0;
      for (int y = by * block; y < (by + 1) * block; ++y)
        for (int x = bx * block; x < (bx + 1) * block; ++x)
          sum += exposure.rayleigh[(static_cast<std::size_t>(line) * film.rows + y) * film.columns + x];
      blocks.push_back(sum / (block * block));
    }
  return blocks;
}

/// The root mean square of the difference, relative to the truth's.
inline double relative_rms(const std::vector<double>& a, const std::vector<double>& truth) {
  double difference = 0.0, square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - truth[i]) * (a[i] - truth[i]);
    square += truth[i] * truth[i];
  }
  return std::sqrt(difference / square);
}

/// The scatter of several pictures of the same, root mean square relative to the truth's.
inline double relative_scatter(const std::vector<std::vector<double>>& pictures,
                               const std::vector<double>& truth) {
  double variance = 0.0, square = 0.0;
  const auto n = static_cast<double>(pictures.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    double mean = 0.0;
    for (const auto& picture : pictures) mean += picture[i] / n;
    for (const auto& picture : pictures) variance += (picture[i] - mean) * (picture[i] - mean) / (n - 1.0);
    square += truth[i] * truth[i];
  }
  return std::sqrt(variance / square);
}

}  // namespace vegard::tests
