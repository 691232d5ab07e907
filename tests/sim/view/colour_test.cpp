#include "sim/view/colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim {
namespace {

Vector3 times(const Matrix3& m, const Vector3& v) {
  Vector3 r{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i] += m[i][j] * v[j];
  return r;
}

TEST(Colour, LinesHaveTheirSmpteCValues) {
  // docs/physics.md row B24, to three digits behind the point.
  const auto expect = [](double nm, double r, double g, double b) {
    const Vector3 rgb = rgb_of_line(nm, "smpte-c");
    EXPECT_NEAR(rgb[0], r, 6e-4) << nm;
    EXPECT_NEAR(rgb[1], g, 6e-4) << nm;
    EXPECT_NEAR(rgb[2], b, 6e-4) << nm;
  };
  expect(630.0, 1.791, -0.163, -0.016);
  expect(557.7, 0.210, 1.381, -0.161);
  expect(427.8, 0.204, -0.211, 1.320);
}

TEST(Colour, WhiteD65IsEqualRgb) {
  const Vector3 white = {0.3127 / 0.3290, 1.0, (1.0 - 0.3127 - 0.3290) / 0.3290};
  for (const char* primaries : {"srgb", "smpte-c"})
    for (double channel : times(rgb_from_xyz(primaries), white))
      EXPECT_NEAR(channel, 1.0, 1e-12) << primaries;
}

TEST(Colour, SrgbMatrixIsThatOfTheStandard) {
  // IEC 61966-2-1, four digits.
  const Matrix3 m = rgb_from_xyz("srgb");
  const Matrix3 standard = {
      {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}}};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(m[r][c], standard[r][c], 6e-4);
}

TEST(ColourMatching, EqualEnergyIsEqualXyz) {
  Vector3 sum{};
  for (int nm = 380; nm <= 780; nm += 5)
    for (int i = 0; i < 3; ++i) sum[i] += colour_matching(nm)[i];
  // The sums of the standard's 5 nm table: 21.371 each.
  EXPECT_NEAR(sum[1], 21.371, 2e-3);
  EXPECT_NEAR(sum[0] / sum[1], 1.0, 5e-4);
  EXPECT_NEAR(sum[2] / sum[1], 1.0, 5e-4);
}

TEST(ColourMatching, IsZeroOutsideTheTableAndSmoothInside) {
  EXPECT_EQ(colour_matching(337.1), (Vector3{0.0, 0.0, 0.0}));
  EXPECT_EQ(colour_matching(844.6), (Vector3{0.0, 0.0, 0.0}));
  EXPECT_NEAR(colour_matching(555.0)[1], 1.0, 1e-3);
  EXPECT_NEAR(colour_matching(557.5)[1], 0.5 * (colour_matching(555)[1] + colour_matching(560)[1]), 2e-3);
}

TEST(RgbPerKilorayleigh, CountsPhotonsAndGreenHasTheGainsLuminance) {
  const std::vector<double> lines = {630.0, 557.7, 427.8};
  const std::vector<Vector3> weights = rgb_per_kilorayleigh(lines, "srgb", 0.05);
  // BT.709 luminance of 1 kR of green.
  EXPECT_NEAR(0.2126 * weights[1][0] + 0.7152 * weights[1][1] + 0.0722 * weights[1][2], 0.05, 2e-5);
  // A photon's energy falls with its wavelength.
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const Vector3 power = rgb_of_line(lines[l], "srgb");
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(weights[l][c] / weights[1][1], power[c] / rgb_of_line(557.7, "srgb")[1] * 557.7 / lines[l],
                  1e-12);
  }
}

TEST(RgbFromRayleigh, AddsTheLinesAndKeepsSigns) {
  Image rayleigh(2, 1, {"6300", "5577"});
  rayleigh.at(1, 0, 0) = 2000.0f;
  rayleigh.at(1, 0, 1) = 500.0f;
  const Image rgb = rgb_from_rayleigh(rayleigh, {{1.0, -0.25, 0.0}, {0.5, 2.0, -1.0}});
  EXPECT_EQ(rgb.at(0, 0, 0), 0.0f);
  EXPECT_FLOAT_EQ(rgb.at(1, 0, 0), 2.25f);
  EXPECT_FLOAT_EQ(rgb.at(1, 0, 1), 0.5f);
  EXPECT_FLOAT_EQ(rgb.at(1, 0, 2), -0.5f);
}

}  // namespace
}  // namespace vegard::sim
