#include "fit/image_file.h"

#include "fit/image_walk.h"
#include "sim/base/error.h"

namespace vegard::fit {
namespace {

constexpr long long kMostPixels = 1LL << 28;
constexpr long long kLongestSide = 1000000;  // libpng's limit; OpenCV's is 2^20

bool starts_with(std::string_view bytes, std::string_view start) {
  return bytes.substr(0, start.size()) == start;
}

[[noreturn]] void refuse(const std::string& file, const std::string& problem, const std::string& expected,
                         const std::string& hint) {
  sim::ErrorDetails details;
  details.file = file;
  details.problem = problem;
  details.expected = expected;
  details.hint = hint;
  throw sim::Error(sim::ErrorKind::unreadable_input, details);
}

}  // namespace

const char* format_name(ImageFormat format) {
  switch (format) {
    case ImageFormat::jpeg:
      return "JPEG";
    case ImageFormat::png:
      return "PNG";
    case ImageFormat::tiff:
      return "TIFF";
  }
  return "";
}

void throw_truncated(const std::string& file, const std::string& what_is_missing) {
  refuse(file, "the file is truncated: " + what_is_missing, "", "copy it again from where it came");
}

void throw_damaged(const std::string& file, const std::string& problem) {
  refuse(file, "the file is damaged: " + problem, "", "copy it again from where it came");
}

void throw_unsupported(const std::string& file, const std::string& kind) {
  refuse(file, kind + " is not read", "8 or 16 bits, or a TIFF of 32-bit floats, grey or RGB",
         "save it anew as a plain PNG or TIFF");
}

ImageFile inspect_image_file(std::string_view bytes, const std::string& file) {
  if (bytes.empty())
    refuse(file, "the file is empty", "a JPEG, PNG or TIFF image", "copy it again from where it came");
  ImageFile image;
  using namespace std::string_view_literals;
  if (starts_with(bytes, "\xff\xd8"sv)) {
    image = walk_jpeg(bytes, file);
  } else if (starts_with(bytes, "\x89PNG\r\n\x1a\n"sv)) {
    image = walk_png(bytes, file);
  } else if (starts_with(bytes, "II\x2a\0"sv) || starts_with(bytes, "MM\0\x2a"sv) ||
             starts_with(bytes, "II\x2b\0"sv) || starts_with(bytes, "MM\0\x2b"sv)) {
    image = walk_tiff(bytes, file);
  } else {
    refuse(file, "this is no image that can be read",
           "a JPEG, PNG or TIFF, by its contents and not by its name",
           "convert it, camera raw files to a 16-bit TIFF");
  }
  const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
  if (image.width < 1 || image.height < 1)
    refuse(file, "the image has a size of " + size + " pixels", "", "");
  if (image.width > kLongestSide || image.height > kLongestSide)
    refuse(file, "the image claims " + size + " pixels", "at most 1000000 along a side", "crop it first");
  if (image.width * image.height > kMostPixels)
    refuse(file, "the image claims " + size + " pixels", "at most 2^28 in all", "scale or crop it first");
  return image;
}

}  // namespace vegard::fit
