#include <algorithm>
#include <optional>
#include <utility>

#include "fit/photo/codec/image_walk.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::fit {
namespace {

/// OpenEXR file layout: magic, version, then headers of attributes (name, type, size, value), each up to an
/// empty name; in files of several parts one more empty name ends the headers. OpenEXR 3.1 takes the sizes in
/// them for what they say, and the memory for it.
class ExrWalk {
 public:
  ExrWalk(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  ImageFile run() {
    ImageFile image;
    image.format = ImageFormat::exr;
    image.bits = 32;
    image.floating = true;
    constexpr std::size_t kVersion = 4, kFirst = 8;
    constexpr std::uint64_t kSeveralParts = 0x1000;
    at_ = kFirst;
    if (bytes_.size() < kFirst) throw_truncated(file_, "it ends inside the EXR header");
    const bool several = (unsigned_at(bytes_, kVersion, 4, false) & kSeveralParts) != 0;
    do {
      header();
      // What is read is the first part, but all of them are opened.
      if (image.width == 0 && image.height == 0) image.width = width_, image.height = height_;
    } while (several && at_ < bytes_.size() && bytes_[at_] != '\0');
    return image;
  }

 private:
  std::string_view word() {
    const std::size_t end = bytes_.find('\0', std::min(at_, bytes_.size()));
    if (end == std::string_view::npos) throw_truncated(file_, "it ends inside the EXR header");
    const std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }

  long long signed_at(std::size_t at) const {
    return static_cast<std::int32_t>(unsigned_at(bytes_, at, 4, false));
  }

  void header() {
    bool sized = false;
    std::optional<std::pair<long long, long long>> tile;
    long long chunks = 0;
    while (true) {
      const std::string_view name = word();
      if (name.empty()) break;
      const std::string_view type = word();
      if (at_ + 4 > bytes_.size()) throw_truncated(file_, "it ends inside the EXR header");
      const std::uint64_t size = unsigned_at(bytes_, at_, 4, false);
      at_ += 4;
      if (size > bytes_.size() - at_) throw_truncated(file_, "it ends inside the EXR header");
      if (name == "dataWindow" && type == "box2i" && size == 16) {
        if (sized) throw_damaged(file_, "an EXR that says its size twice");
        width_ = signed_at(at_ + 8) - signed_at(at_) + 1;
        height_ = signed_at(at_ + 12) - signed_at(at_ + 4) + 1;
        sized = true;
      } else if (name == "tiles" && size >= 8) {
        tile = {unsigned_at(bytes_, at_, 4, false), unsigned_at(bytes_, at_ + 4, 4, false)};
      } else if (name == "chunkCount" && size == 4) {
        chunks = signed_at(at_);
      }
      at_ += size;
    }
    if (!sized) throw_damaged(file_, "an EXR that does not say its size");
    sim::check_pixel_limit(width_, height_, file_);
    if (tile) {
      sim::check_pixel_limit(tile->first, tile->second, file_);
      chunks = std::max(chunks, ((width_ - 1) / tile->first + 1) * ((height_ - 1) / tile->second + 1));
    }
    // Of each chunk its place is listed in eight bytes.
    if (chunks < 0 || chunks > static_cast<long long>((bytes_.size() - at_) / 8))
      throw_truncated(file_, "its list of EXR chunks reaches beyond the end");
  }

  std::string_view bytes_;
  const std::string& file_;
  std::size_t at_ = 0;
  long long width_ = 0, height_ = 0;
};

}  // namespace

ImageFile walk_exr(std::string_view bytes, const std::string& file) { return ExrWalk(bytes, file).run(); }

}  // namespace vegard::fit
