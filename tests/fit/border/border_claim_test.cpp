#include "fit/border/border_claim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "fit/border/border.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit::border_claim_test {
namespace {

using Rgb = std::array<double, 3>;
using Coloured = std::function<Rgb(double azimuth_deg, double elevation_deg)>;

sim::Scene fisheye() {
  return sim::parse_scene(
      "[site]\nlatitude_deg = 68\nlongitude_deg = 20\n[camera]\nmodel = \"equidistant\"\nwidth = 400\nheight "
      "= 400\nfocal_px = 125\nelevation_deg = 90\n",
      "scene");
}

/// With noise of a fiftieth of the root of the light, of each channel by itself (seed 11).
Photo drawn(const sim::Scene& scene, const Coloured& light) {
  Photo photo;
  const int width = scene.camera.width, height = scene.camera.height;
  photo.linear = sim::Image(width, height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const sim::Direction d = sim::direction_of_pixel(scene.camera, x + 0.5, y + 0.5);
      Rgb rgb{};
      if (std::isfinite(d.elevation_deg) && d.elevation_deg > 0.0)
        rgb = light(d.azimuth_deg, d.elevation_deg);
      for (int c = 0; c < 3; ++c) {
        const sim::Words w = sim::random_words(11, sim::Stream::photon_noise, static_cast<std::uint32_t>(x),
                                               static_cast<std::uint32_t>(3 * y + c));
        const double noise = 0.02 * std::sqrt(std::max(rgb[c], 0.01)) *
                             std::sqrt(-2.0 * std::log(sim::uniform(w[0]))) *
                             std::cos(sim::kTwoPi * sim::uniform(w[1]));
        photo.linear.at(x, y, c) = static_cast<float>(rgb[c] + noise);
      }
    }
  return photo;
}

/// A border at 25 degrees from azimuth 60 to 120, sharp below and soft above.
double arc(double azimuth_deg, double elevation_deg, double from_deg = 60.0, double to_deg = 120.0) {
  if (azimuth_deg < from_deg || azimuth_deg > to_deg) return 0.0;
  const double t = elevation_deg - 25.0;
  return 1.0 / (1.0 + std::exp(-t / 0.4)) * (t > 0.0 ? std::exp(-0.5 * t * t / 49.0) : 1.0);
}

constexpr Rgb kSky = {0.05, 0.045, 0.03};

Rgb with(double share, const Rgb& colour) {
  return {kSky[0] + share * colour[0], kSky[1] + share * colour[1], kSky[2] + share * colour[2]};
}

TEST(BorderClaim, GoesToGreenLightAndNotToTheSameEdgeInTheColoursOfTheSkyOrOfLamps) {
  const sim::Scene scene = fisheye();
  const auto traced = [&](const Rgb& colour) {
    return trace_border(drawn(scene, [&](double a, double e) { return with(arc(a, e), colour); }), scene);
  };
  const Border aurora = traced({0.01, 0.06, 0.01});
  ASSERT_EQ(aurora.measured, 1);
  EXPECT_GE(aurora.traces[0].aurora_probability, kClaimedProbability);
  EXPECT_TRUE(aurora.traces[0].doubt.empty());
  for (const Rgb& colour : {Rgb{0.067, 0.06, 0.04}, Rgb{0.13, 0.06, 0.02}, Rgb{0.06, 0.07, 0.10}}) {
    const Border other = traced(colour);
    EXPECT_EQ(other.measured, 0) << colour[0];
    ASSERT_FALSE(other.traces.empty());
    EXPECT_LT(other.traces[0].aurora_probability, kClaimedProbability);
    EXPECT_FALSE(other.traces[0].doubt.empty());
    EXPECT_NE(other.notes.front().find(other.traces[0].doubt), std::string::npos);
  }
}

TEST(BorderClaim, EndsWhereAnArcGoesOverIntoACloud) {
  const sim::Scene scene = fisheye();
  const Border border = trace_border(drawn(scene,
                                           [](double a, double e) {
                                             Rgb rgb = with(arc(a, e, 60.0, 100.0), {0.01, 0.06, 0.01});
                                             const double cloud = arc(a, e, 100.0, 140.0);
                                             rgb[0] += 0.12 * cloud, rgb[1] += 0.06 * cloud;
                                             return rgb;
                                           }),
                                     scene);
  ASSERT_EQ(border.measured, 1);
  EXPECT_NEAR(border.traces[0].points.front().azimuth_deg, 60.0, 3.0);
  // The colour is measured over five degrees on each side.
  EXPECT_NEAR(border.traces[0].points.back().azimuth_deg, 100.0, 5.0);
}

TEST(BorderClaim, DoesNotGoToAStepOfTheDetectorOrACircle) {
  const sim::Scene scene = fisheye();
  Photo photo = drawn(scene, [](double, double) { return Rgb{0.1, 0.1, 0.1}; });
  for (int y = 0; y < 130; ++y)
    for (int x = 0; x < 400; ++x)
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) *= 0.6f;
  for (std::size_t i = 0; i < photo.linear.data.size(); i += 3)
    photo.linear.data[i] = photo.linear.data[i + 2] = photo.linear.data[i + 1];
  EXPECT_EQ(trace_border(photo, scene).measured, 0);
  // Light of a ring about the zenith, as a lens makes it: no arc stays at one elevation over 150 degrees.
  const Border ring = trace_border(drawn(scene,
                                         [](double a, double e) {
                                           const double v = 0.1 + 0.06 * arc(a, e, 20.0, 170.0);
                                           return Rgb{v, v, v};
                                         }),
                                   scene);
  EXPECT_EQ(ring.measured, 0);
}

TEST(BorderClaim, DoesNotGoToTheSidesOfStars) {
  // Two thousand stars, three pixels wide, of random places and brightness (seed 5), and nothing else.
  const sim::Scene scene = fisheye();
  Photo photo = drawn(scene, [](double, double) { return kSky; });
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const sim::Words w = sim::random_words(5, sim::Stream::photon_noise, i, 0);
    const int x = 2 + static_cast<int>(396.0 * sim::uniform(w[0])),
              y = 2 + static_cast<int>(396.0 * sim::uniform(w[1]));
    const double light = 0.02 / std::max(0.02, sim::uniform(w[2]));
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int c = 0; c < 3; ++c)
          photo.linear.at(x + dx, y + dy, c) += static_cast<float>(light * (dx == 0 && dy == 0 ? 1.0 : 0.4));
  }
  EXPECT_EQ(trace_border(photo, scene).measured, 0);
}

TEST(BorderClaim, KnowsTheMilkyWayOfATimeAndPlace) {
  // The evidence alone: two borders that differ only in where the galaxy stands.
  BorderEvidence evidence;
  evidence.points = 40, evidence.length_deg = 40.0, evidence.continuity = 0.9, evidence.contrast = 0.5;
  evidence.sharper_below = 0.4, evidence.roughness_deg = 0.2;
  BorderTrace trace;
  trace.measured = 40;
  judge_border(trace, evidence, {}, {});
  const double elsewhere = trace.aurora_probability;
  evidence.in_milky_way = 1.0;
  judge_border(trace, evidence, {}, {});
  EXPECT_LT(trace.aurora_probability, 0.5 * elsewhere);
  EXPECT_EQ(trace.doubt.empty(), trace.is_claimed());
}

}  // namespace
}  // namespace vegard::fit::border_claim_test
