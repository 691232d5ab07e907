#include "sim/base/picture/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/picture/exif_block.h"
#include "sim/base/picture/tiff_directory.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::image_io_test {
namespace {

using tests::bytes_of;
using tests::expect_error;
using tests::FullDisk;
using tests::put;
using tests::TemporaryFolder;

Image pattern(int width, int height, std::vector<std::string> names) {
  Image image(width, height, std::move(names));
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    image.data[i] = static_cast<float>(std::fmod(static_cast<double>(i) * 0.618033988749895, 1.0));
  }
  return image;
}

/// What another reader finds: the picture's own integers and its attributes.
struct Picture {
  OIIO::ImageSpec spec;
  std::vector<int> values;
};

Picture decoded(const std::string& path) {
  Picture picture;
  const auto input = OIIO::ImageInput::open(path);
  EXPECT_TRUE(input) << OIIO::geterror();
  if (!input) return picture;
  picture.spec = input->spec();
  std::vector<std::uint16_t> words(picture.spec.image_pixels() * picture.spec.nchannels);
  EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT16, words.data())) << input->geterror();
  // OpenImageIO widens a byte b to 257 b.
  const int step = picture.spec.format == OIIO::TypeDesc::UINT8 ? 257 : 1;
  for (const int word : words) picture.values.push_back(word / step);
  return picture;
}

TEST(ImageIo, AnExrComesBackBitForBit) {
  TemporaryFolder folder;
  Image image = pattern(37, 23, {"R", "G", "B"});
  image.at(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  image.at(1, 0, 0) = -std::numeric_limits<float>::infinity();
  image.at(2, 0, 0) = -0.25f;
  image.at(3, 0, 0) = std::numeric_limits<float>::denorm_min();
  const ImageAttributes attributes = {{"seed", "18446744073709551615"},
                                      {"scene", "seed = 1\n[site]\nlatitude_deg = 65.0 # Å\n"},
                                      {"version", "0.1.0"},
                                      {"name", "h000"},
                                      {"type", "aurora"},
                                      {"owner", "nobody"},
                                      {"ImageDescription", "an arc"}};
  write_exr(folder / "a.exr", image, attributes);
  const ExrFile back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.image.width, 37);
  EXPECT_EQ(back.image.height, 23);
  EXPECT_EQ(back.image.channel_names, image.channel_names);
  ASSERT_EQ(back.image.data.size(), image.data.size());
  EXPECT_EQ(std::memcmp(back.image.data.data(), image.data.data(), image.data.size() * sizeof(float)), 0);
  EXPECT_EQ(back.attributes, attributes);
}

TEST(ImageIo, AnExrHoldsTheChannelsOfSeveralImages) {
  TemporaryFolder folder;
  const Image colours = pattern(9, 7, {"R", "G", "B"});
  Image lines(9, 7, {"rayleigh.427.8", "rayleigh.557.7"});
  for (std::size_t i = 0; i < lines.data.size(); ++i) lines.data[i] = 1000.0f + static_cast<float>(i);
  write_exr(folder / "a.exr", std::vector<const Image*>{&colours, &lines}, {});
  const Image back = read_exr(folder / "a.exr").image;
  EXPECT_EQ(back.channel_names,
            (std::vector<std::string>{"R", "G", "B", "rayleigh.427.8", "rayleigh.557.7"}));
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 9; ++x) {
      for (int c = 0; c < 3; ++c) EXPECT_EQ(back.at(x, y, c), colours.at(x, y, c));
      for (int c = 0; c < 2; ++c) EXPECT_EQ(back.at(x, y, 3 + c), lines.at(x, y, c));
    }
  }
}

TEST(ImageIo, TheTimeIsTheScenesOrUnknown) {
  TemporaryFolder folder;
  const Image image = pattern(4, 4, {"R", "G", "B"});
  write_exr(folder / "dated.exr", image, {{"DateTime", "2019-09-05T10:11:12Z"}});
  EXPECT_EQ(read_exr(folder / "dated.exr").attributes.at("DateTime"), "2019:09:05 10:11:12");
  write_exr(folder / "undated.exr", image, {});
  EXPECT_TRUE(read_exr(folder / "undated.exr").attributes.empty());
  for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
    write_display(folder / name, image, 8, 90, {{"DateTime", "2019-09-05T10:11:12Z"}});
    EXPECT_EQ(decoded(folder / name).spec.get_string_attribute("DateTime"), "2019:09:05 10:11:12") << name;
  }
}

TEST(ImageIo, TheSameImageGivesTheSameBytesASecondLater) {
  TemporaryFolder first;
  std::filesystem::create_directory(first / "later");
  const Image image = pattern(70, 50, {"R", "G", "B"});
  const ImageAttributes attributes = {{"seed", "7"}};
  const std::vector<std::string> names = {"a.exr", "a.png", "a.tif", "a.jpg"};
  const auto write_all = [&](const std::string& prefix) {
    for (const std::string& name : names) {
      if (image_format(name) == ImageFormat::exr) {
        write_exr(first / (prefix + name), image, attributes);
      } else {
        write_display(first / (prefix + name), image, 8, 90, attributes);
      }
    }
  };
  write_all("");
  tests::await_next_second();
  write_all("later/");
  for (const std::string& name : names) {
    const std::string bytes = bytes_of(first / name);
    EXPECT_EQ(bytes, bytes_of(first / ("later/" + name))) << name;
    for (const char* trace : {"partial", "Software", "OpenImageIO", "/tmp", "image."}) {
      EXPECT_EQ(bytes.find(trace), std::string::npos) << name << " speaks of " << trace;
    }
  }
}

TEST(ImageIo, DisplayValuesAreRoundedToTheNearestStep) {
  TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const int bits : {8, 16}) {
    const int largest = (1 << bits) - 1;
    Image image(8, 1, {"Y"});
    const auto step = [&](double steps) { return static_cast<float>(steps / largest); };
    image.data = {0.0f, 1.0f, -0.5f, 1.5f, nan, step(100.0), step(100.4), step(100.6)};
    for (const char* name : {"a.png", "a.tif"}) {
      write_display(folder / name, image, bits, 0, {}, true);
      const Picture picture = decoded(folder / name);
      EXPECT_EQ(picture.spec.get_int_attribute("oiio:BitsPerSample",
                                               static_cast<int>(picture.spec.format.size() * 8)),
                bits);
      EXPECT_EQ(picture.values, (std::vector<int>{0, largest, 0, largest, 0, 100, 100, 101})) << name << bits;
    }
  }
}

TEST(ImageIo, EveryStepOfSixteenBitsSurvives) {
  TemporaryFolder folder;
  Image image(256, 256, {"Y"});
  for (int i = 0; i < 65536; ++i) image.data[static_cast<std::size_t>(i)] = static_cast<float>(i / 65535.0);
  write_display(folder / "a.png", image, 16, 0, {});
  const Picture picture = decoded(folder / "a.png");
  ASSERT_EQ(picture.values.size(), 65536u);
  for (int i = 0; i < 65536; ++i) ASSERT_EQ(picture.values[static_cast<std::size_t>(i)], i);
}

TEST(ImageIo, AJpegIsCloseAndKeepsColourSharp) {
  TemporaryFolder folder;
  Image image(64, 64, {"R", "G", "B"});
  for (int y = 0; y < 64; ++y) image.at(32, y, 1) = 1.0f;  // a green line, one pixel wide
  write_display(folder / "a.jpg", image, 8, 98, {});
  const Picture picture = decoded(folder / "a.jpg");
  ASSERT_EQ(picture.values.size(), image.data.size());
  EXPECT_NEAR(picture.values[image.index(32, 20, 1)], 255, 12);
  EXPECT_NEAR(picture.values[image.index(32, 20, 0)], 0, 12);
  EXPECT_NEAR(picture.values[image.index(30, 20, 1)], 0, 12);
}

TEST(ImageIo, PicturesKeepTheAttributesAsText) {
  TemporaryFolder folder;
  const Image image = pattern(8, 8, {"R", "G", "B"});
  const ImageAttributes attributes = {{"seed", "18446744073709551615"}, {"ImageDescription", "an arc"}};
  for (const char* name : {"a.tif", "a.jpg"}) {
    write_display(folder / name, image, 8, 90, attributes);
    EXPECT_EQ(decoded(folder / name).spec.get_string_attribute("ImageDescription"),
              "an arc\nseed=18446744073709551615");
  }
  write_display(folder / "a.png", image, 8, 90, attributes);
  EXPECT_EQ(decoded(folder / "a.png").spec.get_string_attribute("vegard:seed"), "18446744073709551615");
}

/// The PNG that OpenImageIO writes of integers that are in the file.
std::string png_by_openimageio(const std::string& path, const ImageAttributes& attributes) {
  const Picture picture = decoded(path);
  OIIO::ImageSpec spec(picture.spec.width, picture.spec.height, picture.spec.nchannels, picture.spec.format);
  spec.attribute("DateTime", "2019:09:05 10:11:12");
  spec.attribute("oiio:ColorSpace", "sRGB");
  for (const auto& [key, value] : attributes)
    if (key != "DateTime") spec.attribute(key == "ImageDescription" ? key : "vegard:" + key, value);
  const int step = picture.spec.format == OIIO::TypeDesc::UINT8 ? 257 : 1;
  std::vector<std::uint16_t> words;
  for (const int value : picture.values) words.push_back(static_cast<std::uint16_t>(value * step));
  OIIO::Filesystem::IOVecOutput memory;
  const auto output = OIIO::ImageOutput::create("a.png");
  EXPECT_TRUE(output && output->set_ioproxy(&memory) && output->open("a.png", spec) &&
              output->write_image(OIIO::TypeDesc::UINT16, words.data()) && output->close());
  return {memory.buffer().begin(), memory.buffer().end()};
}

TEST(ImageIo, APngIsWhatOpenImageIoWrites) {
  TemporaryFolder folder;
  const ImageAttributes attributes = {{"DateTime", "2019-09-05T10:11:12Z"},
                                      {"ImageDescription", "an arc"},
                                      {"scene", std::string(20000, 'x') + " # Å\n"},
                                      {"seed", "18446744073709551615"},
                                      {std::string(90, 'k'), "longer than a key may be"}};
  for (const auto& names : {std::vector<std::string>{"Y"}, std::vector<std::string>{"R", "G", "B"}})
    for (const int bits : {8, 16}) {
      write_display(folder / "a.png", pattern(217, 101, names), bits, 0, attributes, true);
      EXPECT_EQ(bytes_of(folder / "a.png"), png_by_openimageio(folder / "a.png", attributes)) << bits;
    }
}

/// Its words stand in EXIF, where other programs look for them; no character of long ones is cut.
TEST(ImageIo, AJpegsWordsAreItsExif) {
  TemporaryFolder folder;
  std::string many_characters = "x";
  while (many_characters.size() < 40000) many_characters += "\xc3\xa5";
  for (const std::string& words :
       {std::string("x"), std::string("xyz"), std::string("an arc"), many_characters}) {
    write_display(folder / "a.jpg", pattern(300, 200, {"R", "G", "B"}), 8, 98,
                  {{"DateTime", "2019-09-05T10:11:12Z"}, {"ImageDescription", words}}, true);
    const std::string bytes = bytes_of(folder / "a.jpg");
    const std::string_view tiff = find_exif_block(bytes).tiff;
    const TiffDirectory exif(tiff);
    EXPECT_EQ(exif.text(306), "2019:09:05 10:11:12");
    const std::string kept = words.size() > 30000 ? words.substr(0, 29999) : words;
    EXPECT_NE(tiff.find(kept + std::string(1, '\0')), std::string_view::npos);
    EXPECT_TRUE(exif.text(270).has_value());
    EXPECT_EQ(decoded(folder / "a.jpg").values.size(), 180000u);
    EXPECT_TRUE(exif.complete() && exif.inside());
  }
}

TEST(ImageIo, EmptyAttributesAreLeftOut) {
  TemporaryFolder folder;  // a description of no words
  const Image image = pattern(8, 8, {"R", "G", "B"});
  const ImageAttributes attributes = {{"DateTime", ""}, {"ImageDescription", ""}, {"scene", ""}};
  write_exr(folder / "a.exr", image, attributes);
  EXPECT_TRUE(read_exr(folder / "a.exr").attributes.empty());
  for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
    write_display(folder / name, image, 8, 90, attributes);
    EXPECT_EQ(decoded(folder / name).spec.get_string_attribute("ImageDescription"), "") << name;
  }
}

TEST(ImageIo, ALongSceneDoesNotEndTheProcess) {
  TemporaryFolder folder;  // libjpeg calls exit() for a comment above 64 kB
  const Image image = pattern(8, 8, {"R", "G", "B"});
  const ImageAttributes attributes = {{"scene", std::string(200000, 'x')}};
  write_exr(folder / "a.exr", image, attributes);
  EXPECT_EQ(read_exr(folder / "a.exr").attributes, attributes);
  for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
    write_display(folder / name, image, 8, 90, attributes);
    EXPECT_EQ(decoded(folder / name).values.size(), 192u);
  }
}

TEST(ImageIo, AnExrCutAnywhereIsUnreadable) {
  TemporaryFolder folder;
  const Image image = pattern(40, 40, {"R", "G", "B"});
  write_exr(folder / "a.exr", image, {{"seed", "1"}});
  const std::string bytes = bytes_of(folder / "a.exr");
  for (std::size_t length = 0; length < bytes.size(); length += 97) {
    put(folder / "cut.exr", bytes.substr(0, length));
    expect_error(ErrorKind::unreadable_input, [&] { read_exr(folder / "cut.exr"); });
  }
  put(folder / "cut.exr", bytes.substr(0, bytes.size() - 1));
  expect_error(ErrorKind::unreadable_input, [&] { read_exr(folder / "cut.exr"); });
}

TEST(ImageIo, WhatIsNoExrIsUnreadable) {
  TemporaryFolder folder;
  const auto kind = ErrorKind::unreadable_input;
  expect_error(kind, [&] { read_exr(folder / "missing.exr"); });
  std::filesystem::create_directory(folder / "folder.exr");
  expect_error(kind, [&] { read_exr(folder / "folder.exr"); });
  put(folder / "text.exr", "not a picture at all");
  expect_error(kind, [&] { read_exr(folder / "text.exr"); });
  write_display(folder / "a.png", pattern(8, 8, {"R", "G", "B"}), 8, 0, {});
  std::filesystem::rename(folder / "a.png", folder / "png.exr");
  expect_error(kind, [&] { read_exr(folder / "png.exr"); });
}

TEST(ImageIo, WhatIsWrongWithAnExrInMemoryIsSaidOfTheUsersFile) {
  TemporaryFolder folder;
  write_exr(folder / "a.exr", pattern(8, 8, {"R", "G", "B"}), {});
  const std::string bytes = bytes_of(folder / "a.exr");
  for (const std::size_t length : {std::size_t{3}, std::size_t{40}, bytes.size() / 2, bytes.size() - 1}) {
    const std::string message = expect_error(ErrorKind::unreadable_input, [&] {
      read_exr_bytes(std::string_view(bytes).substr(0, length), "night/mine.exr");
    });
    EXPECT_NE(message.find("night/mine.exr"), std::string::npos) << message;
    EXPECT_EQ(message.find("image.exr"), std::string::npos) << message;
  }
}

TEST(ImageIo, ASizeBeyondAnyMemoryIsRefusedUnread) {
  TemporaryFolder folder;
  write_exr(folder / "a.exr", pattern(8, 8, {"R", "G", "B"}), {});
  std::string bytes = bytes_of(folder / "a.exr");
  for (const char* window : {"dataWindow", "displayWindow"}) {
    // Name, type "box2i", size 4: then xmin ymin xmax ymax.
    const std::size_t corner =
        bytes.find(window) + std::strlen(window) + 1 + std::strlen("box2i") + 1 + 4 + 8;
    const std::int32_t largest[2] = {999999, 999999};
    std::memcpy(&bytes[corner], largest, sizeof largest);
  }
  put(folder / "a.exr", bytes);
  expect_error(ErrorKind::unreadable_input, [&] { read_exr(folder / "a.exr"); });
}

/// A picture of some other program's, in the file's own numbers.
void put_picture(const std::string& path, const OIIO::ImageSpec& spec,
                 const std::vector<std::uint16_t>& values) {
  const auto output = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(output && output->open(path, spec) &&
              output->write_image(OIIO::TypeDesc::UINT16, values.data()) && output->close())
      << OIIO::geterror();
}

TEST(ImageIo, APictureIsReadAsItsOwnNumbers) {
  TemporaryFolder folder;
  const Image image = pattern(37, 23, {"R", "G", "B"});
  for (const int bits : {8, 16}) {
    for (const char* name : {"a.png", "a.tif"}) {
      write_display(folder / name, image, bits, 0, {}, true);
      const PictureFile file = read_picture(folder / name);
      EXPECT_FALSE(file.floating);
      ASSERT_EQ(file.image.channel_names, image.channel_names) << name;
      ASSERT_EQ(file.image.data.size(), image.data.size());
      const double half_step = 0.5 / ((1 << bits) - 1) + 1e-7;
      for (std::size_t i = 0; i < image.data.size(); ++i)
        ASSERT_NEAR(file.image.data[i], image.data[i], half_step);
    }
  }
  write_exr(folder / "a.exr", image, {});
  EXPECT_TRUE(read_picture(folder / "a.exr").floating);
  EXPECT_EQ(read_picture(folder / "a.exr").image.data, image.data);
  write_display(folder / "grey.png", pattern(5, 4, {"Y"}), 8, 0, {});
  EXPECT_EQ(read_picture(folder / "grey.png").image.channel_names, std::vector<std::string>{"Y"});
}

TEST(ImageIo, APictureKeepsItsAlphaApartFromItsColour) {
  TemporaryFolder folder;
  for (const char* name : {"a.png", "a.tif"}) {
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT16);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    put_picture(folder / name, spec, {65535, 32768, 0, 16384, 65535, 65535, 65535, 0});
    const PictureFile file = read_picture(folder / name);
    ASSERT_EQ(file.image.channel_names, (std::vector<std::string>{"R", "G", "B", "A"})) << name;
    EXPECT_FALSE(file.colour_times_alpha) << name;
    EXPECT_NEAR(file.image.at(0, 0, 0), 1.0, 1e-4) << name;
    EXPECT_NEAR(file.image.at(0, 0, 1), 0.5, 1e-4) << name;
    EXPECT_NEAR(file.image.at(0, 0, 3), 0.25, 1e-4) << name;
    EXPECT_EQ(file.image.at(1, 0, 3), 0.0f) << name;
  }
  const Image colours = pattern(3, 3, {"R", "G", "B", "A", "sky.R"});
  write_exr(folder / "a.exr", colours, {});
  const PictureFile exr = read_picture(folder / "a.exr");
  EXPECT_TRUE(exr.colour_times_alpha) << "as EXR has it";
  EXPECT_EQ(exr.image.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(exr.image.at(1, 1, 3), colours.at(1, 1, 3));
}

TEST(ImageIo, APictureStandsUpright) {
  TemporaryFolder folder;
  // Stored as two rows of three; EXIF 2.3, tag 274: where its first row and column belong.
  const std::vector<std::uint16_t> stored = {0, 13107, 26214, 39321, 52428, 65535};  // 0, 0.2 … 1
  const std::vector<std::vector<int>> upright = {{0, 1, 2, 3, 4, 5}, {2, 1, 0, 5, 4, 3}, {5, 4, 3, 2, 1, 0},
                                                 {3, 4, 5, 0, 1, 2}, {0, 3, 1, 4, 2, 5}, {3, 0, 4, 1, 5, 2},
                                                 {5, 2, 4, 1, 3, 0}, {2, 5, 1, 4, 0, 3}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    OIIO::ImageSpec spec(3, 2, 1, OIIO::TypeDesc::UINT16);
    spec.attribute("Orientation", orientation);
    put_picture(folder / "a.tif", spec, stored);
    const Image image = read_picture(folder / "a.tif").image;
    ASSERT_EQ(image.width, orientation < 5 ? 3 : 2) << orientation;
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(image.data[i], 0.2 * upright[orientation - 1][i], 1e-6) << orientation << " at " << i;
  }
}

TEST(ImageIo, APictureCutAnywhereIsUnreadable) {
  TemporaryFolder folder;
  const Image image = pattern(40, 40, {"R", "G", "B"});
  write_exr(folder / "a.exr", image, {});
  for (const char* name : {"a.png", "a.tif", "a.jpg"}) write_display(folder / name, image, 8, 90, {});
  for (const std::string kind : {"exr", "png", "tif", "jpg"}) {
    const std::string bytes = bytes_of(folder / ("a." + kind));
    for (std::size_t length = 0; length < bytes.size(); length += 97) {
      put(folder / ("cut." + kind), bytes.substr(0, length));
      expect_error(ErrorKind::unreadable_input, [&] { read_picture(folder / ("cut." + kind)); });
    }
    put(folder / ("cut." + kind), bytes.substr(0, bytes.size() - 1));
    expect_error(ErrorKind::unreadable_input, [&] { read_picture(folder / ("cut." + kind)); });
  }
}

TEST(ImageIo, WhatIsNoPictureIsUnreadable) {
  TemporaryFolder folder;
  const auto kind = ErrorKind::unreadable_input;
  std::filesystem::create_directory(folder / "folder.png");
  put(folder / "text.jpg", "not a picture at all");
  put(folder / "a.bmp", "of another kind");
  Image infinite = pattern(4, 4, {"R", "G", "B"});
  infinite.at(2, 2, 1) = std::numeric_limits<float>::infinity();
  write_exr(folder / "infinite.exr", infinite, {});
  write_exr(folder / "colourless.exr", pattern(4, 4, {"rayleigh.5577", "rayleigh.6300"}), {});
  write_display(folder / "a.png", pattern(8, 8, {"R", "G", "B"}), 8, 0, {});
  std::filesystem::rename(folder / "a.png", folder / "png.jpg");
  for (const char* name :
       {"missing.png", "folder.png", "text.jpg", "a.bmp", "infinite.exr", "colourless.exr", "png.jpg"})
    EXPECT_NE(expect_error(kind, [&] { read_picture(folder / name); }).find(name), std::string::npos);
}

TEST(ImageIo, AWrongFormatIsAUsageError) {
  TemporaryFolder folder;
  const Image image = pattern(8, 8, {"R", "G", "B"});
  const auto kind = ErrorKind::usage;
  EXPECT_EQ(image_format("A.TIFF"), ImageFormat::tiff);
  EXPECT_EQ(image_format("a.b/c.JPEG"), ImageFormat::jpeg);
  expect_error(kind, [&] { write_display(folder / "a.bmp", image, 8, 90, {}); });
  expect_error(kind, [&] { write_display(folder / "a", image, 8, 90, {}); });
  expect_error(kind, [&] { write_display(folder / "a.exr", image, 8, 90, {}); });
  expect_error(kind, [&] { write_display(folder / "a.jpg", image, 16, 90, {}); });
  expect_error(kind, [&] { write_display(folder / "a.jpg", image, 8, 0, {}); });
  expect_error(kind, [&] { write_display(folder / "a.png", image, 12, 90, {}); });
  expect_error(kind, [&] { write_display(folder / "a.jpg", Image(65501, 1, {"Y"}), 8, 90, {}); });
  expect_error(kind, [&] { write_exr(folder / "a.png", image, {}); });
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ImageIo, AFullDiskLeavesNothing) {
  TemporaryFolder folder;
  const Image image = pattern(200, 200, {"R", "G", "B"});
  {
    FullDisk full(2000);
    const auto kind = ErrorKind::unwritable_output;
    expect_error(kind, [&] { write_exr(folder / "a.exr", image, {}); });
    for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
      expect_error(kind, [&] { write_display(folder / name, image, 8, 90, {}); });
    }
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ImageIo, AMissingFolderAndAnExistingFileAreToldApart) {
  TemporaryFolder folder;
  const Image image = pattern(8, 8, {"R", "G", "B"});
  expect_error(ErrorKind::unwritable_output, [&] { write_exr(folder / "no/a.exr", image, {}); });
  expect_error(ErrorKind::unwritable_output, [&] { write_display(folder / "no/a.png", image, 8, 0, {}); });
  write_exr(folder / "a.exr", image, {});
  write_display(folder / "a.png", image, 8, 0, {});
  const std::string old = bytes_of(folder / "a.png");
  expect_error(ErrorKind::existing_output, [&] { write_exr(folder / "a.exr", image, {}); });
  expect_error(ErrorKind::existing_output, [&] { write_display(folder / "a.png", image, 16, 0, {}); });
  EXPECT_EQ(bytes_of(folder / "a.png"), old);
  write_display(folder / "a.png", image, 16, 0, {}, true);
  EXPECT_NE(bytes_of(folder / "a.png"), old);
}

}  // namespace
}  // namespace vegard::sim::image_io_test
