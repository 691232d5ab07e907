#include "sim/scene/file/curve_table.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::curve_table_test {
namespace {

const char* const kTable =
    "curtain,point,east_km,north_km,distance_km,azimuth_deg,lower_border_km,energy_flux_mw_m2,energy_kev,"
    "width_km,east_error\n"
    "1,1,-50,200,206,346,101,2,3,1.5,nan\n"
    "1,2,0,210,210,0,100,8,4,1.25,0.2\n"
    "2,1,-50,300,304,350,102,1,2,2,?\n"
    "2,2,0,300,300,0,102,0,2,2,\n"
    "2,3,40,310,312,7,102,4,2.5,2,0.1\n";

std::string problem_of(const std::string& text, int curtain) {
  Sheet sheet;
  try {
    take_curtain(text, "curtains.csv", curtain, false, sheet);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    EXPECT_EQ(error.details().file, "curtains.csv");
    return error.details().problem + " | " + error.details().expected + " | line " +
           std::to_string(error.details().line);
  }
  return "";
}

TEST(CurveTable, GivesASheetTheNumbersOfOneCurtain) {
  Sheet sheet;
  take_curtain(kTable, "curtains.csv", 1, false, sheet);
  EXPECT_EQ(sheet.course, SheetCourse::curve);
  EXPECT_EQ(sheet.east_km, (std::vector<double>{-50.0, 0.0}));
  EXPECT_EQ(sheet.north_km, (std::vector<double>{200.0, 210.0}));
  EXPECT_EQ(sheet.point_brightness, (std::vector<double>{0.25, 1.0}));
  EXPECT_EQ(sheet.point_energy_kev, (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(sheet.point_width_km, (std::vector<double>{1.5, 1.25}));
  EXPECT_EQ(sheet.energy_flux_mw_m2, 8.0);
  sheet.energy_flux_mw_m2 = 3.0;
  take_curtain(kTable, "curtains.csv", 2, true, sheet);
  EXPECT_EQ(sheet.energy_flux_mw_m2, 3.0);
  ASSERT_EQ(sheet.east_km.size(), 3u);
  EXPECT_EQ(sheet.point_brightness[1], 1e-6) << "no light at all has no logarithm";
}

TEST(CurveTable, RefusesWhatItCannotUse) {
  EXPECT_TRUE(tests::has_facts(problem_of(kTable, 3), "curtain 3 | 'curtains.csv' | 1 to 2"));
  const std::string without = "curtain,east_km,north_km,energy_flux_mw_m2,energy_kev\n1,0,0,1,1\n";
  EXPECT_NE(problem_of(without, 1).find("width_km"), std::string::npos) << problem_of(without, 1);
  const std::string head = "curtain,east_km,north_km,energy_flux_mw_m2,energy_kev,width_km\n";
  EXPECT_NE(problem_of(head + "1,0,0,1,1,1\n1,0,5,-1,1,1\n", 1).find("below 0"), std::string::npos);
  EXPECT_NE(problem_of(head + "1,0,0,1,1,1\n1,0,5,-1,1,1\n", 1).find("line 3"), std::string::npos);
  EXPECT_NE(problem_of(head + "1,0,0,0,1,1\n1,0,5,0,1,1\n", 1).find("no light"), std::string::npos);
  EXPECT_NE(problem_of(head + "1,0,zero,1,1,1\n", 1).find("line 2"), std::string::npos);
  EXPECT_NE(problem_of(head + "1,0,0\n", 1).find("line 2"), std::string::npos);
  EXPECT_FALSE(problem_of("", 1).empty());
  EXPECT_FALSE(problem_of("a,b\n1,2\n", 1).empty());
  EXPECT_FALSE(problem_of(head, 1).empty());
}

TEST(CurveTable, ASceneReadsItBesideItsFileAndWritesItsPoints) {
  const tests::TemporaryFolder folder;
  using tests::put;
  put(folder / "curtains.csv", kTable);
  const std::string text =
      "[[sheet]]\ncourse = \"curve\"\ncurve_file = \"curtains.csv\"\ncurve = 2\n[fit]\nfree = "
      "[\"sheet.main.east_km.2\"]\n";
  put(folder / "scene.toml", text);
  const Scene scene = read_scene(folder / "scene.toml");
  ASSERT_EQ(scene.sheets.size(), 1u);
  EXPECT_EQ(scene.sheets[0].east_km, (std::vector<double>{-50.0, 0.0, 40.0}));
  EXPECT_EQ(scene.sheets[0].energy_flux_mw_m2, 4.0);
  const Scene again = parse_scene(write_scene(scene), "again.toml");
  EXPECT_EQ(again.sheets[0].point_energy_kev, scene.sheets[0].point_energy_kev);
  EXPECT_EQ(again.sheets[0].course, SheetCourse::curve);

  const auto problem = [&](const std::string& scene_text) {
    put(folder / "scene.toml", scene_text);
    try {
      read_scene(folder / "scene.toml");
    } catch (const Error& error) {
      EXPECT_GT(error.details().line, 0) << error.details().problem;
      return error.details().problem + " | " + error.details().hint;
    }
    return std::string();
  };
  EXPECT_NE(problem("[[sheet]]\ncurve_file = \"none.csv\"\n").find("no such file"), std::string::npos);
  EXPECT_NE(problem("[[sheet]]\ncurve_file = \"curtains.csv\"\neast_km = [1, 2]\n").find("in two ways"),
            std::string::npos);
  EXPECT_NE(problem("[[sheet]]\ncurve = 2\n").find("curve needs curve_file"), std::string::npos);
  EXPECT_NE(problem("[[sheet]]\ncurve_file = \"curtains.csv\"\ncurve = 0.5\n").find("is none"),
            std::string::npos);
  EXPECT_NE(problem("[[sheet]]\ncourse = \"sine\"\ncurve_file = \"curtains.csv\"\n").find("is a sine"),
            std::string::npos);
  put(folder / "curtains.csv",
      "curtain,east_km,north_km,energy_flux_mw_m2,energy_kev,width_km\n1,0,200,1,30,1\n1,9,200,1,3,1\n");
  EXPECT_NE(problem("[[sheet]]\ncurve_file = \"curtains.csv\"\n").find("30 is outside"), std::string::npos);
}

}  // namespace
}  // namespace vegard::sim::curve_table_test
