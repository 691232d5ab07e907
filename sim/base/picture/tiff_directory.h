// Reads the directories of tags in TIFF files and EXIF data.
//
// TIFF 6.0 (Adobe, 1992), section 2; the types are those of EXIF 2.32 (CIPA DC-008), section 4.6.2. The bytes
// are not trusted: values outside of them, or of an unexpected type, count as missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

/// One directory inside the bytes of a TIFF, which must outlive it.
class TiffDirectory {
 public:
  /// Returns the first directory; nothing if the bytes do not begin like a TIFF. Raw files of Olympus
  /// ("IIRO", "IIRS", "MMOR") and Panasonic ("IIU") have other words instead of TIFF's 42. A truncated
  /// directory has its complete entries.
  static std::optional<TiffDirectory> first(std::string_view tiff);

  /// Returns the directory to which a tag points.
  std::optional<TiffDirectory> at_tag(int tag) const;

  bool has(int tag) const { return find(tag) != nullptr; }

  /// Returns finite numbers of any numeric type, at most `most` of them; empty if one of them is invalid (a
  /// fraction over zero).
  std::vector<double> numbers(int tag, std::size_t most) const;

  /// Returns the first of numbers().
  std::optional<double> number(int tag) const;

  /// Returns a text up to its first NUL, at most 200 characters, without blanks at its ends, with '?' for
  /// characters that are not printable ASCII; nothing if it is empty then.
  std::optional<std::string> text(int tag) const;

 private:
  struct Entry {
    int tag = 0, type = 0;
    std::uint32_t count = 0;
    std::size_t place = 0;  ///< position of the four bytes with the value or its offset
  };

  TiffDirectory(std::string_view tiff, bool big_endian, std::size_t offset);
  const Entry* find(int tag) const;
  /// Returns the position of the values; nothing if they are not completely inside of the bytes.
  std::optional<std::size_t> values_of(const Entry& entry, std::size_t wanted) const;
  std::uint32_t word(std::size_t place, int size) const;
  std::optional<double> number_at(std::size_t place, int type) const;

  std::string_view tiff_;
  bool big_endian_ = false;
  std::vector<Entry> entries_;
};

}  // namespace vegard::sim
