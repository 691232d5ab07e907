#include "fit/uncertainty/trade_off.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::trade_off_test {
namespace {

using Words = std::vector<std::string>;

struct Talk {
  sim::Scene scene;
  std::vector<FreeNumber> free;
  std::vector<double> values;
  std::vector<DescribedNumber> numbers;
  /// The sheet stands 200 km due north unless said otherwise.
  explicit Talk(const Words& paths, sim::EastNorth centre = {0.0, 200.0}) : scene(tests::small_scene()) {
    scene.sheets[0].center_km = centre;
    scene.sheets[0].energy_kev = 3.0;
    for (const std::string& path : paths) {
      sim::FreeParameter entry;
      entry.path = path;
      scene.fit.free.push_back(entry);
    }
    free = free_numbers(scene);
    for (const FreeNumber& n : free) values.push_back(n.start);
    numbers = described_numbers(scene, free, values);
  }
};

const Words kTwo = {"sheet.main.center_km.north", "sheet.main.energy_kev"};

TEST(TradeOff, IsToldInUnitsThatOneCanImagine) {
  const Talk talk(kTwo);
  EXPECT_TRUE(tests::has_facts(trade_off_text(talk.numbers, {10.0, -0.3}),
                               "distance and energy of the main sheet | 10 km further | 0.3 keV less"));
  EXPECT_TRUE(tests::has_facts(trade_off_text(talk.numbers, {0.0, -0.3}),
                               "not constrain | energy of the main sheet"));
}

// Numbers of volumes are those of the one that they belong to, and a footprint's centre is a place.
TEST(TradeOff, NamesVolumes) {
  Talk talk({"sheet.main.energy_kev"});
  sim::Footprint arc;
  arc.center_km = {0.0, -100.0};
  arc.east_km = {-50.0, 0.0, 50.0};
  arc.north_km = {1.0, 2.0, 3.0};
  talk.scene.footprints = {arc};
  sim::Node ball;
  ball.name = "ball";
  talk.scene.nodes = {ball};
  talk.scene.fit.free.clear();
  for (const char* path : {"footprint.arc.center_km.north", "footprint.arc.north_km.1",
                           "footprint.arc.width_km", "node.ball.radius"}) {
    sim::FreeParameter entry;
    entry.path = path;
    talk.scene.fit.free.push_back(entry);
  }
  const std::vector<FreeNumber> free = free_numbers(talk.scene);
  const auto numbers = described_numbers(talk.scene, free, {-100.0, 2.0, 3.0, 1.0});
  EXPECT_TRUE(tests::has_facts(trade_off_text(numbers, {-10.0, 0.0, 0.5, 0.0}),
                               "distance and width of the arc footprint | 5 km further | 0.25 km more"));
  EXPECT_TRUE(tests::has_facts(trade_off_text(numbers, {0.0, 1.0, 0.0, 0.0}),
                               "not constrain | north of point 1 of the arc footprint"));
  EXPECT_TRUE(tests::has_facts(trade_off_text(numbers, {0.0, 0.0, 0.0, 1.0}),
                               "not constrain | radius of the ball node"));
}

TEST(TradeOff, NamesWhatStandsOnTheSun) {
  Talk talk({"sheet.main.energy_kev"});
  talk.scene.sun.shown = true;
  sim::Loop loop;
  loop.name = "bright";
  loop.height = 60.0;
  talk.scene.loops = {loop};
  talk.scene.coronae.resize(1);
  talk.scene.fit.free.clear();
  for (const char* path :
       {"loop.bright.height", "loop.bright.tilt_deg", "corona.corona.density", "sun.position_angle_deg"}) {
    sim::FreeParameter entry;
    entry.path = path;
    talk.scene.fit.free.push_back(entry);
  }
  const std::vector<FreeNumber> free = free_numbers(talk.scene);
  const auto numbers = described_numbers(talk.scene, free, {60.0, 10.0, 1.0, 5.0});
  EXPECT_TRUE(tests::has_facts(trade_off_text(numbers, {10.0, -20.0, 0.0, 0.0}),
                               "tilt and height of the bright loop | 10\u00b0 more | 5 less"));
  EXPECT_TRUE(tests::has_facts(trade_off_text(numbers, {0.0, 0.0, 1.0, 0.0}),
                               "not constrain | density of the corona"));
  EXPECT_TRUE(tests::has_facts(trade_off_text(numbers, {0.0, 0.0, 0.0, 1.0}),
                               "not constrain | position angle of the Sun"));
}

// A direction has neither length nor sign.
TEST(TradeOff, DoesNotDependOnTheDirectionsLengthOrSign) {
  const Talk talk(kTwo);
  const std::string words = trade_off_text(talk.numbers, {10.0, -0.3});
  for (const double scale : {-1.0, 1e-6, -7.3e5})
    EXPECT_EQ(trade_off_text(talk.numbers, {10.0 * scale, -0.3 * scale}), words);
}

// Seen by the observer: the sheet in the south is further off when its centre goes south.
TEST(TradeOff, KnowsWhereTheObserverStands) {
  const Talk south(kTwo, {0.0, -200.0});
  EXPECT_NE(trade_off_text(south.numbers, {-10.0, -0.3}).find(": 10 km further with 0.3 keV less"),
            std::string::npos);
  // East of a sheet in the north is to its right; east and north together, along the line of sight, further.
  const Talk both({"sheet.main.center_km", "sheet.main.phase_rad"}, {120.0, 160.0});
  EXPECT_TRUE(tests::has_facts(trade_off_text(both.numbers, {6.0, 8.0, 0.1}),
                               "distance and phase of the main sheet | 20 km further | 0.2 rad more"));
  EXPECT_TRUE(tests::has_facts(trade_off_text(both.numbers, {8.0, -6.0, 0.1}),
                               "place and phase of the main sheet | 20 km to the right | 0.2 rad more"));
  EXPECT_TRUE(tests::has_facts(trade_off_text(both.numbers, {8.0, -6.0, 0.0}),
                               "not constrain | place of the main sheet"));
}

TEST(TradeOff, NamesThreeAtMostAndSaysHowManyMore) {
  const Talk talk({"sheet.main.center_km.north", "sheet.main.energy_kev", "sheet.main.wavelength_km",
                   "sheet.main.width_km", "camera.elevation_deg"});
  EXPECT_TRUE(tests::has_facts(trade_off_text(talk.numbers, {20.0, -0.3, 3.0, 0.01, -1.0}),
                               "distance, energy and wavelength of the main sheet | 2 more | 20 km further | "
                               "0.3 keV less energy | 3 km more wavelength"));
  // The one that is asked about is among them.
  EXPECT_TRUE(tests::has_facts(trade_off_text(talk.numbers, {20.0, -0.3, 0.0, 0.0, -0.001}, 4),
                               "distance of the main sheet | energy of the main sheet | elevation of the "
                               "camera | 20 km further | 0.3 keV less energy | 0.001\u00b0 less elevation"));
}

TEST(TradeOff, SpeaksOfEveryNumberThatMayBeFree) {
  for (const char* path : {"sheet.main.peak_km", "field.inclination_deg", "camera.hfov_deg", "blur.width_deg",
                           "airglow.green_rayleigh", "air.aerosol_optical_depth",
                           "light_pollution.luminance_mcd_m2", "sheet.main.energy_flux_mw_m2"}) {
    sim::Scene scene = tests::small_scene();
    std::vector<FreeNumber> free;
    for (const sim::ParameterPath& p : sim::resolve(scene, path)) {
      free.emplace_back();
      free.back().id = p.id;
      free.back().path = p.text;
      free.back().start = *sim::real_value(scene, p);
      free.back().min = p.row->min;
      free.back().max = p.row->max;
    }
    std::vector<double> values;
    for (const FreeNumber& n : free) values.push_back(n.start);
    for (const DescribedNumber& n : described_numbers(scene, free, values)) {
      EXPECT_FALSE(n.noun.empty()) << n.path;
      EXPECT_FALSE(n.owner.empty()) << n.path;
      EXPECT_EQ(n.noun.find('_'), std::string::npos) << n.noun;
      EXPECT_GT(n.noticeable, 0.0) << n.path;
    }
  }
}

// From a Jacobian to a sentence: residuals that depend on 0.3 keV as on 10 km have that for their
// undetermined direction, whatever the coordinates' transforms do to it.
TEST(WhyUndetermined, CarriesTheDirectionBackThroughTheTransforms) {
  Talk talk({"sheet.main.center_km.north", "sheet.main.bearing_deg", "sheet.main.energy_kev"});
  const std::size_t n = 3;
  constexpr int kResiduals = 50;
  std::vector<double> jacobian;
  for (int r = 0; r < kResiduals; ++r) {
    const double a = std::sin(0.3 * r), b = std::cos(0.17 * r * r);
    const double by_value[3] = {0.3 * a, b, 10.0 * a};
    for (std::size_t j = 0; j < n; ++j)
      jacobian.push_back(by_value[j] * talk.free[j].slope(talk.free[j].coordinate(talk.values[j])));
  }
  const Uncertainty u = uncertainty({jacobian}, kResiduals, 3, no_prior_knowledge(3), 1.0);
  ASSERT_TRUE(std::isnan(u.sigma[0]) && std::isnan(u.sigma[2]) && !std::isnan(u.sigma[1]));
  for (const std::size_t number : {0, 2}) {
    EXPECT_TRUE(tests::has_facts(why_undetermined(talk.scene, talk.free, talk.values, u, number),
                                 "distance and energy of the main sheet | 10 km further | 0.3 keV less"));
  }
  EXPECT_TRUE(tests::has_facts(why_undetermined(talk.scene, talk.free, talk.values, u, 1), "not bound"));
  EXPECT_TRUE(
      tests::has_facts(why_undetermined(talk.scene, talk.free, talk.values, Uncertainty{}, 1), "not bound"));
}

TEST(StrongCorrelations, AreToldTheStrongestFirst) {
  const Talk talk({"sheet.main.energy_kev", "sheet.main.center_km.north", "camera.azimuth_deg"});
  const std::vector<std::vector<double>> r = {{1.0, -0.95, 0.5}, {-0.95, 1.0, 0.97}, {0.5, 0.97, 1.0}};
  const Words two = strong_correlations(talk.numbers, {0.2, 4.0, 0.5}, r);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_TRUE(tests::has_facts(
      two[0], "distance of the main sheet | azimuth of the camera | 0.97 | 4 km further | 0.48\u00b0 more"));
  EXPECT_TRUE(tests::has_facts(
      two[1], "distance and energy of the main sheet | \u22120.95 | 4 km further | 0.19 keV less"));
  EXPECT_EQ(strong_correlations(talk.numbers, {0.2, std::nan(""), 0.5}, r), Words{});
  EXPECT_EQ(strong_correlations(talk.numbers, {0.2, 4.0, 0.5}, r, 0.9, 1).size(), 1u);
}

TEST(StrongCorrelations, TellEastFromNorthWhereBothAreFree) {
  const Talk talk({"sheet.main.center_km"}, {150.0, 150.0});
  const Words words = strong_correlations(talk.numbers, {2.0, 3.0}, {{1.0, -0.94}, {-0.94, 1.0}});
  ASSERT_EQ(words.size(), 1u);
  EXPECT_TRUE(tests::has_facts(words[0],
                               "place to the east | place to the north of the main sheet | \u22120.94 | 2 km "
                               "to the east | 2.8 km to the south"));
}

TEST(StrongCorrelations, TellDistanceWhereTheSheetStandsNearlyThatWay) {
  const Talk talk({"sheet.main.center_km", "sheet.main.energy_kev"}, {58.0, 227.0});
  // A step to the north goes outwards by 227 / hypot(58, 227) = 0.969 of itself.
  const Words words = strong_correlations(talk.numbers, {0.5, 0.16, 0.032},
                                          {{1.0, 0.0, 0.0}, {0.0, 1.0, -0.94}, {0.0, -0.94, 1.0}});
  ASSERT_EQ(words.size(), 1u);
  EXPECT_TRUE(tests::has_facts(
      words[0], "distance and energy of the main sheet | \u22120.94 | 0.16 km further | 0.03 keV less"));
}

}  // namespace
}  // namespace vegard::fit::trade_off_test
