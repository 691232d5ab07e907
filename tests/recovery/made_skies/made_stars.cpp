#include "tests/recovery/made_skies/made_stars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/chance_agreement.h"
#include "sim/view/sky/bright_stars.h"
#include "tests/support/star_field.h"

namespace vegard::tests {

double drawn(std::uint64_t seed, std::uint32_t number, std::uint32_t use, std::uint32_t i) {
  return sim::fine_uniform(sim::random_words(seed, sim::Stream::stars, number, use, i)[0],
                           sim::random_words(seed, sim::Stream::stars, number, use, i)[1]);
}

namespace {

/// A smooth field over the picture, from 0 to 1: waves of lengths from a third of it down to a tenth.
class SmoothField {
 public:
  SmoothField(std::uint64_t seed, std::uint32_t number, std::uint32_t use) {
    for (std::uint32_t i = 0; i < 6; ++i) {
      const double turn = 6.283185 * drawn(seed, number, use, 3 * i);
      const double waves = 6.283185 * (1.0 + 5.0 * drawn(seed, number, use, 3 * i + 1));
      waves_.push_back(
          {waves * std::cos(turn), waves * std::sin(turn), 6.283185 * drawn(seed, number, use, 3 * i + 2)});
    }
  }
  double at(double x, double y) const {
    double sum = 0.0;
    for (const auto& wave : waves_) sum += std::sin(wave[0] * x + wave[1] * y + wave[2]);
    return 0.5 + 0.5 * std::tanh(0.8 * sum);
  }

 private:
  std::vector<std::array<double, 3>> waves_;
};

}  // namespace

MadeStars made_stars(std::uint64_t seed, std::uint32_t number, bool with_stars, double narrowest_deg) {
  const auto draw = [&](std::uint32_t use, std::uint32_t i = 0) { return drawn(seed, number, use, i); };
  MadeStars sky;
  const int width = 720, height = 480;
  sky.frame = {width, height, true};
  sky.observer = {-55.0 + 135.0 * draw(1), 360.0 * draw(2) - 180.0, 100.0, true};
  sky.julian_date = 2457023.5 + 3650.0 * draw(3);
  sky.fov_deg = narrowest_deg * std::pow(180.0 / narrowest_deg, draw(4));
  const sim::LensModel models[] = {sim::LensModel::equidistant, sim::LensModel::equisolid,
                                   sim::LensModel::stereographic, sim::LensModel::pinhole};
  sky.truth.model = models[number % 4];
  if (sky.fov_deg < 40.0) sky.truth.model = sim::LensModel::pinhole;
  if (sky.fov_deg > 100.0 && sky.truth.model == sim::LensModel::pinhole)
    sky.truth.model = sim::LensModel::equisolid;
  sky.truth.mirrored = draw(5) < 0.2;
  const double half = 0.5 * sky.fov_deg * sim::kRadiansPerDegree;
  double radius = half;
  if (sky.truth.model == sim::LensModel::pinhole) radius = std::tan(half);
  if (sky.truth.model == sim::LensModel::equisolid) radius = 2.0 * std::sin(0.5 * half);
  if (sky.truth.model == sim::LensModel::stereographic) radius = 2.0 * std::tan(0.5 * half);
  sky.truth.numbers[fit::focal_px_number] = 0.5 * width / radius;
  sky.truth.numbers[fit::centre_x_number] = width * (0.5 + 0.03 * (draw(6) - 0.5));
  sky.truth.numbers[fit::centre_y_number] = height * (0.5 + 0.03 * (draw(7) - 0.5));
  if (sky.fov_deg > 110.0)
    sky.truth.camera_from_enu =
        fit::rotation_of(360.0 * draw(8), 90.0 - 6.0 * draw(9), 360.0 * draw(10) - 180.0);
  else
    sky.truth.camera_from_enu =
        fit::rotation_of(360.0 * draw(8), 10.0 + 60.0 * draw(9),
                         draw(11) < 0.5 ? 8.0 * draw(10) - 4.0 : 360.0 * draw(10) - 180.0);
  const sim::Lens<double> lens = fit::true_lens(sky.truth);

  // What is before the stars: 1 where the sky is clear.
  const SmoothField cloud(seed, number, 20), tree(seed, number, 21);
  const bool has_clouds = number % 3 == 0, has_twilight = number % 3 == 1, has_trees = number % 2 == 0;
  const double cover = 0.7 * draw(22), side = 6.283185 * draw(23);
  const auto clear_at = [&](double x, double y) {
    double v[3];
    if (!sim::unproject(lens, x, y, v) || v[2] < std::cos(1.2 * half)) return 0.0;
    const double up = (sky.truth.camera_from_enu.transpose() * Eigen::Vector3d(v[0], v[1], v[2]))[2];
    if (up < (has_trees ? 0.14 * tree.at(x / width, 0.3) : 0.0)) return 0.0;
    if (!has_clouds) return 1.0;
    return 1.0 / (1.0 + std::exp(30.0 * (cover - cloud.at(x / width, y / height))));
  };
  const auto ground_at = [&](double x, double y) {
    double light = 1.0;
    if (has_twilight)
      light +=
          30.0 /
          (1.0 + std::exp(-6.0 * ((x / width - 0.5) * std::cos(side) + (y / height - 0.5) * std::sin(side))));
    return light;
  };

  // The noise by the last star that is wanted.
  constexpr double kStarsPerMagnitude = 0.46;  // log10 of how many more there are to each magnitude
  const auto wanted = static_cast<std::size_t>(5.0 * std::pow(40.0, draw(24)));
  std::vector<fit::StarSighting> seen;
  for (const fit::StarSighting& star :
       fit::catalogue_sky(sky.observer, sky.julian_date, sim::kFaintestDeep, 0.0, 0.0)) {
    fit::StarSighting one = star;
    const Eigen::Vector3d v =
        sky.truth.camera_from_enu * Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]);
    const double in_camera[3] = {v[0], v[1], v[2]};
    if (!sim::project(lens, in_camera, one.x_px, one.y_px) || one.x_px < 8.0 || one.y_px < 8.0 ||
        one.x_px > width - 8.0 || one.y_px > height - 8.0 || clear_at(one.x_px, one.y_px) < 0.02)
      continue;
    seen.push_back(one);
  }
  // Fainter stars than the catalogue's, to about twice as many as are wanted.
  const double corner = std::min(M_PI, 1.25 * half), share_of_sky = 0.5 * (1.0 - std::cos(corner));
  const double in_catalogue = static_cast<double>(sim::deep_stars().size()) * share_of_sky;
  const auto strewn =
      static_cast<std::uint32_t>(std::max(0.0, 4.0 * static_cast<double>(wanted) - in_catalogue));
  for (std::uint32_t i = 0; i < strewn; ++i) {
    fit::StarSighting one;
    const double cosine = 1.0 - draw(61, i) * (1.0 - std::cos(corner)), turn = 2.0 * M_PI * draw(62, i);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double in_camera[3] = {sine * std::cos(turn), sine * std::sin(turn), cosine};
    one.magnitude =
        sim::kFaintestDeep + std::log10(1.0 + draw(63, i) * strewn / in_catalogue) / kStarsPerMagnitude;
    if (!sim::project(lens, in_camera, one.x_px, one.y_px) || one.x_px < 8.0 || one.y_px < 8.0 ||
        one.x_px > width - 8.0 || one.y_px > height - 8.0 || clear_at(one.x_px, one.y_px) < 0.02)
      continue;
    seen.push_back(one);
  }
  std::stable_sort(seen.begin(), seen.end(), [](const fit::StarSighting& a, const fit::StarSighting& b) {
    return a.magnitude < b.magnitude;
  });
  const double limit = seen.empty() ? 4.0 : seen[std::min(wanted, seen.size()) - 1].magnitude;
  const double noise = 1.0, faintest_height = 6.0 * noise;

  sky.picture.width = width;
  sky.picture.height = height;
  sky.picture.channel_names = {"Y"};
  std::vector<double> light(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const double clear = clear_at(x + 0.5, y + 0.5);
      const double sky_light = 100.0 * ground_at(x + 0.5, y + 0.5) * (1.0 + 0.6 * (1.0 - clear));
      double v[3];
      const bool looks = sim::unproject(lens, x + 0.5, y + 0.5, v);
      const double up =
          looks ? (sky.truth.camera_from_enu.transpose() * Eigen::Vector3d(v[0], v[1], v[2]))[2] : -1.0;
      const bool is_tree = has_trees && up >= 0.0 && up < 0.14 * tree.at((x + 0.5) / width, 0.3);
      light[i] = looks && (up >= 0.0) && v[2] >= std::cos(1.2 * half) ? sky_light : 10.0;
      // Gaps between leaves.
      if (is_tree) light[i] = drawn(seed, number, 30, static_cast<std::uint32_t>(i)) < 0.1 ? sky_light : 15.0;
    }
  const auto add = [&](double x0, double y0, double peak, double sigma) {
    const int reach = static_cast<int>(std::ceil(5.0 * sigma));
    for (int y = static_cast<int>(y0) - reach; y <= static_cast<int>(y0) + reach; ++y)
      for (int x = static_cast<int>(x0) - reach; x <= static_cast<int>(x0) + reach; ++x) {
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        const double dx = x + 0.5 - x0, dy = y + 0.5 - y0;
        light[static_cast<std::size_t>(y) * width + x] +=
            peak * std::exp(-0.5 * (dx * dx + dy * dy) / (sigma * sigma));
      }
  };
  if (with_stars)
    for (const fit::StarSighting& star : seen) {
      const double peak =
          faintest_height * std::pow(10.0, 0.4 * (limit - star.magnitude)) * clear_at(star.x_px, star.y_px);
      const double behind = ground_at(star.x_px, star.y_px) * (1.6 - 0.6 * clear_at(star.x_px, star.y_px));
      const bool stands_out = peak / (noise * std::sqrt(behind)) >= 6.0;
      (star.magnitude > sim::kFaintestDeep ? sky.nameless : sky.findable) += stands_out;
      add(star.x_px, star.y_px, peak, 1.1);
    }
  const auto lamps = static_cast<std::uint32_t>(5.0 * draw(40)),
             planets = static_cast<std::uint32_t>(3.0 * draw(41));
  for (std::uint32_t i = 0; i < lamps; ++i)
    add(width * draw(42, i), height * (0.75 + 0.25 * draw(43, i)), 4000.0, 2.0 + 5.0 * draw(44, i));
  for (std::uint32_t i = 0; i < planets; ++i)
    add(10.0 + (width - 20.0) * draw(45, i), 10.0 + 0.6 * height * draw(46, i), 600.0, 1.2);
  const auto hot = static_cast<std::uint32_t>(40.0 * draw(47));
  for (std::uint32_t i = 0; i < hot; ++i)
    light[static_cast<std::size_t>(height * draw(48, i)) * width +
          static_cast<std::size_t>(width * draw(49, i))] += 300.0 * draw(50, i);
  sky.picture.data.resize(light.size());
  for (std::size_t i = 0; i < light.size(); ++i)
    sky.picture.data[i] = static_cast<float>(std::min(
        4000.0, light[i] + noise * std::sqrt(light[i] / 100.0) *
                               normal(seed + 1000003ULL * number, static_cast<std::uint32_t>(i), 60)));
  return sky;
}

bool is_right(const MadeStars& sky, const fit::SkyCamera& found) {
  if (found.mirrored != sky.truth.mirrored) return false;
  const std::vector<fit::StarSighting> stars =
      fit::catalogue_sky(sky.observer, sky.julian_date, sim::kFaintestDeep, 5.0, 0.0);
  double sum = 0.0;
  int n = 0;
  for (const fit::ExpectedStar& star : fit::expected_stars(sky.truth, sky.frame, stars)) {
    double x = 0.0, y = 0.0;
    if (!fit::place_of_star(found, stars[static_cast<std::size_t>(star.star)].enu, x, y)) return false;
    sum += std::min(400.0, (x - star.x) * (x - star.x) + (y - star.y) * (y - star.y));
    ++n;
  }
  return n > 0 && std::sqrt(sum / n) < 6.0;
}

}  // namespace vegard::tests
