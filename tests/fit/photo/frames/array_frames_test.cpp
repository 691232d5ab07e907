// Frames out of HDF5, MATLAB and CDF files of other writers (tests/data/imagers/make.py).
#include "fit/photo/frames/array_frames.h"

#include <gtest/gtest.h>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "tests/support/expect_error.h"
#include "tests/support/source_folder.h"

namespace vegard::fit::array_frames_test {
namespace {

using sim::ArrayKind;
using sim::ErrorKind;
using tests::expect_words;

std::string made(const std::string& name) { return tests::source_folder() + "/tests/data/imagers/" + name; }

int value_of(int frame, int x, int y, int colour = 0) { return 100 * frame + 10 * y + x + 40 * colour; }

/// What make.py's frame is as a PGM or PPM.
std::string pnm(int frame, int colours) {
  std::string bytes = std::string(colours == 3 ? "P6\n5 4\n255\n" : "P5\n5 4\n65535\n");
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      for (int c = 0; c < colours; ++c) {
        const int value = value_of(frame, x, y, c);
        if (colours == 1) bytes += static_cast<char>(value >> 8);
        bytes += static_cast<char>(value & 0xff);
      }
  return bytes;
}

struct Made {
  const char* name;
  int colours;
  const char* time_source;
};
const Made kAll[] = {{"rgb.h5", 3, "HDF5 word \"image_request_start_timestamp\""},
                     {"stack.mat", 1, "MATLAB array \"time\""},
                     {"stack_v73.mat", 1, "MATLAB 7.3 array \"posixtime\""},
                     {"asi.cdf", 1, "CDF array \"thg_asf_gill_epoch\""},
                     {"asi_packed.cdf", 1, "CDF array \"thg_asf_gill_epoch\""}};

TEST(ArrayFrames, AreFramesByNumberAndByTime) {
  for (const Made& one : kAll) {
    SCOPED_TRACE(one.name);
    const std::string file = made(one.name);
    EXPECT_TRUE(is_frame_file(file));
    const FrameIndex index = frame_index(file);
    ASSERT_EQ(index.frames.size(), 3u);
    EXPECT_FALSE(index.is_packed);
    for (int f = 0; f < 3; ++f) {
      ASSERT_TRUE(index.frames[f].time);
      EXPECT_NEAR(index.frames[f].time->seconds, 1635573900.25 + 3 * f, 2e-5);  // MATLAB's days have 1e-5 s
      EXPECT_EQ(index.frames[f].time->source, one.time_source);
      const PictureBytes picture = read_picture_bytes(file + "#" + std::to_string(f));
      EXPECT_EQ(picture.bytes, pnm(f, one.colours));
    }
    EXPECT_EQ(read_picture_bytes(file + "#2021-10-30T06:05:03Z").name, file + "#1");
    EXPECT_EQ(pictures_in(file).size(), 3u);
    PictureSeries series;
    for (const int f : {0, 1, 2, 1})
      EXPECT_EQ(series.read(name_of_frame(file, f)).bytes, pnm(f, one.colours));
    expect_words(ErrorKind::usage, {one.name, "3 frames"}, [&] { read_picture_bytes(file); });
    expect_words(ErrorKind::usage, {one.name, "no frame 3"}, [&] { read_picture_bytes(file + "#3"); });
    const Photo photo = read_photo(file + "#2", Decoding::automatic);
    EXPECT_EQ(photo.linear.width, 5);
    EXPECT_EQ(photo.sha256, sim::sha256(pnm(2, one.colours)));
  }
}

TEST(ArrayFrames, TellWhatTheirWordsSay) {
  const sim::PictureMetadata metadata = photo_metadata(made("rgb.h5") + "#1");
  EXPECT_EQ(metadata.site, "gill");
  EXPECT_EQ(metadata.imager, "rgb-04");
  ASSERT_TRUE(metadata.exposure_s);
  EXPECT_DOUBLE_EQ(*metadata.exposure_s, 2.8);
  EXPECT_EQ(metadata.header_time_utc, "2021-10-30T06:05:03.250000Z");
  EXPECT_EQ(metadata.sources.header_time, "HDF5 word \"image_request_start_timestamp\"");
  EXPECT_EQ(photo_metadata(made("asi.cdf") + "#2").header_time_utc, "2021-10-30T06:05:06.25Z");
}

TEST(ArrayFrames, AreBoundedByWhatTheyDeclare) {
  expect_words(ErrorKind::unreadable_input, {"huge.h5", "400000 x 400000", "2^25"},
               [] { frame_index(made("huge.h5")); });
  expect_words(ErrorKind::unreadable_input, {"huge_chunk.h5", "no images"},
               [] { frame_index(made("huge_chunk.h5")); });
  EXPECT_FALSE(is_frame_file(made("skymap.sav")));
}

/// A file of arrays of which nothing is read but their names and shapes.
class Shapes : public sim::ArrayFile {
 public:
  explicit Shapes(std::vector<sim::StoredArray> arrays) : ArrayFile("shapes", "made") {
    arrays_ = std::move(arrays);
  }

 private:
  std::string read_block(const sim::StoredArray&, const std::vector<std::uint64_t>&,
                         const std::vector<std::uint64_t>&) override {
    return {};
  }
};

sim::StoredArray array_of(const std::string& name, const std::vector<std::uint64_t>& dims,
                          bool columns_first = false) {
  sim::StoredArray array;
  array.name = name;
  array.dims = dims;
  array.kind = ArrayKind::f64;
  array.columns_first = columns_first;
  return array;
}

TEST(ArrayFrames, FindTheAxesOfImages) {
  const auto stack = [](const std::vector<std::uint64_t>& dims, std::uint64_t times, bool columns_first) {
    std::vector<sim::StoredArray> arrays = {array_of("small", {4, 4}),
                                            array_of("images", dims, columns_first)};
    if (times > 0) arrays.push_back(array_of("time", {1, times}));
    return find_images(Shapes(arrays));
  };
  const auto is = [](const ImageStack& found, int width, int height, std::size_t frames, int channels,
                     int frame_axis) {
    EXPECT_EQ(found.arrays, std::vector<std::size_t>{1});
    EXPECT_EQ(found.width_px, width);
    EXPECT_EQ(found.height_px, height);
    EXPECT_EQ(found.frames, frames);
    EXPECT_EQ(found.channels, channels);
    EXPECT_EQ(found.frame_axis, frame_axis);
  };
  is(stack({40, 50}, 0, false), 50, 40, 1, 1, -1);
  is(stack({40, 50}, 0, true), 40, 50, 1, 1, -1);
  is(stack({40, 50, 3}, 0, false), 50, 40, 1, 3, -1);
  is(stack({40, 50, 3}, 3, false), 50, 40, 3, 1, 2);
  is(stack({3, 50, 40}, 0, true), 50, 40, 1, 3, -1);
  is(stack({7, 40, 50}, 0, false), 50, 40, 7, 1, 0);
  is(stack({40, 50, 7}, 0, false), 50, 40, 7, 1, 2);
  is(stack({70, 40, 50}, 70, false), 50, 40, 70, 1, 0);
  is(stack({7, 50, 40}, 7, true), 50, 40, 7, 1, 0);
  is(stack({40, 50, 3, 20}, 20, false), 50, 40, 20, 3, 3);
  is(stack({20, 40, 50, 3}, 20, false), 50, 40, 20, 3, 0);
  is(stack({20, 3, 50, 40}, 20, true), 50, 40, 20, 3, 0);
  expect_words(ErrorKind::unreadable_input, {"shapes", "three colours"}, [&] {
    stack({20, 40, 50, 4}, 0, false);
  });
  expect_words(ErrorKind::unreadable_input, {"shapes", "'a', 'b'"}, [] {
    find_images(Shapes({array_of("a", {4, 5}), array_of("b", {5, 4})}));
  });
  const ImageStack numbered =
      find_images(Shapes({array_of("frame10", {4, 5}), array_of("frame9", {4, 5}), array_of("b", {2, 4})}));
  EXPECT_EQ(numbered.arrays, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(numbered.frames, 2u);
  expect_words(ErrorKind::unreadable_input, {"shapes", "200000 images"}, [&] {
    stack({40, 50, 200000}, 200000, false);
  });
}

TEST(ArrayTimes, KnowTheClocksOfCdf) {
  EXPECT_EQ(cdf_epoch_seconds(62167219200000.0), 0.0);  // 1970-01-01 (NASA's CDF library)
  // 2017-01-01T00:00:00, behind its leap second, and a second before.
  EXPECT_NEAR(*tt2000_seconds(536500869184000000), 1483228800.0, 1e-6);
  EXPECT_NEAR(*tt2000_seconds(536500869184000000 - 2000000000), 1483228799.0, 1e-6);
  EXPECT_NEAR(*tt2000_seconds(0), 946728000.0 - 64.184, 1e-6);
  EXPECT_FALSE(cdf_epoch_seconds(-1e31));
}

}  // namespace
}  // namespace vegard::fit::array_frames_test
