#include "fit/answer/photo_line_ratio.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/view/colour/line_colours.h"
#include "tests/support/small_fit.h"

namespace vegard::fit::photo_line_ratio_test {
namespace {

/// A photograph with so many kilorayleighs of each line in all bins, above the answer's sky.
FitResult lit_by(const std::vector<double>& kilorayleigh) {
  FitResult result = tests::small_fit(tests::small_photo());
  FittedPhoto& photo = result.photos[0];
  photo.best.sky = {};
  const std::vector<sim::Vector3> colours = sim::line_colours(photo.best);
  for (int band = 0; band < photo.data.bands; ++band)
    for (int row = 0; row < photo.data.rows; ++row)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = photo.data.index(band, row, c);
        photo.data.mean[i] = photo.model[i] = 0.0;
        for (std::size_t l = 0; l < colours.size(); ++l)
          photo.data.mean[i] += kilorayleigh[l] * colours[l][c];
        photo.model[i] = photo.data.mean[i];
        photo.data.standard_error[i] = 1e-3;
        photo.sigma[i] = 1e-3;
      }
  photo.solved.clear();
  return result;
}

const DerivedNumber& number(const std::vector<DerivedNumber>& all, const std::string& name) {
  for (const DerivedNumber& d : all)
    if (d.name == name) return d;
  ADD_FAILURE() << "no " << name;
  return all.front();
}

TEST(PhotoLineRatios, AreThoseOfTheLightAndAlikeInTheModel) {
  FitResult result = lit_by({1.5, 6.0, 1.2});  // 630.0, 557.7, 427.8 nm
  const auto ratios = photo_line_ratios(result);
  ASSERT_EQ(ratios.size(), 4u);
  EXPECT_NEAR(number(ratios, "I(630.0)/I(557.7) in the photograph").value, 0.25, 1e-9);
  EXPECT_NEAR(number(ratios, "I(427.8)/I(557.7) in the photograph").value, 0.2, 1e-9);
  EXPECT_NEAR(number(ratios, "I(427.8)/I(557.7) in the model's picture").value, 0.2, 1e-9);
  // Another gain, the same ratios.
  result.photos[0].best.sensor.gain_per_kilorayleigh *= 3.0;
  EXPECT_NEAR(number(photo_line_ratios(result), "I(630.0)/I(557.7) in the photograph").value, 0.25, 1e-9);
}

TEST(PhotoLineRatios, ErrorIsWhatNoiseInTheChannelsDoes) {
  // Lines are linear in the channels, so that the slopes by a channel's sum over all bins follow by moving
  // one.
  FitResult result = lit_by({1.5, 6.0, 1.2});
  const std::string name = "I(630.0)/I(557.7) in the photograph";
  const double ratio = number(photo_line_ratios(result), name).value;
  const auto bins = static_cast<double>(result.photos[0].data.mean.size() / 3);
  double variance = 0.0;
  for (int c = 0; c < 3; ++c) {
    constexpr double kMove = 1e-5;
    FitResult moved = result;
    for (std::size_t i = c; i < moved.photos[0].data.mean.size(); i += 3)
      moved.photos[0].data.mean[i] += kMove;
    const double slope = (number(photo_line_ratios(moved), name).value - ratio) / kMove;
    variance += slope * slope * 1e-6 / bins;  // of the channel's mean over all bins
  }
  EXPECT_NEAR(number(photo_line_ratios(result), name).sigma.value(),
              result.error_inflation * std::sqrt(variance), 1e-3 * std::sqrt(variance));
}

TEST(PhotoLineRatios, KnowHowSureTheSkyIs) {
  FitResult result = lit_by({1.5, 6.0, 1.2});
  const std::string name = "I(630.0)/I(557.7) in the photograph";
  const double without = *number(photo_line_ratios(result), name).sigma;
  result.photos[0].solved = {{"sky.level.red", 0.0, 0.01}};
  EXPECT_GT(*number(photo_line_ratios(result), name).sigma, without);
}

TEST(PhotoLineRatios, AreMissingWithAReason) {
  FitResult result = lit_by({1.5, 6.0, 1.2});
  result.photos[0].best.fit.white_balance_known = false;
  const DerivedNumber none = photo_line_ratios(result).at(0);
  EXPECT_TRUE(std::isnan(none.value));
  EXPECT_FALSE(none.sigma);
  EXPECT_NE(none.why_none.find("gain"), std::string::npos);
  result = lit_by({1.5, 6.0, 1.2});
  result.photos[0].best.emission.lines = {557.7};
  EXPECT_TRUE(photo_line_ratios(result).empty());
}

}  // namespace
}  // namespace vegard::fit::photo_line_ratio_test
