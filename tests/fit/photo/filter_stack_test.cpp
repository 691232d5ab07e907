// One file per filter, from the files to the fit.
#include "fit/photo/filter_stack.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/fit.h"
#include "sim/base/file/sha256.h"
#include "sim/base/picture/fits_io.h"
#include "sim/render/render.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::filter_stack_test {
namespace {

const std::vector<double> kLines = {630.0, 557.7, 427.8};

TEST(FilterFile, IsAWavelengthAndAName) {
  const FilterFile filter = filter_file("557.7=some where/a=b.fits");
  EXPECT_EQ(filter.wavelength_nm, 557.7);
  EXPECT_EQ(filter.file, "some where/a=b.fits");
  for (const char* text : {"a.fits", "557.7", "557.7=", "=a.fits", "-3=a.fits", "nan=a.fits", "5577a=b"})
    tests::expect_error(sim::ErrorKind::usage, [&] { filter_file(text); });
}

TEST(ReadFilters, ChannelsFollowTheScenesLines) {
  const tests::TemporaryFolder folder;
  const std::string green = tests::fits_image(-32, {2, 1}, {1.0, 2.0}),
                    red = tests::fits_image(-32, {2, 1}, {3.0, std::nan("")});
  tests::put(folder / "g.fits", green);
  tests::put(folder / "r.fits", red);
  const Photo photo =
      read_filters({{557.7, folder / "g.fits"}, {630.2, folder / "r.fits"}}, kLines, Decoding::automatic);
  EXPECT_EQ(photo.linear.data, (std::vector<float>{3, 1, 0, 0, 2, 0}));
  EXPECT_EQ(photo.usable, (std::vector<std::uint8_t>{1, 1, 0, 0, 1, 0}));
  ASSERT_EQ(photo.filters.size(), 3u);
  EXPECT_EQ(photo.filters[0].wavelength_nm, 630.2);
  EXPECT_EQ(photo.filters[0].file_name, "r.fits");
  EXPECT_EQ(photo.filters[1].sha256, sim::sha256(green));
  EXPECT_EQ(photo.filters[2].wavelength_nm, 0.0);
  EXPECT_EQ(photo.file_name, "g.fits, r.fits");
  EXPECT_TRUE(keeps_negative_light(photo));
  EXPECT_NE(photo.decoding.find("557.7 nm linear (32-bit float FITS, assumed)"), std::string::npos)
      << photo.decoding;
  // Without a scene, as they are given.
  EXPECT_EQ(read_filters({{557.7, folder / "g.fits"}}, {}, Decoding::automatic).linear.at(1, 0, 0), 2.0f);
}

TEST(ReadFilters, WhatDoesNotFitTogetherIsRefused) {
  const tests::TemporaryFolder folder;
  const std::string a = folder / "a.fits", wide = folder / "wide.fits", colours = folder / "colours.fits";
  tests::put(a, tests::fits_image(-32, {1, 1}, {1.0}));
  tests::put(wide, tests::fits_image(-32, {2, 1}, {1.0, 1.0}));
  tests::put(colours, tests::fits_image(-32, {1, 1, 3}, {1.0, 2.0, 3.0}));
  const auto refused = [&](sim::ErrorKind kind, const std::vector<FilterFile>& files) {
    return tests::expect_error(kind, [&] { read_filters(files, kLines, Decoding::automatic); });
  };
  EXPECT_NE(refused(sim::ErrorKind::usage, {{486.1, a}}).find("486.1 nm"), std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::usage, {{630.0, a}, {630.0, a}}).find("two files"), std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::usage, {}).find("0 filters"), std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::unreadable_input, {{630.0, a}, {557.7, wide}}).find("2 x 1"),
            std::string::npos);
  EXPECT_NE(refused(sim::ErrorKind::unreadable_input, {{630.0, colours}}).find("no colours"),
            std::string::npos);
}

/// A small arc seen by an imager with three filters.
sim::Scene imager() {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].beams = 3000;
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sheets[0].energy_kev = 4.0;
  scene.sensor.response = "filters";
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.bands = 4;
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  return scene;
}

// The files' numbers are counts: each filter has a scale of its own, which a fit without white balance finds.
TEST(ReadFilters, AFitOfThreeFilesFindsTheEnergy) {
  const sim::Scene truth = imager();
  const sim::Image rgb = sim::render(truth).rgb;
  const tests::TemporaryFolder folder;
  const double counts[3] = {700.0, 2000.0, 450.0};
  std::vector<FilterFile> files;
  for (int c = 0; c < 3; ++c) {
    sim::Image one(rgb.width, rgb.height, {"Y"});
    for (std::size_t i = 0; i < one.data.size(); ++i)
      one.data[i] = static_cast<float>(counts[c] * rgb.data[3 * i + c]);
    files.push_back({truth.emission.lines[c], folder / (std::to_string(c) + ".fits")});
    sim::write_fits(files.back().file, one, {{"FILTWAV", truth.emission.lines[c], "nm"}});
  }
  const Photo photo = read_filters(files, truth.emission.lines, Decoding::automatic);
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(photo.linear.at(70, 50, c), static_cast<float>(counts[c] * rgb.at(70, 50, c)));
  sim::Scene scene = truth;
  scene.sheets[0].energy_kev = 6.0;
  scene.fit.white_balance_known = false;
  scene.fit.free.resize(1);
  scene.fit.free[0].path = "sheet.main.energy_kev";
  const FitResult result = fit_photo(scene, photo, {});
  // The fit's film has wider cells than the picture and averages beams: 1 %, as in profile_cost_test.
  EXPECT_NEAR(result.parameters[0].value, 4.0, 0.04);
  // Without one of the files the others say it too.
  files.erase(files.begin() + 2);
  const FitResult two = fit_photo(scene, read_filters(files, truth.emission.lines, Decoding::automatic), {});
  EXPECT_NEAR(two.parameters[0].value, 4.0, 0.04);
}

}  // namespace
}  // namespace vegard::fit::filter_stack_test
