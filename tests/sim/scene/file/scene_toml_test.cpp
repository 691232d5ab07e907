#include "sim/scene/file/scene_toml.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/bad_scene.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::scene_toml_test {
namespace {

Scene parse(const std::string& text) { return parse_scene(text, "aurora.toml"); }

/// Every value of both scenes, by path.
void expect_same(const Scene& a, const Scene& b) {
  const auto paths_a = all_paths(a), paths_b = all_paths(b);
  ASSERT_EQ(paths_a.size(), paths_b.size());
  for (std::size_t i = 0; i < paths_a.size(); ++i) {
    EXPECT_EQ(paths_a[i].text, paths_b[i].text);
    EXPECT_EQ(value_text(a, paths_a[i]), value_text(b, paths_b[i])) << paths_a[i].text;
    if (paths_a[i].row->kind != ParameterKind::real) continue;
    EXPECT_EQ(*real_value(a, paths_a[i]), *real_value(b, paths_b[i])) << paths_a[i].text;
  }
  ASSERT_EQ(a.fit.free.size(), b.fit.free.size());
  for (std::size_t i = 0; i < a.fit.free.size(); ++i) {
    const FreeParameter &x = a.fit.free[i], &y = b.fit.free[i];
    EXPECT_EQ(x.path, y.path);
    EXPECT_EQ(x.start, y.start);
    EXPECT_EQ(x.min, y.min);
    EXPECT_EQ(x.max, y.max);
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.scale, y.scale);
    EXPECT_EQ(x.photo, y.photo);
    ASSERT_EQ(x.prior.has_value(), y.prior.has_value());
    if (!x.prior) continue;
    EXPECT_EQ(x.prior->mean, y.prior->mean);
    EXPECT_EQ(x.prior->sigma, y.prior->sigma);
    EXPECT_EQ(x.prior->law, y.prior->law);
  }
  ASSERT_EQ(a.fit.tied.size(), b.fit.tied.size());
  for (std::size_t i = 0; i < a.fit.tied.size(); ++i) {
    EXPECT_EQ(a.fit.tied[i].path, b.fit.tied[i].path);
    EXPECT_EQ(a.fit.tied[i].equals, b.fit.tied[i].equals);
    EXPECT_EQ(a.fit.tied[i].photo, b.fit.tied[i].photo);
  }
}

TEST(ParseScene, AnEmptyFileIsTheDefaultDarkSky) {
  const Scene scene = parse("");
  EXPECT_TRUE(scene.sheets.empty());
  EXPECT_EQ(scene.file, "aurora.toml");
  expect_same(scene, Scene());
}

TEST(ParseScene, ReadsEveryKindOfValue) {
  const Scene scene = parse(R"(
seed = 42
[site]
latitude_deg = 64.8
time_utc = "2019-09-01T05:00:00Z"
[field]
inclination_deg = 77
[camera]
width = 1_000
[[sheet]]
center_km = [-5, 210.5]
pitch_law = 'product'
[[sheet]]
name = "far"
energy_kev = 6.5
[emission]
lines = [557.7, 844.6]
[sky]
level = [0.1, 0.2, 0.3]
[fit]
roi_px = [1, 2, 30, 40]
band_brightness = false
free = [
  "sheet.main.center_km",
  { path = "sheet.far.energy_kev", start = 6, min = 2, max = 12.5, prior = { mean = 5, sigma = 2 } },
]
)");
  EXPECT_EQ(scene.seed, 42u);
  EXPECT_EQ(scene.site.time_utc, "2019-09-01T05:00:00Z");
  EXPECT_EQ(scene.field.inclination_deg, 77.0);  // an integer counts as a number
  EXPECT_EQ(scene.camera.width, 1000);
  ASSERT_EQ(scene.sheets.size(), 2u);
  EXPECT_EQ(scene.sheets[0].name, "main");
  EXPECT_EQ(scene.sheets[0].center_km.east, -5.0);
  EXPECT_EQ(scene.sheets[0].center_km.north, 210.5);
  EXPECT_EQ(scene.sheets[0].pitch_law, PitchLaw::product);
  EXPECT_EQ(scene.sheets[1].energy_kev, 6.5);
  EXPECT_EQ(scene.emission.lines, (std::vector<double>{557.7, 844.6}));
  EXPECT_EQ(scene.blur.width_deg,
            (std::vector<double>{0.18, 0.0}));  // the paper's for 557.7, none for others
  EXPECT_EQ(scene.sky.level[2], 0.3);
  EXPECT_EQ(scene.fit.roi_px[3], 40);
  EXPECT_FALSE(scene.fit.band_brightness);
  ASSERT_EQ(scene.fit.free.size(), 2u);
  EXPECT_EQ(scene.fit.free[0].line, 24);
  EXPECT_EQ(scene.fit.free[1].line, 25);
  EXPECT_EQ(scene.fit.free[1].max, 12.5);
  EXPECT_EQ(scene.fit.free[1].prior->sigma, 2.0);
}

TEST(ParseScene, TheBlurMayStandBeforeTheLinesItBelongsTo) {
  const Scene scene = parse("[blur]\nwidth_deg = [0.3]\n[emission]\nlines = [557.7]\n");
  EXPECT_EQ(scene.blur.width_deg, (std::vector<double>{0.3}));
}

// By hand: start (0, 0), end (300, -400): the middle is (150, -200); 300 east and 400 south are 500 km of a
// 3-4-5 triangle, walked towards 180 deg - atan(3/4) = 143.1301024 deg.
TEST(ParseScene, TurnsStartAndEndIntoCentreBearingAndLength) {
  const Sheet sheet = parse("[[sheet]]\nstart_km = [0, 0]\nend_km = [300, -400]\n").sheets.at(0);
  EXPECT_DOUBLE_EQ(sheet.center_km.east, 150.0);
  EXPECT_DOUBLE_EQ(sheet.center_km.north, -200.0);
  EXPECT_NEAR(sheet.bearing_deg, 143.1301023541560, 1e-12);
  EXPECT_DOUBLE_EQ(sheet.length_km, 500.0);
}

TEST(ParseScene, BearingsRunFromNorthToTheEastWithinOneTurn) {
  const auto bearing = [](const std::string& end) {
    return parse("[[sheet]]\nstart_km = [10, 20]\nend_km = " + end + "\n").sheets.at(0).bearing_deg;
  };
  EXPECT_DOUBLE_EQ(bearing("[10, 120]"), 0.0);
  EXPECT_DOUBLE_EQ(bearing("[110, 120]"), 45.0);
  EXPECT_DOUBLE_EQ(bearing("[110, 20]"), 90.0);
  EXPECT_DOUBLE_EQ(bearing("[10, -80]"), 180.0);
  EXPECT_DOUBLE_EQ(bearing("[-90, 20]"), 270.0);
  EXPECT_DOUBLE_EQ(bearing("[-90, 120]"), 315.0);
  EXPECT_LT(bearing("[9.99999999999999, 1020]"), 360.0);
}

TEST(ParseScene, CentreBearingAndLengthGiveTheEndsBack) {
  const Sheet sheet = parse("[[sheet]]\nstart_km = [-108.4, 239.2]\nend_km = [224.4, 215.7]\n").sheets.at(0);
  const double bearing = sheet.bearing_deg * 3.14159265358979323846 / 180.0;
  const double east = 0.5 * sheet.length_km * std::sin(bearing),
               north = 0.5 * sheet.length_km * std::cos(bearing);
  EXPECT_NEAR(sheet.center_km.east - east, -108.4, 1e-11);
  EXPECT_NEAR(sheet.center_km.north - north, 239.2, 1e-11);
  EXPECT_NEAR(sheet.center_km.east + east, 224.4, 1e-11);
  EXPECT_NEAR(sheet.center_km.north + north, 215.7, 1e-11);
}

// The paper's n_p, the number of points from fold to fold: a layer of 800 beams on 400 km has 2 to a
// kilometre.
TEST(ParseScene, TurnsPointsBetweenFoldsIntoTheirSpacing) {
  const auto spacing = [](const std::string& keys) {
    return parse("[[sheet]]\npoints_between_folds = 60\n" + keys).sheets.at(0).fold_spacing_km;
  };
  EXPECT_DOUBLE_EQ(spacing("beams = 800\nlength_km = 400\n"), 30.0);
  EXPECT_DOUBLE_EQ(spacing("beams = 800\nstart_km = [0, 0]\nend_km = [0, 200]\n"), 15.0);
  EXPECT_DOUBLE_EQ(spacing("beams = 800\nbeams_per_km = 3\nlength_km = 400\n"), 20.0);
}

// A lens as long as half the sensor is wide sees 45 deg to either side; 50 mm on 36 mm are the textbook 39.6
// deg.
TEST(ParseScene, TurnsFocalLengthIntoFieldOfView) {
  EXPECT_NEAR(parse("[camera]\nfocal_length_mm = 18\nsensor_width_mm = 36\n").camera.hfov_deg, 90.0, 1e-12);
  EXPECT_NEAR(parse("[camera]\nfocal_length_mm = 50\nsensor_width_mm = 36\n").camera.hfov_deg, 39.5978, 5e-5);
}

// Source paper, table 1: 1, 10, 100 and 1000 kR.
TEST(ParseScene, TurnsTheBrightnessCoefficientIntoKilorayleigh) {
  const auto brightness = [](const std::string& ibc) {
    return parse("[[sheet]]\nibc = " + ibc + "\n").sheets.at(0).brightness_kilorayleigh;
  };
  EXPECT_NEAR(brightness("1"), 1.0, 1e-12);
  EXPECT_NEAR(brightness("2"), 10.0, 1e-12);
  EXPECT_NEAR(brightness("3"), 100.0, 1e-10);
  EXPECT_NEAR(brightness("4"), 1000.0, 1e-9);
  EXPECT_NEAR(brightness("2.5"), 31.6227766, 1e-6);
}

TEST(ParseScene, TurnsMeanCollisionsAndTheFieldRatioIntoStepAndLossCone) {
  EXPECT_DOUBLE_EQ(parse("[[sheet]]\nmean_collisions = 300\n").sheets.at(0).path_step, 1.0 / 150.0);
  // arcsin sqrt(B / B at 100 km): a field 500 times weaker far out leaves a cone of 2.56 degrees.
  EXPECT_NEAR(parse("[[sheet]]\nfield_ratio = 0.002\n").sheets.at(0).loss_cone_deg, 2.5632, 5e-5);
  EXPECT_NEAR(parse("[[sheet]]\nfield_ratio = 0\n").sheets.at(0).loss_cone_deg, 0.0, 1e-15);
}

class BadScene : public testing::TestWithParam<Bad> {};

TEST_P(BadScene, IsRefusedWithLineKeyAndReason) { expect_refused(GetParam()); }

const Bad bad_scenes[] = {
    {"syntax", "seed = 1\n[camera\n", 2, "", "a TOML file"},
    {"twice", "[camera]\nwidth = 3\nwidth = 4\n", 3, "", "redefine"},
    {"null_byte", "seed = 1\n#\x01\n", 2, "", "a TOML file"},
    {"unknown_key", "[camera]\nheight = 4\nwidht = 3\n", 3, "camera.widht", "did you mean 'width'?"},
    {"unknown_key_far_from_all", "[camera]\nqqqqqqqqq = 3\n", 2, "camera.qqqqqqqqq", "nearest"},
    {"unknown_key_first_of_two", "[camera]\nzzz = 4\naaa = 3\n", 2, "camera.zzz", "unknown key 'zzz'"},
    {"unknown_key_cut_short", "[site]\nlat = 3\n", 2, "site.lat", "did you mean 'latitude_deg'?"},
    {"unknown_key_british", "[[sheet]]\ncentre_km = [1, 2]\n", 2, "sheet.centre_km",
     "did you mean 'center_km'?"},
    {"unknown_key_of_form", "[[sheet]]\nstart = [1, 2]\n", 2, "sheet.start", "did you mean 'start_km'?"},
    {"key_of_another_table", "[camera]\nlatitude_deg = 3\n", 2, "camera.latitude_deg",
     "'latitude_deg' belongs to [site]"},
    {"key_of_a_sheet", "[fit]\nenergy_kev = 3\n", 2, "fit.energy_kev", "'energy_kev' belongs to [[sheet]]"},
    {"key_of_another_table_misspelt", "[fit]\nlatitude_dge = 3\n", 2, "fit.latitude_dge",
     "'latitude_deg' | [site]"},
    {"key_without_table", "width = 3\n", 1, "width", "'width' belongs to [camera]"},
    {"seed_in_a_table", "[fit]\nseed = 3\n", 2, "fit.seed", "'seed' | top"},
    {"unknown_table", "seed = 1\n\n[camra]\nwidth = 3\n", 3, "camra", "'camra' | 'camera'"},
    {"unknown_array_of_tables", "[[sheets]]\n", 1, "sheets", "did you mean 'sheet'?"},
    {"table_in_table", "[camera.lens]\nwidth = 3\n", 1, "camera.lens", "unknown table 'lens'"},
    {"sheet_as_table", "[sheet]\n", 1, "sheet", "write [[sheet]]"},
    {"sheet_as_numbers", "sheet = [1, 2]\n", 1, "sheet", "array of tables | [[sheet]]"},
    {"table_as_array", "[[camera]]\nwidth = 3\n", 1, "camera", "one table [camera]"},
    {"table_as_number", "camera = 3\n", 1, "camera", "whole number 3 | [camera]"},
    {"text_for_integer", "[camera]\n\nwidth = \"wide\"\n", 3, "camera.width",
     "text \"wide\" | 1 to 65535 (px)"},
    {"real_for_integer", "[camera]\nwidth = 3.0\n", 2, "camera.width", "number 3.0 | whole number"},
    {"text_for_real", "[[sheet]]\nenergy_kev = '3'\n", 2, "sheet.main.energy_kev", "text \"3\" | a number"},
    {"boolean_for_real", "[camera]\nhfov_deg = true\n", 2, "camera.hfov_deg", "found true"},
    {"integer_for_boolean", "[fit]\nband_brightness = 1\n", 2, "fit.band_brightness", "| true or false"},
    {"integer_for_text", "[sensor]\nprimaries = 1\n", 2, "sensor.primaries", "whole number 1"},
    {"date_for_text", "[site]\ntime_utc = 2019-09-01T05:00:00Z\n", 2, "site.time_utc", "quotes"},
    {"array_for_real", "[camera]\nhfov_deg = [60]\n", 2, "camera.hfov_deg", "array of 1"},
    {"table_for_vector", "[[sheet]]\ncenter_km = { east = 1, north = 2 }\n", 2, "sheet.main.center_km",
     "a table | array of 2 | east, north"},
    {"short_vector", "[[sheet]]\ncenter_km = [1]\n", 2, "sheet.main.center_km", "array of 1"},
    {"text_in_vector", "[[sheet]]\ncenter_km = [\n1,\n'x']\n", 4, "sheet.main.center_km.north",
     "found the text"},
    {"real_in_roi", "[fit]\nroi_px = [0, 0, 10.5, 10]\n", 2, "fit.roi_px.width", "found the number 10.5"},
    {"long_roi", "[fit]\nroi_px = [0, 0, 10, 10, 10]\n", 2, "fit.roi_px", "array of 4 | x, y, width, height"},
    {"empty_roi", "[fit]\nbands = 2\nroi_px = [5, 5, 0, 10]\n", 3, "fit.roi_px", "empty"},
    {"narrow_roi", "[fit]\nroi_px = [5, 5, 10, 10]\nbands = 11\n", 2, "fit.roi_px", "11 bands"},
    {"no_bands", "[fit]\nbands = 0\n", 2, "fit.bands", "0 | limits"},
    {"unknown_decoding", "[fit]\ndecoding = \"gamma\"\n", 2, "fit.decoding", "which gamma"},
    {"nan", "[camera]\nhfov_deg = nan\n", 2, "camera.hfov_deg", "nan"},
    {"minus_nan", "[sky]\nlevel = [0.0, -nan, 0.0]\n", 2, "sky.level.green", "nan"},
    {"infinite", "[camera]\nazimuth_deg = inf\n", 2, "camera.azimuth_deg", "inf"},
    {"negative_length", "[[sheet]]\nlength_km = -400\n", 2, "sheet.main.length_km", "-400"},
    {"zero_thickness", "[[sheet]]\nthickness_km = 0\n", 2, "sheet.main.thickness_km", "0 is outside"},
    {"too_energetic", "[[sheet]]\nenergy_kev = 20.5\n", 2, "sheet.main.energy_kev", "from 0.1 to 20 (keV)"},
    {"flat_field", "[field]\ndeclination_deg = 2\ninclination_deg = 10\n", 3, "field.inclination_deg",
     "horizontal"},
    {"huge_integer", "seed = 99999999999999999999\n", 1, "", "a TOML file"},
    {"negative_seed", "\nseed = -1\n", 2, "seed", "at least 0"},
    {"wide_fov", "[camera]\nhfov_deg = 180\n", 2, "camera.hfov_deg", "from 0.1 to 170 (deg)"},
    {"unknown_line", "[emission]\nlines = [630.0,\n558.0]\n", 3, "emission.lines", "557.7"},
    {"line_twice", "[emission]\nlines = [630.0, 557.7, 630.0]\n", 2, "emission.lines",
     "630.0 is listed twice"},
    {"no_line", "[emission]\nlines = []\n", 2, "emission.lines", "1 to 8 of"},
    {"blur_too_short", "[blur]\nwidth_deg = [0.1, 0.2]\n", 2, "blur.width_deg",
     "2 widths | 3 emission lines"},
    {"sheet_name_twice", "[[sheet]]\nname = 'a'\n[[sheet]]\nname = 'b'\n[[sheet]]\nname = 'a'\n", 5, "sheet",
     "[[sheet]] | 'a' | line 1"},
    {"two_nameless_sheets", "[[sheet]]\n[[sheet]]\n", 2, "sheet", "without a name | 'main'"},
    {"sheet_name_with_dot", "[[sheet]]\nname = 'a.b'\n", 2, "sheet.main.name", "'a.b'"},
    {"sheet_name_with_space", "[[sheet]]\nname = 'a b'\n", 2, "sheet.main.name", "path"},
    {"empty_sheet_name", "[[sheet]]\nname = ''\n", 2, "sheet.main.name", "empty"},
    {"sheet_named_like_a_key", "[[sheet]]\nname = 'width_km'\n", 2, "sheet.main.name", "also a key"},
    {"both_forms", "[[sheet]]\nstart_km = [1, 2]\nend_km = [3, 4]\ncenter_km = [2, 3]\n", 3, "sheet.end_km",
     "two ways"},
    {"both_forms_by_length", "[[sheet]]\nlength_km = 3\nstart_km = [1, 2]\nend_km = [3, 4]\n", 4,
     "sheet.end_km", "start_km and end_km stand for center_km, bearing_deg, length_km"},
    {"start_alone", "[[sheet]]\nstart_km = [1, 2]\n", 2, "sheet.start_km", "start_km needs end_km"},
    {"end_alone", "[[sheet]]\nend_km = [1, 2]\n", 2, "sheet.end_km", "end_km needs start_km"},
    {"no_way", "[[sheet]]\nstart_km = [1, 2]\nend_km = [1, 2]\n", 3, "sheet.end_km", "the same point"},
    {"too_short_a_way", "[[sheet]]\nstart_km = [1, 2]\nend_km = [1, 2.01]\n", 3, "sheet.main.length_km",
     "0.01 is outside"},
    {"start_not_finite", "[[sheet]]\nstart_km = [nan, 2]\nend_km = [1, 2.01]\n", 2, "sheet.start_km",
     "nan is outside"},
    {"start_a_number", "[[sheet]]\nstart_km = 3\nend_km = [1, 2]\n", 2, "sheet.start_km", "two numbers"},
    {"curve_without_points", "[[sheet]]\ncourse = \"curve\"\n", 2, "sheet.main.course",
     "0 points | east_km and north_km | 2 to 1000"},
    {"curve_of_one_point", "[[sheet]]\ncourse = \"curve\"\neast_km = [1]\nnorth_km = [2]\n", 3,
     "sheet.main.east_km", "1 point |"},
    {"curve_of_other_lengths", "[[sheet]]\ncourse = \"curve\"\neast_km = [1, 9]\nnorth_km = [2]\n", 4,
     "sheet.main.north_km", "1 numbers | 2 points | every point"},
    {"curve_with_too_few_energies",
     "[[sheet]]\ncourse = \"curve\"\neast_km = [1, 9]\nnorth_km = [2, 2]\npoint_energy_kev = [3]\n", 5,
     "sheet.main.point_energy_kev", "1 numbers | 2 points | or none"},
    {"curve_that_stands_still", "[[sheet]]\ncourse = \"curve\"\neast_km = [1, 9, 9]\nnorth_km = [2, 2, 2]\n",
     3, "sheet.main.east_km", "points 1 and 2"},
    {"curve_of_a_dark_point",
     "[[sheet]]\ncourse = \"curve\"\neast_km = [1, 9]\nnorth_km = [2, 2]\npoint_brightness = [1, 0]\n", 5,
     "sheet.main.point_brightness", "0 is outside"},
    {"curve_of_arcs", "[[sheet]]\ncourse = \"curve\"\narcs = 2\neast_km = [1, 9]\nnorth_km = [2, 2]\n", 3,
     "sheet.main.arcs", "curve | single arc"},
    {"curve_of_folds",
     "[[sheet]]\ncourse = \"curve\"\nfold_spacing_km = 20\neast_km = [1, 9]\nnorth_km = [2, 2]\n", 3,
     "sheet.main.fold_spacing_km", "no folds"},
    {"curve_by_the_papers_walk",
     "[[sheet]]\ncourse = \"curve\"\nspacing_rule = \"literal\"\neast_km = [1, 9]\nnorth_km = [2, 2]\n", 3,
     "sheet.main.spacing_rule", "paper's walk"},
    {"points_of_a_sine", "[[sheet]]\neast_km = [1, 9]\nnorth_km = [2, 2]\n", 2, "sheet.main.east_km",
     "east_km | curve | sine"},
    {"free_bearing_of_a_curve",
     "[[sheet]]\ncourse = \"curve\"\neast_km = [1, 9]\nnorth_km = [2, 2]\n[fit]\nfree = "
     "[\"sheet.main.bearing_deg\"]\n",
     6, "sheet.main.bearing_deg", "curve | bearing_deg"},
    {"free_energy_beside_energies",
     "[[sheet]]\ncourse = \"curve\"\neast_km = [1, 9]\nnorth_km = [2, 2]\npoint_energy_kev = [3, 4]\n"
     "[fit]\nfree = [\"sheet.main.energy_kev\"]\n",
     7, "sheet.main.energy_kev", "point_energy_kev | energy_kev"},
    {"free_flux_beside_all_brightness",
     "[[sheet]]\ncourse = \"curve\"\neast_km = [1, 9]\nnorth_km = [2, 2]\npoint_brightness = [1, 1]\n"
     "[fit]\nfree = [\"sheet.main.energy_flux_mw_m2\", \"sheet.main.point_brightness\"]\n",
     7, "sheet.main.energy_flux_mw_m2", "product"},
    {"curve_file_without_a_file", "[[sheet]]\ncurve_file = \"curtains.csv\"\n", 2, "sheet.main.curve_file",
     "no file"},
    {"folds_overlap", "[[sheet]]\nfold_spacing_km = 6\nfold_length_km = 6.5\n", 3,
     "sheet.main.fold_length_km", "overlap | fold_length_km | 6.5 | fold_spacing_km | 6"},
    {"curls_overlap", "[[sheet]]\ncurl_radius_km = 3\ncurl_spacing_km = 2\n", 2, "sheet.main.curl_radius_km",
     "curls would overlap"},
    {"folds_by_points_and_by_spacing", "[[sheet]]\npoints_between_folds = 90\nfold_spacing_km = 6\n", 2,
     "sheet.points_between_folds", "points_between_folds stands for fold_spacing_km"},
    {"too_few_points_between_folds", "[[sheet]]\npoints_between_folds = 0\n", 2, "sheet.points_between_folds",
     "0 | limits"},
    {"points_too_close", "[[sheet]]\npoints_between_folds = 2\n", 2, "sheet.main.fold_spacing_km",
     "folds would overlap"},
    {"form_above_its_beams", "[[sheet]]\nprofile = \"form\"\npeak_km = 200\ntop_km = 180\n", 3,
     "sheet.main.peak_km", "200 km | 180"},
    {"lifetime_too_short", "[[sheet]]\nray_lifetime_s = 1e-12\n", 2, "sheet.main.ray_lifetime_s", "0.001"},
    {"unknown_form", "[[sheet]]\nform = \"draperie\"\n", 2, "sheet.main.form", "did you mean \"drapery\"?"},
    {"ibc_and_brightness", "[[sheet]]\nibc = 2\nbrightness_kilorayleigh = 10\n", 2, "sheet.ibc",
     "ibc | brightness_kilorayleigh | one of"},
    {"ibc_too_bright", "[[sheet]]\nibc = 5\n", 2, "sheet.ibc", "5 | 1 to 4"},
    {"no_collisions", "[[sheet]]\nmean_collisions = 0\n", 2, "sheet.mean_collisions", "from 4 to 200000"},
    {"strong_field", "[[sheet]]\nfield_ratio = 0.5\n", 2, "sheet.field_ratio", "from 0 to 0.24"},
    {"free_flux_of_given_brightness",
     "[[sheet]]\nibc = 2\n[fit]\nfree = [\n\"sheet.main.energy_flux_mw_m2\"]\n", 5,
     "sheet.main.energy_flux_mw_m2", "brightness | energy flux"},
    {"free_inclination_of_a_dipole",
     "[field]\nmodel = \"dipole\"\n[fit]\nfree = [\"field.inclination_deg\"]\n", 4, "field.inclination_deg",
     "dipole | inclination_deg"},
    {"free_aerosol_without_air", "[[sheet]]\n[fit]\nfree = [\"air.aerosol_optical_depth\"]\n", 3,
     "air.aerosol_optical_depth", "no air | aerosol_optical_depth"},
    {"sun_too_high", "[twilight]\nsun_elevation_deg = -2\n", 2, "twilight.sun_elevation_deg",
     "from -15 to -5"},
    {"free_stage_without_folds", "[[sheet]]\n[fit]\nfree = [\"sheet.main.fold_stage\"]\n", 3,
     "sheet.main.fold_stage", "no folds"},
    {"free_spacing_of_one_arc", "[[sheet]]\n[fit]\nfree = [\"sheet.main.arc_spacing_km\"]\n", 3,
     "sheet.main.arc_spacing_km", "single arc"},
    {"focal_length_alone", "[camera]\nfocal_length_mm = 18\n", 2, "camera.focal_length_mm",
     "needs sensor_width_mm"},
    {"focal_length_and_fov", "[camera]\nfocal_length_mm = 18\nsensor_width_mm = 36\nhfov_deg = 60\n", 3,
     "camera.sensor_width_mm", "two ways"},
    {"negative_focal_length", "[camera]\nfocal_length_mm = -18\nsensor_width_mm = 36\n", 2,
     "camera.focal_length_mm", "-18"},
    {"fisheye", "[camera]\nfocal_length_mm = 1\nsensor_width_mm = 36\n", 3, "camera.hfov_deg",
     "outside the limits"},
    {"free_no_array", "[fit]\nfree = \"sheet.main.energy_kev\"\n", 2, "fit.free", "paths and tables"},
    {"free_number", "[fit]\nfree = [\n3]\n", 3, "fit.free", "in quotes"},
    {"free_without_path", "[fit]\nfree = [{ min = 3 }]\n", 2, "fit.free", "has no path"},
    {"free_unknown_key", "[fit]\nfree = [{ path = \"camera.hfov_deg\", strat = 3 }]\n", 2, "fit.free.strat",
     "did you mean 'start'?"},
    {"free_text_for_min", "[fit]\nfree = [{ path = \"camera.hfov_deg\", min = \"3\" }]\n", 2, "fit.free.min",
     "a number"},
    {"free_unknown_path", "[[sheet]]\n[fit]\nfree = [\n\"camera.hfov_deg\",\n\"sheet.main.enrgy_kev\"]\n", 5,
     "sheet.main.enrgy_kev", "did you mean 'sheet.main.energy_kev'?"},
    {"free_integer", "[fit]\nfree = [\"camera.width\"]\n", 2, "camera.width", "cannot be free"},
    {"free_twice", "[[sheet]]\n[fit]\nfree = [\"sheet.main.center_km\",\n\"sheet.main.center_km.east\"]\n", 4,
     "sheet.main.center_km.east", "twice | 'sheet.main.center_km' | line 3"},
    {"free_start_outside", "[fit]\nfree = [{ path = \"camera.hfov_deg\", start = 5, min = 6 }]\n", 2,
     "camera.hfov_deg", "start 5.0 | min and max"},
    {"free_prior_without_sigma", "[fit]\nfree = [{ path = \"camera.hfov_deg\", prior = { mean = 5 } }]\n", 2,
     "fit.free.prior", "no sigma"},
    {"free_prior_number", "[fit]\nfree = [{ path = \"camera.hfov_deg\", prior = 3 }]\n", 2, "fit.free.prior",
     "{ mean, sigma } | law"},
    {"free_prior_of_no_law",
     "[fit]\nfree = [{ path = \"camera.hfov_deg\", prior = { mean = 5, sigma = 1, law = \"flat\" } }]\n", 2,
     "fit.free.prior.law", "\"flat\" is no law"},
    {"free_prior_uniform_with_mean",
     "[fit]\nfree = [{ path = \"camera.hfov_deg\", prior = { mean = 5, law = \"uniform\" } }]\n", 2,
     "fit.free.prior.mean", "uniform | no mean"},
    {"free_prior_uniform_without_limits",
     "[fit]\nfree = [{ path = \"camera.hfov_deg\", min = 50, prior = { law = \"uniform\" } }]\n", 2,
     "camera.hfov_deg", "min and max"},
    {"free_prior_log_normal_about_zero",
     "[fit]\nfree = [{ path = \"camera.hfov_deg\", prior = { mean = 0, sigma = 1, law = \"log-normal\" } "
     "}]\n",
     2, "camera.hfov_deg", "mean 0.0 | logarithm"},
    {"free_prior_log_normal_of_a_sign",
     "[fit]\nfree = [{ path = \"camera.roll_deg\", prior = { mean = 1, sigma = 1, law = \"log-normal\" } "
     "}]\n",
     2, "camera.roll_deg", "min of 0"},
    {"free_scale", "[fit]\nfree = [{ path = \"camera.hfov_deg\", scale = \"log\" }]\n", 2, "fit.free.scale",
     "\"log\" is no scale"},
    {"free_scale_without_room",
     "[[sheet]]\n[fit]\nfree = [{ path = \"sheet.main.center_km.north\", scale = \"logarithmic\" }]\n", 3,
     "sheet.main.center_km.north", "a min above 0"},
    {"free_of_no_photo", "[fit]\nfree = [{ path = \"camera.hfov_deg\", photo = \"left\" }]\n", 2,
     "camera.hfov_deg", "'left'"},
    {"name_of_a_vector",
     "[[sheet]]\n[fit]\nfree = [{ path = \"sheet.main.center_km\", name = \"centre\" }]\n", 3,
     "sheet.main.center_km", "2 numbers | one number"},
    {"name_is_a_path", "[fit]\nfree = [{ path = \"camera.hfov_deg\", name = \"camera.roll_deg\" }]\n", 2,
     "camera.hfov_deg", "parameter's path"},
    {"name_is_a_function", "[fit]\nfree = [{ path = \"camera.hfov_deg\", name = \"sin\" }]\n", 2,
     "camera.hfov_deg", "word of expressions"},
    {"name_is_a_difference", "[fit]\nfree = [{ path = \"camera.hfov_deg\", name = \"a-b\" }]\n", 2,
     "camera.hfov_deg", "expression"},
    {"name_in_two_units",
     "[[sheet]]\n[fit]\nfree = [\n{ path = \"camera.hfov_deg\", name = \"x\" },\n{ path = "
     "\"sheet.main.width_km\", name = \"x\" }]\n",
     5, "sheet.main.width_km", "'x' in line 4 | deg | km"},
    {"name_on_two_scales",
     "[[sheet]]\n[[sheet]]\nname = \"b\"\n[fit]\nfree = [{ path = \"sheet.main.energy_kev\", name = \"e\" "
     "},\n"
     "{ path = \"sheet.b.energy_kev\", name = \"e\", scale = \"linear\" }]\n",
     6, "sheet.b.energy_kev", "'e' in line 5 | scale"},
    {"name_with_two_starts",
     "[[sheet]]\n[[sheet]]\nname = \"b\"\n[fit]\nfree = [{ path = \"sheet.main.energy_kev\", name = \"e\" "
     "},\n"
     "{ path = \"sheet.b.energy_kev\", name = \"e\", start = 4 }]\n",
     6, "sheet.b.energy_kev", "start 4.0 | 'e' in line 5"},
    {"name_with_two_priors",
     "[[sheet]]\n[[sheet]]\nname = \"b\"\n[fit]\nfree = [{ path = \"sheet.main.energy_kev\", name = \"e\" "
     "},\n"
     "{ path = \"sheet.b.energy_kev\", name = \"e\", prior = { mean = 4, sigma = 1 } }]\n",
     6, "sheet.b.energy_kev", "prior | 'e' in line 5"},
    {"name_of_a_number_and_a_path",
     "[[sheet]]\n[fit]\nfree = [{ name = \"e\", start = 2, min = 1, max = 3 },\n{ path = "
     "\"sheet.main.energy_kev\", name = \"e\" }]\n",
     4, "sheet.main.energy_kev", "another number"},
    {"number_without_max", "[fit]\nfree = [{ name = \"x\", start = 2, min = 1 }]\n", 2, "x", "needs a max"},
    {"number_out_of_order", "[fit]\nfree = [{ name = \"x\", start = 2, min = 3, max = 4 }]\n", 2, "x",
     "start 2.0"},
    {"number_without_use", "[fit]\nfree = [{ name = \"x\", start = 2, min = 1, max = 3 }]\n", 2, "x",
     "fit.tied"},
    {"tied_no_array", "[fit]\ntied = 3\n", 2, "fit.tied", "{ path, equals }"},
    {"tied_text", "[fit]\ntied = [\n\"x\"]\n", 3, "fit.tied", "{ path, equals }"},
    {"tied_without_expression", "[fit]\ntied = [{ path = \"camera.hfov_deg\" }]\n", 2, "fit.tied",
     "no equals"},
    {"tied_unknown_key", "[fit]\ntied = [{ path = \"camera.hfov_deg\", equal = \"3\" }]\n", 2,
     "fit.tied.equal", "did you mean 'equals'?"},
    {"tied_unknown_path", "[fit]\ntied = [{ path = \"camera.hfov\", equals = \"3\" }]\n", 2, "camera.hfov",
     "'camera.hfov_deg'"},
    {"tied_width", "[fit]\ntied = [{ path = \"camera.width\", equals = \"30\" }]\n", 2, "camera.width",
     "cannot be tied"},
    {"tied_vector", "[[sheet]]\n[fit]\ntied = [{ path = \"sheet.main.center_km\", equals = \"30\" }]\n", 3,
     "sheet.main.center_km", "components"},
    {"tied_idle", "[fit]\ntied = [{ path = \"air.aerosol_optical_depth\", equals = \"0.1\" }]\n", 2,
     "air.aerosol_optical_depth", "no air"},
    {"tied_and_free",
     "[[sheet]]\n[fit]\nfree = [\"sheet.main.center_km\"]\ntied = [{ path = \"sheet.main.center_km.north\", "
     "equals = \"100\" }]\n",
     4, "sheet.main.center_km.north", "tied and free | 'sheet.main.center_km' | line 3"},
    {"tied_twice",
     "[fit]\ntied = [{ path = \"camera.hfov_deg\", equals = \"60\" },\n{ path = \"camera.hfov_deg\", equals "
     "= "
     "\"50\" }]\n",
     3, "camera.hfov_deg", "tied twice | line 2"},
    {"tied_to_an_unknown_name",
     "[[sheet]]\n[fit]\nfree = [{ name = \"distance\", start = 2, min = 1, max = 3 }]\ntied = [{ path = "
     "\"sheet.main.center_km.north\", equals = \"2 * distanse\" }]\n",
     4, "sheet.main.center_km.north", "unknown name | 'distanse'"},
    {"tied_to_an_unknown_path",
     "[[sheet]]\nname = \"a-b\"\n[fit]\ntied = [{ path = \"sheet.a-b.energy_kev\", equals = "
     "\"sheet.a-b.widht_km\" }]\n",
     4, "sheet.a-b.energy_kev", "did you mean 'sheet.a-b.width_km'?"},
    {"tied_to_nonsense",
     "[fit]\ntied = [{ path = \"camera.hfov_deg\", equals = \"60 + * camera.roll_deg\" }]\n", 2,
     "camera.hfov_deg", "character 6 | '* camera.roll_deg'"},
    {"tied_in_a_circle",
     "[fit]\ntied = [{ path = \"camera.hfov_deg\", equals = \"60 + camera.roll_deg\" },\n{ path = "
     "\"camera.roll_deg\", equals = \"camera.hfov_deg / 60\" }]\n",
     2, "camera.hfov_deg", "circle | camera.hfov_deg | camera.roll_deg | camera.hfov_deg"},
    {"tied_to_itself", "[fit]\ntied = [{ path = \"camera.hfov_deg\", equals = \"camera.hfov_deg + 1\" }]\n",
     2, "camera.hfov_deg", "in a circle"},
    {"tied_out_of_limits",
     "[[sheet]]\n[fit]\nfree = [{ path = \"sheet.main.energy_kev\", start = 5 }]\ntied = [{ path = "
     "\"camera.hfov_deg\", equals = \"40 * sheet.energy_kev\" }]\n",
     4, "camera.hfov_deg", "'40 * sheet.energy_kev' | 200"},
    {"tied_to_no_number",
     "[fit]\ntied = [{ path = \"camera.hfov_deg\", equals = \"sqrt(camera.roll_deg - 1)\" }]\n", 2,
     "camera.hfov_deg", "usable number"},
    {"tied_of_no_photo",
     "[fit]\ntied = [{ path = \"camera.hfov_deg\", equals = \"60\", photo = \"left\" }]\n", 2,
     "camera.hfov_deg", "'left'"},
    {"free_prior_sigma_negative",
     "[fit]\nfree = [{ path = \"camera.hfov_deg\", prior = { mean = 5, sigma = -1 } }]\n", 2,
     "camera.hfov_deg", "a number above 0"},
};

INSTANTIATE_TEST_SUITE_P(Input, BadScene, testing::ValuesIn(bad_scenes),
                         [](const auto& test) { return std::string(test.param.what); });

TEST(ReadScene, NamesAMissingFileADirectoryAndAHugeFile) {
  const auto problem = [](const std::string& file) {
    try {
      read_scene(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
      EXPECT_EQ(error.details().file, file);
      return error.details().problem;
    }
    return std::string();
  };
  const std::string folder = testing::TempDir();
  EXPECT_TRUE(tests::has_facts(problem(folder + "no_such_scene.toml"), "no such file"));
  EXPECT_EQ(problem(folder), "is a directory");
  const std::string huge = folder + "vegard_huge_scene.toml";
  std::ofstream(huge) << "# nothing\n";
  std::filesystem::resize_file(huge, (16 << 20) + 1);
  EXPECT_EQ(problem(huge), "is larger than 16 MB");
  std::filesystem::remove(huge);
}

TEST(ReadScene, ReadsAFileAndRemembersItsName) {
  const std::string file = testing::TempDir() + "vegard_scene.toml";
  std::ofstream(file) << "seed = 5\r\n[camera]\r\nwidth = 640\r\n";
  const Scene scene = read_scene(file);
  std::filesystem::remove(file);
  EXPECT_EQ(scene.seed, 5u);
  EXPECT_EQ(scene.camera.width, 640);
  EXPECT_EQ(scene.file, file);
}

TEST(WriteScene, ReadsBackTheSame) {
  Scene scene = parse(R"toml(
seed = 9223372036854775807
[site]
time_utc = "2019-09-01T05:00:00.25Z"
[[sheet]]
start_km = [-108.44358379158311, 239.24184794813618]
end_km = [224.36924806685985, 215.66492339998274]
[[sheet]]
name = "far"
energy_kev = 0.1
[emission]
lines = [427.8, 337.1]
[fit]
white_balance_known = false
free = [
  "sheet.main.center_km", 
  { path = "sheet.far.energy_kev", start = 0.3333333333333333, prior = { mean = 1, sigma = 1e-3 } },
  { path = "sheet.far.width_km", name = "w", scale = "linear", prior = { mean = 1, sigma = 0.5, law = "log-normal" } },
  { path = "sheet.main.width_km", name = "w", scale = "linear" },
  { name = "tilt", start = 0.25, min = -1, max = 1, prior = { law = "uniform" } },
]
tied = [
  { path = "sheet.far.center_km.east", equals = "sheet.main.center_km.east + 30 * sin(tilt)" },
  { path = "sheet.far.center_km.north", equals = "sheet.main.center_km.north - 0.5 * w" },
]
)toml");
  scene.sensor.gain_per_kilorayleigh = 1e-9;
  scene.sky.level = {1.0 / 3.0, 5e-324, -0.0};
  const std::string text = write_scene(scene, "found by a fit\nin two lines: \x01 \xff København");
  const Scene again = parse(text);
  expect_same(scene, again);
  EXPECT_TRUE(std::signbit(again.sky.level[2]));
  EXPECT_NE(text.find("\n# found by a fit\n# in two lines: ? ? København\n"), std::string::npos);
  EXPECT_NE(text.find("length_km = "), std::string::npos);
  EXPECT_EQ(write_scene(again), write_scene(scene));
}

TEST(WriteScene, ADarkSkyReadsBackTheSame) { expect_same(parse(write_scene(Scene())), Scene()); }

// Whether toml++ rounds every decimal to the nearest double is not in its contract: bit patterns from all
// over the range of the type are sent round.
TEST(WriteScene, KeepsEveryBitOfANumber) {
  std::uint64_t state = 1;
  Scene scene;
  scene.sheets.resize(1);
  int count = 0;
  while (count < 500) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    const std::uint64_t bits = state ^ (state >> 29);
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!(std::abs(value) <= 3000.0)) continue;  // the limits of center_km; NaN fails too
    ++count;
    scene.sheets[0].center_km = {value, std::ldexp(static_cast<double>(bits >> 11), -43)};
    const Scene again = parse(write_scene(scene));
    ASSERT_EQ(again.sheets[0].center_km.east, value);
    ASSERT_EQ(again.sheets[0].center_km.north, scene.sheets[0].center_km.north);
  }
}

}  // namespace
}  // namespace vegard::sim::scene_toml_test
