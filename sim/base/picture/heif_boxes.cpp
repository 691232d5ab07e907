#include "sim/base/picture/heif_boxes.h"

#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"

namespace vegard::sim {
namespace {

/// The first box of this type.
std::string_view body_of(std::string_view bytes, std::string_view type, const std::string& file) {
  while (!bytes.empty()) {
    const HeifBox box = first_heif_box(bytes, file);
    if (box.type == type) return box.body;
    bytes.remove_prefix(box.size);
  }
  return {};
}

}  // namespace

HeifBox first_heif_box(std::string_view bytes, const std::string& file) {
  std::size_t head = 8;
  if (bytes.size() < head) throw truncated(file, "it ends inside the head of a box");
  std::uint64_t size = unsigned_at(bytes, 0, 4);
  if (size == 1) {
    head = 16;
    if (bytes.size() < head) throw truncated(file, "it ends inside the head of a box");
    size = unsigned_at(bytes, 8, 8);
  } else if (size == 0) {
    size = bytes.size();
  }
  const std::string_view type = bytes.substr(4, 4);
  if (size < head) throw damaged(file, "a box of impossible size");
  if (size > bytes.size()) throw truncated(file, "its box " + std::string(type) + " reaches beyond the end");
  return {type, bytes.substr(head, size - head), size};
}

std::uint64_t HeifNumbers::next(std::size_t size) {
  if (bytes_.size() < size) throw damaged(file_, std::string(what_) + " is cut");
  const std::uint64_t value = unsigned_at(bytes_, 0, size);
  bytes_.remove_prefix(size);
  return value;
}

std::optional<std::string_view> bytes_of_heif_item(std::uint64_t item, std::string_view places,
                                                   std::string_view bytes, std::string_view data,
                                                   const std::string& file) {
  HeifNumbers list(places, "the list of where its items are", file);
  const std::uint64_t version = list.next(4) >> 24, sizes = list.next(2);
  const auto size_at = [&](int shift) { return static_cast<std::size_t>(sizes >> shift & 15); };
  const std::size_t offset_size = size_at(12), length_size = size_at(8), base_size = size_at(4),
                    index_size = version == 0 ? 0 : size_at(0);
  for (const std::size_t size : {offset_size, length_size, base_size, index_size})
    if (size > 8) throw damaged(file, "the list of where its items are has numbers of impossible size");
  std::optional<std::string_view> found;
  for (std::uint64_t left = list.next(version < 2 ? 2 : 4); left > 0; --left) {
    const std::uint64_t number = list.next(version < 2 ? 2 : 4);
    const std::uint64_t method = version == 0 ? 0 : list.next(2) & 15;
    list.next(2);
    const std::uint64_t base = list.next(base_size), pieces = list.next(2);
    for (std::uint64_t piece = 0; piece < pieces; ++piece) {
      list.next(index_size);
      const std::uint64_t offset = list.next(offset_size), length = list.next(length_size);
      if (number != item) continue;
      const std::string_view whole = method == 0 ? bytes : data;
      if (found || pieces != 1 || method > 1 || base > whole.size() || offset > whole.size() - base ||
          length > whole.size() - base - offset)
        return std::nullopt;
      found = whole.substr(base + offset, length);
    }
  }
  return found;
}

std::vector<std::string_view> heif_colours(std::string_view bytes) try {
  const std::string file;
  HeifNumbers meta(body_of(bytes, "meta", file), "its table of contents", file);
  meta.next(4);  // version and flags
  const std::string_view boxes = meta.rest(), of_items = body_of(boxes, "iprp", file);
  HeifNumbers main_box(body_of(boxes, "pitm", file), "the number of its main picture", file);
  const std::uint64_t main_picture = main_box.next(main_box.next(4) >> 24 == 0 ? 2 : 4);
  std::vector<HeifBox> properties;
  for (std::string_view list = body_of(of_items, "ipco", file); !list.empty();) {
    properties.push_back(first_heif_box(list, file));
    list.remove_prefix(properties.back().size);
  }
  HeifNumbers list(body_of(of_items, "ipma", file), "the list of its pictures' properties", file);
  const std::uint64_t head = list.next(4), items = list.next(4);
  std::vector<std::string_view> found;
  for (std::uint64_t i = 0; i < items; ++i) {
    const std::uint64_t item = list.next(head >> 24 != 0 ? 4 : 2);
    for (std::uint64_t left = list.next(1); left > 0; --left) {
      const std::uint64_t index = (head & 1) != 0 ? list.next(2) & 0x7fff : list.next(1) & 0x7f;
      if (item == main_picture && index > 0 && index <= properties.size() &&
          properties[index - 1].type == "colr")
        found.push_back(properties[index - 1].body);
    }
  }
  return found;
} catch (const Error&) {
  return {};
}

std::string_view heif_exif(std::string_view bytes) try {
  const std::string file;
  HeifNumbers meta(body_of(bytes, "meta", file), "its table of contents", file);
  meta.next(4);  // version and flags
  const std::string_view boxes = meta.rest();
  std::optional<std::uint64_t> item;
  each_heif_item(body_of(boxes, "iinf", file), file, [&](std::uint64_t number, std::string_view type) {
    if (!item && type == "Exif") item = number;
  });
  if (!item) return {};
  const auto data = bytes_of_heif_item(*item, body_of(boxes, "iloc", file), bytes, {}, file);
  HeifNumbers payload(data.value_or(std::string_view()), "its EXIF data", file);
  const std::uint64_t to_header = payload.next(4);  // from behind this number to the TIFF header
  return to_header < payload.rest().size() ? payload.rest().substr(to_header) : std::string_view();
} catch (const Error&) {
  return {};
}

}  // namespace vegard::sim
