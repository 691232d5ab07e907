// The directories of TIFF files and of data with the same structure: EXIF data, most camera raw files.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/codec/image_file.h"

namespace vegard::fit {

/// TIFF 6.0, section 8 and appendix A.
namespace tiff_tag {
inline constexpr int kWidth = 256;
inline constexpr int kHeight = 257;
inline constexpr int kBits = 258;
inline constexpr int kPhotometric = 262;
inline constexpr int kStripOffsets = 273;
inline constexpr int kOrientation = 274;
inline constexpr int kSamples = 277;
inline constexpr int kStripBytes = 279;
inline constexpr int kPlanar = 284;
inline constexpr int kTileOffsets = 324;
inline constexpr int kTileBytes = 325;
inline constexpr int kExtraSamples = 338;
inline constexpr int kSampleFormat = 339;
inline constexpr int kSubDirectories = 330;
}  // namespace tiff_tag

/// A directory of a TIFF or BigTIFF; never reads beyond the end of the bytes.
class TiffDirectory {
 public:
  /// The first directory, or the one at `offset`; complete() is false if it does not lie wholly inside the
  /// bytes.
  explicit TiffDirectory(std::string_view bytes, std::uint64_t offset = 0) : bytes_(bytes) {
    if (bytes.size() < 8) return;
    big_endian_ = bytes[0] == 'M';
    const bool big_tiff = unsigned_at(bytes, 2, 2, big_endian_) == 43;
    offset_size_ = big_tiff ? 8 : 4;
    entry_size_ = big_tiff ? 20 : 12;
    const std::size_t count_size = big_tiff ? 8 : 2;
    if (big_tiff && bytes.size() < 16) return;
    const std::uint64_t at =
        offset != 0 ? offset : unsigned_at(bytes, big_tiff ? 8 : 4, offset_size_, big_endian_);
    if (at > bytes.size() || bytes.size() - at < count_size) return;
    count_ = unsigned_at(bytes, at, static_cast<int>(count_size), big_endian_);
    begin_ = at + count_size;
    complete_ = count_ <= (bytes.size() - begin_) / entry_size_;
  }

  bool complete() const { return complete_; }

  /// Returns the values of a tag, at most `most` of them; none if the tag is absent. If the values would lie
  /// outside the file, inside() returns false afterwards.
  std::optional<std::vector<std::uint64_t>> values(int tag, std::size_t most = SIZE_MAX) const {
    for (std::uint64_t i = 0; i < count_; ++i) {
      const std::size_t entry = begin_ + i * entry_size_;
      if (static_cast<int>(unsigned_at(bytes_, entry, 2, big_endian_)) != tag) continue;
      const int type = static_cast<int>(unsigned_at(bytes_, entry + 2, 2, big_endian_));
      const int size = type == 1 ? 1 : type == 3 ? 2 : type == 4 || type == 13 ? 4 : type == 16 ? 8 : 0;
      if (size == 0) return std::nullopt;
      const std::uint64_t count = unsigned_at(bytes_, entry + 4, offset_size_, big_endian_);
      std::uint64_t at = entry + 4 + offset_size_;
      if (count > static_cast<std::uint64_t>(offset_size_ / size))
        at = unsigned_at(bytes_, at, offset_size_, big_endian_);
      if (at > bytes_.size() || count > (bytes_.size() - at) / size) {
        inside_ = false;
        return std::nullopt;
      }
      std::vector<std::uint64_t> list(std::min<std::uint64_t>(count, most));
      for (std::size_t k = 0; k < list.size(); ++k)
        list[k] = unsigned_at(bytes_, at + k * size, size, big_endian_);
      return list;
    }
    return std::nullopt;
  }

  std::uint64_t value(int tag, std::uint64_t if_absent) const {
    const auto list = values(tag, 1);
    return list && !list->empty() ? list->front() : if_absent;
  }

  bool inside() const { return inside_; }

 private:
  std::string_view bytes_;
  bool big_endian_ = false;
  bool complete_ = false;
  mutable bool inside_ = true;
  int offset_size_ = 4;
  std::size_t entry_size_ = 12;
  std::size_t begin_ = 0;
  std::uint64_t count_ = 0;
};

/// Throws sim::Error(unreadable_input) unless every strip or tile of the directory's picture lies inside the
/// file.
void check_strips_are_inside(const TiffDirectory& directory, std::size_t file_size, const std::string& file);

}  // namespace vegard::fit
