// Star fields of the table under cameras drawn at random, of which a recognition is told nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "fit/photo/pointing/blind/star_recognition.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "tests/support/star_field.h"

namespace vegard::tests {

struct BlindField {
  fit::SkyCamera truth;  ///< under the axes of equatorial_sky()
  fit::Frame frame;
  double fov_deg = 0.0;  ///< across the longer side
  int stars = 0;         ///< that are among the points
  std::vector<fit::FoundStar> points;
};

/// The field of this number: 20 to 180 degrees across (evenly in the logarithm), 10 to 200 stars (the
/// brightest in view, each tenth left out), three false points for seven stars, strewn over the frame and as
/// bright as stars are; pinholes to 110 degrees, equidistant, equisolid and stereographic lenses; mirrored or
/// not; any rotation; the centre up to 2 % of the frame off its middle; places known to `noise_px`,
/// brightness to 0.3 magnitudes. Fields with fewer than ten stars of the table in view are drawn again.
inline BlindField blind_field(std::uint64_t seed, std::uint32_t number, double noise_px = 0.5) {
  for (std::uint32_t again = 0;; ++again) {
    const sim::Words a = sim::random_words(seed, sim::Stream::stars, number, again, 1);
    const sim::Words b = sim::random_words(seed, sim::Stream::stars, number, again, 2);
    const sim::Words c = sim::random_words(seed, sim::Stream::stars, number, again, 3);
    BlindField field;
    const sim::LensModel models[] = {sim::LensModel::pinhole, sim::LensModel::equidistant,
                                     sim::LensModel::equisolid, sim::LensModel::stereographic};
    // The same for every drawing of a number, else the sky would choose among them.
    const sim::Words fixed = sim::random_words(seed, sim::Stream::stars, number, 0, 4);
    field.truth.model = models[number % 4];
    const double most = field.truth.model == sim::LensModel::pinhole ? 110.0 : 180.0;
    field.fov_deg = 20.0 * std::pow(most / 20.0, sim::uniform(fixed[0]));
    const double heights[] = {1.0, 2.0 / 3.0, 0.75, 0.5625};
    field.frame = {1200, static_cast<int>(1200 * heights[fixed[1] % 4]), true};
    // Of a narrow field that has no ten stars of the table at any pointing: as high as wide.
    if (field.fov_deg < 30.0) field.frame.height_px = 1200;
    const auto wanted = static_cast<int>(10.0 * std::pow(20.0, sim::uniform(fixed[2])));
    field.truth.mirrored = (fixed[3] & 1u) != 0;
    const double half = 0.5 * field.fov_deg * sim::kRadiansPerDegree;
    double radius = half;
    if (field.truth.model == sim::LensModel::pinhole) radius = std::tan(half);
    if (field.truth.model == sim::LensModel::equisolid) radius = 2.0 * std::sin(0.5 * half);
    if (field.truth.model == sim::LensModel::stereographic) radius = 2.0 * std::tan(0.5 * half);
    field.truth.numbers[fit::focal_px_number] = 600.0 / radius;
    field.truth.numbers[fit::centre_x_number] =
        field.frame.width_px * (0.5 + 0.04 * (sim::uniform(a[0]) - 0.5));
    field.truth.numbers[fit::centre_y_number] =
        field.frame.height_px * (0.5 + 0.04 * (sim::uniform(a[1]) - 0.5));
    field.truth.camera_from_enu = fit::rotation_of(
        360.0 * sim::uniform(a[2]), std::asin(2.0 * sim::uniform(a[3]) - 1.0) / sim::kRadiansPerDegree,
        360.0 * sim::uniform(b[0]) - 180.0);
    std::vector<std::pair<double, fit::FoundStar>> by_brightness;
    const std::vector<fit::StarSighting>& sky = fit::equatorial_sky();
    const sim::Lens<double> lens = fit::true_lens(field.truth);
    int in_view = 0;
    double faintest = 0.0;
    for (std::uint32_t i = 0; i < sky.size() && in_view < wanted; ++i) {
      const Eigen::Vector3d v =
          field.truth.camera_from_enu * Eigen::Vector3d(sky[i].enu[0], sky[i].enu[1], sky[i].enu[2]);
      const double in_camera[3] = {v[0], v[1], v[2]};
      fit::FoundStar point;
      if (!sim::project(lens, in_camera, point.x_px, point.y_px)) continue;
      if (point.x_px < 0.0 || point.y_px < 0.0 || point.x_px > field.frame.width_px ||
          point.y_px > field.frame.height_px)
        continue;
      // A fisheye's circle ends at the edge of its field.
      if (v[2] < std::cos(half * 1.25)) continue;
      ++in_view;
      faintest = sky[i].magnitude;
      if (in_view > 10 && in_view % 10 == 5) continue;
      point.x_px += noise_px * normal(seed + number, i, 1);
      point.y_px += noise_px * normal(seed + number, i, 2);
      by_brightness.emplace_back(sky[i].magnitude + 0.3 * normal(seed + number, i, 3), point);
    }
    if (in_view < 10) continue;
    field.stars = static_cast<int>(by_brightness.size());
    const int strewn = (3 * field.stars + 3) / 7;
    const double first = by_brightness.front().first;
    for (int i = 0; i < strewn; ++i) {
      const sim::Words words = sim::random_words(seed, sim::Stream::stars, number, i, 5);
      fit::FoundStar point;
      point.x_px = field.frame.width_px * sim::uniform(words[0]);
      point.y_px = field.frame.height_px * sim::uniform(words[1]);
      // Stars grow threefold a magnitude.
      const double magnitude = faintest + std::log(std::max(1e-3, sim::uniform(words[2]))) / std::log(3.0);
      by_brightness.emplace_back(std::max(first, magnitude), point);
    }
    std::stable_sort(by_brightness.begin(), by_brightness.end(),
                     [](const auto& one, const auto& other) { return one.first < other.first; });
    for (auto& [magnitude, point] : by_brightness) {
      point.flux = std::pow(10.0, -0.4 * magnitude);
      field.points.push_back(point);
    }
    (void)c;
    return field;
  }
}

/// Whether the camera that was found sees the recognised stars where the true one does, to 2 px rms and 5 px
/// in the middle of the picture's points, and has the picture the right way round.
inline bool is_right(const BlindField& field, const fit::StarRecognition& found) {
  if (found.best.camera.mirrored != field.truth.mirrored) return false;
  double sum = 0.0;
  int n = 0;
  for (const fit::StarSighting& star : found.stars()) {
    double x = 0.0, y = 0.0, x0 = 0.0, y0 = 0.0;
    if (!fit::place_of_star(field.truth, star.enu, x0, y0) ||
        !fit::place_of_star(found.best.camera, star.enu, x, y))
      return false;
    sum += (x - x0) * (x - x0) + (y - y0) * (y - y0);
    ++n;
  }
  return n > 0 && std::sqrt(sum / n) < 3.0;
}

}  // namespace vegard::tests
