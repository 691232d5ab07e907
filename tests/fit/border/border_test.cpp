#include "fit/border/border.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "fit/border/border_distance.h"
#include "fit/report/border/border_run.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/air.h"

namespace vegard::fit::border_test {
namespace {

sim::Scene all_sky() {
  return sim::parse_scene(
      "[site]\nlatitude_deg = 68\nlongitude_deg = 20\n[camera]\nmodel = \"equidistant\"\nwidth = 400\nheight "
      "= "
      "400\nfocal_px = 125\nelevation_deg = 90\n",
      "scene");
}

sim::Scene phone() {
  return sim::parse_scene(
      "[site]\nlatitude_deg = 68\nlongitude_deg = 20\n[camera]\nwidth = 420\nheight = 280\nhfov_deg = "
      "70\nazimuth_deg = 350\nelevation_deg = 28\nroll_deg = 6\n",
      "scene");
}

using Light = std::function<double(double azimuth_deg, double elevation_deg)>;

/// A picture of light that is given by direction, with noise that grows with the root of the light (seed 7
/// where none is named).
Photo drawn(const sim::Scene& scene, const Light& light, double noise = 0.0, std::uint64_t seed = 7) {
  Photo photo;
  const int width = scene.camera.width, height = scene.camera.height;
  photo.linear = sim::Image(width, height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.file_name = "drawn.png";
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const sim::Direction d = sim::direction_of_pixel(scene.camera, x + 0.5, y + 0.5);
      double v = std::isfinite(d.elevation_deg) && d.elevation_deg > 0.0
                     ? light(d.azimuth_deg, d.elevation_deg)
                     : 0.0;
      const sim::Words w = sim::random_words(seed, sim::Stream::photon_noise, static_cast<std::uint32_t>(x),
                                             static_cast<std::uint32_t>(y));
      v += noise * std::sqrt(std::max(v, 0.01)) * std::sqrt(-2.0 * std::log(sim::uniform(w[0]))) *
           std::cos(sim::kTwoPi * sim::uniform(w[1]));
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = static_cast<float>(v);
    }
  return photo;
}

/// Elevation of a straight border from east to west, 105 km high and so far north.
double straight_deg(double azimuth_deg, double north_km = 220.0) {
  const double along = std::cos(azimuth_deg * sim::kRadiansPerDegree);
  return along > 0.05 ? elevation_of_place_deg(north_km / along, 0.0, 105.0) : -20.0;
}

/// An edge that rises over some 2 degrees, half way at `edge_deg`, and falls off slowly above.
double curtain(double elevation_deg, double edge_deg, double rise_deg = 0.5, double height_deg = 9.0) {
  const double t = elevation_deg - edge_deg;
  if (edge_deg < -10.0) return 0.0;
  return 1.0 / (1.0 + std::exp(-t / rise_deg)) *
         (t > 0.0 ? std::exp(-0.5 * t * t / (height_deg * height_deg)) : 1.0);
}

/// What the standard air leaves of the light of aurora, which stands above it.
double through_air(double elevation_deg) {
  static const std::vector<double> left = [] {
    sim::Scene scene = all_sky();
    scene.air.model = sim::AirModel::standard;
    std::vector<double> by_tenths;
    const sim::AirAbove air(scene);
    const sim::LineDepths<double> depths(557.7, scene.air.aerosol_optical_depth, scene.air.angstrom_exponent,
                                         scene.air.ozone_dobson);
    for (int i = 0; i <= 900; ++i)
      by_tenths.push_back(depths.transmission(air.towards(std::sin(0.1 * i * sim::kRadiansPerDegree))));
    return by_tenths;
  }();
  const double place = 10.0 * std::min(elevation_deg, 89.9);
  const auto i = static_cast<std::size_t>(place);
  return left[i] + (place - static_cast<double>(i)) * (left[i + 1] - left[i]);
}

double sky(double elevation_deg) { return 0.03 + 0.02 * std::exp(-elevation_deg / 15.0); }

/// How far off the border is at most, of the nearest `share` of its points.
double off_straight(const Border& border, std::size_t trace, double north_km = 220.0, double share = 1.0) {
  std::vector<double> off;
  for (const BorderPoint& p : border.traces[trace].points)
    if (p.measured()) off.push_back(std::abs(p.elevation_deg - straight_deg(p.azimuth_deg, north_km)));
  std::sort(off.begin(), off.end());
  return off.empty() ? sim::kNaN : off[static_cast<std::size_t>(share * static_cast<double>(off.size() - 1))];
}

TEST(Border, LiesWhereTheLightIsHalf) {
  // Half of the peak is within 0.1° of the middle of the rise: the fall above the edge lowers the peak. The
  // fisheye's pixel is 0.46°, the phone's 0.19°.
  for (const bool wide : {true, false}) {
    const sim::Scene scene = wide ? all_sky() : phone();
    const Border border = trace_border(
        drawn(
            scene,
            [](double a, double e) { return sky(e) + 0.5 * through_air(e) * curtain(e, straight_deg(a)); },
            0.01),
        scene);
    ASSERT_EQ(border.measured, 1) << wide;
    EXPECT_GT(border.traces[0].measured, wide ? 110 : 55);
    // At an edge of the picture a column of azimuth is only partly in view.
    EXPECT_LT(off_straight(border, 0, 220.0, 0.9), 0.1);
    for (const BorderPoint& p : border.traces[0].points) {
      if (!p.measured()) continue;
      // Near the horizon a pixel of the fisheye holds as much as the border's own width: there the error
      // tells.
      EXPECT_LT(std::abs(p.elevation_deg - straight_deg(p.azimuth_deg)),
                p.elevation_deg < 6.0 ? std::max(0.4, 3.0 * p.elevation_error_deg) : 0.4)
          << p.azimuth_deg;
      EXPECT_GT(p.peak_elevation_deg, p.elevation_deg);
      EXPECT_GT(p.elevation_error_deg, 0.0);
    }
  }
}

TEST(Border, TellsArcsAboveOneAnother) {
  const sim::Scene scene = all_sky();
  const Border border = trace_border(
      drawn(
          scene,
          [](double a, double e) {
            return sky(e) + through_air(e) * (0.3 * curtain(e, straight_deg(a, 350.0), 0.4, 2.5) +
                                              0.5 * curtain(e, straight_deg(a, 120.0), 0.4, 6.0));
          },
          0.01),
      scene);
  ASSERT_GE(border.measured, 2);
  EXPECT_LT(std::min(off_straight(border, 0, 120.0), off_straight(border, 1, 120.0)), 0.8);
  EXPECT_LT(std::min(off_straight(border, 0, 350.0), off_straight(border, 1, 350.0)), 0.8);
}

TEST(Border, FindsNothingInNoiseOrASmoothSky) {
  const sim::Scene scene = all_sky();
  for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    EXPECT_EQ(trace_border(drawn(
                               scene, [](double, double) { return 0.1; }, 0.1, seed),
                           scene)
                  .traces.size(),
              0u)
        << seed;
  // Airglow towards the horizon, a moonlit sky to one side, and the darkening of the air and of a lens.
  const Light smooth = [](double a, double e) {
    const double s = std::sin(e * sim::kRadiansPerDegree);
    return (0.05 / std::sqrt(1.0 - 0.97 * (1.0 - s * s)) * std::exp(-0.15 / (s + 0.02)) +
            0.08 * (1.0 + 0.6 * std::cos((a - 140.0) * sim::kRadiansPerDegree))) *
           (0.6 + 0.4 * s);
  };
  const Border border = trace_border(drawn(scene, smooth, 0.01), scene);
  EXPECT_EQ(border.measured, 0);
  ASSERT_FALSE(border.notes.empty());
}

TEST(Border, IsNotToldBeyondAMaskOrTheHorizon) {
  const sim::Scene scene = all_sky();
  const Light light = [](double a, double e) { return sky(e) + 0.4 * curtain(e, straight_deg(a)); };
  Photo photo = drawn(scene, light, 0.005);
  // The ground to the north-east, up to the peak's foot: the border there is hidden.
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) {
      const sim::Direction d = sim::direction_of_pixel(scene.camera, x + 0.5, y + 0.5);
      if (d.azimuth_deg < 40.0 && d.elevation_deg < straight_deg(d.azimuth_deg) + 0.3)
        for (int c = 0; c < 3; ++c) photo.usable[photo.linear.index(x, y, c)] = 0;
    }
  const Border border = trace_border(photo, scene);
  ASSERT_GE(border.measured, 1);
  int hidden = 0;
  for (const BorderTrace& trace : border.traces)
    for (const BorderPoint& p : trace.points) {
      if (p.azimuth_deg > 2.0 && p.azimuth_deg < 38.0) {
        EXPECT_FALSE(p.measured()) << p.azimuth_deg;
        EXPECT_EQ(p.limit, BorderLimit::mask);
        EXPECT_TRUE(std::isnan(p.elevation_deg));
        ++hidden;
      }
      if (p.azimuth_deg > 42.0 && p.azimuth_deg < 60.0) {
        EXPECT_TRUE(p.measured()) << p.azimuth_deg;
      }
    }
  EXPECT_GT(hidden, 20);

  // The same as a black roof that no mask leaves out.
  Photo roofed = drawn(scene, light, 0.005);
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x)
      for (int c = 0; c < 3; ++c)
        if (photo.usable[photo.linear.index(x, y, c)] == 0) roofed.linear.at(x, y, c) = 0.0f;
  int before_it = 0;
  const Border beyond = trace_border(roofed, scene);
  for (const BorderTrace& trace : beyond.traces)
    for (const BorderPoint& p : trace.points)
      if (p.azimuth_deg > 4.0 && p.azimuth_deg < 36.0) {
        EXPECT_EQ(p.limit, BorderLimit::ground) << p.azimuth_deg;
        ++before_it;
      }
  EXPECT_GT(before_it, 20);

  // An arc whose border has set.
  const Border low = trace_border(
      drawn(
          scene,
          [](double, double e) { return 0.03 + 0.4 * std::exp(-0.5 * std::pow((e - 4.0) / 4.0, 2.0)); },
          0.005),
      scene);
  EXPECT_EQ(low.measured, 0);
  ASSERT_FALSE(low.traces.empty());
  EXPECT_EQ(low.traces[0].points[0].limit, BorderLimit::horizon);
}

TEST(Border, IsTheSameOnEveryRunAndWhateverTheLightIsCountedIn) {
  const sim::Scene scene = phone();
  Photo photo = drawn(
      scene, [](double a, double e) { return sky(e) + 0.4 * curtain(e, straight_deg(a)); }, 0.02);
  const Border first = trace_border(photo, scene);
  EXPECT_EQ(border_csv(first, scene), border_csv(trace_border(photo, scene), scene));
  for (float& v : photo.linear.data) v *= 0.25f;
  const Border dimmer = trace_border(photo, scene);
  ASSERT_EQ(dimmer.traces.size(), first.traces.size());
  for (std::size_t i = 0; i < first.traces[0].points.size(); ++i)
    EXPECT_NEAR(dimmer.traces[0].points[i].elevation_deg, first.traces[0].points[i].elevation_deg, 1e-4);
}

TEST(Border, RefusesAnotherSizeAndAnObserverInOrbit) {
  sim::Scene scene = phone();
  const Photo photo = drawn(scene, [](double, double) { return 0.1; });
  scene.camera.width = 421;
  EXPECT_THROW(trace_border(photo, scene), sim::Error);
  scene.camera.width = 420;
  scene.site.altitude_m = 390000.0;
  EXPECT_THROW(trace_border(photo, scene), sim::Error);
}

TEST(BorderDistance, GoesThereAndBack) {
  for (const double site_m : {0.0, 520.0, 4000.0})
    for (const double altitude : kBorderAltitudesKm)
      for (const double km : {5.0, 100.0, 300.0, 900.0}) {
        const double elevation = elevation_of_place_deg(km, site_m, altitude);
        EXPECT_NEAR(ground_distance_km(elevation, site_m, altitude), km, 1e-6);
      }
}

TEST(BorderDistance, AgreesWithAFigureByHand) {
  // 30° true, 105 km: sin z' = 6371/6476 sin 60° = 0.851984, z' = 58.4281°, psi = 1.5719°, 174.79 km.
  EXPECT_NEAR(ground_distance_km(30.0, 0.0, 105.0), 174.79, 0.01);
  // The zenith is overhead, and the point beneath a border due north lies on the meridian.
  EXPECT_NEAR(ground_distance_km(90.0, 0.0, 105.0), 0.0, 1e-9);
  sim::Site site;
  site.latitude_deg = 68.0;
  site.longitude_deg = 20.0;
  const BorderPlace north = border_place(site, 0.0, 30.0, 0.5, 105.0);
  EXPECT_NEAR(north.longitude_deg, 20.0, 1e-9);
  EXPECT_NEAR(north.latitude_deg, 68.0 + north.distance_km / 6371.0 / sim::kRadiansPerDegree, 1e-9);
  // Half a degree at 30°: d(distance)/d(elevation) is 5.9 km to the degree there.
  EXPECT_NEAR(north.distance_error_km,
              0.25 * std::abs(ground_distance_km(31.0, 0.0, 105.0) - ground_distance_km(29.0, 0.0, 105.0)),
              0.02);
}

TEST(BorderDistance, TakesRefractionOff) {
  // Bennett (1982, J. Navigation 35, 255), an independent formula for apparent elevations, agrees with
  // Saemundsson's to 0.1 minutes of arc (Meeus, chapter 16); 5° apparent are 9.9' lifted.
  for (const double apparent : {2.0, 5.0, 10.0, 30.0}) {
    const double bennett =
        1.0 / std::tan((apparent + 7.31 / (apparent + 4.4)) * sim::kRadiansPerDegree) / 60.0;
    EXPECT_NEAR(apparent - true_elevation_deg(apparent, 0.0), bennett, 0.15 / 60.0) << apparent;
  }
}

TEST(BorderTable, HasARowForEveryPoint) {
  const sim::Scene scene = phone();
  const Photo photo = drawn(
      scene, [](double a, double e) { return sky(e) + 0.4 * curtain(e, straight_deg(a)); }, 0.01);
  const Border border = trace_border(photo, scene);
  std::size_t points = 0;
  for (const BorderTrace& trace : border.traces) points += trace.points.size();
  const std::string csv = border_csv(border, scene);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), points + 1);
  EXPECT_NEAR(border_summary(border.traces[0], scene).distance_km[2], 220.0, 4.0);
}

TEST(BorderPage, OpensWithTheDistanceOfTheNearestBorder) {
  const sim::Scene scene = phone();
  const Photo photo = drawn(
      scene, [](double a, double e) { return sky(e) + 0.4 * curtain(e, straight_deg(a)); }, 0.01);
  const Border border = trace_border(photo, scene);
  const std::string answer = border_answer(border, scene);
  EXPECT_NE(answer.find("lower border"), std::string::npos) << answer;
  // The curtain's foot is drawn 220 km away, for a border 105 km high.
  EXPECT_NEAR(std::stod(answer.substr(answer.find(" is ") + 4)), 220.0, 4.0) << answer;
  const std::string page = border_page(border, photo, scene, {});
  const std::size_t at = page.find(answer);
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(at, page.find("<svg"));
}

}  // namespace
}  // namespace vegard::fit::border_test
