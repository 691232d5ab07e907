// Every format against every fault: cut at each eighth, headers that lie about size, bits and channels, one
// pixel, none, and a name of another format. Each fault is one error about the file; nothing else comes out.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "fit/photo/codec/picture_format.h"
#include "fit/photo/photo.h"
#include "sim/base/picture/image_io.h"
#include "tests/support/dng_bytes.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/image_bytes.h"
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::bad_picture_files_test {
namespace {

using tests::big_endian;
using tests::little_endian;

struct Lie {
  std::string about, bytes, words;  ///< `words`: what the message says
};

struct Format {
  std::string name, whole;
  std::function<std::string(int, int)> claiming;  ///< the same file, but with this size in its header
  std::vector<Lie> lies;
  std::string one_pixel;        ///< a sound file of one pixel; empty: there is none, or it is refused
  std::string least = "0 x 0";  ///< what is said of no pixels
};

std::string replaced(std::string bytes, std::size_t at, const std::string& piece) {
  EXPECT_LE(at + piece.size(), bytes.size());
  return bytes.replace(at, piece.size(), piece);
}

Format jpeg() {
  const std::string whole = tests::jpeg_of_blocks(2, 2, {50, 100, 150, 200});
  const std::size_t frame = whole.find("\xff\xc0") + 4;  // bits, height, width, components
  const auto claiming = [=](int width, int height) {
    return replaced(whole, frame + 1, big_endian(height, 2) + big_endian(width, 2));
  };
  const std::string one = tests::jpeg_of_blocks(1, 1, {50});
  return {"JPEG",
          whole,
          claiming,
          {{"bits", replaced(whole, frame, big_endian(12, 1)), "12 bits"},
           {"channels", replaced(whole, frame + 5, big_endian(9, 1)), "cannot be decoded"},
           {"channels", replaced(whole, frame + 5, big_endian(0, 1)), "cannot be decoded"}},
          replaced(one, one.find("\xff\xc0") + 5, big_endian(1, 2) + big_endian(1, 2))};
}

Format png() {
  const std::string whole = tests::png(3, 2, 3, 8, std::vector<int>(18, 90));
  const auto header = [=](int width, int height, int bits, int colours) {
    const std::string chunk =
        tests::png_chunk("IHDR", big_endian(width, 4) + big_endian(height, 4) + big_endian(bits, 1) +
                                     big_endian(colours, 1) + std::string(3, '\0'));
    return replaced(whole, 8, chunk);
  };
  return {"PNG",
          whole,
          [=](int width, int height) { return header(width, height, 8, 2); },
          {{"size", header(300, 200, 8, 2), "cannot be decoded"},
           {"bits", header(3, 2, 3, 2), "cannot be decoded"},
           {"bits", header(3, 2, 16, 2), "cannot be decoded"},
           {"channels", header(3, 2, 8, 5), "cannot be decoded"}},
          tests::png(1, 1, 3, 8, {1, 2, 3})};
}

Format tiff() {
  tests::Tiff t;
  t.width = 3, t.height = 2;
  const std::vector<double> samples(18, 90.0);
  const auto with = [=](auto change) {
    tests::Tiff lying = t;
    change(lying);
    return tests::tiff(lying, samples);
  };
  const auto claiming = [=](int width, int height) {
    return with([=](tests::Tiff& lying) { lying.width = width, lying.height = height; });
  };
  // As many bytes of pixels as before, by the header's own count of them.
  std::string sixteen = tests::tiff(t, samples);
  sixteen = replaced(sixteen, sixteen.size() - 18 - 12,
                     little_endian(16, 2) + little_endian(16, 2) + little_endian(16, 2));
  tests::Tiff one = t;
  one.width = one.height = 1;
  return {"TIFF",
          tests::tiff(t, samples),
          claiming,
          {{"size", claiming(300, 200), "cannot be decoded"},
           {"bits", sixteen, "cannot be decoded"},
           {"bits", with([](tests::Tiff& lying) { lying.bits = 24; }), "24-bit"},
           {"channels", with([](tests::Tiff& lying) { lying.channels = 9; }), "9 samples"}},
          tests::tiff(one, {1, 2, 3})};
}

Format pnm() {
  const auto claiming = [](int width, int height) {
    return "P6 " + std::to_string(width) + " " + std::to_string(height) + " 255\n" + std::string(18, 'a');
  };
  return {"PPM",
          claiming(3, 2),
          claiming,
          {{"size", claiming(300, 200), "truncated"},
           {"bits", "P6 3 2 65535\n" + std::string(18, 'a'), "truncated"},
           {"bits", "P6 3 2 65536\n" + std::string(18, 'a'), "65536"},
           {"channels", "P8 3 2 255\n" + std::string(18, 'a'), "no image"}},
          "P6 1 1 255\nabc"};
}

std::string exr_of(int width, int height, const std::vector<std::string>& channels) {
  sim::Image image(width, height, channels);
  for (float& value : image.data) value = 0.25f;
  return sim::encode_exr({&image}, {{"units", "what they are"}});
}

Format exr() {
  const std::string whole = exr_of(3, 2, {"R", "G", "B"});
  // Behind the name and the type of the attribute, each with its end, and the size of its value.
  const std::size_t window = whole.find("dataWindow") + 11 + 6 + 4;
  const std::size_t words = whole.find("vegard:units") + 13 + 7;
  const std::size_t channel = whole.find("chlist") + 7 + 4 + 2;  // type of the first, behind its name
  const auto claiming = [=](int width, int height) {
    return replaced(whole, window + 8, little_endian(width - 1, 4) + little_endian(height - 1, 4));
  };
  return {"EXR",
          whole,
          claiming,
          {{"size", claiming(300, 200), "it: "},
           {"size of a text", replaced(whole, words, little_endian(0x7fffffff, 4)), "truncated"},
           {"bits", replaced(whole, channel, little_endian(9, 4)), "it: "},
           {"channels", exr_of(3, 2, {"a.b", "c.d"}), "no picture"}},
          exr_of(1, 1, {"R", "G", "B"})};
}

Format fits() {
  const auto claiming = [](int width, int height) {
    return tests::fits_header(16, {width, height}) + std::string(2880, '\0');
  };
  const std::vector<double> values(60 * 24, 7.0);  // a block
  const auto bits = [=](int bitpix) {
    return tests::fits_header(bitpix, {60, 24}) + tests::fits_block(tests::fits_numbers(16, values), '\0');
  };
  return {
      "FITS",
      tests::fits_image(16, {60, 24}, values),
      claiming,
      {{"size", claiming(300, 200), "truncated"},
       {"bits", bits(12), "cannot be read"},
       {"channels", tests::fits_image(16, {60, 24, 2}, std::vector<double>(2 * 60 * 24, 7.0)), "2 planes"},
       {"channels", tests::fits_header(16, {60, 24, 1000000000}), "planes"}},
      tests::fits_image(16, {1, 1}, {7.0})};
}

Format raw() {
  tests::Dng d;
  const std::vector<int> sites(static_cast<std::size_t>(d.width) * d.height, 5000);
  const std::string whole = tests::dng(d, sites);
  // Behind the tag, the type and the count.
  const auto value_of = [=](int tag, int type) {
    return whole.find(little_endian(tag, 2) + little_endian(type, 2) + little_endian(1, 4)) + 8;
  };
  const std::size_t bits = value_of(258, 3), samples = value_of(277, 3);
  const auto claiming = [=](int width, int height) {
    return replaced(replaced(whole, value_of(256, 4), little_endian(width, 4)), value_of(257, 4),
                    little_endian(height, 4));
  };
  return {"camera raw",
          whole,
          claiming,
          {{"size", claiming(300, 200), "it: "},
           {"bits", replaced(whole, bits, little_endian(77, 2)), "it: "},
           {"channels", replaced(whole, samples, little_endian(9, 2)), "9 samples"}},
          "",
          "it: "};
}

Format heic() {
  const std::string whole = tests::bytes_of(tests::source_folder() + "/tests/data/quarters.heic");
  const auto claiming = [=](int width, int height) {
    std::string lying = whole;
    for (std::size_t at = lying.find("ispe"); at != std::string::npos; at = lying.find("ispe", at + 1))
      lying = replaced(lying, at + 8, big_endian(width, 4) + big_endian(height, 4));
    return lying;
  };
  return {"HEIC",
          whole,
          claiming,
          {{"size", claiming(65, 32), "another size in its stream"},
           {"size", claiming(3000, 2000), "another size in its stream"}},
          ""};
}

std::vector<Format> formats() { return {jpeg(), png(), tiff(), pnm(), exr(), fits(), raw(), heic()}; }

Photo read(const std::string& bytes) { return read_photo_bytes(bytes, "it", Decoding::automatic); }

std::string refusal(const std::string& bytes) {
  return tests::expect_error(sim::ErrorKind::unreadable_input, [&] { read(bytes); });
}

void says(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << text;
  EXPECT_EQ(text.rfind("it: ", 0), 0u) << text;
}

TEST(BadPictureFiles, CutAtEveryEighth) {
  for (const Format& format : formats()) {
    EXPECT_GT(read(format.whole).linear.width, 0) << format.name;
    for (std::size_t eighth = 0; eighth < 8; ++eighth) {
      SCOPED_TRACE(format.name + ", " + std::to_string(eighth) + "/8");
      says(refusal(format.whole.substr(0, format.whole.size() * eighth / 8)), "it: ");
    }
  }
}

// 40 000 x 40 000 pixels are 19 GB as three channels of floats. That it is the limit which speaks, and not
// the memory that could not be had, shows that none was asked for.
TEST(BadPictureFiles, AHeaderOfFortyThousandSquared) {
  for (const Format& format : formats()) {
    SCOPED_TRACE(format.name);
    const std::string text = refusal(format.claiming(40000, 40000));
    says(text, "the image claims 40000 x 40000 pixels");
    says(text, "at most 2^28 in all");
  }
}

TEST(BadPictureFiles, NoPixels) {
  for (const Format& format : formats()) {
    SCOPED_TRACE(format.name);
    says(refusal(format.claiming(0, 0)), format.least);
  }
}

TEST(BadPictureFiles, LiesAboutSizeBitsAndChannels) {
  for (const Format& format : formats())
    for (const Lie& lie : format.lies) {
      SCOPED_TRACE(format.name + ", " + lie.about);
      says(refusal(lie.bytes), lie.words);
    }
}

// 60 000 boxes, each inside the one before, once took the whole stack.
TEST(BadPictureFiles, BoxesInsideBoxes) {
  constexpr std::size_t kBoxes = 60000, kEach = 12;
  std::string bytes = tests::big_endian(16, 4) + "ftypheic" + std::string(4, '\0');
  for (std::size_t i = 0; i < kBoxes; ++i)
    bytes += tests::big_endian(kEach * (kBoxes - i), 4) + "meta" + std::string(4, '\0');
  says(refusal(bytes), "boxes inside boxes");
}

TEST(BadPictureFiles, OnePixelIsAPicture) {
  for (const Format& format : formats()) {
    if (format.one_pixel.empty()) continue;  // LibRaw takes none below 22 pixels; no HEIC of one is at hand
    SCOPED_TRACE(format.name);
    const Photo photo = read(format.one_pixel);
    EXPECT_EQ(photo.linear.width, 1);
    EXPECT_EQ(photo.linear.height, 1);
    EXPECT_EQ(photo.usable.size(), 3u);
  }
}

TEST(BadPictureFiles, AFileIsKnownByItsContents) {
  const tests::TemporaryFolder folder;
  const std::vector<std::string> endings = {".png", ".tif", ".fits", ".exr", ".jpg", ".pgm", ".heic", ".dng"};
  for (const Format& format : formats()) {
    SCOPED_TRACE(format.name);
    const std::vector<float> right = read(format.whole).linear.data;
    for (const std::string& ending : endings) {
      const std::string path = folder / ("picture" + ending);
      tests::put(path, format.whole);
      EXPECT_EQ(read_photo(path, Decoding::automatic).linear.data, right) << ending;
    }
  }
}

// Bytes that are missing out of the middle of a JPEG leave too few blocks for its last rows, which libjpeg
// fills up with a warning.
TEST(BadPictureFiles, AJpegWithBytesMissingIsRefused) {
  const tests::TemporaryFolder folder;
  const std::string whole = tests::bytes_of(tests::source_folder() + "/data/examples/h000/photo.jpg");
  constexpr std::size_t kMissing = 200;
  for (std::size_t at = whole.size() / 3; at + 2 * kMissing < whole.size(); at += whole.size() / 12) {
    tests::put(folder / "cut.jpg", whole.substr(0, at) + whole.substr(at + kMissing));
    tests::expect_error(sim::ErrorKind::unreadable_input,
                        [&] { read_photo(folder / "cut.jpg", Decoding::automatic); });
  }
}

// What is left over behind the last block is filling, or belongs to a picture of which bytes are missing.
TEST(BadPictureFiles, AJpegWithDataLeftOverIsRefused) {
  const tests::TemporaryFolder folder;
  const std::string whole = tests::bytes_of(tests::source_folder() + "/data/examples/h000/photo.jpg");
  const std::size_t end = whole.size() - 2;
  const auto with = [&](const std::string& left_over) {
    tests::put(folder / "left.jpg", whole.substr(0, end) + left_over + whole.substr(end));
    return read_photo(folder / "left.jpg", Decoding::automatic).linear.data;
  };
  EXPECT_EQ(with(std::string(5, '\0')), with(""));
  tests::expect_error(sim::ErrorKind::unreadable_input, [&] { with("\x45\x12\x33\x45\x12\x33\x01\x02"); });
  // Strays before the tables, as some webcams leave them, and what phones append are none of the picture's.
  const std::size_t tables = whole.find("\xff\xdb");
  ASSERT_NE(tables, std::string::npos);
  for (const std::string& sound :
       {whole.substr(0, tables) + "\x12\x34" + whole.substr(tables), whole + whole.substr(0, 5000)}) {
    tests::put(folder / "left.jpg", sound);
    EXPECT_EQ(read_photo(folder / "left.jpg", Decoding::automatic).linear.data, with(""));
  }
}

}  // namespace
}  // namespace vegard::fit::bad_picture_files_test
