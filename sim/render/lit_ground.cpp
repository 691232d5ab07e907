#include "sim/render/lit_ground.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/reduced_scene.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/line_spectrum.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/night_sky.h"

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

/// The irradiance that the sky alone gives to each slope of the table, from its picture in cells of 2 by 4
/// degrees.
void light_slopes(const Image& rgb, GroundIllumination& light) {
  constexpr int kDown = 2, kAcross = 4, kWidth = 2 * kGroundSkyRows;
  for (int y = 0; y < kGroundSkyRows / 2; y += kDown) {
    const double top = kPi * (0.5 - static_cast<double>(y) / kGroundSkyRows),
                 bottom = kPi * (0.5 - static_cast<double>(y + kDown) / kGroundSkyRows);
    const double sine = 0.5 * (std::sin(top) + std::sin(bottom)), cosine = std::sqrt(1.0 - sine * sine);
    const double solid = (std::sin(top) - std::sin(bottom)) * kTwoPi * kAcross / kWidth;
    for (int x = 0; x < kWidth; x += kAcross) {
      Vector3 sum{};
      for (int j = 0; j < kDown; ++j)
        for (int i = 0; i < kAcross; ++i)
          for (int c = 0; c < 3; ++c)
            sum[c] += std::max(0.0, static_cast<double>(rgb.at(x + i, y + j, c))) * solid / (kDown * kAcross);
      const double azimuth = kTwoPi * ((x + 0.5 * kAcross) / kWidth - 0.5);  // the middle looks north
      const double east = cosine * std::sin(azimuth), north = cosine * std::cos(azimuth);
      constexpr int kSlopes = GroundIllumination::kSlopes;
      for (int n = 0; n < kSlopes; ++n)
        for (int e = 0; e < kSlopes; ++e) {
          const double up_east = GroundIllumination::kSteepest * (2.0 * e / (kSlopes - 1) - 1.0);
          const double up_north = GroundIllumination::kSteepest * (2.0 * n / (kSlopes - 1) - 1.0);
          const double towards = (sine - up_east * east - up_north * north) /
                                 std::sqrt(1.0 + up_east * up_east + up_north * up_north);
          for (int c = 0; c < 3; ++c) light.on[n * kSlopes + e][c] += sum[c] * std::max(0.0, towards);
        }
    }
  }
}

/// Adds the airglow's lines to the light in the air.
void add_airglow(const Scene& sky, GroundIllumination& light) {
  const double observer_km = sky.site.altitude_m * 1e-3;
  const AirAbove air(sky);
  const double zenith[3] = {sky.airglow.green_rayleigh, sky.airglow.red_rayleigh,
                            sky.airglow.sodium_rayleigh};
  constexpr int kSteps = 200;
  for (std::size_t i = 0; i < kAirglowLayers.size(); ++i) {
    const AirglowLayer& layer = kAirglowLayers[i];
    const LineDepths<double> depths(layer.wavelength_nm, sky.air.aerosol_optical_depth,
                                    sky.air.angstrom_exponent, sky.air.ozone_dobson);
    LineInAir line{layer.wavelength_nm, 0.0, 0.0};
    for (int step = 0; step < kSteps; ++step) {
      const double sine = (step + 0.5) / kSteps;
      double here = zenith[i] * van_rhijn(sine, layer.altitude_km, observer_km) / kSteps;
      if (!air.none()) here *= depths.transmission(air.towards(sine));
      line.mean += here;
      line.level += 2.0 * sine * here;
    }
    if (line.mean > 0.0) light.in_air.push_back(line);
  }
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
  for (const double nm : sky.emission.lines) light.in_air.push_back({nm, 0.0, 0.0});
  for (int y = 0; y < kGroundSkyRows / 2; ++y) {
    // The integral of sine times cosine of the elevation over a row, and a column's share of the turn.
    const double top = kPi * (0.5 - static_cast<double>(y) / kGroundSkyRows),
                 bottom = kPi * (0.5 - static_cast<double>(y + 1) / kGroundSkyRows);
    const double share = 0.5 * (std::pow(std::sin(top), 2) - std::pow(std::sin(bottom), 2)) * kTwoPi / kWidth;
    const double of_all = (std::sin(top) - std::sin(bottom)) / kWidth;
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < 3; ++c) light.rgb[c] += share * std::max(0.0, static_cast<double>(rgb.at(x, y, c)));
      for (std::size_t l = 0; l < luminance.size(); ++l) {
        const double here = rayleigh.at(x, y, static_cast<int>(l));
        light.aurora_lx += share * luminance[l] * here;
        light.in_air[l].mean += of_all * here;
        light.in_air[l].level += share * here / kPi;
      }
      if (!night_sky.empty())
        light.night_sky_lx += share * white * luminance_over_white(weights, night_sky, x, y);
      if (!stars.empty()) light.stars_lx += share * white * luminance_over_white(weights, stars, x, y);
    }
  }
  light_slopes(rgb, light);
  add_airglow(sky, light);
  if (!night_sky.empty())
    for (int degree = 0; degree < kWidth; ++degree) {
      Vector3 there;
      for (int c = 0; c < 3; ++c)
        there[c] = night_sky.at((degree + kWidth / 2) % kWidth, kGroundSkyRows / 2 - 1, c);
      light.horizon.push_back(there);
    }
  return light;
}

}  // namespace vegard::sim
