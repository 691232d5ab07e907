#include "fit/photo/pointing/chance_agreement.h"

#include <gtest/gtest.h>

#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/star_field.h"

namespace vegard::tests::chance_agreement_test {
namespace {

const fit::Frame kFrame{640, 480, true};

// P(X >= 5) of a mean of 1 is 1 - (1 + 1 + 1/2 + 1/6 + 1/24) / e = 0.0036598; the geometric series that
// bounds the rest of the sum is 2 % larger at most.
TEST(ChanceAgreement, HasTheTailOfPoisson) {
  EXPECT_NEAR(fit::log10_poisson_tail(5.0, 1.0), std::log10(0.0036598), 0.01);
  EXPECT_EQ(fit::log10_poisson_tail(1.0, 2.0), 0.0);
}

class UnderACamera : public testing::Test {
 protected:
  UnderACamera()
      : camera(known_camera(sim::LensModel::equisolid, 160.0, 0.0, 88.5, 170.0)),
        sky(fit::catalogue_sky({69.6, 19.2, 100.0, true}, *sim::julian_date("2014-02-21T19:30:40Z"), 4.0)) {}

  /// Points at the stars that `is_seen` says of, by their place among those that should be seen.
  template <class IsSeen>
  fit::ChanceAgreement seen(const IsSeen& is_seen) const {
    const std::vector<fit::ExpectedStar> expected = fit::expected_stars(camera, kFrame, sky);
    std::vector<fit::FoundStar> points;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      fit::FoundStar point;
      point.x_px = expected[i].x;
      point.y_px = expected[i].y;
      if (is_seen(i, expected.size())) points.push_back(point);
    }
    return fit::agreement_against_chance(camera, kFrame, sky, points,
                                         fit::PointCells(points, kFrame, points.size()), 5.0, 1e5);
  }

  fit::SkyCamera camera;
  std::vector<fit::StarSighting> sky;
};

// As many points, once at each second star and once at the faint half alone: clouds do not choose.
TEST_F(UnderACamera, FaintStarsWithoutBrightOnesAreNone) {
  EXPECT_TRUE(fit::is_no_chance(seen([](std::size_t i, std::size_t) { return i % 2 == 0; })));
  EXPECT_FALSE(fit::is_no_chance(seen([](std::size_t i, std::size_t n) { return 2 * i >= n; })));
}

TEST_F(UnderACamera, StarsBehindAMaskAreNotMissed) {
  std::vector<char> usable(640 * 480, 1);
  std::fill(usable.begin(), usable.begin() + 640 * 240, 0);
  const fit::SkyPixels pixels(usable);
  EXPECT_DOUBLE_EQ(pixels.share, 0.5);
  for (const fit::ExpectedStar& star : fit::expected_stars(camera, kFrame, sky, pixels))
    EXPECT_GE(star.y, 240.0);
}

}  // namespace
}  // namespace vegard::tests::chance_agreement_test
