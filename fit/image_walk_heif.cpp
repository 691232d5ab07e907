#include <algorithm>

#include "fit/image_walk.h"

namespace vegard::fit {
namespace {

/// A box of ISO/IEC 14496-12, section 4.2.
struct Box {
  std::string_view type, body;
  std::size_t size = 0;
};

/// The box that `bytes` begin with; throws if it does not lie inside them.
Box first_box(std::string_view bytes, const std::string& file) {
  std::size_t head = 8;
  if (bytes.size() < head) throw_truncated(file, "it ends inside the head of a box");
  std::uint64_t size = unsigned_at(bytes, 0, 4, true);
  if (size == 1) {
    head = 16;
    if (bytes.size() < head) throw_truncated(file, "it ends inside the head of a box");
    size = unsigned_at(bytes, 8, 8, true);
  } else if (size == 0) {
    size = bytes.size();
  }
  const std::string_view type = bytes.substr(4, 4);
  if (size < head) throw_damaged(file, "a box of impossible size");
  if (size > bytes.size()) throw_truncated(file, "its box " + std::string(type) + " reaches beyond the end");
  return {type, bytes.substr(head, size - head), size};
}

/// Looks through the boxes for the sizes of pictures (ISO/IEC 23008-12, 6.5.3) and keeps the largest.
void find_sizes(std::string_view bytes, const std::string& file, ImageFile& image) {
  while (!bytes.empty()) {
    const Box box = first_box(bytes, file);
    if (box.type == "meta" && box.body.size() >= 4) {
      find_sizes(box.body.substr(4), file, image);
    } else if (box.type == "iprp" || box.type == "ipco") {
      find_sizes(box.body, file, image);
    } else if (box.type == "ispe" && box.body.size() >= 12) {
      const auto width = static_cast<long long>(unsigned_at(box.body, 4, 4, true));
      const auto height = static_cast<long long>(unsigned_at(box.body, 8, 4, true));
      // Sides of 32 bits: their product fits into 64.
      if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) >=
          static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height))
        image.width = width, image.height = height;
    }
    bytes.remove_prefix(box.size);
  }
}

}  // namespace

bool is_heif(std::string_view bytes) {
  if (bytes.size() < 12 || bytes.substr(4, 4) != "ftyp") return false;
  const std::string_view brand = bytes.substr(8, 4);
  for (const char* known : {"heic", "heix", "heim", "heis", "hevc", "hevx", "mif1", "msf1"})
    if (brand == known) return true;
  return false;
}

ImageFile walk_heif(std::string_view bytes, const std::string& file) {
  ImageFile image;
  image.format = ImageFormat::heif;
  find_sizes(bytes, file, image);
  if (image.width == 0 && image.height == 0) throw_damaged(file, "a HEIC that does not say its size");
  return image;
}

}  // namespace vegard::fit
