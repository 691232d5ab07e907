#include <algorithm>

#include "fit/image_walk.h"

namespace vegard::fit {

// OpenEXR file layout: magic, version, then attributes (name, type, size, value) up to an empty name.
ImageFile walk_exr(std::string_view bytes, const std::string& file) {
  ImageFile image;
  image.format = ImageFormat::exr;
  image.bits = 32;
  image.floating = true;
  std::size_t at = 8;
  const auto word = [&] {
    const std::size_t end = bytes.find('\0', std::min(at, bytes.size()));
    if (end == std::string_view::npos) throw_truncated(file, "it ends inside the EXR header");
    const std::string_view text = bytes.substr(at, end - at);
    at = end + 1;
    return text;
  };
  while (true) {
    const std::string_view name = word();
    if (name.empty()) break;
    const std::string_view type = word();
    if (at + 4 > bytes.size()) throw_truncated(file, "it ends inside the EXR header");
    const std::uint64_t size = unsigned_at(bytes, at, 4, false);
    at += 4;
    if (size > bytes.size() - at) throw_truncated(file, "it ends inside the EXR header");
    if (name == "dataWindow" && type == "box2i" && size == 16) {
      const auto number = [&](int i) {
        return static_cast<long long>(static_cast<std::int32_t>(unsigned_at(bytes, at + 4 * i, 4, false)));
      };
      image.width = number(2) - number(0) + 1;
      image.height = number(3) - number(1) + 1;
      return image;
    }
    at += size;
  }
  throw_damaged(file, "an EXR that does not say its size");
}

}  // namespace vegard::fit
