#include "fit/map/curtains/stored_map.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "fit/report/map_run.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::stored_map_test {
namespace {

using tests::TemporaryFolder;

sim::Scene scene_of_map() {
  return sim::parse_scene(
      "[site]\nlatitude_deg = 67.0\nlongitude_deg = 20.0\n[camera]\nwidth = 96\nheight = 64\n", "scene");
}

Curtain curtain(double north_km, double flux) {
  Curtain made;
  for (int i = 0; i <= 12; ++i) {
    CurtainPoint p;
    p.foot_km = {-30.0 + 5.0 * i, north_km};
    p.flux_mw_m2 = {flux * (i == 4 ? 2.0 : 1.0), 0.1};
    p.energy_kev = {3.5, 0.2};
    p.width_km = {2.5, sim::kNaN};
    made.points.push_back(p);
  }
  made.length_km = 60.0;
  return made;
}

std::vector<InputFile> inputs_of_map() {
  return {{"scene", "camera.toml", "aa"}, {"photo", "photo.png", "bb"}, {"mask", "mask.png", "cc"}};
}

/// What a fit reads of a map's directory; tests/cli/from_map_case.sh reads what `vegard map` has written.
void write(const std::string& directory, const std::vector<Curtain>& curtains = {curtain(200.0, 5.0)},
           const std::vector<Curtain>& faint = {curtain(260.0, 0.5)}) {
  std::filesystem::create_directories(directory);
  nlohmann::json json = {{"kind", "vegard map"},
                         {"version", sim::version()},
                         {"format", kMapFormat},
                         {"interrupted", false},
                         {"curtains", nlohmann::json::array()},
                         {"faint_curtains", faint.size()},
                         {"altitude_scale", 1.0},
                         {"decodings", nlohmann::json::array({{{"photo", ""}, {"decoding", "sRGB"}}})}};
  for (const Curtain& c : curtains) json["curtains"].push_back({{"points", c.points.size()}});
  json["photos"] = nlohmann::json::array(
      {{{"name", ""}, {"width_px", 96}, {"height_px", 64}, {"latitude_deg", 67.0}, {"longitude_deg", 20.0}}});
  json["inputs"] = nlohmann::json::array();
  for (const InputFile& input : inputs_of_map())
    json["inputs"].push_back({{"role", input.role}, {"name", input.name}, {"sha256", input.sha256}});
  std::ofstream(directory + "/map.json") << json;
  std::ofstream(directory + "/" + kCurtainTable) << curtains_csv(curtains);
  std::ofstream(directory + "/" + kFaintCurtainTable) << curtains_csv(faint);
}

/// map.json with something else in it.
void change(const std::string& directory, const std::string& key, const nlohmann::json& value) {
  std::ifstream in(directory + "/map.json");
  nlohmann::json json = nlohmann::json::parse(in);
  if (value.is_null())
    json.erase(key);
  else
    json[key] = value;
  std::ofstream(directory + "/map.json") << json;
}

TEST(StoredMap, HasWhatTheMapWrote) {
  const TemporaryFolder folder;
  write(folder / "map");
  const StoredMap record = read_stored_map(folder / "map");
  ASSERT_EQ(record.curtains.size(), 1u);
  ASSERT_EQ(record.faint.size(), 1u);
  EXPECT_EQ(record.curtains[0].name, "curtain_1");
  EXPECT_EQ(record.faint[0].name, "faint_1");
  ASSERT_EQ(record.curtains[0].points.size(), 13u);
  const RidgePoint& p = record.curtains[0].points[4];
  EXPECT_NEAR(p.foot_km.east, -10.0, 1e-9);
  EXPECT_NEAR(p.flux_mw_m2, 10.0, 1e-6);
  EXPECT_NEAR(p.energy_kev, 3.5, 1e-6);
  EXPECT_NEAR(p.width_km, 2.5, 1e-6);
  ASSERT_EQ(record.pictures.size(), 1u);
  EXPECT_EQ(record.pictures[0].width_px, 96);
  EXPECT_DOUBLE_EQ(record.pictures[0].longitude_deg, 20.0);
  check_same_subject(record, scene_of_map(), inputs_of_map(), {});
}

TEST(StoredMap, KnowsAnotherPhotographSiteAndSize) {
  const TemporaryFolder folder;
  write(folder / "map");
  const StoredMap record = read_stored_map(folder / "map");
  std::vector<InputFile> inputs = inputs_of_map();
  inputs[2].sha256 = "dd";  // another mask
  check_same_subject(record, scene_of_map(), inputs, {});
  inputs[1].sha256 = "dd";
  tests::expect_words(sim::ErrorKind::scene, {"another photograph than photo.png"},
                      [&] { check_same_subject(record, scene_of_map(), inputs, {}); });
  sim::Scene scene = scene_of_map();
  scene.site.latitude_deg = 68.0;
  tests::expect_words(sim::ErrorKind::scene, {"another site"},
                      [&] { check_same_subject(record, scene, inputs_of_map(), {}); });
  scene = scene_of_map();
  scene.camera.height = 65;
  tests::expect_words(sim::ErrorKind::scene, {"another size"},
                      [&] { check_same_subject(record, scene, inputs_of_map(), {}); });
  check_same_subject(record, scene_of_map(), inputs_of_map(), {"sRGB"});
  tests::expect_words(sim::ErrorKind::scene, {"made with", "linear"},
                      [&] { check_same_subject(record, scene_of_map(), inputs_of_map(), {"linear"}); });
  change(folder / "map", "altitude_scale", 1.05);
  const StoredMap higher = read_stored_map(folder / "map");
  tests::expect_words(sim::ErrorKind::scene, {"--altitude-scale"},
                      [&] { check_same_subject(higher, scene_of_map(), inputs_of_map(), {}); });
  write(folder / "map");
  change(folder / "map", "spectrum", "kappa");
  const StoredMap kappa = read_stored_map(folder / "map");
  tests::expect_words(sim::ErrorKind::scene, {"--spectrum kappa"},
                      [&] { check_same_subject(kappa, scene_of_map(), inputs_of_map(), {}); });
}

TEST(StoredMap, RefusesNumbersAndListsThatAreNone) {
  const TemporaryFolder folder;
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, nlohmann::json>>{{"faint_curtains", 1e300},
                                                           {"faint_curtains", 1.5},
                                                           {"faint_curtains", -1},
                                                           {"faint_curtains", true},
                                                           {"curtains", 5},
                                                           {"photos", "x"},
                                                           {"inputs", 3},
                                                           {"altitude_scale", "high"},
                                                           {"spectrum", 5},
                                                           {"decodings", 1}}) {
    write(folder / "map");
    change(folder / "map", key, value);
    tests::expect_words(sim::ErrorKind::unreadable_input, {"lacks"},
                        [&] { read_stored_map(folder / "map"); });
  }
}

TEST(StoredMap, RefusesPointsThatAreNowhereAndPassesOverRings) {
  const TemporaryFolder folder;
  Curtain far = curtain(200.0, 5.0);
  far.points[3].foot_km.east = 1e300;
  write(folder / "map", {far});
  tests::expect_words(sim::ErrorKind::unreadable_input, {"a point that"},
                      [&] { read_stored_map(folder / "map"); });
  Curtain ring = curtain(200.0, 5.0);
  ring.points.resize(3);
  ring.points[2] = ring.points[0];
  write(folder / "map", {ring, curtain(220.0, 5.0)});
  const StoredMap record = read_stored_map(folder / "map");
  ASSERT_EQ(record.curtains.size(), 1u);
  EXPECT_EQ(record.curtains[0].name, "curtain_2");
}

TEST(StoredMap, RefusesWhatIsNoMapOfThisVersion) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& what) {
    tests::expect_words(sim::ErrorKind::unreadable_input, {what}, [&] { read_stored_map(folder / "map"); });
  };
  refused("no such file");
  write(folder / "map");
  change(folder / "map", "version", "0.0.1");
  refused("vegard 0.0.1");
  std::filesystem::remove_all(folder / "map");
  write(folder / "map");
  change(folder / "map", "format", kMapFormat + 1);
  refused("another format");
  change(folder / "map", "format", kMapFormat);
  change(folder / "map", "interrupted", true);
  refused("interrupted");
  change(folder / "map", "interrupted", false);
  change(folder / "map", "photos", nullptr);
  refused("lacks");
  std::filesystem::remove_all(folder / "map");
  write(folder / "map");
  change(folder / "map", "faint_curtains", 7);
  refused("there is no curtain 2");
  change(folder / "map", "kind", "a cake");
  refused("is no map's");
}

TEST(StoredMap, RefusesAMapWithoutACurtain) {
  const TemporaryFolder folder;
  write(folder / "map", {}, {});
  tests::expect_words(sim::ErrorKind::unreadable_input, {"no curtain"},
                      [&] { read_stored_map(folder / "map"); });
}

}  // namespace
}  // namespace vegard::fit::stored_map_test
