#include "sim/view/colour/colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/support/kind_named.h"

namespace vegard::sim::colour_test {
namespace {

TEST(Colour, LinesHaveTheirSmpteCValues) {
  // docs/optics.md row B24, to three digits behind the point.
  const auto expect = [](double nm, double r, double g, double b) {
    const Vector3 rgb = rgb_of_line(nm, Primaries::smpte_c);
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
  for (const char* primaries : {"srgb", "smpte-c", "rec2020", "acescg"})
    for (double channel : product(rgb_from_xyz(tests::kind_named<Primaries>(primaries)), white))
      EXPECT_NEAR(channel, 1.0, 1e-12) << primaries;
}

TEST(Colour, SrgbMatrixIsThatOfTheStandard) {
  // IEC 61966-2-1, four digits.
  const Matrix3 m = rgb_from_xyz(Primaries::srgb);
  const Matrix3 standard = {
      {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}}};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(m[r][c], standard[r][c], 6e-4);
}

TEST(Colour, OtherPrimariesAreThoseOfTheirStandards) {
  // ITU-R BT.2087-0 (BT.709 to BT.2020) and the Academy's matrix from BT.709 to ACEScg (AP1) with Bradford,
  // four digits each.
  const auto expect = [](const char* primaries, const Matrix3& published) {
    const Matrix3 m = product(rgb_from_xyz(tests::kind_named<Primaries>(primaries)),
                              inverse(rgb_from_xyz(Primaries::srgb)));
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(m[r][c], published[r][c], 6e-5) << primaries << r << c;
  };
  expect("rec2020", {{{0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0114}, {0.0164, 0.0880, 0.8956}}});
  expect("acescg", {{{0.6131, 0.3395, 0.0474}, {0.0702, 0.9164, 0.0135}, {0.0206, 0.1096, 0.8698}}});
}

/// A row of the CIE's own table at 1 nm (CIE 018:2019, doi:10.25039/CIE.DS.xvudnb9b), X, Y and Z.
struct Row {
  double nm;
  Vector3 xyz;
};

TEST(ColourMatching, SplinesMeetTheTableAtOneNanometre) {
  const Row rows[] = {
      {403, {0.01878122, 0.000517876, 0.08915364}}, {408, {0.03388092, 0.00094116, 0.1613035}},
      {417, {0.09717672, 0.002764, 0.4654642}},     {427, {0.2448797, 0.00890872, 1.1884971}},
      {428, {0.2587773, 0.00976768, 1.2581233}},    {443, {0.350013, 0.02695857, 1.7762637}},
      {457, {0.308884, 0.05257304, 1.7208581}},     {478, {0.1132752, 0.1279928, 0.9014531}},
      {493, {0.020687, 0.2368571, 0.3938822}},      {518, {0.04798504, 0.6708752, 0.08998272}},
      {533, {0.2011694, 0.8954936, 0.03445836}},    {557, {0.5446916, 0.9993046, 0.0048998}},
      {558, {0.5612094, 0.9983255, 0.0045342}},     {573, {0.8109264, 0.9311628, 0.0018898}},
      {588, {1.0090892, 0.781192, 0.001205}},       {603, {1.0552244, 0.5924756, 0.00068592}},
      {636, {0.5225995, 0.2081616, 2.765333e-5}},   {652, {0.2561184, 0.09618864, 0.0}}};
  const Vector3 largest = {1.0622, 1.0, 1.78297};  // of each function
  double worst = 0.0;
  for (const Row& row : rows)
    for (int i = 0; i < 3; ++i)
      worst = std::max(worst, std::abs(colour_matching(row.nm)[i] - row.xyz[i]) / largest[i]);
  std::printf("largest departure from the table at 1 nm: %.1e of a function's maximum\n", worst);
  EXPECT_LT(worst, 1e-3) << "the CIE's own interpolation is no spline: a thousandth";
}

/// x and y of light.
std::array<double, 2> chromaticity(const Vector3& xyz) {
  const double sum = xyz[0] + xyz[1] + xyz[2];
  return {xyz[0] / sum, xyz[1] / sum};
}

TEST(ColourMatching, LinesHaveTheSpectralLocusesChromaticities) {
  // Where the CIE tabulates the locus (CIE 15, table at 5 nm).
  const struct {
    double nm, x, y;
  } tabulated[] = {{425.0, 0.1703, 0.0058}, {430.0, 0.1689, 0.0069}, {520.0, 0.0743, 0.8338},
                   {555.0, 0.3373, 0.6589}, {560.0, 0.3731, 0.6245}, {630.0, 0.7079, 0.2920}};
  for (const auto& point : tabulated) {
    const auto [x, y] = chromaticity(colour_matching(point.nm));
    EXPECT_NEAR(x, point.x, 1e-4) << point.nm;
    EXPECT_NEAR(y, point.y, 1e-4) << point.nm;
  }
  // Lines between: linear in the CIE's table at 1 nm, as CIE 15 has it.
  const struct {
    double nm;
    Vector3 below, above;
  } lines[] = {{391.4, {0.004762389, 0.000134984, 0.02251136}, {0.005330048, 0.000151492, 0.02520288}},
               {427.8, {0.2448797, 0.00890872, 1.1884971}, {0.2587773, 0.00976768, 1.2581233}},
               {557.7, {0.5446916, 0.9993046, 0.0048998}, {0.5612094, 0.9983255, 0.0045342}},
               {636.4, {0.5225995, 0.2081616, 2.765333e-5}, {0.5035464, 0.1995488, 2.556e-5}}};
  for (const auto& line : lines) {
    const double t = line.nm - std::floor(line.nm);
    Vector3 xyz;
    for (int i = 0; i < 3; ++i) xyz[i] = (1.0 - t) * line.below[i] + t * line.above[i];
    const auto [x, y] = chromaticity(colour_matching(line.nm));
    const auto [cited_x, cited_y] = chromaticity(xyz);
    std::printf("%.1f nm: x %.5f y %.5f, by the table at 1 nm %.5f %.5f\n", line.nm, x, y, cited_x, cited_y);
    EXPECT_NEAR(x, cited_x, 1e-4) << line.nm;
    EXPECT_NEAR(y, cited_y, 1e-4) << line.nm;
  }
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
}  // namespace vegard::sim::colour_test
