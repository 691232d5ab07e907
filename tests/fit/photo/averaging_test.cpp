// Photographs that are averaged over blocks of pixels, and scenes in such pixels.
#include "fit/photo/averaging.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/stability.h"
#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/image_bytes.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::averaging_test {
namespace {

/// Numbers without any order, all different: pixel i's channel has frac(i * golden ratio).
float light_at(std::size_t i) {
  return static_cast<float>(std::fmod(0.6180339887 * static_cast<double>(i), 1.0));
}

struct Averaged {
  sim::Image light;
  std::vector<std::uint8_t> usable;
};

/// Of rows whose light is light(i) at pixel and channel i of the whole picture.
template <class Light>
Averaged averaged(const Averaging& averaging, const Light& light, std::size_t spoilt) {
  const std::size_t of_row = 3 * static_cast<std::size_t>(averaging.from.width);
  BlockAverager averager(averaging);
  for (int y = 0; y < averaging.from.height; ++y) {
    LightRow row;
    for (std::size_t i = y * of_row; i < (y + 1) * of_row; ++i) {
      row.light.push_back(light(i));
      row.usable.push_back(i != spoilt);
    }
    averager.add(row);
  }
  Averaged all;
  averager.take(all.light, all.usable);
  return all;
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

TEST(Averaging, BlocksHaveTheMeansOfTheirPixels) {
  // Row 2, the last column's green.
  const Averaged blocks = averaged({{6, 4}, {3, 2}}, light_at, 3 * (6 * 2 + 5) + 1);
  ASSERT_EQ(blocks.light.width, 3);
  ASSERT_EQ(blocks.light.height, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      for (int c = 0; c < 3; ++c) {
        double mean = 0.0;
        for (int k = 0; k < 4; ++k) mean += 0.25 * light_at(3 * ((2 * y + k / 2) * 6 + 2 * x + k % 2) + c);
        EXPECT_NEAR(blocks.light.at(x, y, c), mean, 1e-6);
        EXPECT_EQ(blocks.usable[blocks.light.index(x, y, c)], x == 2 && y == 1 && c == 1 ? 0 : 1);
      }
}

/// Where sizes are no multiples, a pixel on a border is shared out: no light is lost, none counted twice.
TEST(Averaging, KeepsAllLightWhereBlocksCutPixels) {
  const Averaging averaging{{29, 17}, {8, 5}};
  const Averaged all = averaged(averaging, light_at, kNone);
  for (int c = 0; c < 3; ++c) {
    double before = 0.0, after = 0.0;
    for (std::size_t i = c; i < 3 * 29 * 17; i += 3) before += light_at(i);
    for (std::size_t i = c; i < all.light.data.size(); i += 3) after += all.light.data[i];
    // Floats of 24 bits, a few hundred of them.
    EXPECT_NEAR(after * (29.0 / 8.0) * (17.0 / 5.0) / before, 1.0, 1e-6);
  }
  // A ramp's means are the ramp at the blocks' middles, wherever their borders are.
  const auto ramp = [](std::size_t i) {
    return static_cast<float>(i / 3 % 29 + 0.5 + 2 * (i / (3 * 29) + 0.5));
  };
  const sim::Image light = averaged(averaging, ramp, kNone).light;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 8; ++x)
      // The mean of a step function over a block whose ends lie inside pixels is off by less than one step.
      EXPECT_NEAR(light.at(x, y, 1), (x + 0.5) * 29.0 / 8.0 + 2.0 * (y + 0.5) * 17.0 / 5.0, 0.2);
}

TEST(Averaging, OfCodesIsThatOfTheirLight) {
  const Averaging averaging{{29, 17}, {8, 5}};
  CodeTable table;
  table.white = 250;
  for (int code = 0; code < 256; ++code) table.light.push_back(static_cast<float>(code * code) / 65025.0f);
  for (const int channels : {1, 3}) {
    std::vector<std::uint8_t> codes;
    for (std::size_t i = 0; i < static_cast<std::size_t>(29 * 17 * channels); ++i)
      codes.push_back(static_cast<std::uint8_t>(255.9 * light_at(i)));
    BlockAverager by_codes(averaging), by_light(averaging);
    for (int y = 0; y < 17; ++y) {
      by_codes.add(codes.data() + y * 29 * channels, channels, table);
      LightRow row;
      for (int i = 0; i < 3 * 29; ++i) {
        const std::uint8_t code = codes[y * 29 * channels + (channels == 3 ? i : i / 3)];
        row.light.push_back(table.light[code]);
        row.usable.push_back(code < 250);
      }
      by_light.add(row);
    }
    Averaged one, other;
    by_codes.take(one.light, one.usable);
    by_light.take(other.light, other.usable);
    EXPECT_EQ(one.light.data, other.light.data);
    EXPECT_EQ(one.usable, other.usable);
  }
}

/// Regions of the choices of --stability are in the file's pixels.
TEST(Averaging, OfAPhotographLeavesRegionsInTheFilesPixels) {
  sim::Scene scene = tests::small_scene();
  scene.camera.width = 1200;
  scene.camera.height = 1000;
  sim::FreeParameter energy;
  energy.path = "sheet." + scene.sheets[0].name + ".energy_kev";
  scene.fit.free = {energy};
  Photo photo;
  photo.linear = sim::Image(600, 500, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.averaged_from = {1200, 1000};
  int regions = 0;
  for (const Variation& v : variations_of(scene, {photo})) {
    if (v.choice != "region") continue;
    ++regions;
    EXPECT_GE(v.scene.fit.roi_px[2], 800) << v.name;
    EXPECT_GE(v.scene.fit.roi_px[3], 750) << v.name;
  }
  EXPECT_EQ(regions, 4);
}

TEST(Averaging, LeavesAFitTheRowsThatItAsksFor) {
  sim::Scene scene = tests::small_scene();
  scene.camera.width = 6000;
  scene.camera.height = 4000;
  scene.fit.bands = 24;
  EXPECT_EQ(averaging_for_fit(scene).to.width, 750);
  EXPECT_EQ(averaging_for_fit(scene).to.height, 500);
  scene.fit.roi_px = {0, 1000, 6000, 1000};  // 1000 rows: blocks of two leave 500
  EXPECT_EQ(averaging_for_fit(scene).to.height, 2000);
  scene.fit.roi_px = {0, 1000, 6000, 959};
  EXPECT_FALSE(averaging_for_fit(scene).any());
  scene.fit.roi_px = {0, 0, 0, 0};
  scene.fit.bands = 120;  // of 50 pixels each, which keep a dozen
  EXPECT_EQ(averaging_for_fit(scene).to.width, 1500);
  scene.fit.bands = 24;
  scene.fit.weight[sim::StatisticKind::texture] = 1.0;
  EXPECT_FALSE(averaging_for_fit(scene).any());
  scene.fit.weight[sim::StatisticKind::texture] = 0.0;
  scene.fit.average_rows = 0;
  EXPECT_FALSE(averaging_for_fit(scene).any());
}

/// What the small camera sees at a place, the large one sees there too, also where a lens's numbers in pixels
/// are changed afterwards, as a fit does.
TEST(Averaging, AScenesLensKeepsItsNumbersInTheFilesPixels) {
  sim::Scene scene = tests::small_scene();
  scene.camera.model = sim::LensModel::equidistant;
  scene.camera.width = 1230;
  scene.camera.height = 970;
  scene.camera.focal_px = 500.0;
  scene.fit.roi_px = {100, 33, 1000, 900};
  const Averaging averaging{{1230, 970}, {410, 320}};
  sim::Scene small = averaged_scene(scene, averaging);
  EXPECT_EQ(small.fit.roi_px, (std::array<int, 4>{34, 11, 332, 296}));
  for (sim::Scene* one : {&scene, &small}) {
    one->camera.focal_px = 520.0;
    one->camera.principal_x_px = 14.0;
    one->camera.principal_y_px = -23.0;
  }
  for (const double x : {20.0, 205.0, 400.0})
    for (const double y : {20.0, 160.0, 300.0}) {
      const sim::Direction seen = sim::direction_of_pixel(small.camera, x, y),
                           there = sim::direction_of_pixel(scene.camera, 3.0 * x, 970.0 / 320.0 * y),
                           own = sim::direction_of_pixel(sim::in_own_pixels(small.camera), x, y);
      EXPECT_NEAR(seen.azimuth_deg, there.azimuth_deg, 1e-9);
      EXPECT_NEAR(seen.elevation_deg, there.elevation_deg, 1e-9);
      EXPECT_NEAR(own.azimuth_deg, there.azimuth_deg, 1e-9);
      EXPECT_NEAR(own.elevation_deg, there.elevation_deg, 1e-9);
    }
  const sim::Scene back = with_pixels_of(scene, small);
  EXPECT_EQ(back.camera.width, 1230);
  EXPECT_EQ(back.camera.pixel_width_px, 1.0);
  EXPECT_EQ(back.camera.focal_px, 520.0);
  EXPECT_EQ(back.fit.roi_px, scene.fit.roi_px);
}

TEST(Averaging, OfAFileIsThatOfItsLight) {
  // 24 x 16 pixels in blocks of eight by eight, each of one grey.
  const tests::TemporaryFile file("grey.jpg", tests::jpeg_of_blocks(3, 2, {200, 200, 100, 50, 50, 10}));
  const Photo whole = read_photo(file.path(), Decoding::automatic);
  const Photo blocks = read_photo(file.path(), Decoding::automatic, nullptr, {{24, 16}, {12, 8}});
  ASSERT_EQ(blocks.linear.width, 12);
  EXPECT_EQ(size_of_file(blocks).width, 24);
  EXPECT_EQ(size_of_file(whole).width, 24);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 12; ++x)
      EXPECT_NEAR(blocks.linear.at(x, y, 1), whole.linear.at(2 * x, 2 * y, 1), 1e-6) << x << ", " << y;
  // A photograph of another size is not averaged: it is not the camera's.
  EXPECT_EQ(read_photo(file.path(), Decoding::automatic, nullptr, {{48, 32}, {12, 8}}).linear.width, 24);
}

/// A JPEG's rows are averaged as they are decoded, and turned upright afterwards: what comes out is the
/// average of the upright picture, whichever of EXIF's eight orientations it has.
TEST(Averaging, OfATurnedFileIsThatOfTheUprightPicture) {
  const std::string jpeg = tests::jpeg_of_blocks(3, 2, {200, 180, 100, 50, 30, 255});
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const std::string exif = std::string("Exif\0\0", 6) + tests::exif_with_orientation(orientation, true);
    const tests::TemporaryFile file("turned.jpg", tests::with_app1(jpeg, exif));
    const Photo whole = read_photo(file.path(), Decoding::automatic);
    const sim::PictureSize size = size_of_file(whole);
    const Photo blocks =
        read_photo(file.path(), Decoding::automatic, nullptr, {size, {size.width / 4, size.height / 4}});
    ASSERT_EQ(blocks.linear.width, size.width / 4) << orientation;
    for (int y = 0; y < blocks.linear.height; ++y)
      for (int x = 0; x < blocks.linear.width; ++x) {
        const std::size_t i = blocks.linear.index(x, y, 0),
                          of_whole = whole.linear.index(4 * x + 1, 4 * y + 1, 0);
        EXPECT_NEAR(blocks.linear.data[i], whole.linear.data[of_whole], 1e-6) << orientation;
        EXPECT_EQ(blocks.usable[i], whole.usable[of_whole]) << orientation;
      }
    EXPECT_EQ(blocks.decoding, whole.decoding);
    EXPECT_EQ(blocks.sha256, whole.sha256);
    EXPECT_EQ(blocks.block_error, whole.block_error);
  }
}

/// Of a noisy picture of more rows than are decoded at once, in blocks that cut pixels: what is averaged
/// while it is decoded is what is averaged of all of its pixels.
TEST(Averaging, OfAFileOfManyRowsIsThatOfAllItsPixels) {
  constexpr int kWidth = 203, kHeight = 197;
  cv::Mat picture(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c)
        picture.at<cv::Vec3b>(y, x)[c] =
            static_cast<std::uint8_t>(250.0f * light_at(3 * (y * kWidth + x) + c));
  std::vector<std::uint8_t> bytes;
  ASSERT_TRUE(cv::imencode(".jpg", picture, bytes));
  for (const int orientation : {1, 3, 6}) {
    const std::string exif = std::string("Exif\0\0", 6) + tests::exif_with_orientation(orientation, false);
    const tests::TemporaryFile file("rows.jpg",
                                    tests::with_app1(std::string(bytes.begin(), bytes.end()), exif));
    const Photo whole = read_photo(file.path(), Decoding::automatic);
    const sim::PictureSize size = size_of_file(whole);
    const Averaging averaging{size, {size.width / 4, size.height / 4}};
    const Photo blocks = read_photo(file.path(), Decoding::automatic, nullptr, averaging);
    const Averaged expected = averaged(
        averaging, [&](std::size_t i) { return whole.linear.data[i]; }, kNone);
    ASSERT_EQ(blocks.linear.data.size(), expected.light.data.size());
    for (std::size_t i = 0; i < expected.light.data.size(); ++i)
      // Sums of sixteen floats in another order, of a picture that is turned.
      ASSERT_NEAR(blocks.linear.data[i], expected.light.data[i], 1e-6) << orientation << " at " << i;
  }
  // Half of the data, and an end behind them: libjpeg would make up the rest.
  std::string half(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2));
  half += "\xff\xd9";
  const tests::TemporaryFile file("half.jpg", half);
  tests::expect_error(sim::ErrorKind::unreadable_input, [&] {
    read_photo(file.path(), Decoding::automatic, nullptr, {{kWidth, kHeight}, {50, 49}});
  });
}

TEST(Averaging, AMaskOfTheFilesSizeLeavesWholeBlocksOnly) {
  const tests::TemporaryFile file("grey.jpg", tests::jpeg_of_blocks(3, 2, {200, 200, 100, 50, 50, 10}));
  Photo photo = read_photo(file.path(), Decoding::automatic, nullptr, {{24, 16}, {4, 2}});
  // The mask's second block of 8 x 8 is black: of the photograph's, 6 wide, the second and the third.
  const tests::TemporaryFile mask("mask.jpg", tests::jpeg_of_blocks(3, 2, {250, 5, 250, 250, 250, 250}));
  apply_mask(photo, mask.path());
  std::vector<int> used;
  for (std::size_t i = 0; i < photo.usable.size(); i += 3) used.push_back(photo.usable[i]);
  EXPECT_EQ(used, (std::vector<int>{1, 0, 0, 1, 1, 1, 1, 1}));
  const tests::TemporaryFile small("small.jpg", tests::jpeg_of_blocks(1, 1, {250}));
  const std::string words =
      tests::expect_error(sim::ErrorKind::unreadable_input, [&] { apply_mask(photo, small.path()); });
  EXPECT_NE(words.find("24 x 16"), std::string::npos) << words;
}

}  // namespace
}  // namespace vegard::fit::averaging_test
