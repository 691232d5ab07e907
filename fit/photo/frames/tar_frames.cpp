#include "fit/photo/frames/frame_store.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fit/photo/frames/imager_words.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/file/tar_file.h"
#include "sim/base/text.h"

// Frames in a tar, in which TREx's cameras store a minute of colour frames (*.png.tar): PNGs whose names give
// time, site, camera and exposure (imager_words.h). Frames are ordered by time; those without a time come
// first, ordered by name.

namespace vegard::fit {
namespace {

/// Returns the name without its folders, in small letters.
std::string small_file_name(const std::string& path) {
  return sim::lowered(path.substr(path.rfind('/') + 1));
}

/// "._NAME.png" is what macOS writes beside a file.
bool is_png_name(const std::string& name) { return name[0] != '.' && sim::ends_with(name, ".png"); }

struct InTar {
  sim::TarEntry entry;
  std::optional<ImagerName> says;
};

class TarFrames : public FrameStore {
 public:
  TarFrames(const std::string& name, std::string_view bytes) : name_(name), tar_(name, bytes) {
    for (const sim::TarEntry& entry : tar_.entries())
      if (const std::string plain = small_file_name(entry.name); is_png_name(plain))
        frames_.push_back({entry, imager_name(plain)});
    for (const std::string& link : tar_.links())
      if (is_png_name(small_file_name(link)))
        throw sim::unreadable(name, "'" + link + "' in it is a link to another file, not a picture")
            .expected("files alone")
            .hint("make it anew: tar --dereference --hard-dereference");
    if (frames_.empty())
      throw sim::unreadable(name, "there is no PNG in this tar").expected("PNGs, as TREx's *.png.tar");
    if (frames_.size() > static_cast<std::size_t>(kMaxFrames))
      throw sim::unreadable(name, "there are more than " + std::to_string(kMaxFrames) + " frames in it")
          .hint("cut it up");
    std::stable_sort(frames_.begin(), frames_.end(), [](const InTar& a, const InTar& b) {
      const auto order = [](const InTar& one) {
        return std::make_pair(one.says ? one.says->begin_s : -1e300, one.entry.name);
      };
      return order(a) < order(b);
    });
  }

  std::size_t size() const override { return frames_.size(); }
  std::string word_kind() const override { return "PNG's name, as"; }

  StoredFrame frame(std::size_t number) override {
    const InTar& one = frames_[number];
    kept_ = tar_.read(one.entry);
    kept_number_ = number;
    const auto [width, height, channels] = size_of(kept_, one.entry.name);
    StoredFrame frame;
    frame.width_px = width;
    frame.height_px = height;
    frame.channels = channels;
    if (!one.says) return frame;
    frame.time = ImagerTime{one.says->utc, one.says->begin_s, "PNG's name in the tar"};
    frame.words = {{"Site unique ID", one.says->site},
                   {"Imager unique ID", one.says->imager},
                   {"Mode unique ID", one.says->mode}};
    if (one.says->exposure_s) {
      constexpr double kMilliseconds = 1e3;
      frame.words.emplace_back("subframe_requested_exposure",
                               std::to_string(*one.says->exposure_s * kMilliseconds) + " ms");
    }
    return frame;
  }

  std::string picture(std::size_t number) override {
    if (number == kept_number_ && !kept_.empty()) return std::move(kept_);
    return tar_.read(frames_[number].entry);
  }

 private:
  struct PngSize {
    long long width, height;
    int channels;
  };
  /// Returns the size in the first chunk (PNG, section 11.2.1), which the decoder compares with the rest.
  PngSize size_of(std::string_view png, const std::string& frame) const {
    constexpr std::string_view kBegins("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    constexpr std::size_t kWidthAt = 16, kHeightAt = 20, kColoursAt = 25;
    if (png.size() <= kColoursAt || png.substr(0, kBegins.size()) != kBegins)
      throw sim::unreadable(name_, "'" + frame + "' in it is no PNG");
    const bool is_coloured = (png[kColoursAt] & 2) != 0;
    return {static_cast<long long>(sim::unsigned_at(png, kWidthAt, 4)),
            static_cast<long long>(sim::unsigned_at(png, kHeightAt, 4)), is_coloured ? 3 : 1};
  }

  std::string name_;
  sim::TarFile tar_;
  std::vector<InTar> frames_;
  std::string kept_;  ///< bytes of the frame that was looked at last
  std::size_t kept_number_ = 0;
};

}  // namespace

std::unique_ptr<FrameStore> tar_frames(const std::string& name, std::string_view bytes) {
  return std::make_unique<TarFrames>(name, bytes);
}

}  // namespace vegard::fit
