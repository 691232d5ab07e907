// Reads the directories of tags in TIFF files, in EXIF data and in camera raw files.
//
// TIFF 6.0 (Adobe, 1992), section 2, and BigTIFF; the types are those of EXIF 2.32 (CIPA DC-008),
// section 4.6.2. The bytes are not trusted: values outside of them, or of an unexpected type, count as
// missing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

/// TIFF 6.0, section 8 and appendix A; TIFF/EP and DNG 1.4.
namespace tiff_tag {
inline constexpr int kSubfileType = 254, kWidth = 256, kHeight = 257, kBits = 258, kCompression = 259,
                     kPhotometric = 262, kStripOffsets = 273, kOrientation = 274, kSamples = 277,
                     kStripBytes = 279, kPlanar = 284, kTileOffsets = 324, kTileBytes = 325,
                     kSubDirectories = 330, kExtraSamples = 338, kSampleFormat = 339, kDngVersion = 50706;
}  // namespace tiff_tag

/// One directory inside the bytes of a TIFF, which must outlive it. A truncated directory has its complete
/// entries.
class TiffDirectory {
 public:
  /// The first directory of a TIFF or BigTIFF, or the one at `offset`.
  explicit TiffDirectory(std::string_view tiff, std::uint64_t offset = 0);

  /// Returns the first directory; nothing if the bytes do not begin like a TIFF. Raw files of Olympus
  /// ("IIRO", "IIRS", "MMOR") and Panasonic ("IIU") have other words instead of TIFF's 42.
  static std::optional<TiffDirectory> first(std::string_view tiff);

  /// Returns the directory to which a tag points.
  std::optional<TiffDirectory> at_tag(int tag) const;

  /// False if the directory does not lie wholly inside the bytes.
  bool complete() const { return complete_; }

  bool has(int tag) const { return find(tag).has_value(); }

  /// Returns finite numbers of any numeric type, at most `most` of them; empty if one of them is invalid (a
  /// fraction over zero).
  std::vector<double> numbers(int tag, std::size_t most) const;

  /// Returns the first of numbers().
  std::optional<double> number(int tag) const;

  /// Returns the unsigned integers of a tag, at most `most` of them; none if the tag is absent or of another
  /// type. If the values would lie outside the file, inside() returns false afterwards.
  std::optional<std::vector<std::uint64_t>> values(int tag, std::size_t most = SIZE_MAX) const;
  std::uint64_t value(int tag, std::uint64_t if_absent) const;
  bool inside() const { return inside_; }

  /// Returns the bytes of a tag of bytes of any meaning, such as a colour profile; none if they would lie
  /// outside the file.
  std::optional<std::string_view> bytes(int tag) const;

  /// Returns a text up to its first NUL, at most 200 characters, without blanks at its ends, with '?' for
  /// characters that are not printable ASCII; nothing if it is empty then.
  std::optional<std::string> text(int tag) const;

 private:
  struct Entry {
    int type = 0;
    std::uint64_t count = 0;
    std::size_t place = 0;  ///< position of the bytes with the value or its offset
  };

  void read_head(std::uint64_t place);
  std::optional<Entry> find(int tag) const;
  /// Returns the position of the values; nothing if so many of them are not completely inside of the bytes.
  std::optional<std::size_t> values_of(const Entry& entry, std::uint64_t wanted) const;
  std::uint64_t word(std::size_t place, int size) const;
  std::optional<double> number_at(std::size_t place, int type) const;

  std::string_view tiff_;
  bool big_endian_ = false, big_ = false, complete_ = false;
  mutable bool inside_ = true;
  std::size_t begin_ = 0, count_ = 0;  ///< of the complete entries
};

}  // namespace vegard::sim
