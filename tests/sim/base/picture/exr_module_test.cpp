// EXRs by OpenEXR alone against those of OpenImageIO, by which other programs write and read them.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/module.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/image_io/picture_codecs.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::exr_module_test {
namespace {

using tests::bytes_of;
using tests::TemporaryFolder;

/// Of 1 / 4096, which halves hold, and no two neighbours alike.
Image numbers(int width, int height, std::vector<std::string> names) {
  Image image(width, height, std::move(names));
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = static_cast<float>(i * 1237 % 2048) / 4096.0f;
  return image;
}

/// By OpenImageIO, of floats; `set` adds to the picture's description.
template <typename Set>
std::string exr_by_openimageio(const Image& image, const Set& set) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels(), OIIO::TypeDesc::FLOAT);
  spec.channelnames = image.channel_names;
  spec.attribute("compression", "zip");
  set(spec);
  OIIO::Filesystem::IOVecOutput memory;
  const auto output = OIIO::ImageOutput::create("a.exr");
  EXPECT_TRUE(output && output->set_ioproxy(&memory) && output->open("a.exr", spec) &&
              output->write_image(OIIO::TypeDesc::FLOAT, image.data.data()) && output->close());
  return {memory.buffer().begin(), memory.buffer().end()};
}

TEST(ExrModule, WritesWhatOpenImageIoWrites) {
  TemporaryFolder folder;
  const Image image = numbers(217, 101, {"R", "G", "B", "rayleigh.5577", "A"});
  write_exr(folder / "a.exr", image,
            {{"DateTime", "2019-09-05T10:11:12Z"},
             {"ImageDescription", "an arc"},
             {"scene", std::string(20000, 'x') + " # Å\n"},
             {"whiteLuminance", "0.25"}});
  EXPECT_EQ(bytes_of(folder / "a.exr"), exr_by_openimageio(image, [](OIIO::ImageSpec& spec) {
              spec.attribute("DateTime", "2019:09:05 10:11:12");
              spec.attribute("ImageDescription", "an arc");
              spec.attribute("vegard:scene", std::string(20000, 'x') + " # Å\n");
              spec.attribute("whiteLuminance", 0.25f);
            }));
}

/// EXRs of other programs: of halves, with layers and names of any kind, in tiles, of another window than the
/// frame, and by other compressions.
TEST(ExrModule, ReadsWhatOpenImageIoReads) {
  using Set = void (*)(OIIO::ImageSpec&);
  const std::vector<std::string> names = {"zebra", "red", "B", "sky.Y", "sky.A", "G", "R", "lines.5577"};
  const Image image = numbers(61, 47, names);
  const Set sets[] = {[](OIIO::ImageSpec&) {},
                      [](OIIO::ImageSpec& spec) { spec.set_format(OIIO::TypeDesc::HALF); },
                      [](OIIO::ImageSpec& spec) { spec.tile_width = spec.tile_height = 16; },
                      [](OIIO::ImageSpec& spec) {
                        spec.x = -7;
                        spec.y = 5;
                        spec.full_x = 3;
                        spec.full_width = 200;
                      },
                      [](OIIO::ImageSpec& spec) { spec.attribute("compression", "piz"); },
                      [](OIIO::ImageSpec& spec) { spec.attribute("BUNIT", "kR"); }};
  for (const Set set : sets) {
    const std::string file = exr_by_openimageio(image, set);
    const std::string_view bytes = file;
    OpenProblem problem;
    const auto ours = module_functions<OpenExr>().open("a.exr", &bytes, problem);
    const auto theirs = module_functions<OpenImageIo>().open("openexr", "a.exr", &bytes, {}, problem);
    ASSERT_TRUE(ours && theirs) << problem.words;
    const PictureLayout &a = ours->layout(), &b = theirs->layout();
    EXPECT_EQ(a.channel_names, b.channel_names);
    EXPECT_EQ(a.floating, b.floating);
    for (const auto member :
         {&PictureLayout::x, &PictureLayout::y, &PictureLayout::width, &PictureLayout::height,
          &PictureLayout::full_x, &PictureLayout::full_y, &PictureLayout::full_width,
          &PictureLayout::full_height, &PictureLayout::channels})
      EXPECT_EQ(a.*member, b.*member);
    const auto unit = [](const PictureLayout& layout) {
      for (const auto& [key, text] : layout.texts)
        if (key == "BUNIT") return text;
      return std::string();
    };
    EXPECT_EQ(unit(a), unit(b));
    std::vector<float> of_ours(image.data.size()), of_theirs(image.data.size());
    EXPECT_TRUE(ours->read(a.channels, PixelType::float32, of_ours.data(), problem.words)) << problem.words;
    EXPECT_TRUE(theirs->read(b.channels, PixelType::float32, of_theirs.data(), problem.words));
    EXPECT_EQ(of_ours, of_theirs);
  }
}

/// Numbers that are no floats are left to the library that knows what they mean.
TEST(ExrModule, LeavesWholeNumbersToOpenImageIo) {
  const std::string file = exr_by_openimageio(
      numbers(8, 8, {"Y"}), [](OIIO::ImageSpec& spec) { spec.set_format(OIIO::TypeDesc::UINT); });
  const std::string_view bytes = file;
  OpenProblem problem;
  EXPECT_EQ(module_functions<OpenExr>().open("a.exr", &bytes, problem), nullptr);
  EXPECT_TRUE(problem.no_decoder);
  EXPECT_EQ(read_exr_bytes(file, "a.exr").image.width, 8);
}

}  // namespace
}  // namespace vegard::sim::exr_module_test
