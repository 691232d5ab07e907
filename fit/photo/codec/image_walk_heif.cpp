#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "fit/photo/codec/hevc_size.h"
#include "fit/photo/codec/image_walk.h"
#include "sim/base/picture/pixel_limit.h"

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

struct Sizes {
  std::vector<std::pair<long long, long long>> promised;
  bool cropped = false;           ///< a picture is to be cut out of what is stored
  std::vector<Box> properties;    ///< of all items, in the order in which they are counted
  std::string_view associations;  ///< which items have which of them
};

std::pair<long long, long long> size_of(const Box& property) {
  return {unsigned_at(property.body, 4, 4, true), unsigned_at(property.body, 8, 4, true)};
}

/// Looks through the boxes for the sizes of pictures (ISO/IEC 23008-12, 6.5.3), which are three deep: meta,
/// iprp, ipco. Files that go on deeper would take the stack.
void find_sizes(std::string_view bytes, const std::string& file, Sizes& sizes, int depth = 0,
                bool properties = false) {
  constexpr int kDeepest = 8;
  if (depth > kDeepest) throw_damaged(file, "boxes inside boxes without end");
  while (!bytes.empty()) {
    const Box box = first_box(bytes, file);
    if (properties) sizes.properties.push_back(box);
    if (box.type == "meta" && box.body.size() >= 4) {
      find_sizes(box.body.substr(4), file, sizes, depth + 1);
    } else if (box.type == "iprp" || box.type == "ipco") {
      find_sizes(box.body, file, sizes, depth + 1, box.type == "ipco");
    } else if (box.type == "ipma") {
      sizes.associations = box.body;
    } else if (box.type == "ispe" && box.body.size() >= 12) {
      sizes.promised.push_back(size_of(box));
    } else if (box.type == "clap") {
      sizes.cropped = true;
    }
    bytes.remove_prefix(box.size);
  }
}

/// Throws where an item with a stream of its own is promised to be larger or smaller than that.
void check_streams(const Sizes& sizes, const std::string& file) {
  std::string_view list = sizes.associations;
  const auto next = [&](std::size_t size) {
    if (list.size() < size) throw_damaged(file, "the list of its pictures' properties is cut");
    const std::uint64_t value = unsigned_at(list, 0, static_cast<int>(size), true);
    list.remove_prefix(size);
    return value;
  };
  if (list.empty()) return;
  const std::uint64_t head = next(4), items = next(4);
  const bool long_numbers = head >> 24 != 0, two_bytes = (head & 1) != 0;
  for (std::uint64_t i = 0; i < items; ++i) {
    next(long_numbers ? 4 : 2);
    std::vector<std::pair<long long, long long>> promised;
    std::optional<std::string_view> stream;
    for (std::uint64_t left = next(1); left > 0; --left) {
      const std::uint64_t index = two_bytes ? next(2) & 0x7fff : next(1) & 0x7f;
      if (index == 0 || index > sizes.properties.size()) continue;
      const Box& property = sizes.properties[index - 1];
      if (property.type == "ispe" && property.body.size() >= 12) promised.push_back(size_of(property));
      if (property.type == "hvcC") stream = property.body;
    }
    if (!stream) continue;
    // An odd number of pixels is stored as an even one, and blocks may stand out.
    constexpr long long kLargestBlock = 64;
    const auto fits = [](long long wanted, long long stored) {
      return wanted <= stored && stored - wanted < kLargestBlock;
    };
    const auto size = hevc_size(*stream);
    for (const auto& [width, height] : promised)
      if (!size || !fits(width, size->first) || !fits(height, size->second))
        throw_damaged(file, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                " pixels by its header is of another size in its stream");
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
  Sizes sizes;
  find_sizes(bytes, file, sizes);
  // The largest. Sides of 32 bits: their product fits into 64.
  const auto pixels = [](long long width, long long height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  for (const auto& [width, height] : sizes.promised)
    if (pixels(width, height) >= pixels(image.width, image.height))
      image.width = width, image.height = height;
  if (sizes.promised.empty()) throw_damaged(file, "a HEIC that does not say its size");
  sim::check_pixel_limit(image.width, image.height, file);
  check_streams(sizes, file);
  return image;
}

bool heif_promises(std::string_view bytes, int width, int height, const std::string& file) {
  Sizes sizes;
  find_sizes(bytes, file, sizes);
  return std::any_of(sizes.promised.begin(), sizes.promised.end(), [&](const auto& size) {
    const auto [across, down] = size;
    if (sizes.cropped)
      return std::min(width, height) <= std::min(across, down) &&
             std::max(width, height) <= std::max(across, down);
    return (width == across && height == down) || (width == down && height == across);
  });
}

}  // namespace vegard::fit
