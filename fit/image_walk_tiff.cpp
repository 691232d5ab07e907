#include <algorithm>
#include <optional>
#include <vector>

#include "fit/image_walk.h"

namespace vegard::fit {
namespace {

// TIFF 6.0, section 8 and appendix A.
constexpr int kWidth = 256;
constexpr int kHeight = 257;
constexpr int kBits = 258;
constexpr int kPhotometric = 262;
constexpr int kStripOffsets = 273;
constexpr int kOrientation = 274;
constexpr int kSamples = 277;
constexpr int kStripBytes = 279;
constexpr int kPlanar = 284;
constexpr int kTileOffsets = 324;
constexpr int kTileBytes = 325;
constexpr int kExtraSamples = 338;
constexpr int kSampleFormat = 339;

/// The first directory of a TIFF, classic or big, read no further than the bytes reach.
class Directory {
 public:
  /// Finds the directory; complete() is false if it does not lie wholly inside the bytes.
  explicit Directory(std::string_view bytes) : bytes_(bytes) {
    if (bytes.size() < 8) return;
    big_endian_ = bytes[0] == 'M';
    const bool big_tiff = unsigned_at(bytes, 2, 2, big_endian_) == 43;
    offset_size_ = big_tiff ? 8 : 4;
    entry_size_ = big_tiff ? 20 : 12;
    const std::size_t count_size = big_tiff ? 8 : 2;
    if (big_tiff && bytes.size() < 16) return;
    const std::uint64_t at = unsigned_at(bytes, big_tiff ? 8 : 4, offset_size_, big_endian_);
    if (at > bytes.size() || bytes.size() - at < count_size) return;
    count_ = unsigned_at(bytes, at, static_cast<int>(count_size), big_endian_);
    begin_ = at + count_size;
    complete_ = count_ <= (bytes.size() - begin_) / entry_size_;
  }

  bool complete() const { return complete_; }

  /// The values of a tag, no more than `most`; nothing if the tag is absent. Values that would lie outside
  /// the file are reported as such through inside().
  std::optional<std::vector<std::uint64_t>> values(int tag, std::size_t most = SIZE_MAX) const {
    for (std::uint64_t i = 0; i < count_; ++i) {
      const std::size_t entry = begin_ + i * entry_size_;
      if (static_cast<int>(unsigned_at(bytes_, entry, 2, big_endian_)) != tag) continue;
      const int type = static_cast<int>(unsigned_at(bytes_, entry + 2, 2, big_endian_));
      const int size = type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : type == 16 ? 8 : 0;
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

int checked_orientation(std::uint64_t value) {
  return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
}

void check_picture_is_inside(const Directory& directory, std::size_t file_size, const std::string& file) {
  const bool tiled = directory.values(kTileOffsets, 1).has_value();
  const auto offsets = directory.values(tiled ? kTileOffsets : kStripOffsets);
  const auto counts = directory.values(tiled ? kTileBytes : kStripBytes);
  if (!directory.inside()) throw_truncated(file, "the list of its TIFF strips lies beyond the end");
  if (!offsets || offsets->empty()) throw_damaged(file, "a TIFF without a picture in it");
  for (std::size_t i = 0; i < offsets->size(); ++i) {
    const std::uint64_t begin = (*offsets)[i];
    const std::uint64_t length = counts && i < counts->size() ? (*counts)[i] : 1;
    if (begin > file_size || length > file_size - begin)
      throw_truncated(file, "TIFF strip " + std::to_string(i + 1) + " of " + std::to_string(offsets->size()) +
                                " reaches beyond the end");
  }
}

void check_kind(const Directory& directory, ImageFile& image, const std::string& file) {
  const auto samples = directory.value(kSamples, 1);
  const auto photometric = directory.value(kPhotometric, 1);
  const auto format = directory.value(kSampleFormat, 1);
  const auto bits = directory.values(kBits);
  image.bits = bits && !bits->empty() ? static_cast<int>(std::min<std::uint64_t>(bits->front(), 1000)) : 1;
  image.floating = format == 3;
  if (bits && std::adjacent_find(bits->begin(), bits->end(), std::not_equal_to<>()) != bits->end())
    throw_unsupported(file, "a TIFF with channels of different depth");
  if (!(image.floating ? image.bits == 32 : format == 1 && (image.bits == 8 || image.bits == 16)))
    throw_unsupported(file, "a TIFF of " + std::to_string(image.bits) + "-bit " +
                                (image.floating ? "floats"
                                 : format == 1  ? "integers"
                                                : "signed or odd numbers"));
  if (samples != 1 && samples != 3 && samples != 4)
    throw_unsupported(file, "a TIFF of " + std::to_string(samples) + " samples per pixel");
  // libtiff's own conversion, which OpenCV uses for 8 bits, also does palettes and YCbCr.
  const bool plain = photometric == 1 || photometric == 2;
  const bool converted = image.bits == 8 && (photometric == 3 || photometric == 6);
  if (!plain && !converted) throw_unsupported(file, "a TIFF that is neither grey from black up nor RGB");
  if (image.bits != 8 && samples > 1 && directory.value(kPlanar, 1) != 1)
    throw_unsupported(file, "a TIFF of more than 8 bits with its channels in separate planes");
  constexpr std::uint64_t kUnassociatedAlpha = 2;
  image.colour_times_alpha =
      image.bits == 8 && samples == 4 && directory.value(kExtraSamples, 0) == kUnassociatedAlpha;
}

}  // namespace

int exif_orientation(std::string_view tiff) {
  using namespace std::string_view_literals;
  if (tiff.substr(0, 4) != "II\x2a\0"sv && tiff.substr(0, 4) != "MM\0\x2a"sv) return 1;
  const Directory directory(tiff);
  return directory.complete() ? checked_orientation(directory.value(kOrientation, 1)) : 1;
}

ImageFile walk_tiff(std::string_view bytes, const std::string& file) {
  const Directory directory(bytes);
  if (!directory.complete()) throw_truncated(file, "its TIFF directory lies beyond the end");
  ImageFile image;
  image.format = ImageFormat::tiff;
  // A size beyond 32 bits is no image's: cut where the check of the size still refuses it.
  constexpr std::uint64_t kMost = 0xffffffffu;
  image.width = static_cast<long long>(std::min(directory.value(kWidth, 0), kMost));
  image.height = static_cast<long long>(std::min(directory.value(kHeight, 0), kMost));
  image.orientation = checked_orientation(directory.value(kOrientation, 1));
  check_kind(directory, image, file);
  check_picture_is_inside(directory, bytes.size(), file);
  return image;
}

}  // namespace vegard::fit
