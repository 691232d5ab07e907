#include "sim/scene/file/inert_keys.h"

#include <gtest/gtest.h>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim::inert_keys_test {
namespace {

TEST(IdleKeys, TellWhatAFileSetsForNothing) {
  const Scene scene = parse_scene(
      "[[sheet]]\npeak_km = 130\nenergy_kev = 2\n[blur]\nmodel = \"physical\"\nwidth_deg = [1, 1, 1]\n",
      "x.toml");
  const std::vector<std::string> told = inert_keys(scene);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].rfind("x.toml:2: sheet.main.peak_km: ", 0), 0u) << told[0];
  EXPECT_NE(told[0].find("has no effect"), std::string::npos);
  EXPECT_EQ(told[1].rfind("x.toml:6: blur.width_deg", 0), 0u) << told[1];
}

TEST(IdleKeys, TellWhatAnEnergyDoesBesideAFormsCurve) {
  Scene scene = parse_scene("[[sheet]]\nform = \"drapery\"\nprofile = \"form\"\n", "x.toml");
  EXPECT_TRUE(inert_keys(scene).empty()) << "the energy is not given";
  set_from_text(scene, "sheet.main.energy_kev", "10");
  const std::vector<std::string> told = inert_keys(scene);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].rfind("sheet.main.energy_kev: the heights", 0), 0u) << told[0];
}

TEST(IdleKeys, TellNothingOfWhatCountsOrIsAsItWouldBe) {
  const Scene scene = parse_scene(
      "[[sheet]]\nform = \"drapery\"\nenergy_kev = 2\n[blur]\nwind_m_s = [0, 0]\n[camera]\nfocal_px = 300\n",
      "x.toml");
  EXPECT_TRUE(inert_keys(scene).empty());
  // A written scene has every key.
  EXPECT_TRUE(inert_keys(parse_scene(write_scene(scene), "y.toml")).empty());
}

TEST(IdleKeys, AreToldOfAFormWhoseLineTheSceneNames) {
  const Scene scene = parse_scene(
      "[emission]\nlines = [610.0]\n[blur]\nwidth_deg = [0]\n[[sheet]]\nform = \"steve\"\nenergy_kev = 2\n",
      "x.toml");
  const std::vector<std::string> told = inert_keys(scene);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].rfind("x.toml:7: sheet.main.energy_kev: ", 0), 0u) << told[0];
}

TEST(IdleKeys, KnowThatAPanoramaHasNoFocalLength) {
  const auto told = [](const std::string& camera) {
    return inert_keys(parse_scene("[camera]\nwidth = 400\nheight = 200\n" + camera, "x.toml"));
  };
  for (const std::string model : {"equirectangular", "cube"}) {
    const std::string size =
        model == "cube" ? "height = 300\nmodel = \"cube\"\n" : "height = 200\nmodel = \"equirectangular\"\n";
    for (const std::string& number : {std::string("focal_px = 100\n"), std::string("hfov_deg = 50\n")}) {
      const std::vector<std::string> found = inert_keys(
          parse_scene("[camera]\nwidth = 400\ncube_layout = \"cross\"\n" + size + number, "x.toml"));
      ASSERT_EQ(found.size(), 1u) << model << number;
      EXPECT_NE(found[0].find("panorama"), std::string::npos) << found[0];
    }
  }
  EXPECT_EQ(told("focal_px = 100\n").size(), 1u) << "of a pinhole";
  EXPECT_TRUE(told("hfov_deg = 50\n").empty());
}

TEST(IdleKeys, KnowWhereTheCatalogueOfStarsEnds) {
  const auto told = [](const std::string& stars) {
    return inert_keys(
        parse_scene("[site]\nlatitude_deg = 67\nlongitude_deg = 20\ntime_utc = "
                    "\"2015-03-01T00:00:00Z\"\n[stars]\nshown = true\n" +
                        stars,
                    "x.toml"));
  };
  const std::vector<std::string> found = told("source = \"catalogue\"\nfaintest_magnitude = 12\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rfind("x.toml:8: stars.faintest_magnitude: ", 0), 0u) << found[0];
  EXPECT_NE(found[0].find("V = 6"), std::string::npos);
  EXPECT_TRUE(told("source = \"catalogue\"\nfaintest_magnitude = 6\n").empty());
  EXPECT_TRUE(told("faintest_magnitude = 12\n").empty()) << "of random stars";
}

TEST(IdleKeys, KnowWhichNumbersAFieldHas) {
  const std::string numbers = "inclination_deg = 70\npole_latitude_deg = 81\n";
  const auto told = [&](const std::string& model) {
    const Scene scene = parse_scene(
        "[site]\nlatitude_deg = 67\nlongitude_deg = 20\ntime_utc = "
        "\"2015-03-01T00:00:00Z\"\n[field]\nmodel "
        "= \"" +
            model + "\"\n" + numbers + "[[sheet]]\n",
        "x.toml");
    std::string all;
    for (const std::string& one : inert_keys(scene)) all += one.substr(0, one.find(": ", 9)) + " ";
    return all;
  };
  EXPECT_EQ(told("uniform"), "x.toml:8: field.pole_latitude_deg ");
  EXPECT_EQ(told("dipole"), "x.toml:7: field.inclination_deg ");
  EXPECT_EQ(told("igrf"), "x.toml:7: field.inclination_deg x.toml:8: field.pole_latitude_deg ");
}

}  // namespace
}  // namespace vegard::sim::inert_keys_test
