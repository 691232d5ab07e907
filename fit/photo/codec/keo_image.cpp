// Images of KEO Scientific's airglow imagers (.img): a header of 60 bytes that begins with "$Spextube IV
// image file", three unsigned 16-bit numbers, little end first (columns, rows, bytes of a value), then the
// values, row by row from the top: north up, east to the left. Bytes behind them are ignored. The layout is
// that of UNISvalbard/KHO-starcalibration (readairglow.m), whose array is transposed for display.
#include <string>

#include "fit/photo/codec/full_scale.h"
#include "fit/photo/codec/picture_format.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"

namespace vegard::fit {
namespace keo_image {

constexpr std::size_t kHeader = 60, kPixels = kHeader + 6;

struct Layout {
  long long width = 0, height = 0;
  std::size_t value_bytes = 2;
};

Layout layout_of(std::string_view bytes, const std::string& file) {
  if (bytes.size() < kPixels) throw sim::truncated(file, "it ends inside the header of a KEO image");
  const auto number = [&](std::size_t which) {
    return static_cast<long long>(sim::unsigned_at(bytes, kHeader + 2 * which, 2, false));
  };
  Layout layout{number(0), number(1), static_cast<std::size_t>(number(2))};
  if (layout.value_bytes != 1 && layout.value_bytes != 2)
    throw sim::unreadable(file, "a KEO image of " + std::to_string(layout.value_bytes) + " bytes a value")
        .expected("1 or 2");
  return layout;
}

}  // namespace keo_image

ImageFile walk_keo(std::string_view bytes, const std::string& file) {
  using namespace keo_image;
  const Layout layout = layout_of(bytes, file);
  ImageFile image;
  image.width = layout.width;
  image.height = layout.height;
  image.bits = 8 * static_cast<int>(layout.value_bytes);
  const std::size_t promised =
      static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height) * layout.value_bytes;
  if (promised > bytes.size() - kPixels)
    throw sim::truncated(file, "its header promises " + std::to_string(promised) + " bytes of pixels and " +
                                   std::to_string(bytes.size() - kPixels) + " are there");
  return image;
}

PictureCodes decode_keo(std::string_view bytes, const ImageFile& image, const std::string& file) {
  using namespace keo_image;
  const Layout layout = layout_of(bytes, file);
  PictureCodes codes;
  codes.width = static_cast<int>(layout.width);
  codes.height = static_cast<int>(layout.height);
  codes.channels = 1;
  codes.bits = image.bits;
  codes.white = layout.value_bytes == 1 ? 255.0 : 65535.0;
  codes.linear = true;
  codes.kind = kind_of_codes(image);
  codes.values.resize(codes.size());
  for (std::size_t i = 0; i < codes.values.size(); ++i)
    codes.values[i] = static_cast<float>(
        sim::unsigned_at(bytes, kPixels + i * layout.value_bytes, layout.value_bytes, false));
  mark_full_scale(0, codes);
  return codes;
}

}  // namespace vegard::fit
