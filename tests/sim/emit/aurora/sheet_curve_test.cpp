#include "sim/emit/aurora/sheet_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/curve_foot.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/light/sample.h"

namespace vegard::sim::sheet_curve_test {
namespace {

double plain(const double& number) { return number; }

Sheet bent() {
  Sheet sheet;
  sheet.course = SheetCourse::curve;
  sheet.east_km = {-120.0, -60.0, -50.0, 40.0, 55.0, 150.0};
  sheet.north_km = {180.0, 210.0, 260.0, 250.0, 200.0, 190.0};
  sheet.beams = 500;
  sheet.layers = 1;
  return sheet;
}

SheetCurve<double> curve_of(const Sheet& sheet) {
  return {curve_nodes<double>(sheet, 0.0, plain), 0, static_cast<int>(sheet.east_km.size()) - 2};
}

SheetShape<double> shape_of(const Sheet& sheet) {
  SheetShape<double> shape{};
  shape.width_km = sheet.width_km;
  shape.energy_flux_mw_m2 = sheet.energy_flux_mw_m2;
  shape.side = 1.0;
  return shape;
}

std::vector<BeamPlace> places_of(const Sheet& sheet) {
  const LayerPlaces layer(sheet, layer_address(0, 0, 0), 7, 0.0);
  std::vector<BeamPlace> places(static_cast<std::size_t>(layer.size()));
  for (int first = 0; first < layer.size(); first += LayerPlaces::kSumEvery)
    layer.fill(first, std::min(LayerPlaces::kSumEvery, layer.size() - first), &places[first]);
  return places;
}

TEST(SheetCurve, PassesThroughItsPointsAndKeepsItsDirectionThere) {
  const Sheet sheet = bent();
  const SheetCurve<double> curve = curve_of(sheet);
  for (int k = 0; k < curve.pieces(); ++k) {
    const CurvePlace<double> start = curve.place(k, 0.0), end = curve.place(k, 1.0);
    EXPECT_NEAR(start.at[0], sheet.east_km[k], 1e-9);
    EXPECT_NEAR(start.at[1], sheet.north_km[k], 1e-9);
    EXPECT_NEAR(end.at[0], sheet.east_km[k + 1], 1e-9);
    if (k + 1 == curve.pieces()) break;
    const CurvePlace<double> next = curve.place(k + 1, 0.0);
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(end.along[a], next.along[a], 1e-9);
  }
}

TEST(SheetCurve, GoesEvenlyByTheLengthOfItsPieces) {
  const Sheet sheet = bent();
  const SheetCurve<double> curve = curve_of(sheet);
  constexpr int kSteps = 20000;
  for (int k = 0; k < curve.pieces(); ++k) {
    double walked = 0.0, least = 1e9, most = 0.0;
    CurvePlace<double> before = curve.place(k, 0.0);
    for (int i = 1; i <= kSteps; ++i) {
      const CurvePlace<double> here = curve.place(k, static_cast<double>(i) / kSteps);
      const double step = std::hypot(here.at[0] - before.at[0], here.at[1] - before.at[1]);
      walked += step;
      least = std::min(least, step);
      most = std::max(most, step);
      before = here;
    }
    EXPECT_NEAR(walked / curve.length_km(k), 1.0, 1e-6);
    // The rule of four points over an eighth of a piece is off by 1e-5 in its sharpest bend.
    EXPECT_NEAR(least / most, 1.0, 1e-3);
  }
}

TEST(SheetCurve, BeamsStandEvenlyAndShareTheWholeLength) {
  Sheet sheet = bent();
  sheet.spacing_jitter = 0.0;
  const CurveLayout layout = curve_layout(sheet);
  const SheetCurve<double> curve = curve_of(sheet);
  const double chords = 67.08 + 50.99 + 90.55 + 52.2 + 95.52;
  EXPECT_GT(layout.length_km, chords);
  EXPECT_LT(layout.length_km, 1.3 * chords);
  double flux = 0.0;
  sheet.width_km = 1e-9;  // beams on the line itself
  const SheetShape<double> shape = shape_of(sheet);
  std::vector<CurveFoot<double>> feet;
  for (const BeamPlace& place : places_of(sheet)) {
    feet.push_back(curve_foot(curve, shape, layout, place));
    flux += feet.back().foot.flux_km2_mw_m2;
  }
  EXPECT_NEAR(flux / (sheet.energy_flux_mw_m2 * sheet.width_km * kSqrtTwoPi * layout.length_km), 1.0, 1e-12);
  const double spacing = layout.length_km / 500.0;
  for (std::size_t i = 0; i + 1 < feet.size(); ++i) {
    const double apart = std::hypot(feet[i + 1].foot.east_km - feet[i].foot.east_km,
                                    feet[i + 1].foot.north_km - feet[i].foot.north_km);
    // A chord is a little shorter than its arc.
    EXPECT_LT(apart, spacing * 1.0005);
    EXPECT_GT(apart, spacing * 0.98);
  }
}

TEST(SheetCurve, AStraightOneHasTheFeetOfAStraightSheet) {
  Sheet sine;
  sine.center_km = {10.0, 200.0};
  sine.bearing_deg = 70.0;
  sine.length_km = 300.0;
  sine.layers = 1;
  sine.beams = 300;
  Sheet sheet = sine;
  sheet.course = SheetCourse::curve;
  const double u[2] = {std::sin(70.0 * kRadiansPerDegree), std::cos(70.0 * kRadiansPerDegree)};
  for (const double t : {-150.0, -20.0, 35.0, 150.0}) {
    sheet.east_km.push_back(10.0 + t * u[0]);
    sheet.north_km.push_back(200.0 + t * u[1]);
  }
  sheet.point_brightness = {0.7, 0.7, 0.7, 0.7};
  sheet.point_width_km = {1.5, 1.5, 1.5, 1.5};
  for (const double side : {1.0, -1.0}) {
    SheetShape<double> straight{10.0, 200.0, u[0], u[1],      300.0, 0.0, 100.0,
                                0.0,  0.0,   1.5,  0.7 * 5.0, 0.0,   side};
    SheetShape<double> shape = shape_of(sheet);
    shape.side = side;
    const CurveLayout layout = curve_layout(sheet);
    const SheetCurve<double> curve = curve_of(sheet);
    for (const BeamPlace& place : places_of(sheet)) {
      const BeamFoot<double> wanted = beam_foot(straight, stretch_of(sine, 0.0), place, 0, 1, false);
      const BeamFoot<double> foot = curve_foot(curve, shape, layout, place).foot;
      EXPECT_NEAR(foot.east_km, wanted.east_km, 1e-9);
      EXPECT_NEAR(foot.north_km, wanted.north_km, 1e-9);
      EXPECT_NEAR(foot.flux_km2_mw_m2 / wanted.flux_km2_mw_m2, 1.0, 1e-9);
    }
  }
}

TEST(SheetCurve, WhatVariesAlongItIsExactAtThePointsAndForEvenGrowth) {
  Sheet sheet = bent();
  const CurveLayout layout = curve_layout(sheet);
  for (const double at : layout.at) {
    sheet.point_energy_kev.push_back(std::exp(0.4 + 1.5 * at));
    sheet.point_brightness.push_back(at == layout.at[2] ? 3.0 : 0.5);
  }
  const SheetCurve<double> curve = curve_of(sheet);
  const auto& nodes = curve.nodes();
  double most = 0.0, least = 1e9;
  for (int i = 0; i <= 1000; ++i) {
    const double s = i / 1000.0;
    const auto [piece, fraction] = layout.piece_at(s);
    EXPECT_NEAR(curve.along(nodes.ln_energy, piece, fraction), 0.4 + 1.5 * s, 1e-9);
    const double ln = curve.along(nodes.ln_brightness, piece, fraction);
    most = std::max(most, ln);
    least = std::min(least, ln);
  }
  EXPECT_NEAR(curve.along(nodes.ln_brightness, 2, 0.0), std::log(3.0), 1e-12);
  const double range = std::log(3.0) - std::log(0.5);
  EXPECT_LT(most, std::log(3.0) + range / 3.0);
  EXPECT_GT(least, std::log(0.5) - range / 3.0);
}

/// d foot / d number for every number of the curve, with a drift, against central differences.
TEST(SheetCurve, DerivativesAgreeWithDifferences) {
  Sheet sheet = bent();
  sheet.point_brightness = {0.2, 1.0, 2.0, 0.7, 0.4, 0.9};
  sheet.point_energy_kev = {1.0, 4.0, 3.0, 6.0, 8.0, 2.0};
  sheet.point_width_km = {1.0, 2.0, 1.5, 0.7, 3.0, 1.1};
  sheet.drift_km_s = {0.3, -0.2};
  const CurveLayout layout = curve_layout(sheet);
  const std::vector<BeamPlace> places = places_of(sheet);
  for (std::vector<double>* list : {&sheet.east_km, &sheet.north_km, &sheet.point_brightness,
                                    &sheet.point_energy_kev, &sheet.point_width_km})
    for (double& number : *list) {
      const double here = number, step = 1e-5 * std::max(1.0, std::abs(here));
      const auto seeded = [&](const double& n) {
        FreeDual dual(n);
        if (&n == &number) dual.d.t[0] = 1.0;
        return dual;
      };
      const SheetCurve<FreeDual> curve(curve_nodes<FreeDual>(sheet, 2.0, seeded), 0, 4);
      SheetShape<FreeDual> shape{};
      shape.width_km = sheet.width_km;
      shape.energy_flux_mw_m2 = sheet.energy_flux_mw_m2;
      shape.side = 1.0;
      const auto feet_at = [&](double value) {
        number = value;
        const SheetCurve<double> moved(curve_nodes<double>(sheet, 2.0, plain), 0, 4);
        std::vector<CurveFoot<double>> feet;
        for (const BeamPlace& place : places)
          feet.push_back(curve_foot(moved, shape_of(sheet), layout, place));
        return feet;
      };
      const auto more = feet_at(here + step), less = feet_at(here - step);
      number = here;
      double error = 0.0, size = 0.0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const CurveFoot<FreeDual> foot = curve_foot(curve, shape, layout, places[i]);
        const auto add = [&](const FreeDual& exact, double up, double down) {
          const double difference = (up - down) / (2.0 * step);
          error = std::max(error, std::abs(exact.d.t[0] - difference));
          size = std::max(size, std::abs(difference));
        };
        add(foot.foot.east_km, more[i].foot.east_km, less[i].foot.east_km);
        add(foot.foot.north_km, more[i].foot.north_km, less[i].foot.north_km);
        add(foot.foot.flux_km2_mw_m2, more[i].foot.flux_km2_mw_m2, less[i].foot.flux_km2_mw_m2);
        add(foot.ln_energy, more[i].ln_energy, less[i].ln_energy);
      }
      EXPECT_GT(size, 0.0);
      EXPECT_LT(error, 2e-6 * size) << here;
    }
}

TEST(SheetCurve, EvenedItKeepsItsPower) {
  Sheet sheet = bent();
  sheet.point_brightness = {0.2, 1.0, 2.0, 0.7, 0.4, 0.9};
  sheet.point_width_km = {1.0, 2.0, 1.5, 0.7, 3.0, 1.1};
  sheet.point_energy_kev = {4.0, 4.0, 4.0, 4.0, 4.0, 4.0};
  sheet.beams = 20000;
  double flux = 0.0;
  const CurveLayout layout = curve_layout(sheet);
  const SheetCurve<double> curve = curve_of(sheet);
  for (const BeamPlace& place : places_of(sheet))
    flux += curve_foot(curve, shape_of(sheet), layout, place).foot.flux_km2_mw_m2;
  const Sheet even = evened_sheet(sheet);
  EXPECT_NEAR(even.energy_flux_mw_m2 * even.width_km * even.length_km * kSqrtTwoPi / flux, 1.0, 1e-4);
  EXPECT_NEAR(even.energy_kev, 4.0, 1e-9);
}

TEST(SheetCurve, NearestFootIsThatOfTheCurve) {
  Sheet sheet;
  sheet.course = SheetCourse::curve;
  // A circle of 80 km about (0, 200): its nearest point is 120 km off.
  for (int i = 0; i <= 24; ++i) {
    sheet.east_km.push_back(80.0 * std::sin(kTwoPi * i / 48.0 + 1.0));
    sheet.north_km.push_back(200.0 + 80.0 * std::cos(kTwoPi * i / 48.0 + 1.0));
  }
  const FootPoints feet = foot_points(sheet, 0.0);
  EXPECT_NEAR(std::hypot(feet.nearest.east, feet.nearest.north), 120.0, 0.02);
  EXPECT_NEAR(line_length_km(sheet), 80.0 * kPi, 0.05);
}

}  // namespace
}  // namespace vegard::sim::sheet_curve_test
