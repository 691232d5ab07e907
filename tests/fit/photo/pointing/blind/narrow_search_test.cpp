#include "fit/photo/pointing/blind/narrow_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::tests::narrow_search_test {
namespace {

const fit::Frame kFrame = {1200, 800, true};

fit::FoundStar strewn(std::uint64_t seed, std::uint32_t i) {
  const sim::Words words = sim::random_words(seed, sim::Stream::stars, i);
  fit::FoundStar point;
  point.x_px = kFrame.width_px * sim::uniform(words[0]);
  point.y_px = kFrame.height_px * sim::uniform(words[1]);
  return point;
}

/// A pinhole of so many degrees across, and the stars that it sees, each fourth missing, with as many false
/// points.
struct Field {
  fit::SkyCamera truth;
  std::vector<fit::FoundStar> points;

  Field(double fov_deg, double right_ascension_deg, double declination_deg, bool mirrored) {
    truth.model = sim::LensModel::pinhole;
    truth.mirrored = mirrored;
    truth.numbers[fit::focal_px_number] =
        0.5 * kFrame.width_px / std::tan(0.5 * fov_deg * sim::kRadiansPerDegree);
    truth.numbers[fit::centre_x_number] = 0.5 * kFrame.width_px;
    truth.numbers[fit::centre_y_number] = 0.5 * kFrame.height_px;
    truth.camera_from_enu = fit::rotation_of(90.0 - right_ascension_deg, declination_deg, 20.0);
    const std::vector<fit::ExpectedStar> seen =
        fit::expected_stars(truth, kFrame, fit::deep_equatorial_sky());
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
      fit::FoundStar point = strewn(5, i);
      if (i % 4 != 3) {
        const sim::Words words = sim::random_words(6, sim::Stream::stars, i);
        point.x_px = seen[i].x + 0.6 * (sim::uniform(words[0]) - 0.5);
        point.y_px = seen[i].y + 0.6 * (sim::uniform(words[1]) - 0.5);
      }
      points.push_back(point);
    }
  }
  Eigen::Vector3d middle() const { return truth.camera_from_enu.row(2).transpose(); }
};

bool is_right(const Field& field, const fit::SkyCamera& found) {
  const std::vector<fit::StarSighting>& sky = fit::deep_equatorial_sky();
  for (const fit::ExpectedStar& one : fit::expected_stars(field.truth, kFrame, sky)) {
    double x = 0.0, y = 0.0;
    if (!fit::place_of_star(found, sky[static_cast<std::size_t>(one.star)].enu, x, y) ||
        std::hypot(x - one.x, y - one.y) > 2.0)
      return false;
  }
  return found.mirrored == field.truth.mirrored;
}

TEST(NarrowSearch, FindsFieldsOfFiveToTwentyDegrees) {
  for (const double fov_deg : {5.0, 8.0, 13.0, 20.0})
    for (const bool mirrored : {false, true}) {
      const Field field(fov_deg, 40.0 * fov_deg, 60.0 - 8.0 * fov_deg, mirrored);
      const fit::NarrowSearch found = fit::search_narrow(field.points, kFrame, {}, std::nullopt);
      EXPECT_TRUE(found.found) << fov_deg;
      EXPECT_TRUE(is_right(field, found.best.camera)) << fov_deg;
    }
}

TEST(NarrowSearch, LeavesOutWhatIsBelowTheHorizon) {
  const Field field(8.0, 100.0, 30.0, false);
  EXPECT_TRUE(fit::search_narrow(field.points, kFrame, {}, field.middle()).found);
  EXPECT_FALSE(fit::search_narrow(field.points, kFrame, {}, Eigen::Vector3d(-field.middle())).found);
}

TEST(NarrowSearch, ClaimsNothingOfPointsStrewnAtRandom) {
  for (const std::uint32_t count : {8u, 30u, 120u}) {
    std::vector<fit::FoundStar> points;
    for (std::uint32_t i = 0; i < count; ++i) points.push_back(strewn(7 + count, i));
    EXPECT_FALSE(fit::search_narrow(points, kFrame, {}, std::nullopt).found) << count;
  }
}

// Groombridge 1830 by the Hipparcos catalogue: 11 h 52 min 58.77 s, +37 deg 43' 07.2" at J2000, 4004 and
// -5813 mas a year, V 6.42.
TEST(NarrowSearch, TheCatalogueGoesOnToMagnitudeEight) {
  const std::vector<sim::BrightStar>& stars = sim::deep_stars();
  ASSERT_EQ(stars.size(), 41411u);
  EXPECT_EQ(stars.size(), sim::kDeepStars);
  EXPECT_TRUE(std::is_sorted(stars.begin(), stars.end(),
                             [](const auto& a, const auto& b) { return a.magnitude < b.magnitude; }));
  EXPECT_EQ(stars.back().magnitude, sim::kFaintestDeep);
  EXPECT_EQ(stars[5043].hip, sim::catalogue_stars()[5043].hip);
  const auto star =
      std::find_if(stars.begin(), stars.end(), [](const auto& one) { return one.hip == 57939; });
  ASSERT_NE(star, stars.end());
  EXPECT_NEAR(star->place.j2000.right_ascension_deg, 178.24488, 3e-4);
  EXPECT_NEAR(star->place.j2000.declination_deg, 37.71867, 3e-4);
  EXPECT_NEAR(star->place.motion_ra_mas_per_year, 4004.0, 20.0);
  EXPECT_NEAR(star->place.motion_dec_mas_per_year, -5813.0, 20.0);
  EXPECT_NEAR(star->magnitude, 6.42, 0.02);
}

}  // namespace
}  // namespace vegard::tests::narrow_search_test
