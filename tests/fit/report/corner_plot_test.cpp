#include "fit/report/corner_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "tests/support/small_fit.h"

namespace vegard::fit::corner_plot_test {
namespace {

struct Point {
  double x = 0.0, y = 0.0;
};

/// The points of every polyline of this colour and width, in order of drawing.
std::vector<std::vector<Point>> lines_in(const std::string& svg, const std::string& colour,
                                         const std::string& width) {
  std::vector<std::vector<Point>> lines;
  const std::regex line("<polyline[^>]*stroke=\"" + colour + "\" stroke-width=\"" + width +
                        "\"[^>]*points=\"([^\"]*)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), line), end; it != end; ++it) {
    std::istringstream list((*it)[1].str());
    std::vector<Point> points;
    Point p;
    for (char comma; list >> p.x >> comma >> p.y;) points.push_back(p);
    lines.push_back(points);
  }
  return lines;
}

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Parameters p0, p1, ... with sigma 1, 2, ...; neighbours correlated by r.
CornerData chain_of(int n, double r) {
  CornerData data;
  for (int j = 0; j < n; ++j) {
    data.parameters.push_back({"p" + std::to_string(j), "km", 10.0 * j, 1.0 + j});
    data.correlation.emplace_back();
    for (int k = 0; k < n; ++k)
      data.correlation.back().push_back(j == k ? 1.0 : std::abs(j - k) == 1 ? r : 0.0);
  }
  return data;
}

// chi2 = zᵀ R⁻¹ z of every point of the ellipses, drawn to two decimals of a pixel: 4 on the outer, 1 on the
// inner.
TEST(CornerPlot, DrawsEllipsesOfTheCovariance) {
  const double r = -0.8;
  const std::string svg = corner_plot_svg(chain_of(2, r));
  const auto ellipses = lines_in(svg, "#0072b2", "1.2");
  ASSERT_EQ(ellipses.size(), 2u);
  const double cell = 210.0, px = cell / (2.0 * 2.8);  // pixels to a sigma: 2.8 are shown to either side
  for (int e = 0; e < 2; ++e) {
    double mean_x = 0.0, mean_y = 0.0;
    for (std::size_t i = 1; i < ellipses[e].size(); ++i) {
      mean_x += ellipses[e][i].x / static_cast<double>(ellipses[e].size() - 1);
      mean_y += ellipses[e][i].y / static_cast<double>(ellipses[e].size() - 1);
    }
    for (const Point& p : ellipses[e]) {
      const double a = (p.x - mean_x) / px, b = -(p.y - mean_y) / px;
      EXPECT_NEAR((a * a - 2.0 * r * a * b + b * b) / (1.0 - r * r), e == 0 ? 4.0 : 1.0, 0.01);
    }
  }
  EXPECT_NE(svg.find(">\u22120.80<"), std::string::npos);
}

TEST(CornerPlot, HasOnePanelForEveryPair) {
  const std::string svg = corner_plot_svg(chain_of(7, 0.3));
  EXPECT_EQ(lines_in(svg, "#0072b2", "1.2").size(), 2u * 21u);
  EXPECT_EQ(lines_in(svg, "#0072b2", "1.5").size(), 7u);
  EXPECT_EQ(count(svg, "\u22120.00"), 0);
  EXPECT_EQ(count(svg, "id=\""), 0);
  EXPECT_EQ(svg, corner_plot_svg(chain_of(7, 0.3)));
  EXPECT_TRUE(corner_plot_svg(chain_of(1, 0.0)).empty());
}

TEST(CornerPlot, OfManyShowsTheMostCorrelatedAndSaysSo) {
  CornerData data = chain_of(14, 0.2);
  for (const auto& [j, k] : {std::pair(3, 12), std::pair(0, 5)})
    data.correlation[j][k] = data.correlation[k][j] = 0.95;
  EXPECT_EQ(most_correlated(data, 4), (std::vector<std::size_t>{0, 3, 5, 12}));
  const std::string svg = corner_plot_svg(data);
  EXPECT_EQ(lines_in(svg, "#0072b2", "1.2").size(), 2u * 45u);
  EXPECT_NE(svg.find("10 of 14 parameters"), std::string::npos);
}

// The histogram and the normal curve are densities on one scale: of samples spread evenly over
// √12 sigma the bars are 1/√12 high where the curve's peak is 1/√(2 π), whatever the unit.
TEST(CornerPlot, ShowsTheChainOnTheCurvesScale) {
  CornerData data = chain_of(2, 0.0);
  constexpr int kSamples = 4800;
  for (int i = 0; i < kSamples; ++i) {
    const double t = std::sqrt(12.0) * ((i + 0.5) / kSamples - 0.5);
    data.samples.insert(data.samples.end(), {t, 10.0 + 2.0 * t});
  }
  const std::string svg = corner_plot_svg(data);
  const std::regex area("<polygon fill=\"#d55e00\"[^>]*points=\"([^\"]*)\"");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(svg, match, area));
  std::istringstream list(match[1].str());
  double top = 1e9, bottom = 0.0;
  Point p;
  for (char comma; list >> p.x >> comma >> p.y;) {
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
  double peak = 1e9;
  const auto curves = lines_in(svg, "#0072b2", "1.5");
  for (const Point& q : curves.at(0)) peak = std::min(peak, q.y);
  EXPECT_NEAR((bottom - top) / (bottom - peak), std::sqrt(2.0 * std::acos(-1.0) / 12.0), 0.01);
  EXPECT_GT(count(svg, "fill=\"#d55e00\"/>"), 1000);  // dots
  EXPECT_NE(svg.find("of the chain"), std::string::npos);
}

TEST(CornerData, LeavesOutWhatHasNoWidth) {
  FitResult result = tests::small_fit(tests::small_photo());
  const CornerData data = corner_data(result);
  ASSERT_EQ(data.parameters.size(), 1u);
  EXPECT_EQ(data.parameters[0].name, "energy_kev");
  EXPECT_EQ(data.left_out, (std::vector<std::string>{"phase_rad"}));
  EXPECT_TRUE(corner_plot_svg(data).empty());
  // A chain gives the other one a width too.
  result.chain.emplace();
  result.chain->sigma = {0.2, 0.1};
  result.chain->samples = {4.1, 0.2, 4.2, 0.3, 4.5, 0.4};
  const CornerData with_chain = corner_data(result);
  ASSERT_EQ(with_chain.parameters.size(), 2u);
  EXPECT_EQ(with_chain.samples, result.chain->samples);
  EXPECT_EQ(corner_plot_svg(with_chain).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::corner_plot_test
