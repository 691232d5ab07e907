#include <algorithm>
#include <functional>

#include "fit/photo/codec/image_walk.h"
#include "fit/photo/codec/tiff_directory.h"

namespace vegard::fit {
namespace {

using namespace tiff_tag;

int checked_orientation(std::uint64_t value) {
  return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
}

void check_kind(const TiffDirectory& directory, ImageFile& image, const std::string& file) {
  const auto samples = directory.value(kSamples, 1);
  const auto photometric = directory.value(kPhotometric, 1);
  const auto format = directory.value(kSampleFormat, 1);
  const auto bits = directory.values(kBits);
  image.bits = bits && !bits->empty() ? static_cast<int>(std::min<std::uint64_t>(bits->front(), 1000)) : 1;
  image.floating = format == 3;
  if (bits && std::adjacent_find(bits->begin(), bits->end(), std::not_equal_to<>()) != bits->end())
    throw_unsupported(file, "a TIFF with channels of different depth");
  if (!(image.floating ? image.bits == 32 : format == 1 && (image.bits == 8 || image.bits == 16)))
    throw_unsupported(file, "a TIFF of " + std::to_string(image.bits) + "-bit " +
                                (image.floating ? "floats"
                                 : format == 1  ? "integers"
                                                : "signed or odd numbers"));
  if (samples != 1 && samples != 3 && samples != 4)
    throw_unsupported(file, "a TIFF of " + std::to_string(samples) + " samples per pixel");
  // libtiff's own conversion, which OpenCV uses for 8 bits, also does palettes and YCbCr.
  const bool plain = photometric == 1 || photometric == 2;
  const bool converted = image.bits == 8 && (photometric == 3 || photometric == 6);
  if (!plain && !converted) throw_unsupported(file, "a TIFF that is neither grey from black up nor RGB");
  if (image.bits != 8 && samples > 1 && directory.value(kPlanar, 1) != 1)
    throw_unsupported(file, "a TIFF of more than 8 bits with its channels in separate planes");
  constexpr std::uint64_t kUnassociatedAlpha = 2;
  image.colour_times_alpha =
      image.bits == 8 && samples == 4 && directory.value(kExtraSamples, 0) == kUnassociatedAlpha;
}

}  // namespace

int exif_orientation(std::string_view tiff) {
  using namespace std::string_view_literals;
  if (tiff.substr(0, 4) != "II\x2a\0"sv && tiff.substr(0, 4) != "MM\0\x2a"sv) return 1;
  const TiffDirectory directory(tiff);
  return directory.complete() ? checked_orientation(directory.value(kOrientation, 1)) : 1;
}

ImageFile walk_tiff(std::string_view bytes, const std::string& file) {
  const TiffDirectory directory(bytes);
  if (!directory.complete()) throw_truncated(file, "its TIFF directory lies beyond the end");
  ImageFile image;
  image.format = ImageFormat::tiff;
  // A size beyond 32 bits is no image's: cut where the check of the size still refuses it.
  constexpr std::uint64_t kMost = 0xffffffffu;
  image.width = static_cast<long long>(std::min(directory.value(kWidth, 0), kMost));
  image.height = static_cast<long long>(std::min(directory.value(kHeight, 0), kMost));
  image.orientation = checked_orientation(directory.value(kOrientation, 1));
  check_kind(directory, image, file);
  check_strips_are_inside(directory, bytes.size(), file);
  return image;
}

}  // namespace vegard::fit
