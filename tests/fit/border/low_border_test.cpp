// Borders near the horizon, where the air dims them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "fit/border/border.h"
#include "fit/border/border_air.h"
#include "fit/border/border_distance.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/air.h"

namespace vegard::fit::low_border_test {
namespace {

/// Looks north over the sea, 0.1 degrees to the pixel.
sim::Scene over_the_sea() {
  return sim::parse_scene(
      "[site]\nlatitude_deg = 68\nlongitude_deg = 20\n[camera]\nwidth = 600\nheight = 300\nhfov_deg = "
      "60\nazimuth_deg = 0\nelevation_deg = 12\n",
      "scene");
}

/// Green light of aurora above the air, and the sky's, which the air itself has. Noise of a hundredth of the
/// root of the light, of each channel by itself (seed 19).
Photo drawn(const sim::Scene& scene, double aerosol, const std::function<double(double, double)>& aurora) {
  sim::Scene hazy = scene;
  hazy.air.model = sim::AirModel::standard;
  hazy.air.aerosol_optical_depth = aerosol;
  std::vector<double> transmission;  // by hundredths of a degree
  const sim::AirAbove air_above(hazy);
  const sim::LineDepths<double> depths(557.7, aerosol, hazy.air.angstrom_exponent, hazy.air.ozone_dobson);
  for (int i = 0; i < 4000; ++i)
    transmission.push_back(
        depths.transmission(air_above.towards(std::sin(0.01 * i * sim::kRadiansPerDegree))));
  Photo photo;
  const int width = scene.camera.width, height = scene.camera.height;
  photo.linear = sim::Image(width, height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const sim::Direction d = sim::direction_of_pixel(scene.camera, x + 0.5, y + 0.5);
      const bool is_sky = d.elevation_deg > 0.0;
      const double air =
          is_sky ? transmission[static_cast<std::size_t>(std::min(39.99, d.elevation_deg) * 100.0)] : 0.0;
      const double green = is_sky ? air * aurora(d.azimuth_deg, d.elevation_deg) : 0.0;
      const double sky = is_sky ? 0.01 + 0.01 * std::exp(-d.elevation_deg / 10.0) : 0.002;
      const std::array<double, 3> rgb = {1.1 * sky + 0.1 * green, sky + green, 0.8 * sky + 0.1 * green};
      for (int c = 0; c < 3; ++c) {
        const sim::Words w = sim::random_words(19, sim::Stream::photon_noise, static_cast<std::uint32_t>(x),
                                               static_cast<std::uint32_t>(3 * y + c));
        const double noise = 0.01 * std::sqrt(rgb[static_cast<std::size_t>(c)]) *
                             std::sqrt(-2.0 * std::log(sim::uniform(w[0]))) *
                             std::cos(sim::kTwoPi * sim::uniform(w[1]));
        photo.linear.at(x, y, c) = static_cast<float>(rgb[static_cast<std::size_t>(c)] + noise);
      }
    }
  return photo;
}

/// Elevation of a straight border from east to west, 105 km high and so far north.
double straight_deg(double azimuth_deg, double north_km) {
  return elevation_of_place_deg(north_km / std::cos(azimuth_deg * sim::kRadiansPerDegree), 0.0, 105.0);
}

/// Rises over 0.4 degrees, from 25 to 75 %, as 10 km do that are 800 km away.
double curtain(double elevation_deg, double edge_deg) {
  const double t = elevation_deg - edge_deg;
  return 3.0 / (1.0 + std::exp(-t / 0.2)) * (t > 0.0 ? std::exp(-0.5 * t * t / 25.0) : 1.0);
}

TEST(LowBorder, IsMeasuredThroughClearUsualAndHazyAir) {
  const sim::Scene scene = over_the_sea();
  for (const double north_km : {600.0, 750.0, 850.0})
    for (const double aerosol : {0.05, 0.1, 0.2}) {
      // Three degrees high, haze hides the border itself: 1.4 degrees off, not within the error
      // (docs/border.md).
      if (north_km > 800.0 && aerosol > 0.1) continue;
      SCOPED_TRACE(std::to_string(north_km) + " km, aerosol " + std::to_string(aerosol));
      const Border border = trace_border(
          drawn(scene, aerosol, [&](double a, double e) { return curtain(e, straight_deg(a, north_km)); }),
          scene);
      ASSERT_EQ(border.measured, 1);
      int points = 0, held = 0;
      std::vector<double> off;
      for (const BorderPoint& p : border.traces[0].points) {
        if (!p.measured()) continue;
        ++points;
        off.push_back(p.elevation_deg - straight_deg(p.azimuth_deg, north_km));
        held += std::abs(off.back()) < 2.0 * p.elevation_error_deg ? 1 : 0;
      }
      EXPECT_GT(points, 35);
      // The errors share the air, so all or none of the points may be off; a standard error holds 95 % in
      // two.
      EXPECT_GT(held, 9 * points / 10);
      std::nth_element(off.begin(), off.begin() + points / 2, off.end());
      RecordProperty(std::to_string(north_km) + " " + std::to_string(aerosol),
                     std::to_string(off[points / 2]));
    }
}

TEST(LowBorder, IsNotTheEndOfLightThatTheAirHides) {
  // A glow without any border, above the air, as bright as the arcs.
  const sim::Scene scene = over_the_sea();
  for (const double aerosol : {0.05, 0.1, 0.2})
    EXPECT_EQ(trace_border(drawn(scene, aerosol, [](double, double) { return 3.0; }), scene).measured, 0)
        << aerosol;
}

TEST(BorderAir, IsThatOfTheSceneOrTheStandard) {
  const sim::Scene scene = over_the_sea();
  SkyCells cells;
  cells.rows = 10, cells.lowest_deg = 1.0, cells.elevation_step_deg = 1.0;
  sim::Scene same = scene;
  same.air.model = sim::AirModel::standard;
  const BorderAir air = air_of_rows(scene, cells, 1);
  for (int r = 0; r < cells.rows; ++r) {
    EXPECT_NEAR(std::exp(-air.usual[r]), sim::air_transmission(same, 557.7, cells.elevation_deg(r)), 1e-12);
    EXPECT_LT(air.clear[r], air.usual[r]);
    EXPECT_GT(air.hazy[r], air.usual[r]);
  }
  // Blue light is dimmed by more, and refraction is lost in the errors high up.
  EXPECT_GT(air_of_rows(scene, cells, 2).usual[3], air.usual[3]);
  EXPECT_NEAR(refraction_error_deg(2.0, 0.0), 0.16 * 18.0 / 60.0, 0.005);
  EXPECT_LT(refraction_error_deg(30.0, 0.0), 0.005);
}

}  // namespace
}  // namespace vegard::fit::low_border_test
