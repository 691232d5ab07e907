#include "fit/photo/frames/frame_file.h"

#include <algorithm>
#include <utility>

#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/store_kinds.h"
#include "sim/base/error.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kKindBytes = 2;

bool is_frame_kind(std::string_view bytes) {
  return sim::starts_with(bytes, "P5") || sim::starts_with(bytes, "P6");
}

std::string pixels_text(long long width, long long height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

/// True once the bytes have all of a header, or something that is none.
bool has_whole_header(std::string_view bytes) {
  std::size_t at = kKindBytes;
  for (int number = 0; number < 3; ++number) {
    next_pnm_number(bytes, at);
    if (at >= bytes.size()) return false;
  }
  return true;
}

}  // namespace

FrameReader::FrameReader(const std::string& file) : FrameReader(frame_store(file), file) {
  if (store_ == nullptr) stream_.emplace(file);
}

FrameReader::FrameReader(std::string_view bytes, const std::string& name)
    : FrameReader(frame_store(name, bytes), name) {
  if (store_ == nullptr) stream_.emplace(bytes, name);
}

FrameReader::FrameReader(std::unique_ptr<FrameStore> store, std::string name)
    : store_(std::move(store)), name_(std::move(name)) {
  head_.number = -1;
}

sim::Error FrameReader::bad_frame(const std::string& problem) const {
  return sim::unreadable(name_, "its frame " + std::to_string(head_.number) + " " + problem);
}

sim::Error FrameReader::cut_frame(std::uint64_t there) const {
  const std::string whose =
      head_.number == 0 ? "its header" : "the header of its frame " + std::to_string(head_.number);
  return sim::truncated(name_, whose + " promises " + std::to_string(head_.bytes - pnm_.data) +
                                   " bytes of pixels and " + std::to_string(there) + " are there");
}

bool FrameReader::next() {
  if (store_ != nullptr) return next_of_store();
  if (pixels_ > 0) {
    const std::uint64_t there = stream_->skip(pixels_);
    if (there < pixels_) throw cut_frame(there);
    pixels_ = 0;
  }
  const std::string_view kind = stream_->look(kKindBytes);
  if (kind.empty() && head_.number >= 0) return false;
  if (!is_frame_kind(kind)) {
    if (head_.number < 0)
      throw sim::unreadable(name_, "there are no frames in it")
          .expected("PGM or PPM of bytes (P5, P6), one behind the other");
    // Bytes behind the only picture of a plain file are ignored.
    if (head_.number == 0 && !stream_->is_packed()) return false;
    throw sim::damaged(
        name_, "behind its frame " + std::to_string(head_.number) + " stands something else than a frame");
  }
  ++head_.number;
  if (head_.number >= kMaxFrames)
    throw sim::unreadable(name_, "there are more than " + std::to_string(kMaxFrames) + " frames in it")
        .hint("cut it up");
  read_header();
  return true;
}

void FrameReader::read_header() {
  head_.offset = stream_->position();
  std::string_view begun;
  constexpr std::size_t kUsual = 2048;
  for (std::size_t size = kUsual; size <= kMaxFrameHeaderBytes; size *= 2) {
    begun = stream_->look(size);
    if (begun.size() < size || has_whole_header(begun)) break;
  }
  if (begun.size() == kMaxFrameHeaderBytes && !has_whole_header(begun))
    throw bad_frame("has a header of more than " + std::to_string(kMaxFrameHeaderBytes / 1024) + " kB");
  const std::string of_frame = head_.number == 0 ? name_ : name_ + "#" + std::to_string(head_.number);
  pnm_ = pnm_header(begun, of_frame);
  sim::check_pixel_limit(pnm_.width, pnm_.height, of_frame);
  if (stream_->is_packed() && pnm_.width * pnm_.height > kMaxPackedPixels)
    throw sim::unreadable(of_frame, "a packed frame claims " + pixels_text(pnm_.width, pnm_.height))
        .expected("at most 2^25 in all")
        .hint("unpack the file first");
  header_.resize(pnm_.data);
  stream_->read(header_.data(), header_.size());
  head_.width_px = static_cast<int>(pnm_.width);
  head_.height_px = static_cast<int>(pnm_.height);
  constexpr int kLargestByte = 255;
  pixels_ = static_cast<std::uint64_t>(pnm_.width) * pnm_.height * pnm_.channels *
            (pnm_.largest > kLargestByte ? 2 : 1);
  head_.bytes = pnm_.data + pixels_;

  own_ = imager_words(header_);
  channels_ = pnm_.channels;
  head_.time = imager_time(own_);
  place_among_others();
}

bool FrameReader::next_of_store() {
  if (head_.number + 1 >= static_cast<int>(std::min<std::size_t>(store_->size(), kMaxFrames))) return false;
  ++head_.number;
  StoredFrame frame = store_->frame(static_cast<std::size_t>(head_.number));
  sim::check_pixel_limit(frame.width_px, frame.height_px, name_);
  head_.width_px = static_cast<int>(frame.width_px);
  head_.height_px = static_cast<int>(frame.height_px);
  head_.word_kind = store_->word_kind();
  own_ = std::move(frame.words);
  channels_ = frame.channels;
  head_.time = imager_time(own_, head_.word_kind);
  if (!head_.time) head_.time = frame.time;
  head_.stream = std::move(frame.stream);
  place_among_others();
  return true;
}

void FrameReader::place_among_others() {
  if (head_.number == 0) {
    first_ = own_;
    first_width_px_ = head_.width_px;
    first_height_px_ = head_.height_px;
    first_channels_ = channels_;
  }
  head_.exposure_s = imager_exposure_s(own_);
  if (!head_.exposure_s) head_.exposure_s = imager_exposure_s(first_);
  check_against_others();
  if (!head_.time) return;
  latest_ = head_.time;
  latest_number_ = head_.number;
}

void FrameReader::check_against_others() const {
  const std::string own_size = pixels_text(head_.width_px, head_.height_px);
  if (head_.width_px != first_width_px_ || head_.height_px != first_height_px_)
    throw bad_frame("has " + own_size + ", the first " + pixels_text(first_width_px_, first_height_px_))
        .hint("cut the file up by the size of its frames");
  if (channels_ != first_channels_) throw bad_frame("has other colours than the first");
  const std::string contradicted = contradicted_size(own_, head_.width_px, head_.height_px);
  if (!contradicted.empty())
    throw bad_frame("has " + own_size + ", and " + contradicted)
        .hint("its words belong to another picture, or its size is wrong");
  if (head_.time && latest_ && head_.time->seconds < latest_->seconds)
    throw bad_frame("is out of order: it was taken at " + head_.time->utc + ", frame " +
                    std::to_string(latest_number_) + " before it at " + latest_->utc)
        .hint("cut the file up where its clock goes back");
}

ImagerWords FrameReader::words() const { return head_.number == 0 ? own_ : with_words_of_file(own_, first_); }

std::string FrameReader::take() {
  if (store_ != nullptr) return store_->picture(static_cast<std::size_t>(head_.number));
  std::string frame = std::move(header_);
  header_.clear();
  const std::size_t header = frame.size();
  // Room is made as the pixels come: a header may promise any number of them.
  constexpr std::uint64_t kAtOnce = 1 << 24;
  while (pixels_ > 0) {
    const std::size_t at = frame.size();
    const auto count = static_cast<std::size_t>(std::min(pixels_, kAtOnce));
    frame.reserve(header + static_cast<std::size_t>(std::min<std::uint64_t>(head_.bytes, 2 * at + count)));
    frame.resize(at + count);
    const std::size_t got = stream_->read(frame.data() + at, count);
    if (got < count) throw cut_frame(at + got - header);
    pixels_ -= count;
  }
  return frame;
}

FrameIndex frame_index(const std::string& file) {
  FrameReader reader(file);
  FrameIndex index;
  index.is_packed = reader.is_packed();
  while (reader.next()) {
    if (index.frames.empty()) index.words = reader.words();
    index.frames.push_back(reader.head());
  }
  return index;
}

bool is_frame_file(const std::string& file) {
  try {
    sim::ByteStream stream(path_of_frames(file));
    return is_frame_kind(stream.look(kKindBytes)) || has_frame_store(file);
  } catch (const sim::Error&) {
    return false;
  }
}

}  // namespace vegard::fit
