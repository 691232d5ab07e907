// The scorecard's own parts: what is drawn, how it is photographed, and how an answer is scored.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "fit/answer/derived.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/recovery/scorecard/card.h"
#include "tests/recovery/scorecard/photograph.h"
#include "tests/recovery/scorecard/score.h"
#include "tests/recovery/scorecard/truth.h"
#include "tests/support/temporary_folder.h"

namespace vegard::scorecard::scorecard_test {
namespace {

TEST(Truths, ArePureFunctionsOfSetAndNumber) {
  EXPECT_EQ(sim::write_scene(truth(5, 7).scene), sim::write_scene(truth(5, 7).scene));
  EXPECT_NE(sim::write_scene(truth(5, 7).scene), sim::write_scene(truth(5, 8).scene));
  EXPECT_NE(sim::write_scene(truth(5, 7).scene), sim::write_scene(truth(6, 7).scene));
}

TEST(Truths, LieInTheirRangesAndComeInTheirShares) {
  constexpr int kScenes = 600;
  int two = 0, rays = 0, folds = 0, by_line_of_sight = 0;
  for (int i = 0; i < kScenes; ++i) {
    const Truth t = truth(3, i);
    for (const sim::Sheet& sheet : t.scene.sheets) {
      EXPECT_GE(fit::nearest_distance_km(sheet), 129.999);
      EXPECT_LE(fit::nearest_distance_km(sheet), 320.001);
      EXPECT_GE(sheet.energy_kev, 1.0);
      EXPECT_LE(sheet.energy_kev, 8.0);
      EXPECT_GE(sheet.wavelength_km, 19.999);
      EXPECT_LE(sheet.wavelength_km, 250.001);
      const double ratio = sheet.wavelength_km / (2.0 * sheet.thickness_km);
      EXPECT_GE(ratio, 5.199);
      EXPECT_LE(ratio, 31.401);
    }
    two += t.scene.sheets.size() == 2 ? 1 : 0;
    rays += t.scene.sheets[0].ray_contrast > 0.0 ? 1 : 0;
    folds += t.scene.sheets[0].fold_spacing_km > 0.0 ? 1 : 0;
    by_line_of_sight += t.line_of_sight ? 1 : 0;
    if (t.scene.sheets.size() == 2) {
      const double apart =
          std::abs(fit::nearest_distance_km(t.scene.sheets[0]) - fit::nearest_distance_km(t.scene.sheets[1]));
      EXPECT_GE(apart, 14.999);
      EXPECT_LE(apart, 60.001);
    }
  }
  EXPECT_EQ(by_line_of_sight, kScenes / 3);
  // Four standard deviations of a binomial number of 600: 46, 49 and 42.
  EXPECT_NEAR(two, kScenes / 3, 46);
  EXPECT_NEAR(rays, kScenes / 2, 49);
  EXPECT_NEAR(folds, kScenes / 4, 42);
}

TEST(WideStart, DoesNotKnowTheTruth) {
  // Of two scenes with one sheet each, what is not known is the same.
  const auto unknown = [](int number) {
    const Truth t = truth(3, number);
    sim::Scene start = wide_start(t);
    const sim::Scene other;
    start.seed = other.seed;
    start.field = other.field;
    start.camera = other.camera;
    return std::make_pair(t.scene.sheets.size(), sim::write_scene(start));
  };
  int compared = 0;
  for (int number = 1; number < 8; ++number)
    if (unknown(number).first == unknown(0).first) {
      EXPECT_EQ(unknown(number).second, unknown(0).second) << number;
      ++compared;
    }
  EXPECT_GE(compared, 1);
}

TEST(Photographs, AreTheSameForAnyThreadsAndExposedAsDrawn) {
  for (const int number : {0, 2}) {  // by beams, by lines of sight
    Truth t = truth(3, number);
    t.scene.camera.width = 120;
    t.scene.camera.height = 80;
    t.scene.sky = {};
    const Photograph one = photograph(t, 1);
    EXPECT_EQ(one.bytes, photograph(t, 2).bytes);

    const tests::TemporaryFolder folder;
    const std::string file = folder / "photo.jpg";
    tests::put(file, one.bytes);
    const fit::Photo photo = fit::read_photo(file, fit::Decoding::automatic);
    const fit::Profile profile = fit::extract_profile(photo, {0, 0, 120, 80}, 24);
    double most = 0.0;
    for (const double mean : profile.mean)
      if (std::isfinite(mean)) most = std::max(most, mean);
    // Noise of 0.01 over the five pixels of a row of a band, the largest of many, and JPEG; and a ray that is narrower
    // than five pixels shines less over them than its brightest pixel.
    EXPECT_LT(most, t.exposure + 0.03);
    EXPECT_GT(most, 0.95 * t.exposure - 0.03);
  }
}

/// A result that is right in everything, its two sheets in the other order.
fit::FitResult right_but_swapped(const Truth& t) {
  fit::FitResult result;
  result.verdict = fit::Verdict::good;
  result.dof = 1;
  result.best = wide_start(t);
  result.best.sheets = {t.scene.sheets[1], t.scene.sheets[0]};
  result.best.sheets[0].name = t.scene.sheets[0].name;
  result.best.sheets[1].name = t.scene.sheets[1].name;
  return result;
}

Truth of_two_sheets() {
  int number = 0;
  while (truth(3, number).scene.sheets.size() != 2) ++number;
  return truth(3, number);
}

TEST(Scores, TakeSheetsInEitherOrder) {
  const Truth t = of_two_sheets();
  fit::FitResult result = right_but_swapped(t);
  // 5 % too bright in the second sheet of the fit, which is the first of the truth; both fluxes are known to
  // 5 %, and go up and down together.
  result.best.sheets[1].energy_flux_mw_m2 *= 1.05;
  for (const char* name : {"first", "second"}) {
    fit::FittedParameter flux;
    flux.path = std::string("sheet.") + name + ".energy_flux_mw_m2";
    flux.value = result.best.sheets[name == std::string("first") ? 0 : 1].energy_flux_mw_m2;
    flux.interval68 = {flux.value / 1.05, flux.value * 1.05};
    result.parameters.push_back(flux);
  }
  result.correlation = {{1.0, 0.6}, {0.6, 1.0}};
  const Row row = score(t, wide_start(t), result);
  EXPECT_EQ(row.missed, "");
  EXPECT_EQ(row.recovered, 1);
  EXPECT_NEAR(row.ratio, row.ratio_true / 1.05, 1e-12);
  EXPECT_NEAR(row.ratio_z, -1.0 / std::sqrt(1.0 + 1.0 - 2.0 * 0.6), 1e-9);
  EXPECT_TRUE(std::isnan(row.sheet[0].energy_z));
}

TEST(Scores, MissWhatIsJustOutside) {
  const Truth t = of_two_sheets();
  const auto missed = [&](auto change) {
    fit::FitResult result = right_but_swapped(t);
    change(result.best.sheets[0]);
    return score(t, wide_start(t), result).missed;
  };
  EXPECT_EQ(missed([](sim::Sheet& s) { s.energy_kev *= 1.14; }), "");
  EXPECT_EQ(missed([](sim::Sheet& s) { s.energy_kev *= 1.16; }), "E02");
  EXPECT_EQ(missed([](sim::Sheet& s) { s.center_km.north *= 0.971; }), "");
  EXPECT_EQ(missed([](sim::Sheet& s) { s.center_km.north *= 0.969; }), "distance2");
  EXPECT_EQ(missed([](sim::Sheet& s) { s.thickness_km *= 0.71; }), "");
  EXPECT_EQ(missed([](sim::Sheet& s) { s.thickness_km *= 0.69; }), "amplitude2");
  EXPECT_EQ(missed([](sim::Sheet& s) { s.bearing_deg += 181.9; }), "");
  EXPECT_NE(missed([](sim::Sheet& s) { s.bearing_deg += 182.1; }).find("bearing2"), std::string::npos);
}

TEST(WavesInView, AreThoseBetweenThePicturesEdges) {
  // Straight ahead and across, 200 km away, seen at an angle of 60 degrees from edge to edge at the row of
  // the lower border. The line of sight there is 30 degrees up, so the plane of the picture's row is tilted:
  // half of the width subtends tan(30 deg) of the slant range.
  sim::Scene scene;
  scene.camera.azimuth_deg = 0.0;
  scene.camera.hfov_deg = 60.0;
  scene.camera.elevation_deg = 28.0;
  scene.field.inclination_deg = 90.0;
  sim::Sheet sheet;
  sheet.center_km = {0.0, 200.0};
  sheet.length_km = 1000.0;
  sheet.wavelength_km = 50.0;
  scene.sheets = {sheet};
  // At 200 km altitude the slant range is about 280 km and so the half width 280 km x tan(30 deg) / (cosine
  // of the angle off the axis): between 4 and 7.5 waves.
  const double waves = waves_in_view(scene, 0);
  EXPECT_GT(waves, 4.0);
  EXPECT_LT(waves, 7.5);
  scene.sheets[0].wavelength_km = 100.0;
  EXPECT_NEAR(waves_in_view(scene, 0), 0.5 * waves, 1e-9);
}

TEST(Card, IsReadAsItWasWritten) {
  Row row;
  row.scene = 17;
  row.verdict = "doubtful";
  row.reasons = "one, \"two\"";
  row.ratio = 0.1 + 0.2;
  row.sheet[1].waves_in_view = 1.0 / 3.0;
  const tests::TemporaryFolder folder;
  tests::put(folder / "card.csv", csv_header() + csv_row(row));
  const std::vector<Row> rows = read_card(folder / "card.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(csv_row(rows[0]), csv_row(row));
  EXPECT_EQ(rows[0].reasons, row.reasons);
  EXPECT_EQ(rows[0].ratio, row.ratio);
  EXPECT_TRUE(std::isnan(rows[0].ratio_z));
}

}  // namespace
}  // namespace vegard::scorecard::scorecard_test
