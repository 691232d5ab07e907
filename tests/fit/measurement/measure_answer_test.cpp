#include "fit/measurement/measure_answer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fit/border/border_distance.h"
#include "fit/measurement/main_border.h"
#include "fit/measurement/main_curtain.h"
#include "sim/base/number/constants.h"
#include "tests/support/made_measurement.h"

namespace vegard::fit::measure_answer_test {
namespace {

using made_measurement::mapped;
using made_measurement::measured;
using made_measurement::trace;

bool has(const std::vector<std::string>& sentences, const std::string& text) {
  for (const std::string& sentence : sentences)
    if (sentence.find(text) != std::string::npos) return true;
  return false;
}

std::string all_of(const MeasureAnswer& answer) {
  std::string all;
  for (const std::string& sentence : answer.sentences) all += sentence + "\n";
  return all;
}

/// Of a part of the answer; unconstrained if there is none of that name.
Trust trust_in(const MeasureAnswer& answer, const std::string& name) {
  for (const AnswerPart& part : answer.parts)
    if (part.name == name) return part.trust;
  return Trust::unconstrained;
}

TEST(MainBorder, IsTheMostProbableAndNotTheNearest) {
  // High up, thus near, but less probable; then long and probable; then as probable and short.
  const Measurement m =
      measured({trace(300, 320, 60, 0.91), trace(130, 230, 22, 0.99), trace(20, 32, 40, 0.98)});
  ASSERT_TRUE(m.main_border);
  EXPECT_EQ(m.main_border->trace, 1u);
}

TEST(MainBorder, IsNoneOfWhatIsNotClaimed) {
  const Measurement m = measured({trace(130, 230, 22, 0.6), trace(20, 32, 40, 0.2)});
  EXPECT_FALSE(m.main_border);
  EXPECT_EQ(unclaimed_words(*m.border), "2 edges (stars)");
}

TEST(MainBorder, HasItsHeightInTheErrorOfItsDistance) {
  const Measurement m = measured({trace(130, 230, 22, 1.0)});
  const MainBorder& b = *m.main_border;
  const BorderPlace alone = border_place(m.border_scene->site, 180, 22, 0.2, kAssumedBorder_km);
  EXPECT_NEAR(b.distance_km, alone.distance_km, 1e-9);
  // An altitude that may be any of 95 to 110 km has a standard deviation of 15 km / sqrt(12).
  const double by_altitude = (b.highest_distance_km - b.lowest_distance_km) / std::sqrt(12.0);
  EXPECT_NEAR(b.distance_error_km, std::hypot(alone.distance_error_km, by_altitude), 1e-6);
  EXPECT_GT(b.distance_error_km, 2.0 * alone.distance_error_km);
}

TEST(MainBorder, OneHighPointDoesNotMakeItNear) {
  BorderTrace t = trace(130, 230, 22, 1.0);
  t.points[40].elevation_deg = 30.0;
  EXPECT_NEAR(measured({t}).main_border->elevation_deg, 22.0, 1e-9);
}

TEST(MainBorder, PassesThroughNorth) {
  const Measurement m = measured({trace(340, 380, 22, 1.0)});
  EXPECT_NEAR(m.main_border->from_azimuth_deg, 340.0, 1e-9);
  EXPECT_TRUE(has(measure_answer(m).sentences, "north"));
}

TEST(CompassWord, HasEightWindsRoundedToTheNearest) {
  EXPECT_EQ(compass_word(0), "north");
  EXPECT_EQ(compass_word(359), "north");
  EXPECT_EQ(compass_word(-90), "west");
  EXPECT_EQ(compass_word(66), "north-east");
  EXPECT_EQ(compass_word(68), "east");
  EXPECT_EQ(compass_word(700), "north");
}

TEST(MeasureAnswer, SaysWhereHowFarAndWhatItDependsOn) {
  const MeasureAnswer answer = measure_answer(measured({trace(130, 230, 22, 1.0)}));
  EXPECT_EQ(answer.trust, Trust::good);
  EXPECT_TRUE(has(answer.sentences, "south-east (130°)")) << all_of(answer);
  EXPECT_TRUE(has(answer.sentences, "south-west (230°)")) << all_of(answer);
  EXPECT_TRUE(has(answer.sentences, "° N")) << all_of(answer);
  EXPECT_TRUE(has(answer.sentences, "105 km")) << all_of(answer);
  EXPECT_TRUE(has(answer.sentences, "95 km")) << all_of(answer);
  EXPECT_TRUE(has(answer.not_known, "second picture"));
  EXPECT_TRUE(has(answer.not_known, "filters"));
}

TEST(MeasureAnswer, NoClaimIsNoBorder) {
  const MeasureAnswer answer = measure_answer(measured({trace(130, 230, 22, 0.5)}));
  EXPECT_EQ(answer.trust, Trust::unconstrained);
  EXPECT_TRUE(answer.parts.empty());
  EXPECT_TRUE(has(answer.sentences, "1 edge (stars)"));
}

TEST(MeasureAnswer, DoubtsADistanceThatTheBordersLevelDecides) {
  EXPECT_EQ(measure_answer(measured({trace(130, 230, 22, 1.0, 1.0)})).trust, Trust::good);
  const MeasureAnswer wide = measure_answer(measured({trace(130, 230, 22, 1.0, 7.0)}));
  EXPECT_EQ(wide.trust, Trust::doubtful);
  EXPECT_TRUE(has(wide.sentences, "not sharp")) << all_of(wide);
}

TEST(MeasureAnswer, DoubtsALowBorderByItsError) {
  // At an elevation of 5° a degree is more than a tenth of the distance.
  BorderTrace low = trace(130, 230, 5, 1.0);
  for (BorderPoint& p : low.points) p.elevation_error_deg = 1.0;
  const MeasureAnswer answer = measure_answer(measured({low}));
  EXPECT_EQ(answer.trust, Trust::doubtful);
  EXPECT_EQ(trust_in(answer, "distance"), Trust::doubtful) << all_of(answer);
}

TEST(MeasureAnswer, WithASkylineForTheHorizonNothingIsGood) {
  Measurement m = measured({trace(-20, 20, 22, 1.0)});
  m.has_azimuth = false;
  const MeasureAnswer answer = measure_answer(m);
  EXPECT_EQ(answer.trust, Trust::doubtful);
  EXPECT_TRUE(has(answer.sentences, "20° left")) << all_of(answer);
  EXPECT_EQ(trust_in(answer, "direction"), Trust::doubtful);
  EXPECT_EQ(trust_in(answer, "distance"), Trust::doubtful);
  EXPECT_FALSE(has(answer.sentences, "° N")) << all_of(answer);
}

TEST(MeasureAnswer, StarsAboveASkylineTellTheCompassRoughly) {
  Measurement m = measured({trace(70, 110, 22, 1.0)});
  m.has_azimuth = false;
  m.site.reset();
  m.over_horizon = StarsOverHorizon{0.0, 6.0, 64.0, 2.0, 100.0, 4.0};
  const MeasureAnswer answer = measure_answer(m);
  EXPECT_EQ(trust_in(answer, "direction"), Trust::doubtful);
  EXPECT_TRUE(has(answer.sentences, "east (70 to 110°)")) << all_of(answer);
  EXPECT_TRUE(has(answer.sentences, "to 6°")) << all_of(answer);
  EXPECT_FALSE(has(answer.sentences, "of the middle")) << all_of(answer);
  EXPECT_FALSE(has(answer.sentences, "° N")) << all_of(answer);
}

TEST(MeasureAnswer, AMapThatAgreesIsGoodAndHasOneEnergy) {
  const MeasureAnswer answer = measure_answer(mapped({trace(130, 230, 22, 1.0)}, 1.1, 1.02));
  EXPECT_EQ(answer.trust, Trust::good) << all_of(answer);
  EXPECT_TRUE(has(answer.sentences, "5.00 ± 0.40 keV")) << all_of(answer);
}

TEST(MeasureAnswer, AMapThatExplainsNoPictureLeavesNoGreenBanner) {
  const MeasureAnswer answer = measure_answer(mapped({trace(130, 230, 22, 1.0)}, 7.25, 1.0));
  EXPECT_EQ(answer.trust, Trust::doubtful);
  EXPECT_TRUE(has(answer.sentences, "7.25")) << all_of(answer);
  EXPECT_EQ(trust_in(answer, "direction"), Trust::good);
  EXPECT_EQ(trust_in(answer, "distance"), Trust::good) << all_of(answer);
}

TEST(MeasureAnswer, AMapWithoutAnythingCertainLeavesNoGreenBanner) {
  Measurement m = mapped({trace(130, 230, 22, 1.0)}, 1.0, 1.0);
  for (QuantityVerdict& v : m.map->verdicts) v.trust = Trust::doubtful;
  EXPECT_EQ(measure_answer(m).trust, Trust::doubtful);
}

TEST(MeasureAnswer, AMapElsewhereDoubtsTheDistance) {
  // The border's error is 4 % with its height's, the map's 2 %: 30 % are more than two errors.
  const Measurement m = mapped({trace(130, 230, 22, 1.0)}, 1.0, 1.3);
  EXPECT_FALSE(m.main_curtain->agrees());
  const MeasureAnswer answer = measure_answer(m);
  EXPECT_EQ(answer.trust, Trust::doubtful);
  EXPECT_EQ(trust_in(answer, "distance"), Trust::doubtful) << all_of(answer);
}

TEST(MeasureAnswer, AMapWithoutErrorBarsAgreesByTheBordersErrorAlone) {
  Measurement m = mapped({trace(130, 230, 22, 1.0)}, 1.0, 1.05);
  m.main_curtain->distance_km.error = sim::kNaN;
  EXPECT_TRUE(m.main_curtain->agrees());
  m.main_curtain->distance_km.value *= 1.3;
  EXPECT_FALSE(m.main_curtain->agrees());
}

TEST(MeasureAnswer, AnEnergyWithALargeErrorIsDoubtfulAndTheDistanceGood) {
  const MeasureAnswer answer = measure_answer(mapped({trace(130, 230, 22, 1.0)}, 1.0, 1.0, 0.3));
  EXPECT_EQ(trust_in(answer, "energy"), Trust::doubtful) << all_of(answer);
  EXPECT_EQ(trust_in(answer, "direction"), Trust::good);
  EXPECT_EQ(trust_in(answer, "distance"), Trust::good) << all_of(answer);
}

TEST(MeasureAnswer, EnergiesAtTheEndOfTheMapsAreDoubtful) {
  Measurement m = mapped({trace(130, 230, 22, 1.0)}, 1.0, 1.0);
  std::vector<Curtain> curtains = m.map->curtains;
  for (CurtainPoint& p : curtains.front().points) p.energy_kev = {16.0, 1.0};
  m.main_curtain = main_curtain(m.map->result, curtains, m.border->traces.front(), *m.border_scene);
  EXPECT_NEAR(m.main_curtain->share_at_end, 1.0, 1e-9);
  EXPECT_EQ(trust_in(measure_answer(m), "energy"), Trust::doubtful);
}

TEST(MeasureAnswer, AnInterruptedMapIsToldAsSuch) {
  Measurement m = measured({trace(130, 230, 22, 1.0)});
  m.is_map_interrupted = true;
  EXPECT_TRUE(has(measure_answer(m).not_known, "interrupted"));
}

TEST(MeasureAnswer, WithoutACameraSaysInThreeLinesWhatIsNeeded) {
  const MeasureAnswer answer = measure_answer(Measurement());
  EXPECT_EQ(answer.trust, Trust::unconstrained);
  EXPECT_EQ(answer.sentences.size() + answer.not_known.size(), 3u);
  EXPECT_TRUE(has(answer.sentences, "--camera"));
}

TEST(MeasureAnswer, WithoutACameraSaysWhatIsKnownAndWhatIsNot) {
  Measurement m;
  m.time_utc = "2014-02-21T19:30:40Z";
  m.has_field_of_view = true;
  const std::string all = all_of(measure_answer(m));
  const std::size_t known = all.find("Known"), not_told = all.find("Not told");
  ASSERT_NE(not_told, std::string::npos) << all;
  EXPECT_LT(known, all.find("the time", known)) << all;
  EXPECT_LT(all.find("the time", known), not_told) << all;
  EXPECT_LT(all.find("field of view", known), not_told) << all;
  EXPECT_GT(all.find("the place", known), not_told) << all;
}

TEST(MainCurtain, WeighsByEnergyFluxAndKeepsToTheBorder) {
  Measurement m = mapped({trace(130, 230, 22, 1.0)}, 1.0, 1.0);
  std::vector<Curtain> curtains = m.map->curtains;
  std::vector<CurtainPoint>& points = curtains.front().points;
  // Half of it with nine times the flux and 8 keV, the rest with 2 keV: a mean of exp(0.9 ln 8 + 0.1 ln 2).
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].flux_mw_m2.value = i % 2 == 0 ? 9.0 : 1.0;
    points[i].energy_kev = {i % 2 == 0 ? 8.0 : 2.0, 0.5};
  }
  points.pop_back();  // as many of both
  Curtain elsewhere = curtains.front();
  for (CurtainPoint& p : elsewhere.points) {
    p.azimuth_deg = std::fmod(p.azimuth_deg + 180.0, 360.0);
    p.flux_mw_m2.value = 1000.0;
  }
  curtains.insert(curtains.begin(), elsewhere);
  const auto c = main_curtain(m.map->result, curtains, m.border->traces.front(), *m.border_scene);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->curtain, 1u);
  EXPECT_TRUE(c->is_along_border);
  EXPECT_NEAR(c->energy_kev.value, std::exp(0.9 * std::log(8.0) + 0.1 * std::log(2.0)), 1e-6);
}

}  // namespace
}  // namespace vegard::fit::measure_answer_test
