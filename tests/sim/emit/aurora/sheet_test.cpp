#include "sim/emit/aurora/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::sheet_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

SheetShape<double> shape_of(const Sheet& s, double side = 1.0) {
  return {s.center_km.east,
          s.center_km.north,
          std::sin(s.bearing_deg * kRadiansPerDegree),
          std::cos(s.bearing_deg * kRadiansPerDegree),
          s.length_km,
          s.thickness_km,
          s.wavelength_km,
          s.phase_rad,
          s.phase_shift_rad,
          s.width_km,
          s.energy_flux_mw_m2,
          0.0,
          side};
}

std::vector<BeamPlace> beam_places(const Sheet& sheet, int sheet_index, int layer, std::uint64_t seed,
                                   double beyond) {
  const LayerPlaces layer_places(sheet, layer_address(sheet_index, 0, layer), seed, beyond);
  std::vector<BeamPlace> places(layer_places.size());
  for (int first = 0; first < layer_places.size(); first += LayerPlaces::kSumEvery)
    layer_places.fill(first, std::min(LayerPlaces::kSumEvery, layer_places.size() - first), &places[first]);
  return places;
}

BeamFoot<double> foot_at(const Sheet& sheet, const BeamPlace& place, int layer = 0, double side = 1.0) {
  return beam_foot(shape_of(sheet, side), stretch_of(sheet, 0.0), place, layer, sheet.layers,
                   sheet.spacing_rule == SpacingRule::literal);
}

BeamPlace place_at(double s) {
  BeamPlace place;
  place.s = place.s_of_phase = s;
  place.from = s;
  place.to = s;
  return place;
}

/// The foot's distance to the left of the walk from start to end.
double left_of_line(const Sheet& sheet, const BeamFoot<double>& foot) {
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  return (foot.north_km - sheet.center_km.north) * std::sin(bearing) -
         (foot.east_km - sheet.center_km.east) * std::cos(bearing);
}
double along_line(const Sheet& sheet, const BeamFoot<double>& foot) {
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  return (foot.east_km - sheet.center_km.east) * std::sin(bearing) +
         (foot.north_km - sheet.center_km.north) * std::cos(bearing);
}

Sheet slanted() {
  Sheet sheet;
  sheet.center_km = {30.0, 210.0};
  sheet.bearing_deg = 67.0;
  sheet.length_km = 310.0;
  sheet.thickness_km = 4.0;
  sheet.wavelength_km = 47.0;
  sheet.phase_rad = 0.6;
  return sheet;
}

TEST(Sheet, SineHasItsPhaseFromTheStartAndTwoPiDOverLambdaInAll) {
  const Sheet sheet = slanted();
  for (double s : {0.0, 0.11, 0.5, 0.83, 1.0}) {
    const BeamFoot<double> foot = foot_at(sheet, place_at(s));
    EXPECT_NEAR(along_line(sheet, foot), (s - 0.5) * 310.0, 1e-9);
    EXPECT_NEAR(left_of_line(sheet, foot), 4.0 * std::sin(0.6 + 2.0 * kPi * 310.0 / 47.0 * s), 1e-9) << s;
  }
}

TEST(Sheet, LiteralRuleAdvancesThePhaseByEquationTwoAfterEveryBeam) {
  Sheet sheet = slanted();
  sheet.spacing_rule = SpacingRule::literal;
  sheet.beams = 50;
  const std::vector<BeamPlace> places = beam_places(sheet, 0, 0, 1, 0.0);
  const double step = 310.0 / 50 * 2.0 * kPi / 47.0;
  BeamPlace unspread;
  for (int i = 0; i < 50; ++i) {
    unspread.s_of_phase = places[i].s_of_phase;
    EXPECT_NEAR(left_of_line(sheet, foot_at(sheet, unspread)), 4.0 * std::sin(0.6 + i * step), 1e-9);
  }
}

TEST(Sheet, LastLayerLagsBehindTheFirstByThePhaseShift) {
  Sheet sheet = slanted();
  sheet.layers = 3;
  for (double shift : {0.1 * kPi, 0.35 * kPi}) {
    sheet.phase_shift_rad = shift;
    double widest = 0.0;
    for (double s = 0.0; s <= 1.0; s += 1e-4) {
      const double first = left_of_line(sheet, foot_at(sheet, place_at(s), 0));
      const double last = left_of_line(sheet, foot_at(sheet, place_at(s), 2));
      widest = std::max(widest, std::abs(last - first));
    }
    EXPECT_NEAR(widest, 2.0 * 4.0 * std::sin(0.5 * shift), 1e-4);
    if (shift > 1.0) {
      EXPECT_NEAR(widest / sheet.thickness_km, 1.045, 5e-4);
    }
  }
  EXPECT_NEAR(left_of_line(sheet, foot_at(sheet, place_at(0.4), 1)),
              4.0 * std::sin(0.6 + 2.0 * kPi * 310.0 / 47.0 * 0.4 + 0.5 * sheet.phase_shift_rad), 1e-9);
}

TEST(Sheet, BeamsAreLaidOutWhereTheirFeetAre) {
  Sheet sheet = slanted();
  sheet.layers = 3;
  sheet.phase_shift_rad = 0.8;
  sheet.width_km = 0.4;
  for (int layer = 0; layer < 3; ++layer)
    for (double s : {0.07, 0.3, 0.62}) {
      BeamPlace place = place_at(s);
      place.across = -0.6;
      EXPECT_NEAR(aside_laid_out_km(sheet, place, layer, 0.0),
                  left_of_line(sheet, foot_at(sheet, place, layer)), 1e-9)
          << "layer " << layer << " at " << s;
    }
}

TEST(Sheet, PositiveSideIsTheLeftInTheNorthAndTheRightInTheSouth) {
  Sheet sheet = slanted();
  sheet.phase_rad = 0.5 * kPi;
  EXPECT_NEAR(left_of_line(sheet, foot_at(sheet, place_at(0.0), 0, 1.0)), 4.0, 1e-9);
  EXPECT_NEAR(left_of_line(sheet, foot_at(sheet, place_at(0.0), 0, -1.0)), -4.0, 1e-9);
  // Due east: the left is the north.
  sheet.bearing_deg = 90.0;
  EXPECT_NEAR(foot_at(sheet, place_at(0.0)).north_km, 214.0, 1e-9);
}

Sheet structured() {
  Sheet sheet = slanted();
  sheet.fold_spacing_km = 30.0;
  sheet.fold_length_km = 24.0;
  sheet.fold_stage = 0.9;
  sheet.curl_spacing_km = 9.0;
  return sheet;
}

BeamFoot<double> structured_foot(const Sheet& sheet, const BeamPlace& place, double side = 1.0) {
  SheetShape<double> shape = shape_of(sheet, side);
  shape.fold_stage = sheet.fold_stage;
  const LayerStructure structure{Folds(sheet, 0, 1, 0.0, 0.0), Curls(sheet, 0, 1, 0.0, 0.0)};
  return beam_foot(shape, stretch_of(sheet, 0.0), place, 0, sheet.layers, false, &structure);
}

TEST(Sheet, FoldsAndCurlsMoveBeamsAndAreMirroredInTheSouth) {
  const Sheet sheet = structured();
  double moved = 0.0;
  for (double s = 0.05; s < 1.0; s += 0.013) {
    BeamPlace place = place_at(s);
    place.across = 0.7;
    const BeamFoot<double> north = structured_foot(sheet, place), south = structured_foot(sheet, place, -1.0);
    EXPECT_NEAR(along_line(sheet, south), along_line(sheet, north), 1e-9);
    EXPECT_NEAR(left_of_line(sheet, south), -left_of_line(sheet, north), 1e-9);
    moved = std::max(moved, std::abs(along_line(sheet, north) - (s - 0.5) * 310.0));
  }
  EXPECT_GT(moved, 2.0);
}

TEST(Sheet, CrossSectionTurnsWithAFold) {
  Sheet sheet = structured();
  sheet.curl_spacing_km = 0.0;
  double turned = 0.0;
  for (double s = 0.05; s < 1.0; s += 0.0031) {
    constexpr double h = 1e-7;
    BeamPlace beside = place_at(s);
    beside.across = 1.0;
    const BeamFoot<double> here = structured_foot(sheet, place_at(s)), other = structured_foot(sheet, beside),
                           next = structured_foot(sheet, place_at(s + h));
    const double x = along_line(sheet, other) - along_line(sheet, here),
                 y = left_of_line(sheet, other) - left_of_line(sheet, here);
    EXPECT_NEAR(std::hypot(x, y), sheet.width_km, 1e-9);
    // The angle from the curve's tangent to the cross-section is that from the sine's tangent to the left.
    const double tangent = std::atan2(left_of_line(sheet, next) - left_of_line(sheet, here),
                                      along_line(sheet, next) - along_line(sheet, here));
    const double k = 2.0 * kPi / sheet.wavelength_km;
    const double sines = std::atan(sheet.thickness_km * k * std::cos(sheet.phase_rad + k * s * 310.0));
    const double difference = std::atan2(y, x) - tangent - (0.5 * kPi - sines);
    EXPECT_NEAR(std::remainder(difference, 2.0 * kPi), 0.0, 1e-4) << s;
    turned = std::max(turned, std::abs(std::remainder(tangent - sines, 2.0 * kPi)));
  }
  EXPECT_GT(turned, 1.0);
}

TEST(Sheet, SharesOfTheLightAddUpToItsLength) {
  for (const char* rule : {"stratified", "tied", "literal"}) {
    for (double beyond : {0.0, 0.5}) {
      Sheet sheet = slanted();
      sheet.spacing_rule = tests::kind_named<SpacingRule>(rule);
      sheet.beams = 333;
      double sum = 0.0;
      for (const BeamPlace& place : beam_places(sheet, 0, 1, 9, beyond))
        sum += foot_at(sheet, place, 1).flux_km2_mw_m2;
      EXPECT_NEAR(sum, sheet.energy_flux_mw_m2 * sheet.width_km * std::sqrt(2.0 * kPi) * 310.0, 1e-7)
          << rule << ", beyond " << beyond;
    }
  }
}

TEST(BeamPlaces, WithoutJitterAreEven) {
  Sheet sheet = slanted();
  sheet.spacing_jitter = 0.0;
  sheet.beams = 40;
  const std::vector<BeamPlace> places = beam_places(sheet, 0, 0, 3, 0.0);
  ASSERT_EQ(places.size(), 40u);
  for (int i = 0; i < 40; ++i) {
    EXPECT_NEAR(places[i].s, (i + 0.5) / 40, 1e-12);
    EXPECT_NEAR(places[i].from, i / 40.0, 1e-12);
    EXPECT_NEAR(places[i].to, (i + 1) / 40.0, 1e-12);
  }
}

TEST(BeamPlaces, StratifiedBeamsKeepToTheirStretches) {
  Sheet sheet = slanted();
  sheet.beams = 1000;
  sheet.spacing_jitter = 0.8;
  double smallest = 1.0, largest = -1.0;
  for (double beyond : {0.0, 0.5}) {
    const std::vector<BeamPlace> places = beam_places(sheet, 0, 0, 3, beyond);
    const double wide = (1.0 + 2.0 * -places.front().from) / static_cast<double>(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_NEAR(places[i].from, places.front().from + static_cast<double>(i) * wide, 1e-12);
      EXPECT_NEAR(places[i].to - places[i].from, wide, 1e-12);
      const double off = (places[i].s - 0.5 * (places[i].from + places[i].to)) / wide;
      smallest = std::min(smallest, off);
      largest = std::max(largest, off);
    }
  }
  // A thousand uniform numbers come within a hundredth of both limits but for odds of 1 to 20 000.
  EXPECT_NEAR(smallest, -0.4, 0.008);
  EXPECT_NEAR(largest, 0.4, 0.008);
}

TEST(BeamPlaces, TiedStretchesTouchAndStayWithinTheJitter) {
  Sheet sheet = slanted();
  sheet.spacing_rule = SpacingRule::tied;
  sheet.beams = 1000;
  sheet.spacing_jitter = 0.5;
  const std::vector<BeamPlace> places = beam_places(sheet, 0, 0, 3, 0.0);
  EXPECT_EQ(places.front().from, 0.0);
  EXPECT_NEAR(places.back().to, 1.0, 1e-12);
  double smallest = 1e9, largest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(places[i].from, i > 0 ? places[i - 1].to : 0.0, 1e-12);
    EXPECT_GT(places[i].s, places[i].from);
    EXPECT_LT(places[i].s, places[i].to);
    EXPECT_EQ(places[i].s_of_phase, places[i].s);
    smallest = std::min(smallest, places[i].to - places[i].from);
    largest = std::max(largest, places[i].to - places[i].from);
  }
  // The sum of the steps is scaled to 1, which moves the limits by some 1 %.
  EXPECT_NEAR(smallest * 1000, 0.5, 0.02);
  EXPECT_NEAR(largest * 1000, 1.5, 0.03);
}

TEST(BeamPlaces, LiteralRuleStepsByFiveQuartersOnAverage) {
  Sheet sheet = slanted();
  sheet.spacing_rule = SpacingRule::literal;
  sheet.beams = 20000;
  const std::vector<BeamPlace> places = beam_places(sheet, 0, 0, 17, 0.0);
  // A step's variance is 1/48 + 1/4: four standard errors of the mean of 20000 are 0.015. Seed 17.
  EXPECT_NEAR(places.back().s / (places.size() - 1) * places.size(), 1.25, 0.015);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double step = (places[i].s - places[i - 1].s) * 20000.0;
    EXPECT_TRUE((step > 0.5 - 1e-6 && step < 1.0) || (step > 1.5 && step < 2.0)) << step;
  }
}

TEST(BeamPlaces, CrossSectionIsNormal) {
  Sheet sheet = slanted();
  sheet.beams = 4096;
  double mean = 0.0, square = 0.0;
  for (const BeamPlace& place : beam_places(sheet, 0, 0, 5, 0.0)) {
    mean += place.across / 4096;
    square += place.across * place.across / 4096;
  }
  // A stratified sample: far closer than the 1/64 of a random one.
  EXPECT_NEAR(mean, 0.0, 1e-3);
  EXPECT_NEAR(square, 1.0, 5e-3);
}

TEST(BeamPlaces, DifferBetweenLayersAndSheets) {
  Sheet sheet = slanted();
  const auto a = beam_places(sheet, 0, 0, 5, 0.0), b = beam_places(sheet, 0, 1, 5, 0.0),
             c = beam_places(sheet, 1, 0, 5, 0.0);
  EXPECT_NE(a[3].s, b[3].s);
  EXPECT_NE(a[3].s, c[3].s);
  EXPECT_NE(a[3].across, b[3].across);
  EXPECT_NE(b[3].across, c[3].across);
}

TEST(Sheet, BeamsBeyondItsEndsAreDark) {
  const Sheet sheet = slanted();
  int dark = 0, lit = 0;
  for (const BeamPlace& place : beam_places(sheet, 0, 0, 9, 0.5)) {
    const BeamFoot<double> foot = foot_at(sheet, place);
    if (place.to <= 0.0 || place.from >= 1.0) {
      EXPECT_EQ(foot.flux_km2_mw_m2, 0.0);
      ++dark;
    } else {
      EXPECT_GT(foot.flux_km2_mw_m2, 0.0);
      ++lit;
    }
  }
  EXPECT_NEAR(dark, sheet.beams, 60);
  EXPECT_NEAR(lit, sheet.beams, 60);
}

TEST(Sheet, SlidingAlongItsLineWithThePhaseCompensatedMovesNoBeamInside) {
  // What StretchOfSheet is for: only the light at the two ends changes.
  const Sheet before = slanted();
  Sheet after = before;
  constexpr double shift_km = 12.5;
  const double bearing = before.bearing_deg * kRadiansPerDegree;
  after.center_km.east += shift_km * std::sin(bearing);
  after.center_km.north += shift_km * std::cos(bearing);
  after.phase_rad += 2.0 * kPi * shift_km / before.wavelength_km;
  const StretchOfSheet line = stretch_of(before, 0.0);
  int interior = 0, changed = 0;
  for (const BeamPlace& place : beam_places(before, 0, 1, 4, 0.5)) {
    const auto old_foot = beam_foot(shape_of(before), line, place, 1, before.layers, false);
    const auto new_foot = beam_foot(shape_of(after), line, place, 1, before.layers, false);
    EXPECT_NEAR(new_foot.east_km, old_foot.east_km, 1e-9);
    EXPECT_NEAR(new_foot.north_km, old_foot.north_km, 1e-9);
    const double from_start = place.from * before.length_km, to_end = (1.0 - place.to) * before.length_km;
    if (from_start > shift_km && to_end > 0.0) {
      EXPECT_EQ(new_foot.flux_km2_mw_m2, old_foot.flux_km2_mw_m2);
      ++interior;
    } else {
      changed += new_foot.flux_km2_mw_m2 != old_foot.flux_km2_mw_m2;
    }
  }
  EXPECT_GT(interior, 1800);
  EXPECT_GT(changed, 100);
}

}  // namespace
}  // namespace vegard::sim::sheet_test
