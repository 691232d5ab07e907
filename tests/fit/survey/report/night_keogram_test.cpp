// Borders over a keogram: made arcs in every quarter of the sky must be drawn where the keogram has their
// light.
#include "fit/survey/report/night_keogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fit/photo/photo.h"
#include "sim/base/number/constants.h"
#include "tests/support/fisheye_map.h"

namespace vegard::fit::night_keogram_test {
namespace {

constexpr int kSize = 240;
constexpr double kRadius = 118.0;

/// Elevation of the arc at an azimuth: a great circle, as a far straight arc is.
double arc_elevation_deg(const BorderAtTime& arc, double azimuth_deg) {
  const double off = std::remainder(azimuth_deg - arc.highest_azimuth_deg, 360.0) * sim::kRadiansPerDegree;
  return std::atan(std::tan(arc.highest_deg * sim::kRadiansPerDegree) * std::cos(off)) /
         sim::kRadiansPerDegree;
}

/// A narrow arc within `half_deg` of where it is highest.
BorderAtTime made_arc(double time_s, double azimuth_deg, double highest_deg, double half_deg) {
  BorderAtTime arc;
  arc.time_s = time_s;
  arc.highest_azimuth_deg = azimuth_deg;
  arc.highest_deg = highest_deg;
  arc.sigma_deg = 0.2;
  arc.is_good = true;
  arc.from_azimuth_deg = std::fmod(azimuth_deg - half_deg + 360.0, 360.0);
  arc.to_azimuth_deg = std::fmod(azimuth_deg + half_deg, 360.0);
  arc.lowest_deg = arc_elevation_deg(arc, azimuth_deg + half_deg);
  return arc;
}

Photo picture_of(const BorderAtTime& arc, double half_deg, const sim::DirectionMap& map) {
  constexpr double kArcWidth_deg = 1.5;
  Photo photo;
  photo.linear = sim::Image(map.width, map.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  photo.decoding = "linear (made up)";
  photo.file_name = "made";
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = map.index(x, y);
      const double azimuth = map.azimuth_deg[i];
      double light = 0.01;
      if (!std::isnan(azimuth) &&
          std::abs(std::remainder(azimuth - arc.highest_azimuth_deg, 360.0)) < half_deg)
        light +=
            std::exp(-std::pow((map.elevation_deg[i] - arc_elevation_deg(arc, azimuth)) / kArcWidth_deg, 2));
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = static_cast<float>(light);
    }
  return photo;
}

std::size_t brightest_place(const KeogramColumn& column) {
  std::size_t best = 0;
  for (std::size_t p = 0; 3 * p < column.mean.size(); ++p)
    if (column.mean[3 * p] > column.mean[3 * best]) best = p;
  return best;
}

TEST(NightKeogram, DrawsABorderWhereTheKeogramHasItsLight) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  constexpr double kHalf_deg = 70.0;
  // The plane's azimuth is that of the horizon at the top; arcs are to its front, behind, and at both sides.
  for (const double plane_deg : {0.0, 25.0, 170.0, 349.0}) {
    const KeogramLine line = meridian_line(map, {0, 0, kSize, kSize}, {plane_deg, {}, {}});
    Keogram keogram;
    keogram.time_kind = PictureTimes::Kind::utc;
    keogram.line = line;
    NightDigest digest;
    const std::vector<double> turns = {0.0, 45.0, 63.0, 117.0, 135.0, 180.0, 225.0, 250.0, 290.0, 315.0};
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const double time_s = 1.5e9 + 60.0 * static_cast<double>(k);
      const BorderAtTime arc = made_arc(time_s, std::fmod(plane_deg + turns[k], 360.0), 35.0, kHalf_deg);
      digest.borders.push_back(arc);
      add_picture(picture_of(arc, kHalf_deg, map), time_s, keogram);
    }
    const Plot plot = keogram_with_border(keogram, digest, {1.5e9, 1.5e9 + 600.0});
    ASSERT_EQ(plot.panels.front().series.size(), 1u);
    const Series& drawn = plot.panels.front().series.front();
    ASSERT_EQ(drawn.y.size(), turns.size());
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const double light_deg = line.position[brightest_place(keogram.columns[k])];
      // A step is a little more than a pixel; a border that crosses aslant is spread over the strip's width.
      EXPECT_NEAR(drawn.y[k], light_deg, line.step + line.width) << plane_deg << " " << turns[k];
      EXPECT_EQ(drawn.y[k] > 90.0, turns[k] > 90.0 && turns[k] < 270.0) << plane_deg << " " << turns[k];
      EXPECT_EQ(drawn.x[k], keogram.columns[k].time);
    }
  }
}

TEST(NightKeogram, DrawsNoBorderThatDoesNotReachThePlane) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, kRadius);
  const KeogramLine line = meridian_line(map, {0, 0, kSize, kSize}, {0.0, {}, {}});
  EXPECT_FALSE(crossing_deg(made_arc(0.0, 60.0, 30.0, 40.0), line));
  EXPECT_TRUE(crossing_deg(made_arc(0.0, 60.0, 30.0, 65.0), line));
  EXPECT_FALSE(crossing_deg(made_arc(0.0, 240.0, 30.0, 40.0), line));
  EXPECT_FALSE(crossing_deg(made_arc(0.0, 0.0, 30.0, 40.0), column_line({0, 0, kSize, kSize}, 0)));
}

}  // namespace
}  // namespace vegard::fit::night_keogram_test
