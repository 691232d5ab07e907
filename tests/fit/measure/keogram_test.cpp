// Keograms of made-up nights whose light and times are known.
#include "fit/measure/keogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "fit/report/keogram_plot.h"
#include "fit/report/plot/plot_axis.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/utc_time.h"
#include "tests/support/expect_error.h"
#include "tests/support/fisheye_map.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::keogram_test {
namespace {

constexpr int kSize = 120;

/// An arc in the south at an angle from the northern horizon that grows with time, over a red sky.
double light(double angle_deg, double time, int channel) {
  const double d = (angle_deg - (60.0 + 0.5 * time)) / 12.0;
  return channel == 1 ? std::exp(-d * d) : channel == 0 ? 0.2 : 0.1 + 0.001 * angle_deg;
}

Photo picture(const sim::DirectionMap& map, double time, const std::string& name) {
  Photo photo;
  photo.linear = sim::Image(map.width, map.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  photo.decoding = "linear (made up)";
  photo.file_name = name;
  photo.sha256 = "0123";
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = map.index(x, y);
      // The angle in the plane from north over the zenith to south.
      const double e = map.elevation_deg[i] * sim::kRadiansPerDegree,
                   a = map.azimuth_deg[i] * sim::kRadiansPerDegree;
      const double angle = std::atan2(std::sin(e), std::cos(e) * std::cos(a)) / sim::kRadiansPerDegree;
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) = std::isnan(e) ? 0.0f : static_cast<float>(light(angle, time, c));
    }
  return photo;
}

/// Six pictures ten seconds apart, and two more after a pause.
const std::vector<double> kTimes = {0, 10, 20, 30, 40, 50, 110, 120};

Keogram night(double begin_s) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, 58.0);
  Keogram keogram;
  keogram.line = meridian_line(map, {0, 0, kSize, kSize}, {0.0, {}, 3.0});
  keogram.camera = "maps";
  keogram.time_kind = PictureTimes::Kind::utc;
  keogram.time_source = "the files' names";
  for (std::size_t i = 0; i < kTimes.size(); ++i)
    add_picture(picture(map, kTimes[i], "p" + std::to_string(i) + ".tif"), begin_s + kTimes[i], keogram);
  return keogram;
}

const double kBegin = *sim::utc_seconds("2014-02-21T19:30:00Z");

TEST(Keogram, EachColumnIsTheSkyOfItsTime) {
  const Keogram keogram = night(kBegin);
  ASSERT_EQ(keogram.columns.size(), kTimes.size());
  for (std::size_t i = 0; i < kTimes.size(); ++i)
    for (int p = 0; p < keogram.positions(); ++p)
      for (int c = 0; c < 3; ++c) {
        // A place of 3 degrees has the mean of a curve: off its middle by the curvature, and by where its
        // pixels lie, at most half a pixel (0.8 degrees) of a slope of at most 0.072 per degree.
        const double expected = light(keogram.line.position[p], kTimes[i], c);
        EXPECT_NEAR(keogram.columns[i].mean[3 * p + c], expected, c == 1 ? 0.058 : 1e-3) << i << " " << p;
      }
}

TEST(Keogram, TheTableHoldsTimesPlacesAndLight) {
  const Keogram keogram = night(kBegin);
  std::istringstream lines(keogram_csv(keogram));
  std::string numbers, comments;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') {
      comments += line + "\n";
      continue;
    }
    // A column of text is none of CsvTable's: the moments as seconds.
    const auto comma = line.find(',');
    const auto seconds = sim::utc_seconds(line.substr(0, comma));
    numbers +=
        (seconds ? std::to_string(*seconds - kBegin) : line.substr(0, comma)) + line.substr(comma) + "\n";
  }
  EXPECT_NE(comments.find("# picture: 2014-02-21T19:31:50Z 0123 p6.tif\n"), std::string::npos) << comments;
  EXPECT_NE(comments.find("# times_from: the files' names\n"), std::string::npos);
  const sim::CsvTable table = sim::read_csv_table(numbers, "keogram");
  const auto places = static_cast<std::size_t>(keogram.positions());
  ASSERT_EQ(table.rows(), kTimes.size() * places);
  const std::size_t row = 6 * places + 20;
  EXPECT_EQ(table.column("time")[row], 110.0);
  EXPECT_EQ(table.column("elevation_deg")[row], keogram.line.position[20]);
  EXPECT_EQ(table.column("g")[row], keogram.columns[6].mean[61]);
  EXPECT_EQ(table.column("sigma_g")[row], keogram.columns[6].standard_error[61]);
}

TEST(Keogram, TheExrHoldsAColumnForEachPictureAndTheirTimes) {
  const tests::TemporaryFolder folder;
  const Keogram keogram = night(kBegin);
  const sim::Image image = keogram_image(keogram);
  sim::write_exr(folder / "k.exr", image, keogram_attributes(keogram));
  const sim::ExrFile back = sim::read_exr(folder / "k.exr");
  ASSERT_EQ(back.image.width, static_cast<int>(kTimes.size()));
  ASSERT_EQ(back.image.height, keogram.positions());
  for (int x = 0; x < back.image.width; ++x)
    for (int y = 0; y < back.image.height; ++y)
      EXPECT_EQ(back.image.at(x, y, 1), static_cast<float>(keogram.columns[x].mean[3 * y + 1]));
  const std::string& times = back.attributes.at("keogram_time");
  EXPECT_EQ(times.substr(0, 42), "2014-02-21T19:30:00Z,2014-02-21T19:30:10Z,");
  EXPECT_EQ(back.attributes.at("keogram_elevation_deg").substr(0, 8), "1.5,4.5,");
}

TEST(Keogram, APauseStaysFreeAndElseColumnsTouch) {
  const std::vector<TimeSpan> spans = column_spans(night(0.0));
  for (const std::size_t i : {1, 2, 3, 4, 5, 7}) EXPECT_EQ(spans[i].begin, spans[i - 1].end) << i;
  EXPECT_EQ(spans[0].begin, -5.0);
  EXPECT_EQ(spans[5].end, 55.0);
  EXPECT_EQ(spans[6].begin, 105.0);
  EXPECT_EQ(spans[7].end, 125.0);
}

/// Bytes of the raster at a time and a place.
std::vector<int> shown(const Plot& plot, double time, int place) {
  const Raster& raster = plot.panels[0].raster;
  const int x = static_cast<int>((time - raster.left) / (raster.right - raster.left) * raster.width);
  const std::uint8_t* rgb = &raster.rgb[3 * (static_cast<std::size_t>(place) * raster.width + x)];
  return {rgb[0], rgb[1], rgb[2]};
}

TEST(Keogram, ThePictureShowsItsLightAtItsTime) {
  const Keogram keogram = night(kBegin);
  KeogramLook look;
  look.black = 0.0;
  look.white = 1.0;
  const Plot plot = keogram_plot(keogram, look);
  const Axis& x = plot.panels[0].x;
  EXPECT_NE(x.label.find("UTC, 2014-02-21"), std::string::npos);
  EXPECT_EQ(x.tick_labels.front(), "19:30:00");
  EXPECT_EQ(x.tick_places.front(), kBegin);
  EXPECT_TRUE(plot.panels[0].y.reversed) << "north at the top";
  EXPECT_EQ(plot.panels[0].raster.top, 0.0);
  // 0.2 in red is 124 of 255 by the sRGB curve (IEC 61966-2-1: 1.055 0.2^(1/2.4) - 0.055 = 0.4845).
  for (const double time : {-4.0, 12.0, 54.0, 106.0, 124.0})
    EXPECT_EQ(shown(plot, kBegin + time, 5)[0], 124) << time;
  // The pause is grey at every place.
  for (const double time : {57.0, 80.0, 103.0})
    for (const int place : {0, 20, 50})
      EXPECT_EQ(shown(plot, kBegin + time, place), (std::vector<int>{205, 205, 205})) << time;
  // The arc of the last picture is at 120 degrees: brighter there than where it was in the first.
  EXPECT_GT(shown(plot, kBegin + 120, 39)[1], shown(plot, kBegin + 120, 19)[1] + 100);
  EXPECT_GT(shown(plot, kBegin, 19)[1], shown(plot, kBegin, 39)[1] + 100);
}

TEST(Keogram, OneChannelIsABrightnessOfItsOwn) {
  KeogramLook look;
  look.channel = 1;
  const Plot plot = keogram_plot(night(kBegin), look);
  const auto sum = [&](double time, int place) {
    const std::vector<int> rgb = shown(plot, kBegin + time, place);
    return rgb[0] + rgb[1] + rgb[2];
  };
  EXPECT_GT(sum(0, 19), sum(0, 14));
  EXPECT_GT(sum(0, 14), sum(0, 8));
}

TEST(Keogram, OfManyPicturesThatFallOnOnePixelTheMeanIsShown) {
  const sim::DirectionMap map = tests::fisheye_map(20, 9.0);
  Keogram keogram;
  keogram.line = column_line({0, 0, 20, 20}, 4);
  // Black and white in turn, 9000 of them on 1800 pixels.
  Photo black = picture(map, 0.0, "a.tif"), white = black;
  std::fill(black.linear.data.begin(), black.linear.data.end(), 0.0f);
  std::fill(white.linear.data.begin(), white.linear.data.end(), 1.0f);
  for (int i = 0; i < 9000; ++i) add_picture(i % 2 == 0 ? black : white, i, keogram);
  const Plot plot = keogram_plot(keogram);
  // Five pictures to a pixel: two or three of them white.
  for (const double time : {100.0, 4000.0, 8000.0}) {
    const int code = shown(plot, time, 10)[1];
    EXPECT_GE(code, 170) << "0.4 by the sRGB curve";
    EXPECT_LE(code, 203) << "0.6 by the sRGB curve";
  }
}

TEST(Keogram, PicturesWithoutTimesAreCounted) {
  const sim::DirectionMap map = tests::fisheye_map(20, 9.0);
  Keogram keogram;
  keogram.line = column_line({0, 0, 20, 20}, 4);
  keogram.time_source = "not known";
  for (int i = 0; i < 3; ++i) add_picture(picture(map, 0.0, "p.tif"), i, keogram);
  const Axis x = keogram_plot(keogram).panels[0].x;
  EXPECT_EQ(x.tick_labels, (std::vector<std::string>{"0", "1", "2"}));
  EXPECT_EQ(x.tick_places, (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(x.label, "picture \u2013 times: not known");
}

TEST(Keogram, RefusesPicturesThatDoNotBelongTogether) {
  const sim::DirectionMap map = tests::fisheye_map(kSize, 58.0);
  Keogram keogram = night(kBegin);
  const auto refused = [&](const Photo& photo, double time, sim::ErrorKind kind) {
    return tests::expect_error(kind, [&] { add_picture(photo, time, keogram); });
  };
  const Photo small = picture(tests::fisheye_map(60, 28.0), 0.0, "small.tif");
  EXPECT_NE(refused(small, kBegin + 200, sim::ErrorKind::unreadable_input).find("small.tif"),
            std::string::npos);
  Photo other = picture(map, 0.0, "other.tif");
  EXPECT_NE(refused(other, kBegin + 120, sim::ErrorKind::usage).find("p7.tif"), std::string::npos);
  other.decoding = "sRGB";
  EXPECT_NE(refused(other, kBegin + 200, sim::ErrorKind::unreadable_input).find("sRGB"), std::string::npos);
  EXPECT_EQ(keogram.columns.size(), kTimes.size());
}

TEST(TimeTicks, AreRoundMomentsBetweenTheEnds) {
  const double begin = *sim::utc_seconds("2015-10-07T05:52:10Z");
  EXPECT_EQ(utc_ticks(begin, begin + 40, 10).labels,
            (std::vector<std::string>{"05:52:10", "05:52:15", "05:52:20", "05:52:25", "05:52:30", "05:52:35",
                                      "05:52:40", "05:52:45", "05:52:50"}));
  EXPECT_EQ(utc_ticks(begin, begin + 7200, 5).labels,
            (std::vector<std::string>{"06:00", "06:30", "07:00", "07:30"}));
  EXPECT_EQ(utc_ticks(begin, begin + 4 * 86400.0, 5).labels,
            (std::vector<std::string>{"10-08", "10-09", "10-10", "10-11"}));
}

}  // namespace
}  // namespace vegard::fit::keogram_test
