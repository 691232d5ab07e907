// Borders of bands near the zenith, which run along azimuths instead of crossing them.
#include "fit/border/high_borders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fit/border/border.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit::high_border_test {
namespace {

constexpr double kHeight_km = 105.0;

sim::Scene fisheye() {
  return sim::parse_scene(
      "[site]\nlatitude_deg = 68\nlongitude_deg = 20\n[camera]\nmodel = \"equidistant\"\nwidth = 400\nheight "
      "= 400\nfocal_px = 125\nelevation_deg = 90\n",
      "scene");
}

/// How far a place 105 km high in this direction lies towards `towards_deg`, on a flat Earth.
double aside_km(double azimuth_deg, double elevation_deg, double towards_deg) {
  return kHeight_km / std::tan(elevation_deg * sim::kRadiansPerDegree) *
         std::cos((azimuth_deg - towards_deg) * sim::kRadiansPerDegree);
}

/// A green band whose lower border runs straight, `aside` km from the zenith: sharp on the side away from the
/// zenith, within 3 km, and soft towards it, with half of its light within 14 km: all of it is on one side of
/// the zenith. Noise as in border_claim_test.cpp (seed 23).
Photo band(const sim::Scene& scene, double border_km, double towards_deg) {
  constexpr std::array<double, 3> kSky = {0.05, 0.045, 0.03}, kGreen = {0.01, 0.09, 0.01};
  Photo photo;
  photo.linear = sim::Image(400, 400, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) {
      const sim::Direction d = sim::direction_of_pixel(scene.camera, x + 0.5, y + 0.5);
      if (!(d.elevation_deg > 0.0)) continue;
      const double above = border_km - aside_km(d.azimuth_deg, d.elevation_deg, towards_deg);
      const double light =
          above > -60.0 ? 1.0 / (1.0 + std::exp(-above / 1.5)) * std::exp(-0.5 * std::pow(above / 12.0, 2))
                        : 0.0;
      for (int c = 0; c < 3; ++c) {
        const std::size_t k = static_cast<std::size_t>(c);
        const double value = kSky[k] + light * kGreen[k];
        const sim::Words w = sim::random_words(23, sim::Stream::photon_noise, static_cast<std::uint32_t>(x),
                                               static_cast<std::uint32_t>(3 * y + c));
        photo.linear.at(x, y, c) = static_cast<float>(
            value + 0.02 * std::sqrt(value) * std::sqrt(-2.0 * std::log(sim::uniform(w[0]))) *
                        std::cos(sim::kTwoPi * sim::uniform(w[1])));
      }
    }
  return photo;
}

TEST(HighBorder, OfABandNearTheZenithIsClaimedAlongItsCourse) {
  const sim::Scene scene = fisheye();
  constexpr double kBorder_km = 25.0;
  for (const double towards_deg : {0.0, 40.0, 315.0}) {
    SCOPED_TRACE(towards_deg);
    const Border border = trace_border(band(scene, kBorder_km, towards_deg), scene);
    ASSERT_GE(border.measured, 1);
    // The border's places, of which those from 42 to 74 degrees high must be found within 3 degrees. A trace
    // is false by the measure of docs/border.md if fewer than half of its points lie as near to it.
    const double least = std::cos(3.0 * sim::kRadiansPerDegree);
    const auto is_near = [&](const double* a, const double* b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > least;
    };
    std::vector<std::array<double, 3>> claimed, on_border;
    std::vector<std::size_t> trace_of;
    for (std::size_t t = 0; t < border.traces.size(); ++t)
      for (const BorderPoint& p : border.traces[t].points) {
        if (!border.traces[t].is_claimed() || !p.measured()) continue;
        EXPECT_LE(p.elevation_deg, 75.0);
        trace_of.push_back(t);
        claimed.emplace_back();
        sim::enu_of_direction({p.azimuth_deg, p.elevation_deg}, claimed.back().data());
      }
    std::size_t places = 0, found = 0;
    for (double off_deg = -85.0; off_deg <= 85.0; off_deg += 0.5) {
      const double along = std::cos(off_deg * sim::kRadiansPerDegree);
      const double elevation = std::atan(kHeight_km * along / kBorder_km) / sim::kRadiansPerDegree;
      on_border.emplace_back();
      double* here = on_border.back().data();
      sim::enu_of_direction({towards_deg + off_deg, elevation}, here);
      if (elevation < 42.0 || elevation > 74.0) continue;
      ++places;
      found += std::any_of(claimed.begin(), claimed.end(),
                           [&](const auto& there) { return is_near(here, there.data()); })
                   ? 1
                   : 0;
    }
    std::vector<std::size_t> points(border.traces.size(), 0), near(border.traces.size(), 0);
    for (std::size_t i = 0; i < claimed.size(); ++i) {
      ++points[trace_of[i]];
      near[trace_of[i]] +=
          std::any_of(on_border.begin(), on_border.end(),
                      [&](const auto& here) { return is_near(here.data(), claimed[i].data()); })
              ? 1
              : 0;
    }
    for (std::size_t t = 0; t < points.size(); ++t) EXPECT_GE(2 * near[t], points[t]) << "trace " << t;
    EXPECT_GT(found, 8 * places / 10) << found << " of " << places;
  }
}

TEST(SkyFrame, TurnsTheSkyWithoutBendingIt) {
  // Distances stay, the pole is where it was put, and down is down where both frames agree.
  const SkyFrame frame{45.0, 130.0};
  const sim::Direction pole = frame.direction(17.0, 90.0), opposite = frame.direction(0.0, 45.0);
  EXPECT_NEAR(pole.azimuth_deg, 130.0, 1e-9);
  EXPECT_NEAR(pole.elevation_deg, 45.0, 1e-9);
  EXPECT_NEAR(opposite.elevation_deg, 90.0, 1e-5);
  double a[3], b[3];
  sim::enu_of_direction(frame.direction(30.0, 20.0), a);
  sim::enu_of_direction(frame.direction(75.0, 60.0), b);
  double c[3], d[3];
  sim::enu_of_direction({30.0, 20.0}, c);
  sim::enu_of_direction({75.0, 60.0}, d);
  EXPECT_NEAR(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], c[0] * d[0] + c[1] * d[1] + c[2] * d[2], 1e-12);
  // Columns go clockwise, as azimuths do.
  EXPECT_GT(frame.direction(10.0, 10.0).azimuth_deg, frame.direction(0.0, 10.0).azimuth_deg);
  EXPECT_NEAR(SkyFrame{}.downwards(40.0, 30.0, 0.0), 1.0, 1e-12);
  EXPECT_NEAR(frame.downwards(0.0, 20.0, 0.0), 1.0, 1e-12);
  EXPECT_NEAR(frame.downwards(0.0, 70.0, 0.0), -1.0, 1e-12);
  // Across a line of 45 degrees on the sky.
  EXPECT_NEAR(SkyFrame{}.downwards(40.0, 30.0, std::cos(30.0 * sim::kRadiansPerDegree)), std::sqrt(0.5),
              1e-12);
}

}  // namespace
}  // namespace vegard::fit::high_border_test
