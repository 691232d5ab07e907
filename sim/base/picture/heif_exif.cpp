#include "sim/base/picture/heif_exif.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace vegard::sim {
namespace {

using namespace std::string_view_literals;

/// Big-endian words one after the other; once one lies beyond the end, none is good any more.
class ExifWords {
 public:
  explicit ExifWords(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t next(int size) {
    if (!good_ || bytes_.size() - at_ < static_cast<std::size_t>(size)) {
      good_ = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
    at_ += static_cast<std::size_t>(size);
    return value;
  }

  std::string_view letters() {
    const std::size_t begin = at_;
    next(4);
    return good_ ? bytes_.substr(begin, 4) : std::string_view();
  }

  std::string_view rest() const { return good_ ? bytes_.substr(at_) : std::string_view(); }
  void skip(std::size_t size) {
    if (!good_ || size > bytes_.size() - at_)
      good_ = false;
    else
      at_ += size;
  }
  bool good() const { return good_; }
  bool at_end() const { return !good_ || at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

/// What is inside the first box of this type.
std::string_view box(std::string_view bytes, std::string_view type) {
  ExifWords words(bytes);
  while (!words.at_end()) {
    std::uint64_t size = words.next(4);
    const std::string_view found = words.letters();
    std::size_t head = 8;
    if (size == 1) {
      size = words.next(8);
      head = 16;
    }
    const std::string_view rest = words.rest();
    if (size == 0) size = rest.size() + head;  // to the end
    if (!words.good() || size < head || size - head > rest.size()) return {};
    if (found == type) return rest.substr(0, size - head);
    words.skip(size - head);
  }
  return {};
}

/// The number of the item of type "Exif".
std::optional<std::uint64_t> exif_item(std::string_view item_information) {
  ExifWords words(item_information);
  const std::uint64_t version = words.next(4) >> 24;
  words.next(version == 0 ? 2 : 4);
  std::string_view rest = words.rest();
  while (!rest.empty()) {
    ExifWords entry(rest);
    const std::uint64_t size = entry.next(4);
    const bool is_entry = entry.letters() == "infe"sv;
    if (!entry.good() || size < 8 || size > rest.size()) return std::nullopt;
    ExifWords inside(rest.substr(8, size - 8));
    const std::uint64_t entry_version = inside.next(4) >> 24;
    if (is_entry && entry_version >= 2) {
      const std::uint64_t id = inside.next(entry_version == 2 ? 2 : 4);
      inside.next(2);
      if (inside.letters() == "Exif"sv) return id;
    }
    rest.remove_prefix(size);
  }
  return std::nullopt;
}

/// The bytes of an item of one extent, counted from the file's beginning.
std::string_view item(std::string_view bytes, std::string_view locations, std::uint64_t wanted) {
  ExifWords words(locations);
  const std::uint64_t version = words.next(4) >> 24;
  const std::uint64_t sizes = words.next(2);
  const int offset_size = sizes >> 12 & 15, length_size = sizes >> 8 & 15, base_size = sizes >> 4 & 15;
  const int index_size = version == 0 ? 0 : static_cast<int>(sizes & 15);
  for (const int size : {offset_size, length_size, base_size, index_size})
    if (size != 0 && size != 4 && size != 8) return {};
  const std::uint64_t items = words.next(version < 2 ? 2 : 4);
  for (std::uint64_t i = 0; i < items && words.good(); ++i) {
    const std::uint64_t id = words.next(version < 2 ? 2 : 4);
    const std::uint64_t method = version == 0 ? 0 : words.next(2) & 15;
    const std::uint64_t elsewhere = words.next(2);
    const std::uint64_t base = words.next(base_size);
    const std::uint64_t extents = words.next(2);
    for (std::uint64_t k = 0; k < extents && words.good(); ++k) {
      words.next(index_size);
      const std::uint64_t offset = words.next(offset_size), length = words.next(length_size);
      if (id != wanted) continue;
      if (!words.good() || method != 0 || elsewhere != 0 || extents != 1) return {};
      const std::uint64_t begin = base + offset;
      if (begin < base || begin > bytes.size() || length > bytes.size() - begin) return {};
      return bytes.substr(begin, length);
    }
  }
  return {};
}

}  // namespace

std::string_view heif_exif(std::string_view bytes) {
  const std::string_view meta = box(bytes, "meta"sv);
  if (meta.size() < 4) return {};
  const std::string_view boxes = meta.substr(4);  // after its version and flags
  const auto id = exif_item(box(boxes, "iinf"sv));
  if (!id) return {};
  ExifWords payload(item(bytes, box(boxes, "iloc"sv), *id));
  const std::uint64_t to_header = payload.next(4);  // how far behind this number the TIFF header begins
  payload.skip(to_header);
  return payload.rest();
}

}  // namespace vegard::sim
