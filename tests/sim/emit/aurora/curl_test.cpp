#include "sim/emit/aurora/sheet_structures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/emit/aurora/sheet.h"

namespace vegard::sim::curl_test {
namespace {

Sheet curled_sheet() {
  Sheet sheet;
  sheet.curl_spacing_km = 12.0;
  sheet.curl_radius_km = 1.2;
  sheet.curl_turn_rad = 3.0;
  sheet.curl_gather = 0.6;
  return sheet;
}

LayerStructure structure_of(const Sheet& sheet, double instant_s = 0.0, double drifted_km = 0.0) {
  return {Folds(sheet, 0, 5, instant_s, drifted_km), Curls(sheet, 0, 5, instant_s, drifted_km)};
}

/// The curl nearest to a place.
Curl curl_near(const LayerStructure& structure, double along_km) {
  Curl nearest;
  nearest.center_km = 1e9;
  for (double a = along_km - 12.0; a <= along_km + 12.0; a += 1.0)
    structure.curls.near(a, [&](const Curl& curl) {
      if (std::abs(curl.center_km - along_km) < std::abs(nearest.center_km - along_km)) nearest = curl;
    });
  return nearest;
}

/// Where a beam comes to on a layer that is a straight line but for its structure.
PlanePoint<double> straight_point(const LayerStructure& structure, double along_km, double across_km) {
  PlanePoint<double> point = structured_point<double>({0.0, 0.1, 0.0}, structure, 0.5, along_km, across_km);
  point.x_km += along_km;
  return point;
}

TEST(Curl, GathersBeamsInItsCentreInTheirOrder) {
  const Sheet sheet = curled_sheet();
  const Curl curl = curl_near(structure_of(sheet), 50.0);
  constexpr double h = 1e-5;
  // Beams per kilometre, of what they would be without the curl: 1 over the slope of the map.
  const double spacing = (curl.gathered(curl.center_km + h) - curl.gathered(curl.center_km - h)) / (2.0 * h);
  EXPECT_NEAR(1.0 / spacing, 1.0 / (1.0 - 0.6), 1e-6);
  double before = -1e9;
  for (double x = -8.0; x <= 8.0; x += 0.01) {
    const double now = curl.gathered(curl.center_km + x);
    EXPECT_GT(now, before);
    before = now;
  }
  EXPECT_NEAR(curl.gathered(curl.center_km + 6.0), curl.center_km + 6.0, 1e-9);
}

// x (1 - g exp(-x² / R²)): at a radius 1 / e of the gathering is left, at two 1 / e⁴.
TEST(Curl, GathersByAGaussianOfItsRadius) {
  const Curl curl{5.0, 2.0, 0.6, 0.0};
  EXPECT_NEAR(curl.gathered(7.0), 5.0 + 2.0 * (1.0 - 0.6 * std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(curl.gathered(1.0), 5.0 - 4.0 * (1.0 - 0.6 * std::exp(-4.0)), 1e-12);
}

TEST(Curl, TurnsItsCentreClockwiseSeenFromAboveAndKeepsAreas) {
  Sheet sheet = curled_sheet();
  sheet.curl_gather = 0.0;
  const LayerStructure structure = structure_of(sheet);
  const Curl curl = curl_near(structure, 50.0);
  constexpr double h = 1e-5;
  const PlanePoint<double> turned = straight_point(structure, curl.center_km + h, 0.0);
  EXPECT_NEAR(turned.x_km - curl.center_km, h * std::cos(3.0), 1e-9);
  EXPECT_NEAR(turned.aside_km, -h * std::sin(3.0), 1e-9);
  for (double x = -8.0; x <= 8.0; x += 0.37)
    for (double y = -3.0; y <= 3.0; y += 0.31) {
      const double at = curl.center_km + x;
      const PlanePoint<double> e = straight_point(structure, at + h, y),
                               w = straight_point(structure, at - h, y),
                               n = straight_point(structure, at, y + h),
                               s = straight_point(structure, at, y - h);
      const double area =
          (e.x_km - w.x_km) * (n.aside_km - s.aside_km) - (n.x_km - s.x_km) * (e.aside_km - w.aside_km);
      EXPECT_NEAR(area / (4.0 * h * h), 1.0, 1e-6) << x << " " << y;
    }
}

TEST(Curl, LeavesDistantBeamsWhereTheyStand) {
  const LayerStructure structure = structure_of(curled_sheet());
  const Curl curl = curl_near(structure, 50.0), next = curl_near(structure, curl.center_km + 12.0);
  // Half-way between the two, a beam is moved by no more than (gather + turn) * distance * exp(-distance^2 /
  // R^2) for either.
  const double distance = 0.5 * (next.center_km - curl.center_km);
  ASSERT_GT(distance, 3.0 * 1.2);
  const PlanePoint<double> point = straight_point(structure, curl.center_km + distance, 0.3);
  const Sheet sheet = curled_sheet();
  const double bound = 2.0 * (sheet.curl_gather + std::abs(sheet.curl_turn_rad)) * std::hypot(distance, 0.3) *
                       std::exp(-distance * distance / (sheet.curl_radius_km * sheet.curl_radius_km));
  ASSERT_LT(bound, 0.01);
  EXPECT_NEAR(point.x_km, curl.center_km + distance, bound);
  EXPECT_NEAR(point.aside_km, 0.3, bound);
}

TEST(Curls, TravelWithTheirSpeedAndTheSheet) {
  Sheet sheet = curled_sheet();
  sheet.curl_speed_km_s = 8.5;
  const LayerStructure before = structure_of(sheet), after = structure_of(sheet, 2.0, 3.0);
  for (double a = 40.0; a < 90.0; a += 0.9) {
    const PlanePoint<double> old_point = straight_point(before, a, 0.2),
                             new_point = straight_point(after, a + 20.0, 0.2);
    EXPECT_NEAR(new_point.x_km, old_point.x_km + 20.0, 1e-9);
    EXPECT_NEAR(new_point.aside_km, old_point.aside_km, 1e-9);
  }
}

TEST(Curls, StandAtTheirMeanSpacing) {
  const Sheet sheet = curled_sheet();
  const Curls curls(sheet, 0, 5, 0.0, 0.0);
  std::vector<double> centers;
  for (double a = -3000.0; a < 3000.0; a += 2.0)
    curls.near(a, [&](const Curl& curl) {
      if (centers.empty() || curl.center_km > centers.back() + 1e-9) centers.push_back(curl.center_km);
    });
  ASSERT_NEAR(centers.size(), 500u, 3);
  // Shifts are at most a quarter of the spacing, so distances lie between a half of it and one and a half.
  double shortest = 1e9, longest = 0.0;
  for (std::size_t i = 1; i < centers.size(); ++i) {
    shortest = std::min(shortest, centers[i] - centers[i - 1]);
    longest = std::max(longest, centers[i] - centers[i - 1]);
  }
  EXPECT_GE(shortest, 6.0);
  EXPECT_LT(shortest, 8.0);
  EXPECT_LE(longest, 18.0);
  EXPECT_GT(longest, 16.0);
}

// A spiral turns about one point for all layers of its arc: they stay where they were against each other, and
// so do areas, but for what is left of a neighbour where it is let go, five to six radii off: 1e-4.
TEST(Spirals, WindAllLayersUpAboutOnePointAndKeepAreas) {
  Sheet sheet;
  sheet.spiral_spacing_km = 150.0;
  const LayerStructure structure(sheet, 0, 3, 5, 0.0, 0.0);
  ASSERT_TRUE(structure.any());
  EXPECT_FALSE(structure.curls.any());
  Curl spiral;
  spiral.center_km = 1e9;
  structure.spirals.near(0.0, [&](const Curl& s) {
    if (std::abs(s.center_km) < std::abs(spiral.center_km)) spiral = s;
  });
  const auto at = [&](double along, double layer_aside, double across) {
    const LayerSine<double> layer{layer_aside, 0.0, 1.5707963267948966}, middle{0.0, 0.0, 0.0};
    PlanePoint<double> p = structured_point(layer, structure, 0.5, along, across, middle);
    p.x_km += along;
    return p;
  };
  constexpr double h = 1e-4;
  double moved = 0.0;
  for (double x = -60.0; x <= 60.0; x += 7.3)
    for (double aside : {-4.0, 0.0, 5.0}) {
      const double along = spiral.center_km + x;
      // Whatever layer a place belongs to, it goes to the same point.
      const PlanePoint<double> by_layer = at(along, aside, 0.0), by_width = at(along, 0.0, aside);
      EXPECT_NEAR(by_layer.x_km, by_width.x_km, 1e-9);
      EXPECT_NEAR(by_layer.aside_km, by_width.aside_km, 1e-9);
      const PlanePoint<double> e = at(along + h, 0.0, aside), w = at(along - h, 0.0, aside),
                               n = at(along, 0.0, aside + h), s = at(along, 0.0, aside - h);
      const double area =
          (e.x_km - w.x_km) * (n.aside_km - s.aside_km) - (n.x_km - s.x_km) * (e.aside_km - w.aside_km);
      EXPECT_NEAR(area / (4.0 * h * h), 1.0, 2e-4) << x << " " << aside;
      moved = std::max(moved, std::abs(by_layer.aside_km - aside));
    }
  EXPECT_GT(moved, 10.0);
}

TEST(Spirals, WindUpAndUnwindInTheirLifetime) {
  Sheet sheet;
  sheet.spiral_spacing_km = 150.0;
  sheet.spiral_lifetime_s = 60.0;
  sheet.spiral_speed_km_s = 4.0;
  double most = 0.0, least = 1e9;
  for (double t = 0.0; t < 120.0; t += 0.5) {
    const Curls spirals = Curls::spirals(sheet, 0, 5, t, 0.0);
    double turn = 0.0;
    spirals.near(4.0 * t, [&](const Curl& s) {
      if (std::abs(s.center_km - 4.0 * t) < 75.0) turn = -s.turn_rad;
    });
    most = std::max(most, turn);
    least = std::min(least, turn);
  }
  EXPECT_NEAR(most, sheet.spiral_turn_rad, 0.01);
  EXPECT_NEAR(least, 0.0, 0.01);
}

TEST(Curls, ComeAndGoWithoutAJumpEvenOnFolds) {
  Sheet sheet = curled_sheet();
  sheet.curl_lifetime_s = 0.5;
  sheet.fold_spacing_km = 30.0;
  sheet.fold_length_km = 20.0;
  sheet.fold_stage_spread = 0.0;
  double moved = 0.0;
  const auto at = [&](double t, double a) {
    return structured_point<double>({3.0, 0.1, 0.1 * a}, structure_of(sheet, t), 1.0, a, 0.3);
  };
  for (double t = 0.0; t < 1.5; t += 0.001)
    for (double a : {3.0, 9.0, 17.0}) {
      // Some 20 km/s at most.
      const PlanePoint<double> now = at(t, a), next = at(t + 0.001, a);
      EXPECT_NEAR(now.x_km, next.x_km, 0.03);
      EXPECT_NEAR(now.aside_km, next.aside_km, 0.03);
      moved = std::max(moved, std::abs(now.aside_km - at(0.0, a).aside_km));
    }
  EXPECT_GT(moved, 0.3);
  for (double a = 0.0; a < 200.0; a += 0.001) {
    // A curl and a fold stretch neighbours' distance by some tens of times.
    const PlanePoint<double> now = at(0.3, a), next = at(0.3, a + 0.001);
    EXPECT_NEAR(now.x_km, next.x_km, 0.03) << a;
    EXPECT_NEAR(now.aside_km, next.aside_km, 0.03) << a;
  }
}

}  // namespace
}  // namespace vegard::sim::curl_test
