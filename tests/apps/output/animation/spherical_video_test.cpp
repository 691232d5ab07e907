// A movie of a panorama, taken apart: both of the ways in which it tells what it is, and nothing else
// changed.

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "apps/output/animation/movie.h"
#include "sim/base/error.h"
#include "sim/base/image.h"
#include "sim/base/picture/image_io.h"
#include "tests/support/temporary_folder.h"

namespace vegard::apps::spherical_video_test {
namespace {

std::string bytes_in(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

std::uint32_t number(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value * 256 + static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

/// The contents of the boxes of a type in a row of boxes, which must fill it exactly.
std::vector<std::string> boxes(const std::string& bytes, const std::string& type) {
  std::vector<std::string> found;
  std::size_t at = 0;
  while (at < bytes.size()) {
    const std::uint32_t size = number(bytes, at);
    EXPECT_GE(size, 8u);
    EXPECT_LE(at + size, bytes.size());
    if (size < 8 || at + size > bytes.size()) break;
    if (bytes.substr(at + 4, 4) == type) found.push_back(bytes.substr(at + 8, size - 8));
    at += size;
  }
  EXPECT_EQ(at, bytes.size()) << type;
  return found;
}

std::string one_box(const std::string& bytes, const std::string& type) {
  const std::vector<std::string> found = boxes(bytes, type);
  EXPECT_EQ(found.size(), 1u) << type;
  return found.empty() ? std::string() : found.front();
}

class PanoramaMovie : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<std::string> frames;
    for (int frame = 0; frame < 4; ++frame) {
      sim::Image picture(64, 32, {"R", "G", "B"});
      for (std::size_t i = 0; i < picture.data.size(); ++i)
        picture.data[i] = static_cast<float>((i * 7 + frame * 50) % 256) / 255.0f;
      frames.push_back(folder / (std::to_string(frame) + ".png"));
      sim::write_display(frames.back(), picture, 8, 92, {});
    }
    write_movie(folder / "flat.mp4", frames, 25.0, false);
    write_movie(folder / "around.mp4", frames, 25.0, false, {}, nullptr, true);
  }
  tests::TemporaryFolder folder;
};

TEST_F(PanoramaMovie, SaysSoInBothVersionsOfSphericalVideo) {
  const std::string track = one_box(one_box(bytes_in(folder / "around.mp4"), "moov"), "trak");
  // Version 1: an XML text behind the box's identifier.
  const std::string uuid = one_box(track, "uuid");
  const std::string identifier = "\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd";
  ASSERT_EQ(uuid.substr(0, 16), identifier);
  const std::string xml = uuid.substr(16);
  for (const char* element :
       {"<rdf:SphericalVideo", "<GSpherical:Spherical>true</GSpherical:Spherical>",
        "<GSpherical:Stitched>true</GSpherical:Stitched>", "<GSpherical:StitchingSoftware>vegard ",
        "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>", "</rdf:SphericalVideo>"})
    EXPECT_NE(xml.find(element), std::string::npos) << element;
  // Version 2: behind the other boxes of the description of the samples, which has 78 bytes before them.
  const std::string table = one_box(one_box(one_box(track, "mdia"), "minf"), "stbl");
  const std::string descriptions = one_box(table, "stsd");
  ASSERT_EQ(number(descriptions, 4), 1u);
  const std::string format = descriptions.substr(12, 4);
  const std::string parts = one_box(descriptions.substr(8), format).substr(78);
  EXPECT_EQ(one_box(parts, "st3d"), std::string(5, '\0'));  // version, flags, no stereo
  const std::string sphere = one_box(parts, "sv3d");
  EXPECT_EQ(one_box(sphere, "svhd").substr(4, 7), "vegard ");
  const std::string projection = one_box(sphere, "proj");
  EXPECT_EQ(one_box(projection, "prhd"), std::string(16, '\0'));  // yaw, pitch and roll 0
  EXPECT_EQ(one_box(projection, "equi"), std::string(20, '\0'));  // nothing cut off
}

TEST_F(PanoramaMovie, HasTheSamePictures) {
  const std::string flat = bytes_in(folder / "flat.mp4"), around = bytes_in(folder / "around.mp4");
  const std::size_t begin = flat.find("moov") - 4;
  EXPECT_EQ(around.substr(0, begin), flat.substr(0, begin));
  EXPECT_EQ(flat.find("sv3d"), std::string::npos);
  cv::VideoCapture one(folder / "flat.mp4", cv::CAP_FFMPEG), other(folder / "around.mp4", cv::CAP_FFMPEG);
  ASSERT_TRUE(one.isOpened() && other.isOpened());
  cv::Mat here, there;
  int frames = 0;
  for (; one.read(here) && other.read(there); ++frames) EXPECT_EQ(cv::norm(here, there, cv::NORM_INF), 0.0);
  EXPECT_EQ(frames, 4);
}

TEST(SphericalMoov, RefusesWhatIsNone) {
  for (const std::string& bytes :
       {std::string(), std::string("moov"), std::string("\0\0\0\x08moov", 8),
        std::string("\0\0\xff\x08moov", 8), std::string("\0\0\0\x10moov\0\0\0\x04trak", 16),
        std::string("\0\0\0\x10moov\0\0\0\x08trak", 16)})
    EXPECT_THROW(spherical_moov(bytes, "movie.mp4"), sim::Error);
}

}  // namespace
}  // namespace vegard::apps::spherical_video_test
