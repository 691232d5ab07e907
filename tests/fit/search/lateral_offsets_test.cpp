#include "fit/search/lateral_offsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/compare/observation.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::lateral_offsets_test {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// Sheets of one layer across the view, rather like what a search looks at.
sim::Scene waved(const std::vector<double>& north_km) {
  sim::Scene scene = tests::small_scene();
  scene.camera.width = 240;
  scene.camera.height = 160;
  scene.blur.width_deg = {0.2, 0.2, 0.2};
  scene.fit.bands = 24;
  sim::Sheet sheet = scene.sheets[0];
  sheet.bearing_deg = 90.0;
  sheet.layers = 1;
  sheet.length_km = 600.0;
  sheet.beams = 4000;
  sheet.thickness_km = 3.0;
  sheet.wavelength_km = 90.0;
  sheet.phase_rad = 1.0;
  scene.sheets.clear();
  for (const double north : north_km) {
    sheet.name = "s" + std::to_string(scene.sheets.size());
    sheet.center_km = {0.0, north};
    scene.sheets.push_back(sheet);
    sheet.wavelength_km *= 0.7;
    sheet.phase_rad += 1.5;
  }
  return scene;
}

/// The same, but straight: what is known before anything is known of the sines.
sim::Scene straightened(sim::Scene scene) {
  for (sim::Sheet& sheet : scene.sheets) {
    sheet.thickness_km = 0.1;
    sheet.wavelength_km = 60.0;
    sheet.phase_rad = 0.0;
  }
  return scene;
}

std::vector<std::vector<LateralOffset>> offsets_of(const sim::Scene& truth, const sim::Scene& model) {
  const Photo photo = tests::rendered_photo(truth);
  const Observation o = observed(model, photo, 2);
  return lateral_offsets(*o.coarse, model);
}

double sine_km(const sim::Sheet& sheet, double along_km) {
  return sheet.thickness_km * std::sin(kTwoPi * along_km / sheet.wavelength_km + sheet.phase_rad);
}

void expect_on_sine(const std::vector<LateralOffset>& offsets, const sim::Sheet& sheet, double widest_km) {
  double square = 0.0;
  for (const LateralOffset& p : offsets) {
    const double off = (p.lateral_km - sine_km(sheet, p.along_km)) / p.sigma_km;
    EXPECT_LT(std::abs(off), 2.0) << "at " << p.along_km << " km";
    EXPECT_LT(p.sigma_km, widest_km) << "or anything would pass";
    square += off * off / static_cast<double>(offsets.size());
  }
  EXPECT_LT(square, 1.0);
}

/// The wavelengths that are tried are an eighth of a wave in view apart, and
/// that of measured offsets is off by up to 3 %. The phase of one that is a little
/// off is compared in the middle of what is seen.
void expect_sine(const SineThroughOffsets& found, const sim::Sheet& sheet,
                 const std::vector<LateralOffset>& offsets, double middle_km) {
  const auto by_place = [](const LateralOffset& a, const LateralOffset& b) {
    return a.along_km < b.along_km;
  };
  const auto [first, last] = std::minmax_element(offsets.begin(), offsets.end(), by_place);
  const double in_view_km = last->along_km - first->along_km;
  const double waves = in_view_km * (1.0 / found.wavelength_km - 1.0 / sheet.wavelength_km);
  EXPECT_LT(std::abs(waves), std::max(0.125, 0.03 * in_view_km / sheet.wavelength_km))
      << found.wavelength_km << " km";
  EXPECT_NEAR(found.amplitude_km, sheet.thickness_km, 0.2 * sheet.thickness_km);
  const double difference = kTwoPi * middle_km * (1.0 / found.wavelength_km - 1.0 / sheet.wavelength_km) +
                            found.phase_rad - sheet.phase_rad;
  EXPECT_NEAR(std::remainder(difference, kTwoPi), 0.0, 0.2);
}

TEST(LateralOffsets, OfARenderedSheetLiesOnItsSine) {
  const sim::Scene truth = waved({200.0});
  const auto found = offsets_of(truth, straightened(truth));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].size(), 24u) << "every band shows the sheet";
  expect_on_sine(found[0], truth.sheets[0], 2.5);
  const std::vector<SineThroughOffsets> sines = sines_through(found[0], 300.0, 15.0, 300.0, 4.0, 8);
  ASSERT_FALSE(sines.empty());
  expect_sine(sines.front(), truth.sheets[0], found[0], 300.0);
}

/// Two sheets in one band are told from each other by less, and a first look at straight ones finds the
/// wavelengths to a step of its search, an eighth of a wave in view. The second look is from what the first
/// has found.
TEST(LateralOffsets, IsThatOfEachOfTwoSheets) {
  const sim::Scene truth = waved({185.0, 235.0});
  sim::Scene model = straightened(truth);
  for (int look = 0; look < 2; ++look) {
    SCOPED_TRACE(look);
    const auto found = offsets_of(truth, model);
    ASSERT_EQ(found.size(), 2u);
    for (std::size_t s = 0; s < 2; ++s) {
      SCOPED_TRACE(s);
      EXPECT_EQ(found[s].size(), 24u);
      expect_on_sine(found[s], truth.sheets[s], 8.0);  // half the wave's swing, of the outermost bands
      const std::vector<SineThroughOffsets> sines = sines_through(found[s], 300.0, 15.0, 300.0, 4.0, 3);
      ASSERT_FALSE(sines.empty());
      model.sheets[s].wavelength_km = sines[0].wavelength_km;
      model.sheets[s].thickness_km = sines[0].amplitude_km;
      model.sheets[s].phase_rad = sines[0].phase_rad;
      if (look > 0) expect_sine(sines[0], truth.sheets[s], found[s], 300.0);
    }
  }
}

TEST(LateralOffsets, CountsFromTheModelsOwnLineAndSine) {
  const sim::Scene truth = waved({200.0});
  sim::Scene model = truth;
  model.sheets[0].center_km.north += 2.0;
  const auto found = offsets_of(truth, model);
  ASSERT_EQ(found[0].size(), 24u);
  // A sine's positive values lie to the north of a line that runs east, where the field points down.
  double mean = 0.0;
  for (const LateralOffset& p : found[0])
    mean += (p.lateral_km - sine_km(truth.sheets[0], p.along_km)) / static_cast<double>(found[0].size());
  EXPECT_NEAR(mean, -2.0, 0.3);
}

// Three layers, of which the last is the whole shift ahead: their mean is the middle one's sine, of
// (1 + 2 cos(shift / 2)) / 3 of the amplitude.
TEST(LateralOffsets, OfSeveralLayersIsTheirMean) {
  sim::Scene truth = waved({200.0});
  truth.sheets[0].layers = 3;
  truth.sheets[0].phase_shift_rad = 1.2;
  const auto found = offsets_of(truth, truth);
  ASSERT_EQ(found[0].size(), 24u);
  // The best sine of that wavelength. The photograph is the model's own, but for how coarsely the search
  // looks at it.
  double ss = 0.0, sc = 0.0, cc = 0.0, s = 0.0, c = 0.0;
  for (const LateralOffset& p : found[0]) {
    const double turn = kTwoPi * p.along_km / truth.sheets[0].wavelength_km;
    ss += std::sin(turn) * std::sin(turn);
    sc += std::sin(turn) * std::cos(turn);
    cc += std::cos(turn) * std::cos(turn);
    s += p.lateral_km * std::sin(turn);
    c += p.lateral_km * std::cos(turn);
  }
  const double of_sine = s * cc - c * sc, of_cosine = c * ss - s * sc, determinant = ss * cc - sc * sc;
  EXPECT_NEAR(std::atan2(of_cosine, of_sine), truth.sheets[0].phase_rad + 0.6, 0.08);
  EXPECT_NEAR(std::hypot(of_sine, of_cosine) / determinant,
              truth.sheets[0].thickness_km * (1.0 + 2.0 * std::cos(0.6)) / 3.0, 0.2);
}

TEST(LateralOffsets, HasNoPointWhereNoSheetIsInView) {
  sim::Scene truth = waved({200.0});
  sim::Scene model = straightened(truth);
  for (sim::Scene* scene : {&truth, &model}) {
    scene->sheets[0].length_km = 200.0;
    scene->sheets[0].center_km.east = -100.0;  // ends at the camera's meridian
    scene->camera.azimuth_deg = 0.0;
    scene->camera.roll_deg = 0.0;
  }
  const auto half = offsets_of(truth, model);
  ASSERT_EQ(half.size(), 1u);
  EXPECT_GE(half[0].size(), 9u);
  EXPECT_LE(half[0].size(), 12u) << "the western half of the bands";
  for (const LateralOffset& p : half[0]) EXPECT_LE(p.along_km, 200.0);

  for (sim::Scene* scene : {&truth, &model}) scene->sheets[0].center_km.north = -200.0;  // behind the camera
  const auto none = offsets_of(truth, model);
  ASSERT_EQ(none.size(), 1u);
  EXPECT_TRUE(none[0].empty());
}

TEST(SinesThrough, FindsTheSineOfItsPointsAndItsLine) {
  std::vector<LateralOffset> offsets;
  sim::Sheet sheet;
  sheet.thickness_km = 4.0;
  sheet.wavelength_km = 70.0;
  sheet.phase_rad = -2.0;
  for (int i = 0; i < 24; ++i) {
    const double along = 200.0 + 9.0 * i;
    offsets.push_back({along, sine_km(sheet, along) + 1.5 + 0.02 * (along - 300.0), 0.2});
  }
  const std::vector<SineThroughOffsets> sines = sines_through(offsets, 300.0, 20.0, 250.0, 4.0, 5);
  ASSERT_FALSE(sines.empty());
  EXPECT_LE(sines.size(), 5u);
  expect_sine(sines.front(), sheet, offsets, 300.0);
  EXPECT_NEAR(sines.front().offset_km, 1.5, 0.2);
  EXPECT_NEAR(sines.front().slope, 0.02, 0.005);
  for (std::size_t i = 1; i < sines.size(); ++i) EXPECT_LE(sines[i - 1].chi2, sines[i].chi2);
  for (const SineThroughOffsets& s : sines) {
    EXPECT_GE(s.wavelength_km, 20.0 - 1e-9);
    EXPECT_LE(s.wavelength_km, 250.0 + 1e-9);
  }
}

TEST(SinesThrough, TakesAFixedWavelengthAsItIs) {
  std::vector<LateralOffset> offsets;
  for (int i = 0; i < 12; ++i)
    offsets.push_back({10.0 * i, 2.0 * std::sin(kTwoPi * 10.0 * i / 50.0 + 0.5), 0.1});
  const std::vector<SineThroughOffsets> sines = sines_through(offsets, 60.0, 50.0, 50.0, 2.0, 8);
  ASSERT_FALSE(sines.empty());
  EXPECT_NEAR(sines.front().wavelength_km, 50.0, 1e-9);
  EXPECT_NEAR(sines.front().phase_rad, 0.5, 0.01);
  EXPECT_NEAR(sines.front().amplitude_km, 2.0, 0.02);
}

TEST(SinesThrough, FewPointsTellNoSine) {
  const std::vector<LateralOffset> four = {{0, 1, 1}, {10, 2, 1}, {20, 1, 1}, {30, 0, 1}};
  EXPECT_TRUE(sines_through(four, 0.0, 20.0, 100.0, 4.0, 5).empty());
  EXPECT_TRUE(sines_through({}, 0.0, 20.0, 100.0, 4.0, 5).empty());
}

}  // namespace
}  // namespace vegard::fit::lateral_offsets_test
