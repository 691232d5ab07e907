#include "sim/light/colours_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/random.h"
#include "tests/support/glow.h"

namespace vegard::sim::colours_profile_test {
namespace {

using Colour = std::array<double, 3>;

Colour sum_of(const std::vector<Colour>& of_line, const std::vector<double>& amounts) {
  Colour sum{};
  for (std::size_t l = 0; l < of_line.size(); ++l)
    for (int c = 0; c < 3; ++c) sum[c] += amounts[l] * of_line[l][c];
  return sum;
}

double distance(const Colour& a, const Colour& b) {
  return std::hypot(a[0] - b[0], std::hypot(a[1] - b[1], a[2] - b[2]));
}

const std::vector<Colour> kLines = {{1.0, -0.1, 0.02}, {-0.3, 1.0, -0.1}, {0.1, -0.05, 1.0}, {0.9, 0.5, 0.0}};

TEST(LineAmounts, MakeAColourInsideTheConeExactly) {
  for (std::uint32_t k = 0; k < 100; ++k) {
    const Words words = random_words(1, Stream::footprint, k, 2);
    std::vector<double> some(4);
    for (int l = 0; l < 4; ++l) some[l] = uniform(words[l]);
    const Colour colour = sum_of(kLines, some);
    const std::vector<double> amounts = line_amounts(kLines, colour);
    EXPECT_LT(distance(sum_of(kLines, amounts), colour), 1e-12);
    double light = 0.0, light_of_some = 0.0;
    for (int l = 0; l < 4; ++l) {
      EXPECT_GE(amounts[l], 0.0);
      light += amounts[l];
      light_of_some += some[l];
    }
    EXPECT_LE(light, light_of_some + 1e-12);
  }
}

TEST(LineAmounts, ComeAsCloseAsLightCanToOneOutside) {
  const Colour colour{-0.8, 0.2, 0.3};  // less red than any line takes away
  const std::vector<double> amounts = line_amounts(kLines, colour);
  const double reached = distance(sum_of(kLines, amounts), colour);
  EXPECT_GT(reached, 0.01);
  // No step that leaves all amounts at 0 or above brings it closer.
  for (int l = 0; l < 4; ++l)
    for (const double step : {-1e-4, 1e-4}) {
      std::vector<double> other = amounts;
      other[l] += step;
      if (other[l] < 0.0) continue;
      EXPECT_GE(distance(sum_of(kLines, other), colour), reached);
    }
}

TEST(LineAmounts, OfBlackAreNone) {
  for (const double amount : line_amounts(kLines, {0.0, 0.0, 0.0})) EXPECT_EQ(amount, 0.0);
}

TEST(ColoursProfile, KeepsTheTotalAndItsShapeAndHasTheLaddersShares) {
  const HeightProfile usual = maxwellian_profile(tests::glow(), {630.0, 557.7, 427.8}, 2.0);
  const ColourLadder ladder{{0.0, 3.0, 1.0}, {2.0, 0.0, 2.0}, 110.0, 200.0};
  const HeightProfile profile = colours_profile(usual, ladder);
  double column = 0.0, usual_column = 0.0;
  for (int l = 0; l < 3; ++l) {
    column += column_below(profile, l, 640.0).rayleigh;
    usual_column += column_below(usual, l, 640.0).rayleigh;
  }
  EXPECT_NEAR(column, usual_column, 1e-6 * usual_column);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const float* row = &profile.rate[static_cast<std::size_t>(a) * 4];
    const float* usual_row = &usual.rate[static_cast<std::size_t>(a) * 4];
    const double sum = usual_row[0] + usual_row[1] + usual_row[2];
    EXPECT_NEAR(row[0] + row[1] + row[2], sum, 1e-6 * sum);
    const double altitude = HeightProfile::altitude_km(a);
    if (altitude == 155.0) {  // half way: amounts 1, 1.5, 1.5
      EXPECT_NEAR(row[0], sum / 4.0, 1e-6 * sum);
      EXPECT_NEAR(row[1], sum * 1.5 / 4.0, 1e-6 * sum);
    }
    if (altitude <= 110.0) {
      EXPECT_NEAR(row[1], 0.75 * sum, 1e-6 * sum);
    }
    if (altitude >= 200.0) {
      EXPECT_NEAR(row[2], 0.5 * sum, 1e-6 * sum);
    }
  }
}

TEST(ColoursProfile, SlopeIsThatOfDifferences) {
  const ColourLadder ladder{{0.0, 1.0, 0.0}, {1.0, 0.0, 1.0}, 110.0, 220.0};
  const auto at = [&](double ln) {
    return colours_profile(maxwellian_profile(tests::glow(), {630.0, 557.7, 427.8}, 2.0 * std::exp(ln)),
                           ladder);
  };
  constexpr double h = 1e-2;
  const HeightProfile more = at(h), less = at(-h), here = at(0.0);
  double peak = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < here.rate.size(); ++i) {
    const double slope = here.d_rate_d_ln_energy[i];
    peak = std::max(peak, std::abs(slope));
    worst = std::max(worst, std::abs(slope - (more.rate[i] - less.rate[i]) / (2.0 * h)));
  }
  EXPECT_GT(peak, 0.0);
  // h² / 6 of a third derivative of some 50 of the first, and single precision.
  EXPECT_LT(worst, 2e-3 * peak);
}

}  // namespace
}  // namespace vegard::sim::colours_profile_test
