// The directories of tags in which TIFF files and EXIF data keep what a picture says of itself.
//
// TIFF 6.0 (Adobe, 1992), section 2; the types are those of EXIF 2.32 (CIPA DC-008), section 4.6.2. Bytes are
// never trusted: what points outside of them, or is of another type than asked for, is not there.
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
  /// The first one; nothing if the bytes do not begin as a TIFF does. Raw files of Olympus ("IIRO", "IIRS",
  /// "MMOR") and Panasonic ("IIU") have other words in the place of TIFF's 42. A directory that the bytes cut
  /// short is there with its whole entries.
  static std::optional<TiffDirectory> first(std::string_view tiff);

  /// The directory that a tag points to.
  std::optional<TiffDirectory> at_tag(int tag) const;

  bool has(int tag) const { return find(tag) != nullptr; }

  /// Finite numbers of any numeric type, at most `most` of them; empty if one of them is no number (a
  /// fraction over zero).
  std::vector<double> numbers(int tag, std::size_t most) const;

  /// The first of them.
  std::optional<double> number(int tag) const;

  /// A text up to its first NUL, at most 200 characters of it, blanks at its ends cut off, with '?' for all
  /// that is not printable ASCII; nothing if nothing is left.
  std::optional<std::string> text(int tag) const;

 private:
  struct Entry {
    int tag = 0, type = 0;
    std::uint32_t count = 0;
    std::size_t place = 0;  ///< of the four bytes that hold the value or its offset
  };

  TiffDirectory(std::string_view tiff, bool big_endian, std::size_t offset);
  const Entry* find(int tag) const;
  /// Where the values lie; nothing if not wholly inside the bytes.
  std::optional<std::size_t> values_of(const Entry& entry, std::size_t wanted) const;
  std::uint32_t word(std::size_t place, int size) const;
  std::optional<double> number_at(std::size_t place, int type) const;

  std::string_view tiff_;
  bool big_endian_ = false;
  std::vector<Entry> entries_;
};

}  // namespace vegard::sim
