// The boxes of HEIF files: ISO/IEC 14496-12 sections 4.2, 8.11.3 (iloc) and 8.11.6 (iinf); ISO/IEC 23008-12.
//
// Functions that have a `file` throw sim::Error(unreadable_input) about it for boxes that do not lie inside
// the bytes or are invalid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

struct HeifBox {
  std::string_view type, body;
  std::size_t size = 0;  ///< of the whole box
};

/// Returns the box that `bytes` begin with.
HeifBox first_heif_box(std::string_view bytes, const std::string& file);

/// Big-endian numbers one after another; `what` they are is for the message where they end too early.
class HeifNumbers {
 public:
  HeifNumbers(std::string_view bytes, const char* what, const std::string& file)
      : bytes_(bytes), what_(what), file_(file) {}
  std::uint64_t next(std::size_t size);
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
  const char* what_;
  const std::string& file_;
};

/// Calls visit(number, type) for each item of the box iinf with a type; a type that is cut off is empty.
template <class Visit>
void each_heif_item(std::string_view item_information, const std::string& file, const Visit& visit) {
  HeifNumbers head(item_information, "the list of its items", file);
  head.next(head.next(4) >> 24 != 0 ? 4 : 2);
  for (std::string_view entries = head.rest(); !entries.empty();) {
    const HeifBox box = first_heif_box(entries, file);
    entries.remove_prefix(box.size);
    if (box.type != "infe") continue;
    HeifNumbers entry(box.body, "an item", file);
    const std::uint64_t version = entry.next(4) >> 24;
    if (version < 2) continue;  // such entries have no types
    const std::uint64_t number = entry.next(version == 2 ? 2 : 4);
    entry.next(2);
    visit(number, entry.rest().size() < 4 ? std::string_view() : entry.rest().substr(0, 4));
  }
}

/// Returns the bytes of an item by the box iloc (`places`), if they are one piece in the file or in the box
/// idat
/// (`data`).
std::optional<std::string_view> bytes_of_heif_item(std::uint64_t item, std::string_view places,
                                                   std::string_view bytes, std::string_view data,
                                                   const std::string& file);

/// Returns the bodies of the properties colr of the main picture (ISO/IEC 14496-12, 12.1.5), in the file's
/// order; none if a box before them is invalid.
std::vector<std::string_view> heif_colours(std::string_view bytes);

/// Returns the EXIF data of a HEIF file from their TIFF header on; empty if there are none, or if a box
/// before them is invalid.
std::string_view heif_exif(std::string_view bytes);

}  // namespace vegard::sim
