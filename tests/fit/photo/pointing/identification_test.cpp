#include "fit/photo/pointing/identification.h"

#include <gtest/gtest.h>

#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/lens_form.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/star_field.h"

namespace vegard::tests::identification_test {
namespace {

const fit::Frame kFrame{640, 480, true};

/// What a finder would give of the real sky: stars with noise, some of them missing, and points that are
/// none.
std::vector<fit::FoundStar> points_of(const fit::SkyCamera& camera, const std::vector<fit::StarSighting>& sky,
                                      double noise_px, int strewn) {
  std::vector<fit::FoundStar> points;
  for (std::uint32_t i = 0; i < sky.size(); ++i) {
    fit::FoundStar point;
    if (i % 5 == 3 || !fit::place_of_star(camera, sky[i].enu, point.x_px, point.y_px)) continue;
    if (point.x_px < 0.0 || point.y_px < 0.0 || point.x_px > 640.0 || point.y_px > 480.0) continue;
    point.x_px += noise_px * normal(3, i, 1);
    point.y_px += noise_px * normal(3, i, 2);
    points.push_back(point);
  }
  for (int i = 0; i < strewn; ++i) {
    const sim::Words words = sim::random_words(4, sim::Stream::stars, i);
    fit::FoundStar point;
    point.x_px = 640.0 * sim::uniform(words[0]);
    point.y_px = 480.0 * sim::uniform(words[1]);
    points.push_back(point);
  }
  return points;
}

class RealSky : public testing::Test {
 protected:
  RealSky()
      : truth(known_camera(sim::LensModel::equisolid, 160.0, 0.0, 88.5, 170.0)),
        sky(fit::catalogue_sky({69.6, 19.2, 100.0, true}, *sim::julian_date("2014-02-21T19:30:40Z"), 4.0)) {}
  fit::SkyCamera truth;
  std::vector<fit::StarSighting> sky;

  void expect_found(const fit::SkyCamera& rough, fit::IdentificationSettings settings) const {
    const auto points = points_of(truth, sky, 0.2, 60);
    settings.free = fit::free_numbers({sim::LensModel::equisolid, 0, false, false}, true);
    const fit::Identification found = fit::identify(rough, kFrame, sky, points, settings);
    int right = 0;
    for (const fit::StarSighting& star : found.stars) {
      double x = 0.0, y = 0.0;
      ASSERT_TRUE(fit::place_of_star(truth, star.enu, x, y));
      right += std::hypot(star.x_px - x, star.y_px - y) < 1.5;
    }
    // Four fifths of the stars in the frame have a point; a few of the strewn ones lie near the others.
    EXPECT_GE(right, static_cast<int>(0.75 * found.in_frame));
    EXPECT_TRUE(fit::is_trustworthy(found));
    EXPECT_LE(static_cast<int>(found.stars.size()) - right, 2 + static_cast<int>(found.by_chance));
  }
};

TEST_F(RealSky, GrowsFromARoughCamera) {
  fit::SkyCamera rough = truth;
  rough.camera_from_enu = fit::rotation_of(0.0, 87.5, 172.5);
  rough.numbers[fit::focal_px_number] = 163.0;
  rough.numbers[fit::centre_x_number] += 5.0;
  expect_found(rough, {});
}

TEST_F(RealSky, FindsTheTurnThatNobodyKnows) {
  fit::SkyCamera rough = truth;
  rough.camera_from_enu = fit::rotation_of(0.0, 90.0, -63.0);
  fit::IdentificationSettings settings;
  settings.twist_deg = 180.0;
  settings.shift_px = 2.5;
  expect_found(rough, settings);
}

TEST_F(RealSky, FindsItsScaleToo) {
  fit::SkyCamera rough = truth;
  rough.camera_from_enu = fit::rotation_of(0.0, 89.0, 174.0);
  rough.numbers[fit::focal_px_number] = 178.0;
  fit::IdentificationSettings settings;
  settings.twist_deg = 6.0;
  settings.shift_px = 5.0;
  settings.scale_share = 0.12;
  expect_found(rough, settings);
}

// Points strewn at random are nobody's stars, however long one searches.
TEST_F(RealSky, DoesNotTrustAnAccident) {
  std::vector<fit::FoundStar> points = points_of(truth, {}, 0.0, 150);
  fit::IdentificationSettings settings;
  settings.twist_deg = 90.0;
  settings.shift_px = 5.0;
  settings.free = fit::free_numbers({sim::LensModel::equisolid, 0, false, false}, true);
  EXPECT_FALSE(fit::is_trustworthy(fit::identify(truth, kFrame, sky, points, settings)));
}

TEST(CatalogueSky, IsAboveAndApart) {
  const auto sky = fit::catalogue_sky({69.6, 19.2, 100.0, true}, *sim::julian_date("2014-02-21T19:30:40Z"),
                                      4.0, 10.0, 1.0);
  ASSERT_GT(sky.size(), 100u);
  for (std::size_t i = 0; i < sky.size(); ++i) {
    EXPECT_GE(sky[i].enu[2], std::sin(10.0 * sim::kRadiansPerDegree));
    EXPECT_LE(sky[i].magnitude, 4.0);
    for (std::size_t j = 0; j < i; ++j) {
      double cosine = 0.0;
      for (int k = 0; k < 3; ++k) cosine += sky[i].enu[k] * sky[j].enu[k];
      EXPECT_LT(cosine, std::cos(1.0 * sim::kRadiansPerDegree));
    }
  }
}

// A wide field has enough stars to magnitude 4; a field of 12 degrees needs fainter ones, and gets no more
// than there are.
TEST(FaintestForField, IsDeeperInNarrowFields) {
  const std::vector<fit::StarSighting> sky = fit::catalogue_sky({69.7, 18.8, 100.0, true}, 2459000.5, 6.0);
  const auto shown = [&](const fit::SkyCamera& camera, double faintest) {
    int n = 0;
    for (const fit::ExpectedStar& one : fit::expected_stars(camera, kFrame, sky))
      n += sky[static_cast<std::size_t>(one.star)].magnitude <= faintest;
    return n;
  };
  const fit::SkyCamera wide = known_camera(sim::LensModel::equidistant, 250.0, 120.0, 60.0, 0.0);
  EXPECT_EQ(fit::faintest_for_field(wide, kFrame, sky, 4.0), 4.0);
  const fit::SkyCamera narrow = known_camera(sim::LensModel::pinhole, 1500.0, 120.0, 60.0, 0.0);
  const double deeper = fit::faintest_for_field(narrow, kFrame, sky, 4.0, 12);
  EXPECT_GT(deeper, 4.0);
  EXPECT_EQ(shown(narrow, deeper), 12);
  EXPECT_EQ(shown(narrow, fit::faintest_for_field(narrow, kFrame, sky, 4.0, 1000)), shown(narrow, 6.0));
}

}  // namespace
}  // namespace vegard::tests::identification_test
