#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "fit/photo/codec/picture_format.h"
#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/store_kinds.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"

// Pages of a TIFF (TIFF 6.0, section 2: directories one after another). The largest ones of one size are
// frames; those that are marked as a smaller version or a mask (NewSubfileType), and smaller ones, are none.
// A page becomes a TIFF of its own: the file's bytes, whose header leads to that page and no further.

namespace vegard::fit {
namespace tiff_pages_of {

struct Page {
  std::uint64_t offset = 0, next_at = 0;  ///< places of the directory and of the offset of the next one
  std::uint64_t width = 0, height = 0, samples = 1;
  bool is_whole_picture = true;
};

class Pages {
 public:
  explicit Pages(const sim::RandomBytes& file) : file_(file) {
    const std::string head = bytes_at(0, 16);
    if (head.size() < 8) return;
    big_endian_ = head[0] == 'M';
    constexpr std::uint64_t kBigTiff = 43;
    big_ = number(head, 2, 2) == kBigTiff;
    if (big_ && head.size() < 16) return;
    std::set<std::uint64_t> seen;
    for (std::uint64_t at = big_ ? number(head, 8, 8) : number(head, 4, 4);
         at != 0 && seen.insert(at).second && seen.size() <= static_cast<std::size_t>(kMaxFrames);) {
      const std::optional<std::uint64_t> next = read_page(at);
      if (!next) break;
      at = *next;
    }
    keep_largest();
  }

  const std::vector<Page>& pages() const { return pages_; }
  /// True unless the first directory is the only frame.
  bool is_more_than_first() const {
    return pages_.size() > 1 || (pages_.size() == 1 && pages_.front().offset != first_);
  }
  bool big() const { return big_; }
  bool big_endian() const { return big_endian_; }

 private:
  std::string bytes_at(std::uint64_t place, std::size_t count) const {
    std::string bytes(count, '\0');
    bytes.resize(file_.read(place, bytes.data(), count));
    return bytes;
  }
  std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t size) const {
    return sim::unsigned_at(bytes, at, size, big_endian_);
  }

  /// The place of the next directory, 0 behind the last; none for a directory that is cut.
  std::optional<std::uint64_t> read_page(std::uint64_t at) {
    using namespace sim::tiff_tag;
    const std::size_t count_bytes = big_ ? 8 : 2, entry_bytes = big_ ? 20 : 12, offset_bytes = big_ ? 8 : 4;
    const std::string counted = bytes_at(at, count_bytes);
    if (counted.size() < count_bytes) return std::nullopt;
    const std::uint64_t entries = number(counted, 0, count_bytes);
    constexpr std::uint64_t kMaxEntries = 4096;
    if (entries > kMaxEntries) return std::nullopt;
    const std::size_t size = static_cast<std::size_t>(entries) * entry_bytes;
    const std::string directory = bytes_at(at + count_bytes, size + offset_bytes);
    if (directory.size() < size + offset_bytes) return std::nullopt;
    Page page;
    page.offset = at;
    page.next_at = at + count_bytes + size;
    if (first_ == 0) first_ = at;
    for (std::size_t e = 0; e < size; e += entry_bytes) {
      constexpr std::uint64_t kShort = 3, kLong8 = 16;
      const auto tag = static_cast<int>(number(directory, e, 2));
      const std::uint64_t type = number(directory, e + 2, 2);
      const std::size_t bytes = type == kShort ? 2 : type == kLong8 && big_ ? 8 : 4;
      const std::uint64_t value = number(directory, e + (big_ ? 12 : 8), bytes);
      constexpr std::uint64_t kReducedOrMask = 1 | 4;
      if (tag == kSubfileType) page.is_whole_picture = (value & kReducedOrMask) == 0;
      if (tag == kWidth) page.width = value;
      if (tag == kHeight) page.height = value;
      if (tag == kSamples) page.samples = value;
    }
    pages_.push_back(page);
    return number(directory, size, offset_bytes);
  }

  void keep_largest() {
    constexpr std::uint64_t kSide = 1000000;
    const auto is_out = [](const Page& page) {
      return !page.is_whole_picture || page.width == 0 || page.height == 0 || page.width > kSide ||
             page.height > kSide;
    };
    pages_.erase(std::remove_if(pages_.begin(), pages_.end(), is_out), pages_.end());
    std::uint64_t most = 0;
    for (const Page& page : pages_) most = std::max(most, page.width * page.height);
    const auto largest = std::find_if(pages_.begin(), pages_.end(),
                                      [&](const Page& page) { return page.width * page.height == most; });
    if (largest == pages_.end()) return;
    const Page first = *largest;
    pages_.erase(std::remove_if(pages_.begin(), pages_.end(),
                                [&](const Page& page) {
                                  return page.width != first.width || page.height != first.height;
                                }),
                 pages_.end());
  }

  const sim::RandomBytes& file_;
  bool big_endian_ = false, big_ = false;
  std::uint64_t first_ = 0;
  std::vector<Page> pages_;
};

class TiffPages : public FrameStore {
 public:
  TiffPages(const std::string& name, std::string_view bytes) : file_(name, bytes), pages_(file_) {}

  std::size_t size() const override { return pages_.pages().size(); }
  std::string word_kind() const override { return "TIFF page"; }

  StoredFrame frame(std::size_t number) override {
    const Page& page = pages_.pages()[number];
    StoredFrame frame;
    frame.width_px = static_cast<long long>(page.width);
    frame.height_px = static_cast<long long>(page.height);
    frame.channels = page.samples < 3 ? 1 : 3;
    return frame;
  }

  std::string picture(std::size_t number) override {
    const Page& page = pages_.pages()[number];
    std::string bytes = file_.bytes(0, file_.size());
    const std::size_t size = pages_.big() ? 8 : 4;
    put(page.offset, size, pages_.big() ? 8 : 4, bytes);
    put(0, size, static_cast<std::size_t>(page.next_at), bytes);
    return bytes;
  }

 private:
  void put(std::uint64_t value, std::size_t size, std::size_t at, std::string& bytes) const {
    for (std::size_t i = 0; i < size; ++i)
      bytes[at + (pages_.big_endian() ? size - 1 - i : i)] = static_cast<char>(value >> (8 * i) & 0xff);
  }

  sim::RandomBytes file_;
  Pages pages_;
};

}  // namespace tiff_pages_of

bool holds_tiff_pages(const std::string& name, std::string_view bytes) {
  const sim::RandomBytes file(name, bytes);
  if (!tiff_pages_of::Pages(file).is_more_than_first()) return false;
  // The directories of a camera raw file are versions of one picture.
  return !is_camera_raw(file.bytes(0, file.size()));
}

std::unique_ptr<FrameStore> tiff_pages(const std::string& name, std::string_view bytes) {
  return std::make_unique<tiff_pages_of::TiffPages>(name, bytes);
}

}  // namespace vegard::fit
