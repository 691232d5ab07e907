#include "fit/parameters/parameter_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::parameter_map_test {
namespace {

/// Two sheets at a common distance, of which one has four fifths of the other's energy and half of its width.
sim::Scene tied_scene() {
  return sim::parse_scene(R"toml(
[[sheet]]
name = "a"
[[sheet]]
name = "far-off"
[fit]
free = [
  { name = "distance", start = 200, min = 100, max = 400, scale = "logarithmic" },
  { path = "sheet.a.bearing_deg", start = 80 },
  { path = "sheet.a.energy_kev", start = 5 },
  { path = "sheet.a.width_km", name = "w" },
  { path = "sheet.far-off.width_km", name = "w" },
  "camera.hfov_deg",
]
tied = [
  { path = "sheet.far-off.center_km.east", equals = "sheet.a.center_km.east + 10 * log(sheet.far-off.energy_kev)" },
  { path = "sheet.a.center_km.east", equals = "distance * cos_deg(sheet.a.bearing_deg)" },
  { path = "sheet.a.center_km.north", equals = "distance * sin_deg(sheet.a.bearing_deg)" },
  { path = "sheet.far-off.energy_kev", equals = "0.8 * sheet.a.energy_kev" },
  { path = "sheet.far-off.thickness_km", equals = "sheet.a.thickness_km + 2 * w" },
]
)toml",
                          "tied.toml");
}

TEST(FreeNumbers, OfOneNameAreOneAndANumberMayHaveNoPath) {
  const sim::Scene scene = tied_scene();
  const std::vector<FreeNumber> free = free_numbers(scene);
  ASSERT_EQ(free.size(), 5u);
  EXPECT_FALSE(free[0].has_path());
  EXPECT_EQ(free[0].label(), "distance");
  EXPECT_EQ(free[0].unit(), "");
  EXPECT_FALSE(free[0].id.any());
  EXPECT_TRUE(free[0].logarithmic());
  EXPECT_NEAR(free[0].value(0.0), 200.0, 1e-9) << "the middle of the logarithms of 100 and 400";
  EXPECT_EQ(free[3].label(), "sheet.a.width_km");
  ASSERT_EQ(free[3].also.size(), 1u);
  EXPECT_EQ(sim::path_of(scene, free[3].also[0].id), "sheet.far-off.width_km");
  EXPECT_EQ(wrap_period(free[1]), 0.0) << "formulas may tell a turn from none";
}

TEST(FreeNumbers, MayBeOnAnotherScaleThanTheTables) {
  sim::Scene scene = tests::small_scene();
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev"),
                    tests::free_entry("sheet.main.center_km.north")};
  scene.fit.free[0].scale = sim::FreeScale::linear;
  scene.fit.free[0].min = 2.0;
  scene.fit.free[0].max = 4.0;
  scene.fit.free[1].scale = sim::FreeScale::logarithmic;
  scene.fit.free[1].min = 100.0;
  scene.fit.free[1].max = 400.0;
  const std::vector<FreeNumber> free = free_numbers(scene);
  EXPECT_NEAR(free[0].value(0.0), 3.0, 1e-12);
  EXPECT_NEAR(free[1].value(0.0), 200.0, 1e-10);
}

TEST(ParameterMap, PutsWhatFollowsInTheOrderOfItsDependence) {
  sim::Scene scene = tied_scene();
  const std::vector<FreeNumber> free = free_numbers(scene);
  const ParameterMap map(scene, free);
  EXPECT_FALSE(map.is_plain());
  EXPECT_TRUE(map.put({300.0, 60.0, 5.0, 0.7, 50.0}, scene));
  const double rad = std::acos(-1.0) / 180.0;
  const sim::Sheet &a = scene.sheets[0], &b = scene.sheets[1];
  EXPECT_NEAR(a.center_km.east, 300.0 * std::cos(60.0 * rad), 1e-10);
  EXPECT_NEAR(a.center_km.north, 300.0 * std::sin(60.0 * rad), 1e-10);
  EXPECT_EQ(b.energy_kev, 0.8 * 5.0);
  EXPECT_NEAR(b.center_km.east, a.center_km.east + 10.0 * std::log(4.0), 1e-10);
  EXPECT_EQ(a.width_km, 0.7);
  EXPECT_EQ(b.width_km, 0.7);
  EXPECT_EQ(b.thickness_km, a.thickness_km + 1.4);
  EXPECT_EQ(scene.camera.hfov_deg, 50.0);
}

/// Of all numbers, and of a few of them, against differences of put() itself.
TEST(ParameterMap, ItsSlopesAgreeWithDifferences) {
  sim::Scene scene = tied_scene();
  const std::vector<FreeNumber> free = free_numbers(scene);
  const ParameterMap map(scene, free);
  const std::vector<double> values = {300.0, 60.0, 5.0, 0.7, 50.0};
  map.put(values, scene);
  for (const std::vector<int>& moved :
       {std::vector<int>{0, 1, 2, 3, 4}, std::vector<int>{2}, std::vector<int>{4, 0}}) {
    const ParameterMap::Motion motion = map.motion(values, moved, scene);
    ASSERT_EQ(motion.slopes.size(), motion.numbers.size() * moved.size());
    // Every number that moves is listed, and no other.
    for (std::size_t k = 0; k < moved.size(); ++k) {
      sim::Scene up = scene, down = scene;
      std::vector<double> more = values, less = values;
      const double step = 1e-4 * values[moved[k]];
      more[moved[k]] += step;
      less[moved[k]] -= step;
      map.put(more, up);
      map.put(less, down);
      for (const sim::ParameterPath& path : sim::all_paths(scene)) {
        if (path.row->kind != sim::ParameterKind::real) continue;
        const double difference = (*sim::real_value(up, path) - *sim::real_value(down, path)) / (2.0 * step);
        double slope = 0.0;
        for (std::size_t i = 0; i < motion.numbers.size(); ++i)
          if (motion.numbers[i] == path.id) slope = motion.slopes[i * moved.size() + k];
        // The differences' own truncation: the step squared over six, of a sine over degrees.
        EXPECT_NEAR(slope, difference, 1e-7 * std::max(1.0, std::abs(difference))) << path.text;
      }
    }
  }
  EXPECT_EQ(map.motion(values, {0, 1, 2, 3, 4}, scene).numbers.size(), 1u + 1u + 2u + 1u + 5u);
  EXPECT_EQ(map.motion(values, {2}, scene).numbers.size(), 3u) << "both energies and a place";
  EXPECT_EQ(map.motion(values, {0}, scene).numbers.size(), 3u) << "three places, and no number of its own";
}

TEST(ParameterMap, IsTheIdentityWhereNothingIsTied) {
  sim::Scene scene = tied_scene();
  const std::vector<FreeNumber> all = free_numbers(scene);
  const ParameterMap tied(scene, all);
  const ParameterMap::Motion alone = tied.motion({300.0, 60.0, 5.0, 0.7, 50.0}, {4}, scene);
  EXPECT_EQ(alone.numbers, tests::ids_of(scene, {"camera.hfov_deg"}));
  EXPECT_TRUE(alone.slopes.empty());

  scene.fit.tied.clear();
  scene.fit.free = {tests::free_entry("sheet.a.center_km"), tests::free_entry("sheet.far-off.energy_kev")};
  const std::vector<FreeNumber> free = free_numbers(scene);
  const ParameterMap map(scene, free);
  EXPECT_TRUE(map.is_plain());
  const ParameterMap::Motion motion = map.motion({1.0, 2.0, 3.0}, {2, 0}, scene);
  EXPECT_EQ(motion.numbers, tests::ids_of(scene, {"sheet.far-off.energy_kev", "sheet.a.center_km.east"}));
  EXPECT_TRUE(motion.slopes.empty());
}

TEST(ParameterMap, HoldsWhatWouldLeaveItsLimitsAndSaysSo) {
  sim::Scene scene = tests::small_scene();
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev")};
  scene.fit.tied = {{"camera.hfov_deg", "30 * sheet.main.energy_kev", "", 0}};
  sim::validate(scene);
  const std::vector<FreeNumber> free = free_numbers(scene);
  const ParameterMap map(scene, free);
  EXPECT_TRUE(map.put({3.0}, scene));
  EXPECT_NEAR(map.motion({3.0}, {0}, scene).slopes[1], 30.0, 1e-9);
  EXPECT_FALSE(map.put({8.0}, scene));
  EXPECT_EQ(scene.camera.hfov_deg, sim::resolve(scene, "camera.hfov_deg")[0].row->max);
  EXPECT_EQ(map.motion({8.0}, {0}, scene).slopes[1], 0.0);
}

TEST(ParameterMap, OfAPhotographKnowsItsOwnNumbersOnly) {
  sim::Scene scene = tests::small_scene();
  scene.fit.photos.resize(2);
  scene.fit.photos[0].name = "left";
  scene.fit.photos[1].name = "right";
  for (sim::PhotoEntry& photo : scene.fit.photos) photo.file = photo.name + ".png";
  scene.fit.free = {tests::free_entry("camera.hfov_deg"), tests::free_entry("camera.hfov_deg"),
                    tests::free_entry("sheet.main.energy_kev")};
  scene.fit.free[0].photo = "left";
  scene.fit.free[1].photo = "right";
  scene.fit.tied = {{"camera.roll_deg", "camera.hfov_deg / 20", "right", 0}};
  sim::validate(scene);
  const std::vector<FreeNumber> free = free_numbers(scene);
  EXPECT_EQ(free[0].label(), "camera.hfov_deg of left");
  const ParameterMap left(scene, free, "left"), right(scene, free, "right");
  sim::Scene of_left = scene, of_right = scene;
  left.put({50.0, 40.0, 4.0}, of_left);
  right.put({50.0, 40.0, 4.0}, of_right);
  EXPECT_EQ(of_left.camera.hfov_deg, 50.0);
  EXPECT_EQ(of_left.camera.roll_deg, scene.camera.roll_deg);
  EXPECT_EQ(of_right.camera.hfov_deg, 40.0);
  EXPECT_EQ(of_right.camera.roll_deg, 2.0);
  const ParameterMap::Motion motion = right.motion({50.0, 40.0, 4.0}, {0, 1, 2}, of_right);
  ASSERT_EQ(motion.numbers.size(), 3u);
  EXPECT_EQ(motion.slopes[0], 0.0);
  EXPECT_EQ(motion.slopes[1], 1.0);
  EXPECT_EQ(left.motion({50.0, 40.0, 4.0}, {1}, of_left).numbers.size(), 0u);
}

TEST(ParameterMap, NamesWhatFollowsWithItsSlopes) {
  sim::Scene scene = tied_scene();
  const std::vector<FreeNumber> free = free_numbers(scene);
  const ParameterMap map(scene, free);
  const std::vector<double> values = {300.0, 60.0, 5.0, 0.7, 50.0};
  map.put(values, scene);
  const std::vector<ParameterMap::Dependent> all = map.dependents(values, scene);
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(sim::path_of(scene, all[0].id), "sheet.far-off.width_km");
  EXPECT_EQ(all[0].equals, "sheet.a.width_km");
  EXPECT_EQ(all[0].slopes, (std::vector<double>{0.0, 0.0, 0.0, 1.0, 0.0}));
  for (const ParameterMap::Dependent& d : all) {
    if (sim::path_of(scene, d.id) != "sheet.far-off.center_km.east") continue;
    EXPECT_NEAR(d.slopes[0], 0.5, 1e-10);
    EXPECT_NEAR(d.slopes[2], 2.0, 1e-9) << "10 ln(0.8 E) by E at 5";
  }
}

/// At their very limits a number and what is tied to it are read again, too.
TEST(StartFrom, AnAnswerAtALimitIsASceneAgain) {
  sim::Scene scene = tests::small_scene();
  scene.fit.free = {tests::free_entry("")};
  scene.fit.free[0].name = "share";
  scene.fit.free[0].start = 0.2;
  scene.fit.free[0].min = 0.1;
  scene.fit.free[0].max = 0.3;
  scene.fit.tied = {{"sheet.main.energy_kev", "20 / 0.3 * share * (1 + 1e-12)", "", 0}};
  const std::vector<FreeNumber> free = free_numbers(scene);
  const std::vector<double> values = {free[0].value(1e3)};
  EXPECT_EQ(values[0], 0.3);
  EXPECT_TRUE(ParameterMap(scene, free).put(values, scene));
  start_from(free, values, scene);
  EXPECT_EQ(scene.sheets[0].energy_kev, 20.0);
  EXPECT_EQ(sim::parse_scene(sim::write_scene(scene), "best.toml").fit.free[0].start, 0.3);
}

TEST(StartFrom, MakesTheAnswerTheNextStart) {
  sim::Scene scene = tied_scene();
  const std::vector<FreeNumber> free = free_numbers(scene);
  const std::vector<double> values = {300.0, 60.0, 7.0, 0.7, 50.0};
  const ParameterMap map(scene, free);
  map.put(values, scene);
  start_from(free, values, scene);
  const sim::Scene again = sim::parse_scene(sim::write_scene(scene), "best.toml");
  const std::vector<FreeNumber> next = free_numbers(again);
  ASSERT_EQ(next.size(), values.size());
  for (std::size_t j = 0; j < next.size(); ++j) EXPECT_EQ(next[j].start, values[j]) << next[j].label();
  EXPECT_EQ(next[0].min, 100.0);
}

}  // namespace
}  // namespace vegard::fit::parameter_map_test
