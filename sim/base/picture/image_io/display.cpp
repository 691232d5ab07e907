#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/base/file/whole_file.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/image_io/library.h"

namespace vegard::sim {
namespace {

constexpr int jpeg_size_limit = 65500;  // libjpeg's

template <typename Step>
std::vector<Step> quantised(const Image& encoded) {
  constexpr double largest = std::numeric_limits<Step>::max();
  std::vector<Step> steps(encoded.data.size());
  std::transform(encoded.data.begin(), encoded.data.end(), steps.begin(), [](float value) {
    if (!(value > 0.0f)) return Step{0};
    // Exact in double before the rounding: 24 bits times 16.
    return static_cast<Step>(std::floor(std::min(1.0, static_cast<double>(value)) * largest + 0.5));
  });
  return steps;
}

void check_display(ImageFormat format, const Image& encoded, int bits, int jpeg_quality,
                   const std::string& name) {
  const auto unfit = [&](const char* problem, const char* expected) {
    return failure(ErrorKind::usage, name, problem, expected);
  };
  if (format == ImageFormat::exr) throw unfit("EXR is not a display format", ".png, .tif or .jpg");
  if (bits != 8 && bits != 16) throw unfit("no such number of bits per channel", "8 or 16");
  if (format == ImageFormat::jpeg) {
    if (bits != 8) throw unfit("JPEG cannot hold 16 bits per channel", "8, or .png or .tif");
    if (jpeg_quality < 1 || jpeg_quality > 100) throw unfit("no such JPEG quality", "1 to 100");
    if (encoded.width > jpeg_size_limit || encoded.height > jpeg_size_limit) {
      throw unfit("too large for a JPEG", "at most 65500 pixels a side");
    }
  }
}

}  // namespace

std::string encode_display(ImageFormat format, const Image& encoded, int bits, int jpeg_quality,
                           const ImageAttributes& attributes, const std::string& name) {
  assert(!encoded.empty() && (encoded.channels() == 1 || encoded.channels() == 3));
  check_display(format, encoded, bits, jpeg_quality, name);

  PictureLayout layout;
  layout.width = encoded.width;
  layout.height = encoded.height;
  layout.channels = encoded.channels();
  const std::vector<std::uint8_t> bytes =
      bits == 8 ? quantised<std::uint8_t>(encoded) : std::vector<std::uint8_t>();
  const std::vector<std::uint16_t> words =
      bits == 16 ? quantised<std::uint16_t>(encoded) : std::vector<std::uint16_t>();
  const void* const pixels = bits == 8 ? static_cast<const void*>(bytes.data()) : words.data();
  if (format == ImageFormat::png) return encode_png(layout, bits, attributes, pixels, name);
  if (format == ImageFormat::jpeg) return encode_jpeg(layout, jpeg_quality, attributes, bytes.data(), name);
  // No colour space here: OpenImageIO 2.4 makes EXIF data of it and then, writing to memory, a file that none
  // can read.
  CodecSettings settings = {{"DateTime", exif_time(value_or_empty(attributes, "DateTime"))},
                            {"compression", std::string("zip")}};
  if (const std::string words = description_of(attributes); !words.empty())
    settings.emplace_back("ImageDescription", words);
  return encode("image.tif", name, layout, bits == 8 ? PixelType::uint8 : PixelType::uint16, settings,
                pixels);
}

void write_display(const std::string& path, const Image& encoded, int bits, int jpeg_quality,
                   const ImageAttributes& attributes, bool overwrite) {
  const ImageFormat format = image_format(path);
  check_display(format, encoded, bits, jpeg_quality, path);
  WholeFile file(path, overwrite);
  file.write(encode_display(format, encoded, bits, jpeg_quality, attributes, path));
  file.commit();
}

}  // namespace vegard::sim
