#include "sim/light/tables/emission_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/light/height_profile.h"
#include "sim/light/sheet_profile.h"
#include "sim/light/spectrum_profile.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/sim/light/made_tables.h"
#include "tests/support/expect_error.h"
#include "tests/support/glow.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::emission_tables_test {
namespace {

const std::vector<double> kLinesNm = {630.0, 557.7, 427.8};

const EmissionTables& tables_with_oxygen() {
  Scene scene;
  tests::give_tables_with_oxygen(scene);
  return emission_tables(scene);
}

TEST(EmissionTables, AreReadOnceAndShared) {
  Scene scene;
  tests::give_tables_with_oxygen(scene);
  const Scene copy = scene;
  EXPECT_EQ(&emission_tables(scene), &emission_tables(copy));
  EXPECT_EQ(&emission_tables("glow"), &tests::glow().tables);
  EXPECT_NE(&emission_tables("glow"), &emission_tables(scene));
  scene.emission.tables = "glow";
  EXPECT_EQ(&emission_tables(scene), &emission_tables("glow"))
      << "the name decides, not a folder that is left";
}

// The made tables go by powers of the factor on each side of 1: at the factors themselves, and where the
// three lie on one straight line.
TEST(EmissionTable, BetweenOxygenFactorsIsASplineThroughThem) {
  const EmissionTable& made = tables_with_oxygen().maxwellian();
  const EmissionTable& glow = tests::glow().tables.maxwellian();
  ASSERT_EQ(made.oxygen_factors(), (std::vector<double>{0.5, 1.0, 2.0}));
  EXPECT_EQ(glow.oxygen_factors(), std::vector<double>{1.0});
  constexpr std::size_t kGreen = 5;  // its column
  const double energy = made.energies_kev()[3];
  const auto here = glow.at_energy("ver_5577", energy);
  double peak = 0.0;
  for (const Emission1d& e : here) peak = std::max(peak, e.rate);
  int compared = 0;
  for (std::size_t a = 0; a < here.size(); ++a) {
    if (here[a].rate < 1e-4 * peak) continue;  // far above the floor
    ++compared;
    const double power = tests::oxygen_power(kGreen, made.altitudes_km()[a]);
    const auto at = [&](double factor) { return made.at_energy("ver_5577", energy, factor)[a].rate; };
    EXPECT_NEAR(at(1.0) / here[a].rate, 1.0, 1e-9);
    EXPECT_NEAR(at(0.5) / here[a].rate, std::pow(0.5, power), 1e-9);
    EXPECT_NEAR(at(2.0) / here[a].rate, std::pow(2.0, 0.8 * power), 1e-9);
    // Beyond the factors it goes on straight.
    EXPECT_NEAR(std::log(at(8.0) / at(4.0)), std::log(at(4.0) / at(2.0)), 1e-9);
  }
  EXPECT_GT(compared, 20);
}

TEST(OxygenWeights, AreOneInSumAndReproduceAPowerLaw) {
  EXPECT_EQ(oxygen_weights({1.0}, 1.0).size(), 1u);
  const std::vector<double> factors = {0.25, 0.5, 1.0, 3.0};
  for (const double factor : {0.2, 0.25, 0.4, 1.0, 1.7, 3.0, 4.0}) {
    double sum = 0.0, slopes = 0.0, log = 0.0, by_log = 0.0;
    const std::vector<SplineValue> weights = oxygen_weights(factors, factor);
    for (std::size_t f = 0; f < factors.size(); ++f) {
      sum += weights[f].value;
      slopes += weights[f].slope;
      log += weights[f].value * std::log(factors[f]);
      by_log += weights[f].slope * std::log(factors[f]);
    }
    EXPECT_NEAR(sum, 1.0, 1e-13) << factor;
    EXPECT_NEAR(slopes, 0.0, 1e-13) << factor;
    EXPECT_NEAR(log, std::log(factor), 1e-13) << factor;
    EXPECT_NEAR(by_log, 1.0, 1e-13) << factor;
  }
}

/// profile_slope() by the oxygen factor beside central differences, for one sheet.
void expect_slopes(const Sheet& sheet, const std::string& what) {
  Scene scene = tests::with_sheet(sheet);
  scene.emission.lines = kLinesNm;
  tests::give_tables_with_oxygen(scene);
  const ParameterId id = parameter_with(ParameterRole::oxygen_factor);
  for (const double factor : {0.6, 1.0, 1.7}) {
    scene.emission.oxygen_factor = factor;
    const std::vector<std::vector<float>> slopes = profile_slopes(kLinesNm, scene, 0, id);
    // A ladder's middle rung.
    const std::vector<HeightProfile> ladder = ladder_profiles(kLinesNm, scene, 0);
    ASSERT_EQ(slopes.size(), std::max<std::size_t>(1, ladder.size())) << what;
    const std::size_t rung = slopes.size() / 2;
    const auto at = [&](double by) {
      scene.emission.oxygen_factor = factor + by;
      return ladder.empty() ? sheet_profile(kLinesNm, scene, 0) : ladder_profiles(kLinesNm, scene, 0)[rung];
    };
    constexpr double kStep = 1e-3;
    const HeightProfile more = at(kStep), less = at(-kStep);
    const std::vector<float>& slope = slopes[rung];
    ASSERT_EQ(slope.size(), more.rate.size());
    for (int l = 0; l < 3; ++l) {
      double largest = 0.0;
      for (int a = 0; a < HeightProfile::kAltitudes; ++a)
        largest = std::max<double>(largest, std::abs(slope[a * 4 + l]));
      EXPECT_GT(largest, 0.0) << what;
      // Rates are floats, whose rounding a difference divides by its step.
      for (int a = 0; a < HeightProfile::kAltitudes; a += 3)
        EXPECT_NEAR(slope[a * 4 + l], (more.rate[a * 4 + l] - less.rate[a * 4 + l]) / (2.0 * kStep),
                    1e-4 * largest + 1.2e-7 / kStep * more.rate[a * 4 + l])
            << what << ", factor " << factor << ", line " << l << ", " << HeightProfile::altitude_km(a)
            << " km";
    }
  }
}

TEST(ProfileSlope, OfTheOxygenFactorIsThatOfTheRate) {
  for (const double brightness : {0.0, 10.0}) {
    Sheet sheet;
    sheet.brightness_kilorayleigh = brightness;
    const std::string given = brightness > 0.0 ? ", brightness given" : "";
    expect_slopes(sheet, "maxwellian" + given);
    sheet.profile = ProfileKind::form;
    expect_slopes(sheet, "form" + given);
    sheet.profile = ProfileKind::mono;
    expect_slopes(sheet, "mono" + given);
  }
  Sheet gaussian;
  gaussian.profile = ProfileKind::gaussian;
  expect_slopes(gaussian, "gaussian");
  Sheet curve;
  curve.course = SheetCourse::curve;
  curve.point_energy_kev = {2.0, 2.2};
  expect_slopes(curve, "two energies");
}

TEST(ProfileSlope, OfTheOxygenFactorIsNoneWhereTheLightIsNotTheElectrons) {
  Sheet sheet;
  sheet.profile = ProfileKind::spline;
  Scene scene = tests::with_sheet(sheet);
  EXPECT_TRUE(profile_slope(kLinesNm, scene, 0, parameter_with(ParameterRole::oxygen_factor)).empty());
}

TEST(EmissionTables, TakeAColumnOfTheLinesOwnBeforeTheRatioOfAnother) {
  TableFolder folder = tests::glow_folder();
  folder.place = "own";
  // 670.5 nm as 520.0 nm has it, in one more column.
  for (const char* file : {kMaxwellianFile, kFluxesFile}) {
    const CsvTable table = read_csv_table(folder.files.at(file), file);
    const bool rates = file == kMaxwellianFile;
    const std::vector<double>& copied = table.column(rates ? "ver_5200" : "R_5200");
    std::ostringstream text;
    text.precision(12);
    for (const std::string& name : table.columns) text << name << ",";
    text << (rates ? "ver_6705\n" : "R_6705\n");
    for (std::size_t r = 0; r < table.rows(); ++r) {
      for (const std::vector<double>& column : table.numbers) text << column[r] << ",";
      text << copied[r] << "\n";
    }
    folder.files[file] = text.str();
  }
  const EmissionTables own(std::make_shared<const TableFolder>(folder));
  const EmissionLine& bands = *find_emission_line(670.5);
  EXPECT_EQ(column_of(bands, own.maxwellian()).name, "ver_6705");
  EXPECT_EQ(column_of(bands, own.maxwellian()).ratio, 1.0);
  EXPECT_EQ(column_of(bands, tests::glow().tables.maxwellian()).name, bands.table_column);
  EXPECT_EQ(column_of(bands, tests::glow().tables.maxwellian()).ratio, bands.ratio);
  {
    // At a flux of 1, at which backgrounds do not count.
    const HeightProfile profile = maxwellian_profile({own}, {520.0, 670.5}, 3.0);
    for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
      EXPECT_EQ(profile.rate[a * 4 + 1], profile.rate[a * 4]);
      EXPECT_EQ(profile.d_rate_d_ln_energy[a * 4 + 1], profile.d_rate_d_ln_energy[a * 4]);
    }
  }
  // column_brightness.csv has no R_6705.
  EXPECT_EQ(own.flux_factors().background_rayleigh("ver_6705"), 0.0);
  EXPECT_GT(own.flux_factors().background_rayleigh("ver_5200"), 1.0);
  // What was made of them has the column too, and others are GLOW's.
  EXPECT_TRUE(own.mono().has("ver_6705"));
  const HeightProfile violet = maxwellian_profile({own}, {391.4}, 3.0),
                      usual = maxwellian_profile(tests::glow(), {391.4}, 3.0);
  EXPECT_EQ(violet.rate, usual.rate);
}

TEST(EmissionTables, TakeATableOfMonoEnergeticElectronsWhereThereIsOne) {
  // GLOW's Maxwellian table under the name of the other.
  TableFolder folder = tests::glow_folder();
  folder.place = "mono";
  std::string text = folder.files.at(kMaxwellianFile);
  text.replace(text.find("E0_keV"), 6, "E_keV");
  folder.files[kMonoFile] = text;
  const EmissionTables made(std::make_shared<const TableFolder>(folder));
  const HeightProfile mono = mono_profile({made}, kLinesNm, 3.0),
                      maxwellian = maxwellian_profile({made}, kLinesNm, 3.0);
  EXPECT_EQ(mono.rate, maxwellian.rate);
  EXPECT_EQ(mono.d_rate_d_ln_energy, maxwellian.d_rate_d_ln_energy);
  // Beyond its energies it is that of its end.
  EXPECT_EQ(mono_profile({made}, kLinesNm, 30.0).rate, mono_profile({made}, kLinesNm, 19.953).rate);
  for (const float slope : mono_profile({made}, kLinesNm, 30.0).d_rate_d_ln_energy) ASSERT_EQ(slope, 0.0f);
}

// Bad input.

/// Of GLOW's tables with something done to one file.
std::string message(const char* file, const std::function<void(std::string&)>& spoil) {
  TableFolder folder = tests::glow_folder();
  folder.place = "own";
  spoil(folder.files[file]);
  return tests::expect_error(ErrorKind::unreadable_input, [&] {
    const EmissionTables tables(std::make_shared<const TableFolder>(folder));
    if (tables.has_mono_file()) tables.mono();
  });
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

/// Without the lines of which `goes` says so; the first line stays.
void remove_lines(std::string& text, const std::function<bool(const std::string&)>& goes) {
  std::istringstream in(text);
  std::string line, kept;
  std::getline(in, line);
  kept = line + "\n";
  while (std::getline(in, line))
    if (!goes(line)) kept += line + "\n";
  text = kept;
}

bool begins(const std::string& line, const std::string& with) { return line.rfind(with, 0) == 0; }

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

TEST(EmissionTables, SayWhereAMaxwellianTableIsWrong) {
  const char* file = kMaxwellianFile;
  expect_words(message(file, [](std::string& t) { replace(t, "ver_4278", "ver_4279"); }),
               {"own/ver_maxwellian.csv", "no column 'ver_4278'"});
  expect_words(message(file, [](std::string& t) { replace(t, "E0_keV", "E_keV"); }),
               {"own/ver_maxwellian.csv", "no column 'E0_keV'"});
  expect_words(message(file, [](std::string& t) { replace(t, "1.48782e-12", "-1.48782e-12"); }),
               {"own/ver_maxwellian.csv:2", "-1.48782e-12", "ver_3371"});
  expect_words(message(file, [](std::string& t) { replace(t, "1.48782e-12", "nan"); }),
               {"own/ver_maxwellian.csv:2", "'nan'"});
  expect_words(
      message(file,
              [](std::string& t) { remove_lines(t, [](auto& l) { return begins(l, "0.1122,80.0"); }); }),
      {"own/ver_maxwellian.csv:104", "0.1122 keV, 81 km", "0.1122 keV, 80 km"});
  expect_words(
      message(file, [](std::string& t) { remove_lines(t, [](auto& l) { return begins(l, "19.953,640"); }); }),
      {"own/ver_maxwellian.csv:4794", "rows are missing"});
  expect_words(message(file,
                       [](std::string& t) {
                         remove_lines(t, [](auto& l) { return l.find(",640.0,") != std::string::npos; });
                       }),
               {"own/ver_maxwellian.csv:", "altitudes end at", "640 km"});
  expect_words(message(file,
                       [](std::string& t) {
                         remove_lines(t, [](auto& l) { return l.find(",80.0,") != std::string::npos; });
                       }),
               {"own/ver_maxwellian.csv:2", "altitudes begin at 81 km", "80 km"});
  expect_words(
      message(file, [](std::string& t) { remove_lines(t, [](auto& l) { return begins(l, "19.953,"); }); }),
      {"own/ver_maxwellian.csv:", "energies end at 17.7", "19.9 keV"});
  expect_words(message(file,
                       [](std::string& t) {
                         for (std::size_t at = 0; (at = t.find("\n0.1122,", at)) != std::string::npos; ++at)
                           t.replace(at + 1, 6, "0.0900");
                       }),
               {"own/ver_maxwellian.csv:104", "energy does not increase"});
  expect_words(message(file, [](std::string& t) { t.clear(); }), {"own/ver_maxwellian.csv", "is empty"});
}

TEST(EmissionTables, SayWhereOxygenFactorsAreWrong) {
  const auto with = [](const std::vector<double>& factors) {
    return message(kMaxwellianFile, [&](std::string& text) {
      text = tests::table_with_oxygen(read_csv_table(text, "x.csv"), factors);
    });
  };
  expect_words(with({0.5, 2.0}), {"own/ver_maxwellian.csv:2", "oxygen factor is 1"});
  expect_words(with({1.0, 0.5}), {"own/ver_maxwellian.csv:", "oxygen factor"});
  expect_words(message(kMonoFile,
                       [](std::string& text) {
                         text = tests::glow_folder().files.at(kMaxwellianFile);
                         text.replace(text.find("E0_keV"), 6, "E_keV");
                         text = tests::table_with_oxygen(read_csv_table(text, "x.csv"), {1.0, 2.0});
                       }),
               {"own/ver_mono.csv:2", "other oxygen factors", "ver_maxwellian.csv"});
}

TEST(EmissionTables, SayWhereTheOtherFilesAreWrong) {
  expect_words(message(kFluxesFile, [](std::string& t) { replace(t, "R_5577", "R_5578"); }),
               {"own/linearity_Q.csv", "no column 'R_5577'"});
  expect_words(
      message(kFluxesFile,
              [](std::string& t) { remove_lines(t, [](auto& l) { return begins(l, "10,0.15,"); }); }),
      {"own/linearity_Q.csv:", "0.15 keV", "Q_erg 10"});
  expect_words(message(kFluxesFile, [](std::string& t) { replace(t, "1,0.1,1.916388e+02", "1,0.1,-1"); }),
               {"own/linearity_Q.csv:2", "R_3371 is -1"});
  expect_words(message(kFluxesFile,
                       [](std::string& t) {
                         remove_lines(t, [](auto& l) { return l.find(",20,") != std::string::npos; });
                       }),
               {"own/linearity_Q.csv", "19.9 keV"});
  expect_words(message(kColumnsFile,
                       [](std::string& t) { remove_lines(t, [](auto& l) { return begins(l, "10,"); }); }),
               {"own/column_brightness.csv:", "no row of 10 keV"});
  expect_words(message(kTablesAirFile, [](std::string& t) { replace(t, "nO2", "O2"); }),
               {"own/atmosphere.csv", "no column 'nO2'"});
  expect_words(message(kTablesAirFile, [](std::string& t) { replace(t, "2.034741e+09", "-2.034741e+09"); }),
               {"own/atmosphere.csv:2", "nO"});
  expect_words(message(kTablesAirFile,
                       [](std::string& t) { remove_lines(t, [](auto& l) { return begins(l, "81.0,"); }); }),
               {"own/atmosphere.csv:3", "no altitude", "81 km"});
  expect_words(message(kTablesAirFile,
                       [](std::string& t) { remove_lines(t, [](auto& l) { return begins(l, "640"); }); }),
               {"own/atmosphere.csv:", "ends at", "640 km"});
}

TEST(CheckEmissionTables, RefusesOxygenThatTheTablesDoNotHave) {
  Scene scene;
  scene.emission.tables = "glow";
  check_emission_tables(scene);
  scene.emission.oxygen_factor = 1.2;
  expect_words(tests::expect_error(ErrorKind::scene, [&] { check_emission_tables(scene); }),
               {"emission.oxygen_factor", "atomic oxygen", "oxygen_factor"});
  scene.emission.oxygen_factor = 1.0;
  FreeParameter free;
  free.path = "emission.oxygen_factor";
  scene.fit.free = {free};
  expect_words(tests::expect_error(ErrorKind::scene, [&] { check_emission_tables(scene); }),
               {"emission.oxygen_factor", "fit.free"});
  tests::give_tables_with_oxygen(scene);
  check_emission_tables(scene);
  scene.emission.oxygen_factor = 1.9;
  check_emission_tables(scene);
  scene.emission.oxygen_factor = 2.1;
  expect_words(tests::expect_error(ErrorKind::scene, [&] { check_emission_tables(scene); }),
               {"2.1", "from 0.5 to 2"});
  scene.emission.oxygen_factor = 1.0;
  scene.file = "night.toml";
  scene.fit.free[0].max = 3.0;
  scene.fit.free[0].line = 12;
  expect_words(tests::expect_error(ErrorKind::scene, [&] { check_emission_tables(scene); }),
               {"night.toml:12:", "3 is outside", "from 0.5 to 2"});
  scene.fit.free[0].max = 1.5;
  check_emission_tables(scene);
  limit_free_oxygen(scene);
  EXPECT_EQ(scene.fit.free[0].min, 0.5);
  EXPECT_EQ(scene.fit.free[0].max, 1.5);
}

}  // namespace
}  // namespace vegard::sim::emission_tables_test
