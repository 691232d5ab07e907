#include "fit/triangulation/triangulated_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "fit/triangulation/matched_curves.h"
#include "sim/base/number/constants.h"

namespace vegard::fit::triangulated_point_test {
namespace {

PlacedCamera all_sky(double latitude_deg, double longitude_deg, double pointing_error_deg = 0.05) {
  PlacedCamera camera;
  camera.camera.model = sim::LensModel::equidistant;
  camera.camera.width = camera.camera.height = 1000;
  camera.camera.focal_px = 300.0;
  camera.camera.elevation_deg = 90.0;
  camera.site.latitude_deg = latitude_deg;
  camera.site.longitude_deg = longitude_deg;
  camera.site.altitude_m = 400.0;
  camera.pointing_error_deg = pointing_error_deg;
  return camera;
}

std::vector<ViewPoint> views(const std::vector<PlacedCamera>& cameras, EarthShape shape = EarthShape::wgs84) {
  std::vector<ViewPoint> out;
  for (const PlacedCamera& camera : cameras) out.emplace_back(camera, shape);
  return out;
}

std::vector<Sight> sights_of(const std::vector<ViewPoint>& cameras, const Eigen::Vector3d& place_km) {
  std::vector<Sight> sights;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    sights.emplace_back();
    sights.back().camera = i;
    sights.back().pixel = cameras[i].pixel(place_km).value();
    sights.back().pixel_error_px = 0.5;
  }
  return sights;
}

TEST(EarthShape, IsTheEllipsoidOfMaps) {
  // The corners of the ellipsoid: the poles are a (1 - f) from the centre.
  const Eigen::Vector3d pole = earth_place_km(EarthShape::wgs84, GeodeticPlace{90.0, 0.0, 10.0});
  EXPECT_NEAR(pole[2], 6356.752314245 + 10.0, 1e-6);  // NIMA TR8350.2, table 3.1: the polar semi-axis
  EXPECT_NEAR(earth_place_km(EarthShape::wgs84, GeodeticPlace{0.0, 90.0, 0.0})[1], 6378.137, 1e-9);
  for (const double latitude : {-90.0, -67.3, 0.0, 0.001, 45.0, 69.3, 89.999})
    for (const double height : {-0.1, 0.0, 105.0, 900.0}) {
      for (const EarthShape shape : {EarthShape::wgs84, EarthShape::sphere}) {
        const GeodeticPlace back =
            geodetic_place(shape, earth_place_km(shape, GeodeticPlace{latitude, 20.5, height}));
        EXPECT_NEAR(back.latitude_deg, latitude, 1e-9);
        EXPECT_NEAR(back.height_km, height, 1e-8);
        EXPECT_TRUE(std::abs(latitude) > 89.9 || std::abs(back.longitude_deg - 20.5) < 1e-9);
      }
    }
}

TEST(TriangulatedPoint, IsTheSourceOfItsSights) {
  const GeodeticPlace truth{68.7, 20.2, 112.0};
  const std::vector<PlacedCamera> three = {all_sky(69.35, 20.36), all_sky(68.03, 21.69), all_sky(67.8, 18.0)};
  for (const EarthShape shape : {EarthShape::wgs84, EarthShape::sphere})
    for (const std::size_t count : {2u, 3u}) {
      const auto cameras = views({three.begin(), three.begin() + static_cast<std::ptrdiff_t>(count)}, shape);
      const TriangulatedPoint point =
          triangulated(cameras, sights_of(cameras, earth_place_km(shape, truth)), 0.0);
      ASSERT_TRUE(point.is_given());
      EXPECT_NEAR(point.place.latitude_deg, truth.latitude_deg, 1e-6);
      EXPECT_NEAR(point.place.longitude_deg, truth.longitude_deg, 1e-6);
      // The refraction's formula and its inverse have the air's pressure from formulas that differ a little.
      EXPECT_NEAR(point.place.height_km, truth.height_km, 1e-3);
      EXPECT_LT(point.miss_km, 1e-3);
      EXPECT_EQ(point.freedom, 2 * static_cast<int>(count) - 3);
      EXPECT_LT(point.chi2, 1e-6);
    }
}

TEST(TriangulatedPoint, MissesByWhatTheLinesMiss) {
  // Two lines that cross at right angles below a place: each is turned by a known angle out of their plane.
  const auto cameras = views({all_sky(69.0, 20.0, 0.0), all_sky(68.0, 20.0, 0.0)});
  const Eigen::Vector3d place = earth_place_km(EarthShape::wgs84, GeodeticPlace{68.5, 20.0, 110.0});
  std::vector<Sight> sights = sights_of(cameras, place);
  const Eigen::Vector3d east = east_north_up({68.5, 20.0, 0.0}).row(0);
  sights[0].pixel = cameras[0].pixel(place + 1.0 * east).value();
  sights[1].pixel = cameras[1].pixel(place - 1.0 * east).value();
  const TriangulatedPoint point = triangulated(cameras, sights, 0.0);
  ASSERT_TRUE(point.is_given());
  EXPECT_NEAR(point.miss_km, 2.0, 0.01);
  EXPECT_LT(point.probability, 1e-3);  // 2 km in 125 km, where half a pixel of 300 to a radian is 0.2 km
}

TEST(TriangulatedPoint, HasAReasonWhereThereIsNone) {
  const auto cameras = views({all_sky(69.0, 20.0), all_sky(68.0, 20.0)});
  const Eigen::Vector3d place = earth_place_km(EarthShape::wgs84, GeodeticPlace{68.5, 20.0, 110.0});
  std::vector<Sight> sights = sights_of(cameras, place);
  const auto reason = [&] { return triangulated(cameras, sights, 0.0).reason; };
  EXPECT_EQ(reason(), NoPlace::none);
  std::swap(sights[0].pixel, sights[1].pixel);
  EXPECT_EQ(reason(), NoPlace::behind);
  sights = sights_of(cameras, place);
  const Eigen::Vector3d direction = cameras[0].direction(sights[0].pixel).value();
  sights[1].pixel = cameras[1].pixel(cameras[1].place_km() + 1e9 * direction).value();
  EXPECT_EQ(reason(), NoPlace::parallel);
  sights[1].pixel.x_px = 3000.0;
  EXPECT_EQ(reason(), NoPlace::outside_lens);
  // One place, the same camera twice.
  const auto twice = views({all_sky(69.0, 20.0), all_sky(69.0, 20.0)});
  EXPECT_EQ(triangulated(twice, sights_of(twice, place), 0.0).reason, NoPlace::parallel);
  const Eigen::Vector3d hidden = earth_place_km(EarthShape::wgs84, GeodeticPlace{68.5, 33.0, 1.0});
  sights = sights_of(cameras, hidden);
  EXPECT_EQ(reason(), NoPlace::underground);
  EXPECT_TRUE(std::isnan(triangulated(twice, sights_of(twice, place), 0.0).place.height_km));
}

/// Cameras as they are, and what is believed of them: turned and late by chance.
struct Truth {
  std::vector<ViewPoint> seen, believed;
  std::vector<Eigen::Vector3d> moved_km;  ///< the light, at each camera's instant
};

Truth chance_pair(std::mt19937_64& random, double turn_deg, double clock_s, double drift_km_s) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double base_deg = (20.0 + 280.0 * uniform(random)) / 111.2, towards = sim::kTwoPi * uniform(random);
  Truth truth;
  std::vector<PlacedCamera> cameras = {
      all_sky(67.0, 20.0, turn_deg),
      all_sky(67.0 + base_deg * std::cos(towards),
              20.0 + base_deg * std::sin(towards) / std::cos(67.0 * sim::kRadiansPerDegree), turn_deg)};
  for (PlacedCamera& camera : cameras) {
    camera.clock_error_s = clock_s;
    truth.believed.emplace_back(camera, EarthShape::wgs84);
    // About the zenith's axis and two level ones: azimuth and, for an axis near the zenith, a tilt.
    const double tilt = turn_deg * std::hypot(normal(random), normal(random));
    const double side = 360.0 * uniform(random);
    camera.camera.azimuth_deg = side;
    camera.camera.roll_deg = -side + turn_deg * normal(random);
    camera.camera.elevation_deg = 90.0 - tilt;
    truth.seen.emplace_back(camera, EarthShape::wgs84);
    const Eigen::Matrix3d axes = east_north_up({67.0, 20.0, 0.0});
    const double moved_km = clock_s * drift_km_s;
    truth.moved_km.push_back(axes.transpose() *
                             Eigen::Vector3d(moved_km * normal(random), moved_km * normal(random), 0.0));
  }
  return truth;
}

// 300 pairs, seed 47: the share within one standard error is 68.3 % ± 2.7 %; three of these are allowed.
TEST(TriangulatedPoint, ErrorsHoldTheTruth) {
  std::mt19937_64 random(47);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  int given = 0, within = 0, curve_within = 0, curves = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double drift_km_s = 0.5;
    const Truth truth = chance_pair(random, 0.1, 3.0, drift_km_s);
    const GeodeticPlace place{66.0 + 2.5 * uniform(random), 17.0 + 6.0 * uniform(random),
                              95.0 + 60.0 * uniform(random)};
    const Eigen::Vector3d at = earth_place_km(EarthShape::wgs84, place);
    std::vector<Sight> sights;
    std::vector<PictureCurve> lines(2);
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Vector3d seen = at + truth.moved_km[i];
      const auto pixel = truth.seen[i].pixel(seen);
      ASSERT_TRUE(pixel);
      sights.emplace_back();
      sights[i].camera = i;
      sights[i].pixel_error_px = 0.5;
      sights[i].pixel = {pixel->x_px + 0.5 * normal(random), pixel->y_px + 0.5 * normal(random)};
      // A level curve through the place, from south-west to north-east.
      lines[i].camera = i;
      const Eigen::Matrix3d axes = east_north_up(place);
      const Eigen::Vector3d along = (axes.row(0) + axes.row(1)).transpose() / std::sqrt(2.0);
      const double off_px = 0.5 * normal(random);
      const auto ahead = truth.seen[i].pixel(seen + along);
      ASSERT_TRUE(ahead);
      const Eigen::Vector2d across =
          Eigen::Vector2d(-(ahead->y_px - pixel->y_px), ahead->x_px - pixel->x_px).normalized();
      // Of the first camera one point in the middle of the curve is matched.
      for (int k = -8; k <= 8; ++k) {
        const auto one = truth.seen[i].pixel(seen + 10.0 * k * along);
        ASSERT_TRUE(one);
        lines[i].points.push_back({one->x_px + off_px * across[0], one->y_px + off_px * across[1]});
        lines[i].error_px.push_back(0.5);
      }
    }
    const TriangulatedPoint point = triangulated(truth.believed, sights, drift_km_s);
    if (point.is_given() && point.height_error_km < 0.1 * place.height_km) {
      ++given;
      within += std::abs(point.place.height_km - place.height_km) < point.height_error_km;
    }
    const MatchedCurves matched =
        matched_curves(truth.believed, lines[0], lines[1], {60.0, 500.0}, drift_km_s);
    for (const CurveMatch& match : matched.matches)
      if (match.vertex == 8 && match.branch == 0 && match.point.height_error_km < 0.1 * place.height_km) {
        ++curves;
        curve_within += std::abs(match.point.place.height_km - place.height_km) < match.point.height_error_km;
      }
  }
  EXPECT_GT(given, 200);
  EXPECT_GT(curves, 150);
  const double share = static_cast<double>(within) / given;
  const double of_curves = static_cast<double>(curve_within) / curves;
  EXPECT_GT(share, 0.61);
  EXPECT_LT(share, 0.76);
  EXPECT_GT(of_curves, 0.60);
  EXPECT_LT(of_curves, 0.76);
}

/// An arc over a stretch of longitudes, as a camera sees it.
PictureCurve arc_of(const std::vector<ViewPoint>& cameras, std::size_t camera, double latitude_deg,
                    double turn, double height_km) {
  PictureCurve curve;
  curve.camera = camera;
  for (int k = -15; k <= 15; ++k) {
    const GeodeticPlace place{latitude_deg + turn * 0.2 * k, 20.0 + 0.2 * k, height_km};
    curve.points.push_back(cameras[camera].pixel(earth_place_km(EarthShape::wgs84, place)).value());
    curve.error_px.push_back(0.5);
  }
  return curve;
}

TEST(MatchedCurves, OfOneArcAreClear) {
  const auto cameras = views({all_sky(69.0, 20.0), all_sky(68.0, 20.0)});
  const MatchedCurves matched = matched_curves(cameras, arc_of(cameras, 0, 68.6, 0.0, 105.0),
                                               arc_of(cameras, 1, 68.6, 0.0, 105.0), {60.0, 500.0}, 0.0);
  ASSERT_FALSE(matched.branches.empty());
  const CurveBranch& best = matched.branches.front();
  EXPECT_NEAR(best.mean.km, 105.0, 3.0 * best.mean.error_km);
  EXPECT_TRUE(doubts_about(best, best.weight).empty());
}

TEST(MatchedCurves, OfTwoArcsThatCrossByAccidentAreNotClear) {
  // Each camera sees another arc; from the two places they seem to cross, at a height that is none.
  const auto cameras = views({all_sky(69.0, 20.0), all_sky(68.0, 20.0)});
  const MatchedCurves matched = matched_curves(cameras, arc_of(cameras, 0, 68.6, 0.0, 105.0),
                                               arc_of(cameras, 1, 68.6, 1.0, 105.0), {60.0, 500.0}, 0.0);
  ASSERT_FALSE(matched.branches.empty());
  const CurveBranch& best = matched.branches.front();
  EXPECT_FALSE(doubts_about(best, best.weight).empty());
}

TEST(MatchedCurves, AreDoubtedForEachReasonAlone) {
  EXPECT_TRUE(doubts_about(CurveBranch{1.0, 1.0, 0.0, {31, 105.0, 1.0, 1.0, 1.0}, 1.0}, 1.0).empty());
  EXPECT_EQ(doubts_about(CurveBranch{1.0, 0.03, 0.0, {1, 105.0, 1.0, 1.0, 0.0}, 1.0}, 1.0).size(), 2u);
  EXPECT_EQ(doubts_about(CurveBranch{1.0, 1.0, 0.0, {31, 105.0, 1.0, 1.0, 20.0}, 1.0}, 1.0).size(), 1u);
  EXPECT_EQ(doubts_about(CurveBranch{sim::kNaN, 1.0, 0.0, {31, 105.0, 1.0, 1.0, 1.0}, 1.0}, sim::kNaN).size(),
            1u);
}

TEST(TriangulatedPoint, HasNoPlaceForAPixelOutsideThePicture) {
  const auto cameras = views({all_sky(69.0, 20.0), all_sky(68.0, 20.0)});
  std::vector<Sight> sights =
      sights_of(cameras, earth_place_km(EarthShape::wgs84, GeodeticPlace{68.5, 20.0, 110.0}));
  sights[0].pixel.x_px = 1000.5;
  EXPECT_EQ(triangulated(cameras, sights, 0.0).reason, NoPlace::outside_lens);
}

}  // namespace
}  // namespace vegard::fit::triangulated_point_test
