#include "fit/map/curtains/curtain_sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/parameter_map.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::fit::curtain_sheets_test {
namespace {

/// A point every 5 km of a band with folds, as a map has it; its light and energy change along it.
Ridge folded(const std::string& name = "curtain_1") {
  Ridge ridge;
  ridge.name = name;
  for (int i = 0; i <= 60; ++i) {
    const double t = i / 60.0, east = -150.0 + 290.0 * t;
    RidgePoint p;
    p.foot_km = {east, 200.0 + 14.0 * std::sin(east / 12.0)};
    p.flux_mw_m2 = 4.0 + 3.0 * std::sin(5.0 * t);
    p.width_km = 2.5;
    p.energy_kev = 3.0 * std::exp(0.5 * t);
    ridge.points.push_back(p);
  }
  return ridge;
}

double light_of(const Ridge& ridge) {
  double light = 0.0;
  for (std::size_t i = 1; i < ridge.points.size(); ++i) {
    const RidgePoint &a = ridge.points[i - 1], &b = ridge.points[i];
    light += 0.5 * (a.flux_mw_m2 * a.width_km + b.flux_mw_m2 * b.width_km) *
             std::hypot(b.foot_km.east - a.foot_km.east, b.foot_km.north - a.foot_km.north);
  }
  return light;
}

TEST(CurtainSheets, PointsStandOnTheRidgeAndTheCurveFollowsIt) {
  const Ridge ridge = folded();
  const sim::Sheet sheet = sheet_of_ridge(ridge);
  ASSERT_EQ(sheet.course, sim::SheetCourse::curve);
  EXPECT_GE(sheet.east_km.size(), 15u);  // four folds
  EXPECT_LE(sheet.east_km.size(), 32u);
  for (std::size_t i = 0; i < sheet.east_km.size(); ++i)
    EXPECT_TRUE(std::any_of(ridge.points.begin(), ridge.points.end(), [&](const RidgePoint& p) {
      return p.foot_km.east == sheet.east_km[i] && p.foot_km.north == sheet.north_km[i];
    })) << i;
  const std::vector<sim::EastNorth> curve = sim::curve_feet(sheet, 0.0, 2000);
  for (const RidgePoint& p : ridge.points) {
    double nearest = 1e9;
    for (const sim::EastNorth& foot : curve)
      nearest = std::min(nearest, std::hypot(foot.east - p.foot_km.east, foot.north - p.foot_km.north));
    EXPECT_LT(nearest, 3.0) << p.foot_km.east;
  }
}

TEST(CurtainSheets, AStraightRidgeNeedsFewPoints) {
  Ridge ridge = folded();
  for (RidgePoint& p : ridge.points) {
    p.foot_km.north = 200.0;
    p.flux_mw_m2 = 4.0;
  }
  EXPECT_LE(sheet_of_ridge(ridge).east_km.size(), 10u);  // of 290 km
}

TEST(CurtainSheets, HasTheLightAndTheEnergyOfTheRidge) {
  const Ridge ridge = folded();
  const sim::Sheet sheet = sheet_of_ridge(ridge);
  EXPECT_NEAR(light_of_curtain(sheet) / light_of(ridge), 1.0, 1e-6);
  for (std::size_t i = 0; i < sheet.east_km.size(); ++i)
    for (const RidgePoint& p : ridge.points) {
      if (p.foot_km.east != sheet.east_km[i]) continue;
      EXPECT_NEAR(sheet.point_brightness[i] * sheet.energy_flux_mw_m2 / p.flux_mw_m2, 1.0, 0.15) << i;
      EXPECT_NEAR(sheet.point_energy_kev[i] / p.energy_kev, 1.0, 0.05) << i;
      EXPECT_NEAR(sheet.point_width_km[i], 2.5, 1e-9) << i;
    }
}

TEST(CurtainSheets, KnotsAreTheEndsAndWhatThereIsRoomFor) {
  const sim::Sheet sheet = sheet_of_ridge(folded());
  const int last = static_cast<int>(sheet.east_km.size()) - 1;
  EXPECT_EQ(knots_of_sheet(sheet, 1e6), (std::vector<int>{0, last}));
  const std::vector<int> some = knots_of_sheet(sheet, 100.0);
  EXPECT_EQ(some.front(), 0);
  EXPECT_EQ(some.back(), last);
  EXPECT_GE(some.size(), 4u);
  EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
  EXPECT_EQ(std::set<int>(some.begin(), some.end()).size(), some.size());
}

TEST(CurtainSheets, AllThatIsFreeMovesTheScene) {
  sim::Scene given;
  given.camera.width = 96;
  const sim::Scene scene = scene_of_ridges(given, {folded("curtain_1"), folded("curtain_2")});
  EXPECT_NO_THROW(sim::parse_scene(sim::write_scene(scene), "scene.toml"));
  const std::vector<FreeNumber> free = free_numbers(scene);
  // Of both: a distance across for each point in view, a brightness for each but the one that is held.
  const CurtainEnds ends = ends_out_of_view(given, folded());
  ASSERT_TRUE(ends.before && ends.after);
  const std::size_t points = scene.sheets[0].east_km.size();
  const auto energies = knots_of_sheet(scene.sheets[0], 50.0, ends).size(),
             widths = knots_of_sheet(scene.sheets[0], 150.0, ends).size();
  EXPECT_EQ(free.size(), 2 * (2 * (points - 2) + energies + widths) - 1);
  std::vector<double> values;
  for (const FreeNumber& n : free) values.push_back(n.start);
  sim::Scene moved = scene;
  const ParameterMap map(scene, free);
  EXPECT_TRUE(map.put(values, moved));
  for (std::size_t i = 0; i < points; ++i) {
    EXPECT_NEAR(moved.sheets[0].east_km[i], scene.sheets[0].east_km[i], 1e-5);
    EXPECT_NEAR(moved.sheets[0].north_km[i], scene.sheets[0].north_km[i], 1e-5);
  }
  for (std::size_t j = 0; j < free.size(); ++j)
    if (free[j].name == "curtain_2_across_km_3") values[j] = 7.0;
  map.put(values, moved);
  EXPECT_NEAR(std::hypot(moved.sheets[1].east_km[3] - scene.sheets[1].east_km[3],
                         moved.sheets[1].north_km[3] - scene.sheets[1].north_km[3]),
              7.0, 1e-4);
}

TEST(CurtainSheets, WhatLeavesThePictureGoesOnBeyondIt) {
  const sim::Scene scene;
  const CurtainEnds ends = ends_out_of_view(scene, folded());
  ASSERT_TRUE(ends.before && ends.after);
  const sim::Sheet whole = sheet_of_ridge(folded()), longer = sheet_of_ridge(folded(), ends);
  ASSERT_EQ(longer.east_km.size(), whole.east_km.size() + 2);
  EXPECT_NEAR(std::hypot(longer.east_km[0] - whole.east_km[0], longer.north_km[0] - whole.north_km[0]), 60.0,
              1e-6);
  EXPECT_EQ(longer.point_brightness[0], whole.point_brightness[0]);
  EXPECT_EQ(longer.energy_flux_mw_m2, whole.energy_flux_mw_m2);
  Ridge in_view = folded();
  in_view.points.erase(in_view.points.begin(), in_view.points.begin() + 20);
  in_view.points.resize(20);
  const CurtainEnds none = ends_out_of_view(scene, in_view);
  EXPECT_FALSE(none.before || none.after);
}

TEST(CurtainSheets, ACurveIsDroppedWithAllThatIsFreeOfIt) {
  sim::Scene scene = scene_of_ridges(sim::Scene(), {folded("curtain_1"), folded("curtain_10")});
  drop_curtain(scene, "curtain_1");
  EXPECT_NO_THROW(sim::parse_scene(sim::write_scene(scene), "scene.toml"));
  ASSERT_EQ(scene.sheets.size(), 1u);
  EXPECT_EQ(scene.sheets[0].name, "curtain_10");
  sim::Scene other = scene_of_ridges(sim::Scene(), {folded("curtain_10")});
  EXPECT_EQ(free_numbers(scene).size(), free_numbers(other).size());  // one brightness is held again
  EXPECT_EQ(scene.fit.tied.size(), other.fit.tied.size());
}

TEST(CurtainSheets, LeavesOutWhatTheSceneHasShining) {
  const sim::Scene given = sim::parse_scene(
      "[[sheet]]\nname = \"old\"\n[fit]\nfree = [\"camera.roll_deg\", \"sheet.old.energy_kev\"]\n"
      "tied = [{ path = \"sheet.old.width_km\", equals = \"2\" }]\n",
      "scene.toml");
  const sim::Scene scene = scene_of_ridges(given, {folded()});
  ASSERT_EQ(scene.sheets.size(), 1u);
  EXPECT_EQ(scene.sheets[0].name, "curtain_1");
  EXPECT_EQ(free_numbers(scene).front().path, "camera.roll_deg");
  EXPECT_FALSE(scene.fit.band_brightness);
}

}  // namespace
}  // namespace vegard::fit::curtain_sheets_test
