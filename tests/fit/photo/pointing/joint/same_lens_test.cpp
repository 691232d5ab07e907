#include "fit/photo/pointing/joint/same_lens.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/star_field.h"

namespace vegard::tests::same_lens_test {
namespace {

const fit::Frame kFrame{640, 480, true};

fit::LensPicture picture_of(const fit::SkyCamera& truth, int count, std::uint64_t seed) {
  fit::LensPicture picture{"picture", truth, star_field(truth, count, 0.2, seed), {}};
  picture.used.assign(picture.stars.size(), 1);
  return picture;
}

// Seeds 21 to 23: three pictures that look three ways. Their lens is one, known better than by one of them
// (by the square root of 3 if stars are alike, here asked for 1.3), and each looks where it did.
TEST(SameLens, IsOneAndKnownBetter) {
  std::vector<fit::LensPicture> pictures;
  std::vector<fit::SkyCamera> truths;
  for (int i = 0; i < 3; ++i) {
    truths.push_back(known_camera(sim::LensModel::equidistant, 300.0, 20.0 + 40.0 * i, 50.0, 3.0 - 4.0 * i));
    pictures.push_back(picture_of(truths.back(), 40, 21 + static_cast<std::uint64_t>(i)));
  }
  fit::LensSettings settings;
  settings.model = sim::LensModel::equidistant;
  settings.form = fit::LensForm{sim::LensModel::equidistant, 0, false, false};
  const std::vector<fit::Calibration> found = fit::calibrate_same_lens(settings, pictures, kFrame, "all");
  ASSERT_EQ(found.size(), 3u);
  const fit::Calibration alone = fit::calibrate(settings, pictures[0].stars, kFrame, "one");
  const auto focal_sigma = [](const fit::Calibration& one) {
    return one.number_roots.row(fit::focal_px_number).norm();
  };
  EXPECT_LT(1.3 * focal_sigma(found[0]), focal_sigma(alone));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found[i].camera.numbers, found[0].camera.numbers);
    EXPECT_NEAR(found[i].camera.numbers[fit::focal_px_number], 300.0, 4.0 * focal_sigma(found[0]));
    const double cosine = found[i].camera.camera_from_enu.row(2).dot(truths[i].camera_from_enu.row(2));
    EXPECT_LT(std::acos(std::min(1.0, cosine)) / sim::kRadiansPerDegree,
              4.0 * found[i].line_of_sight_sigma_deg);
    EXPECT_GT(found[i].without_rms_px, found[i].rms_px);
  }
}

TEST(SameLens, IsNotThatOfAMirrorImage) {
  fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 300.0, 20.0, 50.0, 3.0);
  std::vector<fit::LensPicture> pictures = {picture_of(truth, 30, 31)};
  truth.mirrored = true;
  pictures.push_back(picture_of(truth, 30, 32));
  const std::string words = expect_error(sim::ErrorKind::unreadable_input,
                                         [&] { fit::calibrate_same_lens({}, pictures, kFrame, "all"); });
  EXPECT_TRUE(has_facts(words, "mirror"));
}

}  // namespace
}  // namespace vegard::tests::same_lens_test
