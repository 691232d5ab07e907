// Vertical profiles of a frame: numbers of a picture whose light is known row by row.
#include "fit/survey/survey_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/photo/photo.h"
#include "fit/survey/survey_export.h"
#include "sim/base/error.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit::profile_work_test {
namespace {

constexpr int kWidth = 50, kHeight = 200;
constexpr double kPeakRow = 120.3, kSigma_px = 12.0, kDark = 0.02, kBright = 0.3;

sim::Scene scene_of_picture() {
  sim::Scene scene;
  scene.camera.width = kWidth;
  scene.camera.height = kHeight;
  scene.camera.elevation_deg = 25.0;
  return scene;
}

/// A layer of a Gaussian's shape across rows, red a third of green, no blue; a step of noise from pixel to
/// pixel, without which nothing tells errors.
Photo layer(double bright = kBright) {
  Photo photo;
  photo.linear = sim::Image(kWidth, kHeight, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.bits = 16;
  for (int y = 0; y < kHeight; ++y) {
    const double of_row = bright * std::exp(-0.5 * std::pow((y - kPeakRow) / kSigma_px, 2));
    for (int x = 0; x < kWidth; ++x) {
      const double noise = 1e-3 * ((7 * x + 3 * y) % 5 - 2);
      float* pixel = &photo.linear.data[static_cast<std::size_t>(y * kWidth + x) * 3];
      pixel[0] = static_cast<float>(kDark + of_row / 3.0 + noise);
      pixel[1] = static_cast<float>(kDark + of_row + noise);
      pixel[2] = static_cast<float>(kDark + noise);
    }
  }
  return photo;
}

const SurveyQuantity* find(const WorkAnswer& answer, int item, const std::string& name) {
  const auto found = std::find_if(answer.quantities.begin(), answer.quantities.end(),
                                  [&](const auto& q) { return q.item == item && q.name == name; });
  return found == answer.quantities.end() ? nullptr : &*found;
}

double value(const WorkAnswer& answer, int item, const std::string& name) {
  const SurveyQuantity* found = find(answer, item, name);
  return found != nullptr && found->value ? *found->value : std::nan("");
}

TEST(ProfileWork, TellsAltitudeThicknessAndColourOfALayer) {
  const sim::Scene scene = scene_of_picture();
  const WorkAnswer answer = profile_answer(layer(), scene, 1);
  EXPECT_EQ(answer.verdict, "good");
  for (int strip = 1; strip <= kSurveyStrips; ++strip) {
    const double middle_px = (strip - 0.5) * kWidth / kSurveyStrips;
    const auto elevation = [&](double row) {
      return sim::direction_of_pixel(scene.camera, middle_px, row + 0.5).elevation_deg;
    };
    const double pixel_deg = std::abs(elevation(kPeakRow) - elevation(kPeakRow + 1.0));
    // The parabola through rows of a Gaussian 12 rows wide is off by less than a hundredth of a row; the
    // noise of means over 10 pixels and some rows, 2e-4, moves a peak of that bend by a tenth of a row.
    EXPECT_NEAR(value(answer, strip, "elevation of the brightest place"), elevation(kPeakRow),
                0.2 * pixel_deg);
    // Smoothed by two rows: sqrt(12² + 2²) wide, and so much lower.
    const double wide_px = std::hypot(kSigma_px, 2.0), half_px = wide_px * std::sqrt(2.0 * std::log(2.0));
    EXPECT_NEAR(value(answer, strip, "half-width below"), elevation(kPeakRow) - elevation(kPeakRow + half_px),
                0.2 * pixel_deg);
    EXPECT_NEAR(value(answer, strip, "half-width above"), elevation(kPeakRow - half_px) - elevation(kPeakRow),
                0.2 * pixel_deg);
    EXPECT_NEAR(value(answer, strip, "brightness"), kDark + kBright * kSigma_px / wide_px, 1e-3);
    EXPECT_NEAR(value(answer, strip, "darkest brightness"), kDark, 1e-3);
    EXPECT_NEAR(value(answer, strip, "red over green"), 1.0 / 3.0, 0.005);
    EXPECT_NEAR(value(answer, strip, "blue over green"), 0.0, 0.005);
    ASSERT_NE(find(answer, strip, "brightness"), nullptr);
    EXPECT_GT(find(answer, strip, "brightness")->sigma.value_or(0.0), 0.0);
  }
}

TEST(ProfileWork, SaysWhereTheLightLeavesWhatIsKnown) {
  Photo photo = layer();
  // A roof that a mask takes away, from the brightest rows on downwards.
  for (int y = static_cast<int>(kPeakRow) + 4; y < kHeight; ++y)
    std::fill_n(photo.usable.begin() + static_cast<std::ptrdiff_t>(y) * kWidth * 3, kWidth * 3, 0);
  const WorkAnswer answer = profile_answer(photo, scene_of_picture(), 1);
  const SurveyQuantity* below = find(answer, 1, "half-width below");
  ASSERT_NE(below, nullptr);
  EXPECT_FALSE(below->value);
  EXPECT_TRUE(below->reason);
  EXPECT_TRUE(std::isfinite(value(answer, 1, "half-width above")));
}

TEST(ProfileWork, OfADarkFrameTellsNothing) {
  const WorkAnswer answer = profile_answer(layer(0.0), scene_of_picture(), 1);
  EXPECT_EQ(answer.verdict, "none");
  EXPECT_TRUE(answer.quantities.empty());
}

TEST(ProfileWork, OfTheMiddleStripStandsInTables) {
  const WorkAnswer answer = profile_answer(layer(), scene_of_picture(), 1);
  const SurveyQuantity* shown = quantity_in(&answer, {SurveyWork::profile, "brightness", "white"});
  ASSERT_NE(shown, nullptr);
  EXPECT_EQ(shown->item, 3);
}

TEST(ProfileWork, OfAnotherSizeIsRefused) {
  sim::Scene scene = scene_of_picture();
  scene.camera.width = 60;
  EXPECT_THROW(profile_answer(layer(), scene, 1), sim::Error);
}

}  // namespace
}  // namespace vegard::fit::profile_work_test
