#include "sim/scene/table/parameter_table.h"

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/spline_rates.h"

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/scene/table/parameter_declarations.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::parameter_table_test {
namespace {

Scene scene_of_two() {
  Scene scene;
  scene.sheets.resize(2);
  scene.sheets[1].name = "far";
  return scene;
}

Scene scene_of_one() {
  Scene scene;
  scene.sheets.resize(1);
  return scene;
}

/// The details of the error that `action` must throw.
template <class Action>
ErrorDetails error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    return error.details();
  }
  ADD_FAILURE() << "no error was thrown";
  return {};
}

ErrorDetails set_error(Scene& scene, const std::string& path, const std::string& text) {
  return error_of([&] { set_from_text(scene, path, text); });
}

ErrorDetails validate_error(const Scene& scene) {
  return error_of([&] { validate(scene); });
}

TEST(ParameterTable, HasEachPathOnceWithWords) {
  std::set<std::string> patterns;
  for (const ParameterRow& row : parameter_table()) {
    EXPECT_TRUE(patterns.insert(path_pattern(row)).second) << path_pattern(row);
    EXPECT_FALSE(row.meaning.empty()) << path_pattern(row);
    EXPECT_LT(row.min, row.max) << path_pattern(row);
    EXPECT_TRUE(!row.can_be_free || row.kind == ParameterKind::real) << path_pattern(row);
    EXPECT_TRUE(row.kind == ParameterKind::text || row.choices.empty()) << path_pattern(row);
    // The fit's logarithm needs a range that is not negative.
    EXPECT_TRUE(row.scale != ParameterScale::logarithmic || row.min >= 0.0) << path_pattern(row);
  }
}

TEST(ParameterTable, DefaultsAreThoseOfTheStructs) {
  const auto& rows = parameter_table();
  const auto text = [&](const std::string& pattern) {
    for (const ParameterRow& row : rows) {
      if (path_pattern(row) == pattern) return row.default_text;
    }
    return std::string("no such row");
  };
  EXPECT_EQ(text("seed"), "1");
  EXPECT_EQ(text("camera.hfov_deg"), "60.0");
  EXPECT_EQ(text("sheet.<name>.center_km.north"), "200.0");
  EXPECT_EQ(text("emission.lines.<n>"), "[630.0, 557.7, 427.8]");
  EXPECT_EQ(text("blur.width_deg.<line>"), "[0.43, 0.18, 0.0]");
  EXPECT_EQ(text("sensor.primaries"), "\"srgb\"");
  EXPECT_EQ(text("fit.band_brightness"), "true");
}

TEST(ParameterTable, DefaultsAreWithinTheirLimits) {
  EXPECT_NO_THROW(validate(Scene()));
  const Scene scene = scene_of_two();
  EXPECT_NO_THROW(validate(scene));
  for (const ParameterPath& path : all_paths(scene)) {
    if (path.row->kind != ParameterKind::real) continue;
    EXPECT_GE(*real_value(scene, path), path.row->min) << path.text;
    EXPECT_LE(*real_value(scene, path), path.row->max) << path.text;
  }
}

TEST(ParameterTable, EveryRowOccursInAScene) {
  std::set<const ParameterRow*> seen;
  Scene scene = scene_of_one();
  scene.sheets[0].profile = ProfileKind::spline;  // or it has no coefficients
  fill_spline_rates(scene);
  for (const RepeatedTable& repeated : repeated_tables())
    if (repeated.count(scene) == 0) repeated.append(scene);
  Footprint& footprint = scene.footprints[0];  // lists have no rows while they are empty
  for (auto* list : {&footprint.east_km, &footprint.north_km, &footprint.latitude_deg,
                     &footprint.longitude_deg, &footprint.point_energy, &footprint.point_flux})
    list->assign(2, 1.0);
  Sheet& sheet = scene.sheets[0];
  for (auto* list : {&sheet.east_km, &sheet.north_km, &sheet.point_brightness, &sheet.point_energy_kev,
                     &sheet.point_width_km})
    list->assign(2, 1.0);
  Nebula& nebula = scene.nebulae[0];
  for (auto* list : {&nebula.inner_rayleigh, &nebula.outer_rayleigh, &nebula.glow_rayleigh})
    list->assign(scene.emission.lines.size(), 1.0);
  for (auto* list : {&scene.sun.photosphere_rayleigh, &scene.volumes[0].density_rayleigh,
                     &scene.volumes[0].lamp_flux, &scene.chromospheres[0].rayleigh, &scene.loops[0].rayleigh,
                     &scene.coronae[0].rayleigh, &scene.bundles[0].rayleigh, &scene.ejections[0].rayleigh,
                     &scene.fit.guide_x_px, &scene.fit.guide_y_px, &scene.emission.modes})
    list->assign(scene.emission.lines.size(), 1.0);
  for (const ParameterPath& path : all_paths(scene)) seen.insert(path.row);
  EXPECT_EQ(seen.size(), parameter_table().size());
}

TEST(ParameterTable, RealValuesHaveAddressesOfTheirOwn) {
  Scene scene = scene_of_two();
  std::set<const double*> addresses;
  std::set<std::string> texts;
  std::size_t count = 0;
  for (const ParameterPath& path : all_paths(scene)) {
    EXPECT_TRUE(texts.insert(path.text).second) << path.text;
    if (path.row->kind != ParameterKind::real) continue;
    ++count;
    EXPECT_TRUE(addresses.insert(real_value(scene, path)).second) << path.text;
  }
  EXPECT_EQ(addresses.size(), count);
  EXPECT_GT(count, 50u);
}

TEST(ParameterTable, EveryValueIsReachedByItsPathSetAndReadBack) {
  const Scene before = scene_of_two();
  for (const ParameterPath& path : all_paths(before)) {
    Scene scene = before;
    const std::string old = value_text(scene, path);
    std::string text;
    switch (path.row->kind) {
      case ParameterKind::real:
        // A number that no other value has, inside the limits and the rules.
        text = path.row->table == "emission" && path.row->key == "lines" ? "844.6"
               : path.row->key == "inclination_deg"                      ? "-61.25"
                                                                         : "";
        if (text.empty()) text = std::to_string(path.row->min + 0.4375 * (path.row->max - path.row->min));
        break;
      case ParameterKind::integer:
        text = path.row->min > 2 ? "16" : path.row->max < 17 ? "2" : "17";
        break;
      case ParameterKind::boolean:
        text = old == "true" ? "false" : "true";
        break;
      case ParameterKind::text:
        text = path.text == "body.name"          ? "\"own\""
               : path.row->key == "name"         ? "\"other\""
               : path.row->key == "response"     ? "\"nikon_d700\""
               : path.row->key == "time_utc"     ? "\"2019-09-01T05:00:00Z\""
               : path.text == "fit.decoding"     ? "\"gamma:2.2\""
               : path.row->key == "colour_table" ? "\"195\""
               : path.row->choices.empty()       ? "\"picture.png\""
                                                 : "\"" + path.row->choices.back() + "\"";
        break;
    }
    ASSERT_EQ(resolve(scene, path.text).size(), 1u) << path.text;
    set_from_text(scene, path.text, text);
    if (path.row->kind == ParameterKind::real) {
      EXPECT_EQ(*real_value(scene, path), std::stod(text)) << path.text;
    } else {
      EXPECT_EQ(value_text(scene, path), text) << path.text;
    }
    // Nothing else moved: setting the old text again restores every value. (A form is there to move others.)
    if (path.row->key == "name" || path.row->key == "form" || path.row->table == "emission") continue;
    set_from_text(scene, path.text, old);
    for (const ParameterPath& p : all_paths(before)) EXPECT_EQ(value_text(scene, p), value_text(before, p));
  }
}

// A kind is a number inside: two words of one number, or one in another's place, would come back as another.
TEST(ParameterTable, EveryWordOfAChoiceComesBack) {
  Scene scene = scene_of_one();
  scene.footprints.resize(1), scene.nebulae.resize(1), scene.nodes.resize(1), scene.volumes.resize(1);
  scene.loops.resize(1), scene.coronae.resize(1), scene.bundles.resize(1), scene.ejections.resize(1);
  int words = 0;
  for (const ParameterPath& path : all_paths(scene))
    for (const std::string& word : path.row->choices) {
      set_from_text(scene, path.text, word);
      EXPECT_EQ(value_text(scene, path), "\"" + word + "\"") << path.text;
      ++words;
    }
  EXPECT_GT(words, 100);
  EXPECT_EQ(word_of(HeightFalloff::inverse_square), "inverse-square");
  EXPECT_EQ(word_of(NodeKind::subtract), "difference");
  EXPECT_EQ(word_of(static_cast<NodeKind>(99)), "");
}

TEST(Resolve, GivesOnePathPerComponentOfAVector) {
  const auto paths = resolve(scene_of_two(), "sheet.far.center_km");
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].text, "sheet.far.center_km.east");
  EXPECT_EQ(paths[1].text, "sheet.far.center_km.north");
  EXPECT_EQ(paths[1].element, 1);
  EXPECT_EQ(paths[1].component, 1);
  const auto widths = resolve(Scene(), "blur.width_deg");
  ASSERT_EQ(widths.size(), 3u);
  EXPECT_EQ(widths[1].text, "blur.width_deg.5577");
}

TEST(Resolve, UnderstandsAPathWithoutNameWhereThereIsOneSheet) {
  Scene scene = scene_of_one();
  EXPECT_EQ(resolve(scene, "sheet.energy_kev").at(0).text, "sheet.main.energy_kev");
  EXPECT_EQ(resolve(scene, "sheet.center_km.east").at(0).text, "sheet.main.center_km.east");
  const Scene two = scene_of_two();
  EXPECT_THROW(resolve(two, "sheet.energy_kev"), Error);
}

TEST(Resolve, NamesTheNearestPath) {
  const Scene scene = scene_of_one();
  const auto hint = [&](const std::string& path) {
    const ErrorDetails details = error_of([&] { resolve(scene, path); });
    EXPECT_EQ(details.key, path);
    return details.hint;
  };
  EXPECT_EQ(hint("sheet.main.enrgy_kev"), "did you mean 'sheet.main.energy_kev'?");
  EXPECT_EQ(hint("sheet.mian.energy_kev"), "did you mean 'sheet.main.energy_kev'?");
  EXPECT_EQ(hint("sheet.enrgy_kev"), "did you mean 'sheet.main.energy_kev'?");
  EXPECT_EQ(hint("sheet.main.center_km.est"), "did you mean 'sheet.main.center_km.east'?");
  EXPECT_EQ(hint("camera.fov_deg"), "did you mean 'camera.hfov_deg'?");
  EXPECT_EQ(hint("sheet.main.start_km"), "name center_km, bearing_deg, length_km instead");
  EXPECT_EQ(hint("camera.focal_length_mm"), "name hfov_deg instead");
  EXPECT_EQ(hint("sheet.main.points_between_folds"), "name fold_spacing_km instead");
  EXPECT_NE(hint(""), "");
  EXPECT_NE(hint("sheet"), "");
  EXPECT_NE(hint("sheet.main"), "");
  EXPECT_NE(hint("camera."), "");
  EXPECT_TRUE(tests::has_facts(error_of([] { resolve(Scene(), "sheet.main.energy_kev"); }).hint, "no sheet"));
}

TEST(SetFromText, SetsVectorsAndBareWords) {
  Scene scene = scene_of_one();
  set_from_text(scene, "sheet.main.center_km", "[10, 220.5]");
  EXPECT_EQ(scene.sheets[0].center_km.east, 10.0);
  EXPECT_EQ(scene.sheets[0].center_km.north, 220.5);
  set_from_text(scene, "sensor.primaries", "smpte-c");
  EXPECT_EQ(scene.sensor.primaries, Primaries::smpte_c);
  set_from_text(scene, "site.time_utc", "2019-09-01T05:00:00Z");
  EXPECT_EQ(scene.site.time_utc, "2019-09-01T05:00:00Z");
  set_from_text(scene, "site.time_utc", "2019-03-01T22:10:00+01:00");
  EXPECT_EQ(scene.site.time_utc, "2019-03-01T22:10:00+01:00");
  set_from_text(scene, "fit.roi_px", "[1, 2, 30, 40]");
  EXPECT_EQ(scene.fit.roi_px, (std::array<int, 4>{1, 2, 30, 40}));
  set_from_text(scene, "sky.level", "[0.1, 0.2, 0.3]");
  EXPECT_EQ(scene.sky.level, (std::array<double, 3>{0.1, 0.2, 0.3}));
  set_from_text(scene, "seed", "9223372036854775807");
  EXPECT_EQ(scene.seed, 9223372036854775807u);
}

TEST(SetFromText, KeepsTheAddressesOfASceneThatOthersHold) {
  Scene scene = scene_of_one();
  const double* energy = &scene.sheets[0].energy_kev;
  set_from_text(scene, "sheet.energy_kev", "4.5");
  EXPECT_EQ(*energy, 4.5);
}

TEST(SetFromText, ANewListOfLinesKeepsTheBlurOfTheLinesThatStay) {
  Scene scene;
  set_from_text(scene, "blur.width_deg", "[0.5, 0.25, 0.125]");
  set_from_text(scene, "emission.lines", "[844.6, 557.7]");
  EXPECT_EQ(scene.blur.width_deg, (std::vector<double>{0.0, 0.25}));
  set_from_text(scene, "emission.lines", "[630.0]");
  EXPECT_EQ(scene.blur.width_deg, (std::vector<double>{0.43}));
  set_from_text(scene, "emission.lines", "[557.7]");
  set_from_text(scene, "blur.width_deg", "[0.75]");
  set_from_text(scene, "blur.width_deg.5577", "0.5");
  EXPECT_EQ(scene.blur.width_deg, (std::vector<double>{0.5}));
  EXPECT_NO_THROW(validate(scene));
}

TEST(SetFromText, SetsWhatIsFree) {
  Scene scene = scene_of_one();
  set_from_text(scene, "fit.free", "[\"sheet.main.energy_kev\", { path = \"camera.hfov_deg\", min = 50 }]");
  ASSERT_EQ(scene.fit.free.size(), 2u);
  EXPECT_EQ(scene.fit.free[1].min, 50.0);
  set_from_text(scene, "fit.tied", "[{ path = \"camera.roll_deg\", equals = \"camera.hfov_deg / 30\" }]");
  ASSERT_EQ(scene.fit.tied.size(), 1u);
  EXPECT_EQ(scene.fit.tied[0].equals, "camera.hfov_deg / 30");
}

// The scene is written into the run's folder: no file could hold these bytes, and be read again.
TEST(SetFromText, RefusesBytesThatAreNoText) {
  Scene scene = scene_of_one();
  set_from_text(scene, "composite.background", "Polarlicht \xc3\xbc\"\\\n\x01.png");
  EXPECT_EQ(scene.composite.background, "Polarlicht \xc3\xbc\"\\\n\x01.png");
  for (const char* text : {"Polarlicht \xfc.png", "\xc0\xaf", "\xed\xa0\x80", "\xff"}) {
    const ErrorDetails details = error_of([&] { set_from_text(scene, "composite.background", text); });
    EXPECT_EQ(details.key, "composite.background");
    EXPECT_EQ(details.expected, "UTF-8");
  }
}

TEST(SetFromText, RefusesWhatIsWrongAndLeavesTheScene) {
  Scene scene = scene_of_one();
  const auto refused = [&](const std::string& path, const std::string& text) {
    const ErrorDetails details = set_error(scene, path, text);
    EXPECT_EQ(details.key.compare(0, path.size(), path), 0) << details.key;
    EXPECT_EQ(details.line, 0);
    return details.problem + " | " + details.expected;
  };
  EXPECT_TRUE(tests::has_facts(refused("camera.width", "wide"), "'wide' | 1 to 65535 (px)"));
  EXPECT_TRUE(tests::has_facts(refused("camera.width", "3.0"), "number 3.0 | 1 to 65535 (px)"));
  EXPECT_TRUE(tests::has_facts(refused("camera.width", "0"), "0 | 1 to 65535 (px)"));
  EXPECT_TRUE(tests::has_facts(refused("camera.width", "4294967297"), "4294967297 | 1 to 65535 (px)"));
  EXPECT_TRUE(tests::has_facts(refused("sheet.length_km", "-3"), "-3 | 0.1 to 5000 (km)"));
  EXPECT_TRUE(tests::has_facts(refused("sheet.length_km", "nan"), "nan | 0.1 to 5000 (km)"));
  EXPECT_TRUE(tests::has_facts(refused("sheet.length_km", "-inf"), "-inf | 0.1 to 5000 (km)"));
  EXPECT_TRUE(tests::has_facts(refused("sheet.length_km", ""), "'' | 0.1 to 5000 (km)"));
  refused("sheet.length_km", "3\nother = 4");
  refused("sheet.length_km", "[3.0]");
  refused("sheet.center_km", "[1.0]");
  refused("sheet.center_km", "[1.0, nan]");
  refused("sheet.center_km", "[7.0, 99999.0]");
  refused("sheet.center_km", "5.0");
  refused("fit.band_brightness", "1");
  refused("seed", "-1");
  refused("field.inclination_deg", "10");
  refused("emission.lines", "[]");
  refused("emission.lines", "[630.0, 630.0]");
  refused("emission.lines", "[630.1]");
  refused("emission.lines.0", "557.7");
  refused("blur.width_deg", "[0.1]");
  refused("sheet.main.name", "a.b");
  refused("sheet.main.name", "width_km");
  refused("site.time_utc", "yesterday");
  refused("site.time_utc", "2019-02-29");
  refused("site.time_utc", "2019-03-01T22:10:00+15:00");
  EXPECT_EQ(set_error(scene, "sensor.primaries", "smpte_c").hint, "did you mean \"smpte-c\"?");
  EXPECT_TRUE(tests::has_facts(set_error(scene, "emission.lines", "[558]").hint, "557.7"));

  const Scene untouched = scene_of_one();
  for (const ParameterPath& p : all_paths(untouched))
    EXPECT_EQ(value_text(scene, p), value_text(untouched, p));
}

TEST(Validate, RefusesScenesMadeByHand) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene = scene_of_one();
  scene.file = "aurora.toml";
  scene.sheets[0].energy_kev = nan;
  EXPECT_EQ(validate_error(scene).key, "sheet.main.energy_kev");
  EXPECT_EQ(validate_error(scene).file, "aurora.toml");

  scene = scene_of_one();
  scene.sheets.push_back(scene.sheets[0]);
  EXPECT_TRUE(tests::has_facts(validate_error(scene).problem, "[[sheet]] | 'main'"));

  scene = Scene();
  scene.emission.lines = {557.7};
  EXPECT_EQ(validate_error(scene).key, "blur.width_deg");
  EXPECT_TRUE(tests::has_facts(validate_error(scene).problem, "3 widths | 1 emission line"));

  scene = Scene();
  scene.sky.gradient[1] = -nan;
  EXPECT_EQ(validate_error(scene).key, "sky.gradient.green");

  scene = Scene();
  scene.seed = 1ull << 63;  // beyond TOML's integers: could not be written
  EXPECT_EQ(validate_error(scene).key, "seed");

  scene = Scene();
  scene.footprints.resize(1);
  scene.footprints[0].profile = ProfileKind::file;  // a sheet may have it
  EXPECT_TRUE(tests::has_facts(validate_error(scene).problem, "\"file\""));
  EXPECT_TRUE(tests::has_facts(validate_error(scene).expected,
                               "\"maxwellian\" | \"mono\" | \"gaussian\" | \"form\" | \"layer\""));

  scene = Scene();
  scene.fit.roi_px = {10, 10, 0, 20};
  EXPECT_EQ(validate_error(scene).key, "fit.roi_px");
  scene.fit.roi_px = {10, 10, 23, 20};
  EXPECT_TRUE(tests::has_facts(validate_error(scene).problem, "24 bands | 23 pixels"));
}

TEST(Validate, WantsATimeInIso8601) {
  Scene scene;
  for (const char* time : {"", "2020-02-29", "2019-09-01T05:00Z", "2019-09-01T23:59:60Z",
                           "2019-09-01T05:00:00.25Z", "2019-09-01T05:00:00+01:00"}) {
    scene.site.time_utc = time;
    EXPECT_NO_THROW(validate(scene)) << time;
  }
  for (const char* time :
       {"now", "2019-02-29", "2019-13-01", "2019-09-01T24:00Z", "2019-09-01T05:60Z", "2019-09-01T05:00:61Z",
        "2019-09-01T05:00:00", "2019-09-01T05:00:00.Z", "2019-09-01T05:00.5Z", "2019-09-01.5",
        "2019-09-01T05:00:00+15:00", "2019-09-01T05:00:00Z "}) {
    scene.site.time_utc = time;
    EXPECT_THROW(validate(scene), Error) << time;
  }
}

TEST(Validate, WantsTheTimeAndThePlaceOfTheRealSky) {
  const auto error_of = [](const std::string& shown, const std::string& site) {
    try {
      parse_scene("[site]\n" + site + shown, "a.toml");
    } catch (const Error& error) {
      return error.details();
    }
    return ErrorDetails{};
  };
  const std::string place = "latitude_deg = 67.8\nlongitude_deg = 20.4\n";
  for (const std::string shown :
       {"[stars]\nshown = true\nsource = 'catalogue'\n", "[stars]\nplanets = true\n",
        "[stars]\nmilky_way = true\n", "[moon]\nshown = true\n", "[moon]\nskylight = true\n",
        "[twilight]\nshown = true\nsun = 'time'\n"}) {
    EXPECT_EQ(error_of(shown, place + "time_utc = '2012-03-08T21:00:00Z'\n").problem, "") << shown;
    EXPECT_EQ(error_of(shown, place + "time_utc = '2012-03-08T21:00Z'\n").problem, "") << shown;
    const ErrorDetails never = error_of(shown, place);
    EXPECT_NE(never.problem.find("the time"), std::string::npos) << shown;
    EXPECT_NE(never.expected.find("1900 to 2200"), std::string::npos) << shown;
    const ErrorDetails day = error_of(shown, place + "time_utc = '2012-03-08'\n");
    EXPECT_TRUE(tests::has_facts(day.problem, "'2012-03-08' | time of day")) << shown;
    EXPECT_EQ(day.key, "site.time_utc");
    EXPECT_EQ(day.line, 4);
    for (const std::string year : {"1899", "2201"}) {
      const ErrorDetails other = error_of(shown, place + "time_utc = '" + year + "-06-01T12:00:00Z'\n");
      EXPECT_NE(other.problem.find("years"), std::string::npos) << shown << year;
    }
    const std::string time = "time_utc = '2012-03-08T21:00:00Z'\n";
    EXPECT_NE(error_of(shown, "longitude_deg = 20.4\n" + time).problem.find("latitude"), std::string::npos);
    EXPECT_NE(error_of(shown, "latitude_deg = 67.8\n" + time).problem.find("longitude"), std::string::npos);
    // 0 is a longitude like any other where it is given.
    EXPECT_EQ(error_of(shown, "latitude_deg = 51.5\nlongitude_deg = 0\n" + time).problem, "") << shown;
  }
}

TEST(Validate, TakesADateForTheReferenceField) {
  const auto scene_of = [](const std::string& time) {
    return parse_scene("[site]\nlatitude_deg = 67.8\nlongitude_deg = 20.4\ntime_utc = '" + time +
                           "'\n[field]\nmodel = 'igrf'\n",
                       "a.toml");
  };
  EXPECT_EQ(igrf_year(scene_of("2012-03-08")), igrf_year(scene_of("2012-03-08T00:00:00Z")));
}

TEST(Validate, WantsASteepField) {
  Scene scene;
  for (const double steep : {20.0, -20.0, 90.0, -90.0}) {
    scene.field.inclination_deg = steep;
    EXPECT_NO_THROW(validate(scene)) << steep;
  }
  for (const double flat : {0.0, 19.9, -19.9}) {
    scene.field.inclination_deg = flat;
    EXPECT_NE(validate_error(scene).problem.find("nearly horizontal"), std::string::npos) << flat;
  }
}

TEST(Validate, ChecksWhatIsFree) {
  const auto problem = [](const FreeParameter& free) {
    Scene scene;
    scene.sheets.resize(1);
    scene.fit.free = {free};
    return validate_error(scene).problem;
  };
  const auto accepted = [](std::vector<FreeParameter> free) {
    Scene scene;
    scene.sheets.resize(1);
    scene.fit.free = std::move(free);
    EXPECT_NO_THROW(validate(scene));
  };
  const auto free = [](const std::string& path) {
    FreeParameter f;
    f.path = path;
    return f;
  };
  accepted({free("sheet.main.center_km"), free("sheet.energy_kev"), free("camera.hfov_deg")});

  EXPECT_EQ(problem(free("sheet.main.enrgy_kev")), "no such parameter");
  EXPECT_TRUE(tests::has_facts(problem(free("camera.width")), "cannot be free"));
  EXPECT_TRUE(tests::has_facts(problem(free("sheet.main.top_km")), "cannot be free"));
  EXPECT_TRUE(tests::has_facts(problem(free("sky.level")), "cannot be free"));

  FreeParameter f = free("sheet.main.energy_kev");  // the scene's value is 3
  f.min = 4.0;
  EXPECT_TRUE(tests::has_facts(problem(f), "value 3.0 | min and max"));
  f.start = 5.0;
  accepted({f});
  f.max = 4.5;
  EXPECT_TRUE(tests::has_facts(problem(f), "start 5.0 | min and max"));
  f.max = 4.0;
  EXPECT_TRUE(tests::has_facts(problem(f), "min 4.0 | max 4.0"));
  f.max = 25.0;
  EXPECT_TRUE(tests::has_facts(problem(f), "max: 25"));
  f.max.reset();
  f.start = std::nan("");
  EXPECT_TRUE(tests::has_facts(problem(f), "start: nan"));
  f.start = 5.0;
  f.prior = Prior{5.0, 0.0};
  EXPECT_TRUE(tests::has_facts(problem(f), "prior: | sigma 0.0"));
  f.prior = Prior{std::nan(""), 1.0};
  EXPECT_TRUE(tests::has_facts(problem(f), "prior: | mean nan"));
  f.prior = Prior{5.0, 1.0};
  accepted({f});

  // 427.8 has no blur to start from on a logarithmic scale.
  EXPECT_NE(problem(free("blur.width_deg")).find("has no logarithm"), std::string::npos);
  accepted({free("blur.width_deg.6300")});
}

TEST(Validate, RefusesAPathThatIsFreeTwiceAlsoThroughItsVector) {
  Scene scene = scene_of_one();
  scene.fit.free.resize(2);
  scene.fit.free[0].path = "sheet.main.center_km";
  scene.fit.free[0].line = 7;
  scene.fit.free[1].path = "sheet.center_km.north";
  scene.fit.free[1].line = 8;
  const ErrorDetails details = validate_error(scene);
  EXPECT_TRUE(tests::has_facts(details.problem, "'sheet.main.center_km' | line 7"));
  EXPECT_EQ(details.line, 8);
  EXPECT_EQ(details.key, "sheet.main.center_km.north");
}

}  // namespace
}  // namespace vegard::sim::parameter_table_test
