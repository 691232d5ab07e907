#include "sim/render/lit_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/render/reduced_scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/line_spectrum.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {
namespace {

constexpr int kGroundSkyRows = 180;  // a degree each
constexpr double kGroundSkyPoints =
    3e6;  // as many deflection points leave 1 % of noise in a sum over the sky

/// The luminance of a pixel, over that of white.
double luminance_over_white(const Vector3& weights, const Image& rgb, int x, int y) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) sum += weights[c] * rgb.at(x, y, c);
  return sum;
}

}  // namespace

Scene sky_over_ground(const Scene& scene) {
  Reduction reduction;
  reduction.points = kGroundSkyPoints;
  Scene sky = scene;
  sky.camera = Camera();
  sky.camera.model = LensModel::equirectangular;
  sky.camera.width = 2 * kGroundSkyRows;
  sky.camera.height = kGroundSkyRows;
  sky.camera.elevation_deg = 0.0;
  sky.composite = Composite();
  sky.sky.gradient = sky.sky.curvature = {0.0, 0.0, 0.0};  // down the picture of another camera
  sky.march.depth.clear();
  sky.march.glow = 0.0;
  sky.sensor.vignetting_cos_power = 0.0;
  sky.sensor.vignetting = Sensor().vignetting;
  sky.ground.shown = false;
  if (sky.moon.skylight) sky.moon.shown = true;  // what lights the air lights the ground
  // A blur moves light about and leaves its sum.
  sky.blur.model = BlurModel::angle;
  std::fill(sky.blur.width_deg.begin(), sky.blur.width_deg.end(), 0.0);
  reduction.most = {sky.camera.width, sky.camera.height};
  sky = reduced_scene(sky, reduction);
  for (Sheet& sheet : sky.sheets) sheet.points_per_px = 0.0;  // grain is no matter in a sum
  return sky;
}

GroundIllumination light_of_sky(const Scene& sky, const Image& rayleigh, const Image& rgb,
                                const Image& night_sky, const Image& stars) {
  GroundIllumination light;
  std::vector<double> luminance;
  for (const double nm : sky.emission.lines)
    luminance.push_back(luminance_cd_m2_per_rayleigh(components_of_line(sky, nm)));
  const Vector3 weights = inverse(rgb_from_xyz(sky.sensor.primaries))[1];
  const double white = white_luminance_cd_m2(sky);
  constexpr int kWidth = 2 * kGroundSkyRows;
  for (int y = 0; y < kGroundSkyRows / 2; ++y) {
    // The integral of sine times cosine of the elevation over a row, and a column's share of the turn.
    const double top = kPi * (0.5 - static_cast<double>(y) / kGroundSkyRows),
                 bottom = kPi * (0.5 - static_cast<double>(y + 1) / kGroundSkyRows);
    const double share = 0.5 * (std::pow(std::sin(top), 2) - std::pow(std::sin(bottom), 2)) * kTwoPi / kWidth;
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < 3; ++c) light.rgb[c] += share * std::max(0.0, static_cast<double>(rgb.at(x, y, c)));
      for (std::size_t l = 0; l < luminance.size(); ++l)
        light.aurora_lx += share * luminance[l] * rayleigh.at(x, y, static_cast<int>(l));
      if (!night_sky.empty())
        light.night_sky_lx += share * white * luminance_over_white(weights, night_sky, x, y);
      if (!stars.empty()) light.stars_lx += share * white * luminance_over_white(weights, stars, x, y);
    }
  }
  return light;
}

Image ground_layer(const Scene& scene, const GroundIllumination& light, int threads) {
  const Camera& camera = scene.camera;
  Image layer(camera.width, camera.height, {"R", "G", "B", "A"});
  const CameraView<double> view = camera_view(camera);
  const double lowest = sine_of_horizon(scene.site.altitude_m * 1e-3);
  Vector3 ground{};
  for (int c = 0; c < 3; ++c) ground[c] = scene.ground.albedo * light.rgb[c] / kPi;
  const auto below = [&](double x_px, double y_px) {
    double enu[3];
    return enu_of_pixel(view, x_px, y_px, enu) && enu[2] < lowest;
  };
  constexpr int kFine = 8;
  parallel_for(static_cast<std::size_t>(camera.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    std::vector<std::uint8_t> above(camera.width + 1), under(camera.width + 1);
    for (int x = 0; x <= camera.width; ++x) {
      above[x] = below(x, y) ? 1 : 0;
      under[x] = below(x, y + 1) ? 1 : 0;
    }
    for (int x = 0; x < camera.width; ++x) {
      const int corners = above[x] + above[x + 1] + under[x] + under[x + 1];
      double share = corners / 4;
      // The sky of a pixel whose middle is below the horizon is dark already.
      if (corners % 4 != 0 && below(x + 0.5, y + 0.5)) {
        share = 1.0;
      } else if (corners % 4 != 0) {
        int inside = 0;
        for (int i = 0; i < kFine * kFine; ++i)
          inside += below(x + (i % kFine + 0.5) / kFine, y + (i / kFine + 0.5) / kFine) ? 1 : 0;
        share = static_cast<double>(inside) / (kFine * kFine);
      }
      for (int c = 0; c < 3; ++c) layer.at(x, y, c) = static_cast<float>(share * ground[c]);
      layer.at(x, y, 3) = static_cast<float>(share);
    }
  });
  return layer;
}

}  // namespace vegard::sim
