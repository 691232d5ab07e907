#include "sim/base/picture/whole_picture.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {
namespace {

class ExrHeaders {
 public:
  ExrHeaders(std::string_view beginning, std::size_t file_bytes, const std::string& file)
      : bytes_(beginning), file_bytes_(file_bytes), file_(file) {}

  ExrSize size_of_first() {
    constexpr std::size_t kVersion = 4, kFirst = 8;
    constexpr std::uint32_t kSeveralParts = 0x1000;
    ExrSize first;
    if (bytes_.size() < kFirst) throw cut_header();
    at_ = kFirst;
    const bool several = (little_word_at(kVersion) & kSeveralParts) != 0;
    do {
      header();
      // Only the first part is read, but all of them are opened.
      if (first.width == 0 && first.height == 0) first = display_;
    } while (several && at_ < bytes_.size() && bytes_[at_] != '\0');
    return first;
  }

 private:
  Error cut_header() const {
    return bytes_.size() < file_bytes_ ? damaged(file_, "an EXR with a header of many megabytes")
                                       : truncated(file_, "it ends inside the EXR header");
  }

  std::uint32_t little_word_at(std::size_t at) const {
    return static_cast<std::uint32_t>(unsigned_at(bytes_, at, 4, false));
  }
  long long signed_at(std::size_t at) const { return static_cast<std::int32_t>(little_word_at(at)); }

  std::string_view word() {
    const std::size_t end = bytes_.find('\0', std::min(at_, bytes_.size()));
    if (end == std::string_view::npos) throw cut_header();
    const std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }

  void header() {
    bool sized = false;
    std::optional<ExrSize> display;
    std::optional<std::pair<long long, long long>> tile;
    long long chunks = 0;
    while (true) {
      const std::string_view name = word();
      if (name.empty()) break;
      const std::string_view type = word();
      if (at_ + 4 > bytes_.size()) throw cut_header();
      const std::size_t size = little_word_at(at_);
      at_ += 4;
      if (size > file_bytes_ - at_) throw truncated(file_, "it ends inside the EXR header");
      if (size > bytes_.size() - at_) throw cut_header();
      if (name == "dataWindow" && type == "box2i" && size == 16) {
        if (sized) throw damaged(file_, "an EXR that says its size twice");
        size_ = {signed_at(at_ + 8) - signed_at(at_) + 1, signed_at(at_ + 12) - signed_at(at_ + 4) + 1};
        sized = true;
      } else if (name == "displayWindow" && type == "box2i" && size == 16) {
        display =
            ExrSize{signed_at(at_ + 8) - signed_at(at_) + 1, signed_at(at_ + 12) - signed_at(at_ + 4) + 1};
      } else if (name == "tiles" && size >= 8) {
        tile = {little_word_at(at_), little_word_at(at_ + 4)};
      } else if (name == "chunkCount" && size == 4) {
        chunks = signed_at(at_);
      }
      at_ += size;
    }
    if (!sized) throw damaged(file_, "an EXR that does not say its size");
    check_pixel_limit(size_.width, size_.height, file_);
    display_ = display.value_or(size_);
    check_pixel_limit(display_.width, display_.height, file_);
    if (tile) {
      check_pixel_limit(tile->first, tile->second, file_);
      chunks =
          std::max(chunks, ((size_.width - 1) / tile->first + 1) * ((size_.height - 1) / tile->second + 1));
    }
    // The list of chunks has eight bytes for each.
    if (chunks < 0 || chunks > static_cast<long long>((file_bytes_ - at_) / 8))
      throw truncated(file_, "its list of EXR chunks reaches beyond the end");
  }

  std::string_view bytes_;
  std::size_t file_bytes_;
  const std::string& file_;
  std::size_t at_ = 0;
  ExrSize size_, display_;
};

}  // namespace

ExrSize check_exr_header(std::string_view beginning, std::size_t file_bytes, const std::string& file) {
  return ExrHeaders(beginning, file_bytes, file).size_of_first();
}

std::uint32_t png_checksum(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      t[n] = n;
      for (int k = 0; k < 8; ++k) t[n] = (t[n] & 1u) != 0 ? 0xEDB88320u ^ (t[n] >> 1) : t[n] >> 1;
    }
    return t;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : bytes) crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xFFu] ^ (crc >> 8);
  return ~crc;
}

bool png_is_whole(std::string_view bytes) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  if (bytes.substr(0, kSignature.size()) != kSignature) return false;
  std::size_t at = kSignature.size();
  while (bytes.size() - at >= 12) {
    const std::size_t length = unsigned_at(bytes, at, 4);
    if (length > bytes.size() - at - 12) return false;
    const std::string_view name_and_data = bytes.substr(at + 4, 4 + length);
    if (png_checksum(name_and_data) != unsigned_at(bytes, at + 8 + length, 4)) return false;
    if (name_and_data.substr(0, 4) == "IEND") return true;
    at += 12 + length;
  }
  return false;
}

bool jpeg_is_whole(std::string_view bytes) {
  constexpr std::uint32_t kStart = 0xD8, kEnd = 0xD9, kScan = 0xDA, kFirstRestart = 0xD0;
  if (bytes.size() < 2 || unsigned_at(bytes, 0, 1) != 0xFF || unsigned_at(bytes, 1, 1) != kStart)
    return false;
  std::size_t at = 2;
  bool in_scan = false;
  while (at + 1 < bytes.size()) {
    const std::uint64_t marker = unsigned_at(bytes, at + 1, 1);
    if (unsigned_at(bytes, at, 1) != 0xFF || (in_scan && marker == 0)) {
      if (!in_scan) return false;
      ++at;
    } else if (marker == 0xFF) {
      ++at;  // any number of these may stand before a marker
    } else if (marker >= kFirstRestart && marker < kStart) {
      at += 2;
    } else if (marker == kEnd) {
      return true;
    } else {
      if (at + 3 >= bytes.size()) return false;
      in_scan = marker == kScan;
      at += 2 + unsigned_at(bytes, at + 2, 2);
    }
  }
  return false;
}

}  // namespace vegard::sim
