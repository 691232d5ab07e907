#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/photo/codec/picture_format.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/heif_boxes.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::fit {
namespace {

using Box = sim::HeifBox;

/// The tables of a file's items: the boxes pitm (the main picture), iinf, iloc and idat.
struct ItemTables {
  std::string_view primary, types, places, data;
};

struct Sizes {
  ItemTables items;
  std::vector<std::pair<long long, long long>> promised;
  bool cropped = false;           ///< a picture is to be cut out of what is stored
  std::vector<Box> properties;    ///< of all items, in the order in which they are counted
  std::string_view associations;  ///< which items have which of them
};

std::pair<long long, long long> size_of(const Box& property) {
  return {sim::unsigned_at(property.body, 4, 4), sim::unsigned_at(property.body, 8, 4)};
}

/// Takes a table, and refuses a second one of its kind: which of them libheif would take is not known here.
void take_table(const Box& box, std::string_view& table, const std::string& file) {
  if (table.data() != nullptr)
    throw sim::damaged(file, "two boxes " + std::string(box.type) + " contradict each other");
  table = box.body;
}

/// Looks through the boxes for the sizes of pictures (ISO/IEC 23008-12, 6.5.3), which are three deep: meta,
/// iprp, ipco. Files that go on deeper would take the stack.
void find_sizes(std::string_view bytes, const std::string& file, Sizes& sizes, int depth = 0,
                bool properties = false) {
  constexpr int kDeepest = 8;
  if (depth > kDeepest) throw sim::damaged(file, "boxes inside boxes without end");
  while (!bytes.empty()) {
    const Box box = sim::first_heif_box(bytes, file);
    if (properties) sizes.properties.push_back(box);
    if (box.type == "meta" && box.body.size() >= 4) {
      find_sizes(box.body.substr(4), file, sizes, depth + 1);
    } else if (box.type == "iprp" || box.type == "ipco") {
      find_sizes(box.body, file, sizes, depth + 1, box.type == "ipco");
    } else if (box.type == "ipma") {
      take_table(box, sizes.associations, file);
    } else if (box.type == "pitm") {
      take_table(box, sizes.items.primary, file);
    } else if (box.type == "iinf") {
      take_table(box, sizes.items.types, file);
    } else if (box.type == "iloc") {
      take_table(box, sizes.items.places, file);
    } else if (box.type == "idat") {
      take_table(box, sizes.items.data, file);
    } else if (box.type == "ispe" && box.body.size() >= 12) {
      sizes.promised.push_back(size_of(box));
    } else if (box.type == "clap") {
      sizes.cropped = true;
    }
    bytes.remove_prefix(box.size);
  }
}

/// The kind of an item ("hvc1", "grid"); none if it is not in the list or stands there twice (ISO/IEC
/// 14496-12, 8.11.6).
std::string type_of_item(std::uint64_t item, const ItemTables& tables, const std::string& file) {
  int found = 0;
  std::string type;
  sim::each_heif_item(tables.types, file, [&](std::uint64_t number, std::string_view its_type) {
    if (number != item) return;
    ++found;
    type = its_type;
  });
  return found == 1 ? type : "";
}

/// Width and height that a grid of tiles puts together (ISO/IEC 23008-12, 6.6.2.3).
std::optional<std::pair<long long, long long>> size_of_grid(std::string_view grid) {
  constexpr std::size_t kHead = 4;  // version, flags, rows and columns
  if (grid.size() < kHead) return std::nullopt;
  const int size = (static_cast<unsigned char>(grid[1]) & 1) != 0 ? 4 : 2;
  if (grid[0] != 0 || grid.size() < kHead + 2 * static_cast<std::size_t>(size)) return std::nullopt;
  return std::pair<long long, long long>{sim::unsigned_at(grid, kHead, size),
                                         sim::unsigned_at(grid, kHead + size, size)};
}

/// Throws unless the main picture is a stream of its own, which check_items() looks at, or a grid of tiles
/// of the promised size: OpenImageIO 2.4 reads as many rows as are promised.
void check_main_picture(std::string_view bytes, const Sizes& sizes, std::uint64_t main_picture,
                        bool has_stream, const std::vector<std::pair<long long, long long>>& promised,
                        const std::string& file) {
  const std::string type = type_of_item(main_picture, sizes.items, file);
  if (has_stream && type == "hvc1") return;
  if (type != "grid" || has_stream)
    throw sim::damaged(file, "its main picture is neither an HEVC stream nor put together of tiles");
  const auto grid = sim::bytes_of_heif_item(main_picture, sizes.items.places, bytes, sizes.items.data, file);
  const auto size = grid ? size_of_grid(*grid) : std::nullopt;
  for (const auto& [width, height] : promised)
    if (!size || size->first != width || size->second != height)
      throw sim::damaged(file, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                   " pixels by its header is put together of tiles to another size");
}

/// Throws where an item is promised to be larger or smaller than its stream, or the main picture than its
/// tiles.
void check_items(std::string_view bytes, const Sizes& sizes, const std::string& file) {
  if (sizes.associations.empty()) return;
  sim::HeifNumbers main_box(sizes.items.primary, "the number of its main picture", file);
  const std::uint64_t main_picture = main_box.next(main_box.next(4) >> 24 == 0 ? 2 : 4);
  sim::HeifNumbers list(sizes.associations, "the list of its pictures' properties", file);
  const std::uint64_t head = list.next(4), items = list.next(4);
  const bool long_numbers = head >> 24 != 0, two_bytes = (head & 1) != 0;
  int main_pictures = 0;
  for (std::uint64_t i = 0; i < items; ++i) {
    const std::uint64_t item = list.next(long_numbers ? 4 : 2);
    std::vector<std::pair<long long, long long>> promised;
    std::optional<std::string_view> stream;
    for (std::uint64_t left = list.next(1); left > 0; --left) {
      const std::uint64_t index = two_bytes ? list.next(2) & 0x7fff : list.next(1) & 0x7f;
      if (index == 0 || index > sizes.properties.size()) continue;
      const Box& property = sizes.properties[index - 1];
      if (property.type == "ispe" && property.body.size() >= 12) promised.push_back(size_of(property));
      if (property.type == "hvcC") stream = property.body;
    }
    if (item == main_picture) {
      ++main_pictures;
      check_main_picture(bytes, sizes, item, stream.has_value(), promised, file);
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
        throw sim::damaged(file, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                     " pixels by its header is of another size in its stream");
  }
  if (main_pictures != 1) throw sim::damaged(file, "it does not say once what its main picture is");
}

/// Bit by bit, the highest first. Beyond the end there is nothing good.
class Bits {
 public:
  /// Drops the last of three bytes 0, 0, 3, which only keeps the first two from being taken for a start code.
  explicit Bits(std::string_view escaped) {
    for (const char byte : escaped) {
      const std::size_t size = bytes_.size();
      if (byte == '\x03' && size >= 2 && bytes_[size - 1] == '\0' && bytes_[size - 2] == '\0' &&
          !just_skipped_) {
        just_skipped_ = true;
        continue;
      }
      just_skipped_ = false;
      bytes_ += byte;
    }
  }

  std::uint64_t next(int count) {
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i, ++at_) {
      const std::size_t byte = at_ / 8;
      good_ = good_ && byte < bytes_.size();
      value = value << 1 | (good_ ? static_cast<unsigned char>(bytes_[byte]) >> (7 - at_ % 8) & 1u : 0u);
    }
    return value;
  }

  /// Exponential Golomb code (H.265, 9.2).
  long long number() {
    int zeros = 0;
    while (good_ && zeros < 32 && next(1) == 0) ++zeros;
    good_ = good_ && zeros < 32;
    return good_ ? static_cast<long long>((std::uint64_t{1} << zeros) - 1 + next(zeros)) : 0;
  }

  void skip(std::size_t count) { at_ += count; }
  bool good() const { return good_ && at_ <= 8 * bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
  bool good_ = true, just_skipped_ = false;
};

void skip_profiles(Bits& bits, int sub_layers) {
  constexpr std::size_t kProfile = 88, kLevel = 8;
  bits.skip(kProfile + kLevel);
  bool profile[8] = {}, level[8] = {};
  for (int i = 0; i < sub_layers; ++i) profile[i] = bits.next(1) != 0, level[i] = bits.next(1) != 0;
  if (sub_layers > 0) bits.skip(2 * static_cast<std::size_t>(8 - sub_layers));
  for (int i = 0; i < sub_layers; ++i) bits.skip((profile[i] ? kProfile : 0) + (level[i] ? kLevel : 0));
}

std::optional<std::pair<long long, long long>> size_in(std::string_view parameter_set) {
  Bits bits(parameter_set);
  bits.skip(16 + 4);  // the unit's head, and a number
  const int sub_layers = static_cast<int>(bits.next(3));
  bits.skip(1);
  skip_profiles(bits, sub_layers);
  bits.number();
  const long long chroma = bits.number();
  if (chroma == 3) bits.skip(1);
  long long width = bits.number(), height = bits.number();
  if (bits.next(1) != 0) {
    const long long across = chroma == 1 || chroma == 2 ? 2 : 1, down = chroma == 1 ? 2 : 1;
    width -= across * bits.number();
    width -= across * bits.number();
    height -= down * bits.number();
    height -= down * bits.number();
  }
  if (!bits.good() || chroma > 3 || width < 1 || height < 1) return std::nullopt;
  return std::pair(width, height);
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
  Sizes sizes;
  find_sizes(bytes, file, sizes);
  // The largest. Sides of 32 bits: their product fits into 64.
  const auto pixels = [](long long width, long long height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  for (const auto& [width, height] : sizes.promised)
    if (pixels(width, height) >= pixels(image.width, image.height))
      image.width = width, image.height = height;
  if (sizes.promised.empty()) throw sim::damaged(file, "a HEIC that does not say its size");
  sim::check_pixel_limit(image.width, image.height, file);
  check_items(bytes, sizes, file);
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

std::optional<std::pair<long long, long long>> hevc_size(std::string_view configuration) {
  constexpr std::size_t kHead = 22;
  constexpr int kParameterSet = 33;
  const auto number = [&](std::size_t at, std::size_t size) {
    return sim::unsigned_at(configuration, at, size);
  };
  if (configuration.size() <= kHead) return std::nullopt;
  const std::size_t arrays = number(kHead, 1);
  std::size_t at = kHead + 1;
  for (std::size_t a = 0; a < arrays; ++a) {
    if (at + 3 > configuration.size()) return std::nullopt;
    const bool wanted = (number(at, 1) & 0x3f) == kParameterSet;
    const std::size_t units = number(at + 1, 2);
    at += 3;
    for (std::size_t u = 0; u < units; ++u) {
      if (at + 2 > configuration.size()) return std::nullopt;
      const std::size_t length = number(at, 2);
      at += 2;
      if (length > configuration.size() - at) return std::nullopt;
      if (wanted) return size_in(configuration.substr(at, length));
      at += length;
    }
  }
  return std::nullopt;
}

}  // namespace vegard::fit
