// Keys of numbers: the curves between them, what they carry along, and which are refused.
#include "sim/scene/freedom/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/structs/site_axes.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::keyframes_test {
namespace {

const char* const kScene = R"([site]
latitude_deg = 65.0
longitude_deg = 20.0
[[sheet]]
name = "arc"
center_km = [10.0, 150.0]
length_km = 200.0
)";

std::string key(double time_s, const std::string& path, const std::string& value,
                const std::string& ease = "monotone") {
  return "[[key]]\ntime_s = " + std::to_string(time_s) + "\npath = \"" + path + "\"\nvalue = " + value +
         "\nease = \"" + ease + "\"\n";
}

Scene scene_with(const std::string& keys) { return parse_scene(kScene + keys, "a.toml"); }

TEST(Keyframes, GoThroughTheirKeysAndRestOutsideThem) {
  for (const char* ease : {"monotone", "catmull-rom", "linear", "smooth", "hold"}) {
    std::string keys;
    const double times[] = {1.0, 2.0, 5.0, 6.0}, values[] = {10.0, 40.0, 40.0, 25.0};
    for (int i = 0; i < 4; ++i)
      keys += key(times[i], "camera.elevation_deg", std::to_string(values[i]), ease);
    const Scene scene = scene_with(keys);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(scene_at(scene, times[i]).camera.elevation_deg, values[i], 1e-12) << ease;
    EXPECT_EQ(scene_at(scene, -5.0).camera.elevation_deg, 10.0);
    EXPECT_EQ(scene_at(scene, 99.0).camera.elevation_deg, 25.0);
    EXPECT_TRUE(scene_at(scene, 3.0).keys.empty());
  }
}

TEST(Keyframes, AStraightLineStaysOneAndAMonotoneSplineNeverLeavesItsKeys) {
  const std::string elevation = "camera.elevation_deg";
  const std::string line = key(0, elevation, "0.0", "catmull-rom") +
                           key(1, elevation, "10.0", "catmull-rom") +
                           key(4, elevation, "40.0", "catmull-rom") + key(5, elevation, "50.0");
  const std::string steps = key(0, elevation, "0.0") + key(1, elevation, "1.0") + key(2, elevation, "60.0") +
                            key(3, elevation, "60.0") + key(4, elevation, "5.0");
  const Scene straight = scene_with(line), stepped = scene_with(steps);
  double before = -1.0;
  for (double t = 0.0; t <= 3.0; t += 0.01) {
    // Cubic Hermite curves reproduce lines, where all slopes are that of the line.
    EXPECT_NEAR(scene_at(straight, t).camera.elevation_deg, 10.0 * t, 1e-9);
    const double now = scene_at(stepped, t).camera.elevation_deg;
    EXPECT_GE(now, before - 1e-12) << t;
    EXPECT_LE(now, 60.0 + 1e-12) << t;
    before = now;
  }
  // No corner at a key: the slopes on either side are one.
  const auto slope = [&](double t) {
    return (scene_at(stepped, t + 1e-6).camera.elevation_deg - scene_at(stepped, t).camera.elevation_deg) /
           1e-6;
  };
  EXPECT_NEAR(slope(1.0 - 2e-6), slope(1.0 + 1e-6), 1e-2);
}

TEST(Keyframes, OfAVectorMoveEachComponent) {
  const Scene scene = scene_with(key(0, "sheet.center_km", "[0.0, 100.0]", "linear") +
                                 key(2, "sheet.center_km", "[20.0, 200.0]", "linear"));
  const Scene now = scene_at(scene, 0.5);
  EXPECT_NEAR(now.sheets[0].center_km.east, 5.0, 1e-12);
  EXPECT_NEAR(now.sheets[0].center_km.north, 125.0, 1e-12);
}

TEST(Keyframes, AnObserverWhoMovesLeavesTheAuroraWhereItIs) {
  const Scene scene = scene_with(key(0, "site.latitude_deg", "65.0") + key(0, "site.longitude_deg", "20.0") +
                                 key(1, "site.latitude_deg", "72.0") + key(1, "site.longitude_deg", "30.0") +
                                 key(0, "site.altitude_m", "0.0") + key(1, "site.altitude_m", "4e5"));
  const Scene there = scene_at(scene, 1.0);
  EXPECT_EQ(there.site.altitude_m, 4e5);
  // The foot of the centre, at 110 km, by the axes of either site.
  const auto place = [](const Scene& s, int axis) {
    const SiteAxes axes = axes_at(s.site);
    const EastNorth& foot = s.sheets[0].center_km;
    const double radius = kEarthRadiusKm + kFootAltitudeKm;
    const double up = std::sqrt(radius * radius - foot.east * foot.east - foot.north * foot.north);
    return foot.east * axes.axis[0][axis] + foot.north * axes.axis[1][axis] + up * axes.axis[2][axis];
  };
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(place(there, axis), place(scene, axis), 1e-6);
  EXPECT_LT(there.sheets[0].center_km.north, -500.0);  // and the observer has flown past it
}

TEST(Keyframes, ComeBackFromAWrittenScene) {
  const Scene scene = scene_with(key(0, "sheet.arc.energy_kev", "2.5", "smooth") +
                                 key(1.5, "sheet.arc.center_km", "[1.0, 2.0]", "catmull-rom"));
  const Scene again = parse_scene(write_scene(scene), "b.toml");
  ASSERT_EQ(again.keys.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(again.keys[i].time_s, scene.keys[i].time_s);
    EXPECT_EQ(again.keys[i].path, scene.keys[i].path);
    EXPECT_EQ(again.keys[i].value, scene.keys[i].value);
    EXPECT_EQ(again.keys[i].ease, scene.keys[i].ease);
  }
}

struct Refused {
  std::string keys, where, words;
};
class RefusedKeys : public testing::TestWithParam<Refused> {};

TEST_P(RefusedKeys, SayWhere) {
  tests::expect_words(ErrorKind::scene, {"a.toml:" + GetParam().where, GetParam().words},
                      [] { scene_with(GetParam().keys); });
}

// The scene has 7 lines, a key 5.
INSTANTIATE_TEST_SUITE_P(
    All, RefusedKeys,
    testing::Values(
        Refused{key(3, "camera.hfov_deg", "30.0") + key(3, "camera.hfov_deg", "40.0"), "13", "order of time"},
        Refused{key(3, "sheet.energy_kev", "3.0") + key(2, "sheet.arc.energy_kev", "4.0"), "13", "line 8"},
        Refused{key(0, "camera.width", "30.0"), "8", "camera.width"},
        Refused{key(0, "sensor.tone", "1.0"), "8", "words"},
        Refused{key(0, "time.start_s", "1.0"), "8", "clock"},
        Refused{key(0, "fit.model_error", "0.1"), "8", "fit"},
        Refused{key(0, "camera.focal_px", "100.0"), "8", "pinhole"},
        Refused{key(0, "camera.hfovdeg", "30.0"), "8", "hfov_deg"},
        Refused{key(0, "sheet.center_km", "30.0"), "8", "2 numbers"},
        Refused{key(0, "camera.hfov_deg", "300.0"), "8", "170"},
        Refused{key(0, "site.altitude_m", "-20000.0"), "8", "inside the Earth"},
        Refused{key(0, "site.altitude_m", "0.0", "catmull-rom") +
                    key(1, "site.altitude_m", "0.0", "catmull-rom") +
                    key(2, "site.altitude_m", "4e5", "catmull-rom"),
                "8", "inside the Earth"},
        Refused{key(0, "site.latitude_deg", "0.0") + key(1, "site.latitude_deg", "65.0"), "8", "site"},
        Refused{"[[key]]\ntime_s = 0.0\npath = \"camera.hfov_deg\"\n", "8", "value"},
        Refused{key(0, "camera.hfov_deg", "30.0", "bouncy"), "12", "monotone"}));

}  // namespace
}  // namespace vegard::sim::keyframes_test
