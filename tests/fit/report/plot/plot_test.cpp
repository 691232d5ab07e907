#include "fit/report/plot/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

#include "fit/photo/photo.h"
#include "fit/report/plot/plot_axis.h"
#include "fit/report/plot/plot_canvas.h"
#include "fit/report/profile_plot.h"
#include "tests/support/image_bytes.h"

namespace vegard::fit::plot_test {
namespace {

using Labels = std::vector<std::string>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(AxisTicks, NiceNumbers) {
  EXPECT_EQ(axis_ticks(0.0, 1.0, 5).labels, (Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(axis_ticks(-0.013, 0.013, 3).labels, (Labels{"\u22120.01", "0.00", "0.01"}));
  EXPECT_EQ(axis_ticks(3.0, 480.0, 10).labels,
            (Labels{"50", "100", "150", "200", "250", "300", "350", "400", "450"}));
  EXPECT_EQ(axis_ticks(0.0, 3.1e-7, 4).labels, (Labels{"0", "1e\u22127", "2e\u22127", "3e\u22127"}));
  EXPECT_EQ(axis_ticks(0.9e7, 1.1e7, 4).labels, (Labels{"9.0e6", "9.5e6", "1.00e7", "1.05e7", "1.10e7"}));
}

TEST(AxisTicks, InsideTheLimitsEvenlySpacedAndNotTooMany) {
  for (double min : {-7.3, 0.0, 0.123, 1234.5})
    for (double length : {1e-3, 0.7, 19.0, 4.4e4}) {
      const AxisTicks ticks = axis_ticks(min, min + length, 6);
      ASSERT_GE(ticks.places.size(), 2u);
      EXPECT_LE(ticks.places.size(), 7u);
      ASSERT_EQ(ticks.places.size(), ticks.labels.size());
      for (std::size_t i = 0; i < ticks.places.size(); ++i) {
        EXPECT_GE(ticks.places[i], min - 1e-5 * length);
        EXPECT_LE(ticks.places[i], min + length * (1 + 1e-5));
        if (i > 1) {
          EXPECT_NEAR(ticks.places[i] - ticks.places[i - 1], ticks.places[1] - ticks.places[0],
                      1e-9 * length);
        }
      }
    }
}

/// One panel whose axes are fixed, so that a point's pixel is known.
Plot simple_plot() {
  Plot plot;
  plot.title = "Height & <light>";
  plot.note = "a note";
  plot.panel_width_px = 200;
  plot.panel_height_px = 100;
  Panel panel;
  panel.x = {"brightness", 0.0, 2.0};
  panel.y = {"elevation (\u00b0)", 0.0, 50.0};
  Series series;
  series.label = "green";
  series.colour = {10, 200, 30};
  series.width_px = 3;
  series.x = {0.0, 1.0, 2.0};
  series.y = {25.0, 25.0, 25.0};
  panel.series = {series};
  plot.panels = {panel};
  return plot;
}

/// The points of every polyline of this colour, in order.
std::vector<std::vector<PlotPoint>> lines_in(const std::string& svg, const std::string& colour) {
  std::vector<std::vector<PlotPoint>> lines;
  const std::regex line("<polyline[^>]*stroke=\"" + colour + "\"[^>]*points=\"([^\"]*)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), line), end; it != end; ++it) {
    std::istringstream list((*it)[1].str());
    std::vector<PlotPoint> points;
    PlotPoint p;
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

TEST(PlotSvg, PutsDataWhereTheAxesSay) {
  const std::string svg = plot_svg(simple_plot());
  const auto lines = lines_in(svg, "#0ac81e");
  ASSERT_EQ(lines.size(), 2u);  // the legend's sample and the line itself
  const auto frame = lines_in(svg, "#969696");
  const std::vector<PlotPoint>& corners = frame.front();  // top left, bottom left, bottom right
  ASSERT_EQ(corners.size(), 3u);
  EXPECT_DOUBLE_EQ(corners[2].x - corners[0].x, 200.0);
  EXPECT_DOUBLE_EQ(corners[1].y - corners[0].y, 100.0);
  ASSERT_EQ(lines[1].size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(lines[1][i].x, corners[0].x + 100.0 * i, 0.01);
    EXPECT_NEAR(lines[1][i].y, corners[0].y + 50.0, 0.01);
  }
}

TEST(PlotSvg, DrawsErrorsAsBarsWhereItIsAskedTo) {
  Plot plot = simple_plot();
  Series& series = plot.panels[0].series[0];
  series.mark = Mark::points;
  series.error_bars = true;
  series.low = {20.0, 15.0, kNaN};
  series.high = {30.0, 50.0, kNaN};
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(count(svg, "fill-opacity"), 0);  // no band, in the legend neither
  const auto corners = lines_in(svg, "#969696").front();
  const auto bars = lines_in(svg, "#84e38e");  // half as dark as the points
  ASSERT_EQ(bars.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(bars[i].size(), 2u);
    EXPECT_NEAR(bars[i][0].x, corners[0].x + 100.0 * i, 0.01);
    EXPECT_NEAR(bars[i][1].x, bars[i][0].x, 0.01);
    EXPECT_NEAR(bars[i][0].y, corners[1].y - 2.0 * series.low[i], 0.01);  // 100 pixels for 50
    EXPECT_NEAR(bars[i][1].y, corners[1].y - 2.0 * series.high[i], 0.01);
  }
}

TEST(PlotSvg, ReversedAxisGrowsDownwards) {
  Plot plot = simple_plot();
  plot.panels[0].series[0].y = {0.0, 10.0, 20.0};
  const auto up = lines_in(plot_svg(plot), "#0ac81e")[1];
  plot.panels[0].y.reversed = true;
  const auto down = lines_in(plot_svg(plot), "#0ac81e")[1];
  EXPECT_GT(up[0].y, up[2].y);
  EXPECT_LT(down[0].y, down[2].y);
}

TEST(PlotSvg, WhatIsUnknownInterruptsTheLine) {
  Plot plot = simple_plot();
  plot.panels[0].series[0].x = {0.0, 0.5, kNaN, 1.0, 1.5};
  plot.panels[0].series[0].y = {1.0, 2.0, 3.0, 4.0, 5.0};
  const std::string svg = plot_svg(plot);
  const auto lines = lines_in(svg, "#0ac81e");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1].size(), 2u);
  EXPECT_EQ(lines[2].size(), 2u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(PlotSvg, IsWellFormedAndSelfContained) {
  Plot plot = simple_plot();
  plot.panels[0].series[0].band_along_x = true;
  plot.panels[0].series[0].low = {-0.1, 0.9, 1.9};
  plot.panels[0].series[0].high = {0.1, 1.1, 2.1};
  const std::string svg = plot_svg(plot);
  EXPECT_NE(svg.find("Height &amp; &lt;light&gt;"), std::string::npos);
  EXPECT_EQ(count(svg, "<svg"), count(svg, "</svg>"));
  EXPECT_EQ(count(svg, "<text"), count(svg, "</text>"));
  EXPECT_EQ(count(svg, "fill-opacity"), 2);  // the band, in the panel and in the legend
  EXPECT_EQ(count(svg, "id=\""), 0);
  EXPECT_EQ(count(svg, "href"), 0);
  EXPECT_EQ(svg, plot_svg(plot));
}

TEST(PlotSvg, NothingToShowIsNoTrouble) {
  Plot plot = simple_plot();
  plot.panels[0].x = plot.panels[0].y = {};
  plot.panels[0].series[0].x = {kNaN, kNaN, kNaN};
  EXPECT_EQ(plot_svg(plot).find("nan"), std::string::npos);
  plot.panels[0].series[0].x = {5.0, 5.0, 5.0};  // no extent either way
  plot.panels[0].series[0].y = {0.0, 0.0, 0.0};
  EXPECT_EQ(plot_svg(plot).find("nan"), std::string::npos);
  plot.panels.clear();
  EXPECT_NE(plot_svg(plot).find("</svg>"), std::string::npos);
}

/// Two by two pixels, as large as the axes.
Plot plot_of_four_pixels() {
  Plot plot = simple_plot();
  plot.panels[0].series.clear();
  Raster& raster = plot.panels[0].raster;
  raster.width = raster.height = 2;
  raster.rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 200, 100, 50};
  raster.right = 2.0;
  raster.top = 50.0;
  return plot;
}

TEST(PlotPng, ARasterFillsItsPlaceUprightAndUnsmoothed) {
  const Plot plot = plot_of_four_pixels();
  const auto corners = lines_in(plot_svg(plot), "#969696").front();
  const tests::TemporaryFile file("raster.png", plot_png(plot));
  const Photo png = read_photo(file.path(), Decoding::linear);
  // Within a few pixels of the picture's middle, on all four sides of it.
  for (int down = 0; down < 2; ++down)
    for (int right = 0; right < 2; ++right) {
      const int x = static_cast<int>(2 * (corners[0].x + (right ? 104 : 96))),
                y = static_cast<int>(2 * (corners[0].y + (down ? 54 : 46)));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(png.linear.at(x, y, c) * 255, plot.panels[0].raster.rgb[3 * (2 * down + right) + c], 0.5);
    }
}

TEST(PlotSvg, ARasterIsAPictureInsideTheAxes) {
  const std::string svg = plot_svg(plot_of_four_pixels());
  EXPECT_EQ(count(svg, "<image"), 1);
  EXPECT_EQ(count(svg, "href=\"data:image/png;base64,"), 1);
  EXPECT_NE(svg.find("width=\"200\" height=\"100\" preserveAspectRatio=\"none\""), std::string::npos);
}

TEST(PlotSvg, TicksMayBeNamed) {
  Plot plot = simple_plot();
  plot.panels[0].x.tick_places = {0.5, 1.5, 7.0};
  plot.panels[0].x.tick_labels = {"early", "late", "never"};
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(count(svg, ">early<"), 1);
  EXPECT_EQ(count(svg, ">late<"), 1);
  EXPECT_EQ(count(svg, ">never<"), 0) << "beyond the axis";
}

// The PNG is read back as a photograph; a point in the middle of the thick line must have its colour, and a
// clipped one outside the panel must not.
TEST(PlotPng, DrawsTheSamePicture) {
  Plot plot = simple_plot();
  plot.panels[0].series[0].x = {-5.0, 7.0};
  plot.panels[0].series[0].y = {25.0, 25.0};
  const auto corners = lines_in(plot_svg(plot), "#969696").front();
  const tests::TemporaryFile file("plot.png", plot_png(plot));
  const Photo png = read_photo(file.path(), Decoding::linear);
  const PlotSize size = plot_size(plot);
  EXPECT_EQ(png.linear.width, 2 * static_cast<int>(std::ceil(size.width)));
  EXPECT_EQ(png.linear.height, 2 * static_cast<int>(std::ceil(size.height)));
  const int y = static_cast<int>(2 * (corners[0].y + 50)),
            middle = static_cast<int>(2 * (corners[0].x + 130));
  EXPECT_NEAR(png.linear.at(middle, y, 0) * 255, 10, 2);
  EXPECT_NEAR(png.linear.at(middle, y, 1) * 255, 200, 2);
  EXPECT_NEAR(png.linear.at(middle, y, 2) * 255, 30, 2);
  for (const int outside : {static_cast<int>(2 * corners[0].x) - 16, static_cast<int>(2 * corners[2].x) + 6})
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(png.linear.at(outside, y, c) * 255, 255, 2);
}

Photo striped_photo(int width, int height) {
  Photo photo;
  photo.linear = sim::Image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = 0.001f * y + 0.01f * (x % 3) + 0.1f * c;
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.file_name = "stripes.png";
  photo.decoding = "sRGB (8-bit PNG, assumed)";
  return photo;
}

TEST(ProfilePlot, OnePanelPerBandUpToSix) {
  const Photo photo = striped_photo(48, 30);
  EXPECT_EQ(profile_plot(photo, extract_profile(photo, {0, 0, 48, 30}, 4)).panels.size(), 4u);
  const Plot many = profile_plot(photo, extract_profile(photo, {0, 0, 48, 30}, 16));
  ASSERT_EQ(many.panels.size(), 6u);
  EXPECT_EQ(many.panels[0].title, "columns 0\u20135");
  EXPECT_EQ(many.panels[5].title, "columns 39\u201347");
  EXPECT_NE(many.note.find("16 bands in 6 panels"), std::string::npos);
}

// Averaging bands of the same profile is the same as taking wider bands.
TEST(ProfilePlot, AverageOfBandsIsTheWiderBand) {
  const Photo photo = striped_photo(72, 30);
  const Plot fine = profile_plot(photo, extract_profile(photo, {0, 0, 72, 30}, 24));
  const Plot coarse = profile_plot(photo, extract_profile(photo, {0, 0, 72, 30}, 6));
  for (int p = 0; p < 6; ++p)
    for (int c = 0; c < 3; ++c)
      for (int row = 0; row < 30; ++row)
        EXPECT_NEAR(fine.panels[p].series[c].x[row], coarse.panels[p].series[c].x[row], 1e-9);
}

TEST(ProfilePlot, HeightIsTheElevationWhereTheCameraIsKnown) {
  const Photo photo = striped_photo(48, 30);
  const Profile profile = extract_profile(photo, {0, 10, 48, 20}, 2);
  const Plot rows = profile_plot(photo, profile);
  EXPECT_TRUE(rows.panels[0].y.reversed);
  EXPECT_DOUBLE_EQ(rows.panels[0].series[0].y[0], 10.5);
  const Plot elevations = profile_plot(photo, profile, [](double x, double y) { return x + 100 * y; });
  EXPECT_FALSE(elevations.panels[0].y.reversed);
  EXPECT_DOUBLE_EQ(elevations.panels[1].series[0].y[0], 36 + 1050);
}

TEST(ProfilePlot, TallRegionsAreThinned) {
  const Photo photo = striped_photo(3, 1203);
  const Plot plot = profile_plot(photo, extract_profile(photo, {0, 0, 3, 1203}, 1));
  const Series& red = plot.panels[0].series[0];
  ASSERT_EQ(red.x.size(), 401u);
  EXPECT_NEAR(red.x[100], 0.001 * 301 + 0.01, 1e-6);
  EXPECT_DOUBLE_EQ(red.y[100], 301.5);
}

TEST(PlotText, IsSpelledInThePngsOwnLetters) {
  EXPECT_EQ(spelled_in_ascii("log\u2081\u2080 n (cm\u207b\u00b3), 5 \u00b1 1 mW m\u207b\u00b2"),
            "log10 n (cm^-3), 5 +/- 1 mW m^-2");
  EXPECT_EQ(spelled_in_ascii("\u03c7\u00b2 and x\u00b2y\u00b9\u2070"), "chi^2 and x^2y^10");
  EXPECT_EQ(spelled_in_ascii("30\u00b0 \u2265 \u7532"), "30\x01 >= ?");
}

}  // namespace
}  // namespace vegard::fit::plot_test
