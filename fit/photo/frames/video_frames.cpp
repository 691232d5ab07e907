#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "fit/photo/codec/pnm_header.h"
#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/store_kinds.h"
#include "fit/photo/frames/video_reader.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/module.h"
#include "sim/base/text.h"
#include "sim/base/utc_time.h"

// Frames of films. The top of each container is gone through here (ISO/IEC 14496-12, 4.2; RIFF; RFC 8794 with
// Matroska's Segment): what it promises beyond the file's end is cut off.

namespace vegard::fit {
namespace video_frames_of {

using namespace std::string_view_literals;

/// Marks of pictures in the same boxes as films: HEIF, AVIF, and Canon's raw files.
bool is_brand_of_pictures(std::string_view brand) {
  for (const std::string_view one :
       {"heic"sv, "heix"sv, "heim"sv, "heis"sv, "hevc"sv, "hevx"sv, "mif1"sv, "mif2"sv, "msf1"sv, "avif"sv,
        "avis"sv, "miaf"sv, "crx "sv, "jxl "sv, "jp2 "sv})
    if (brand == one) return true;
  return false;
}

VideoContainer container_of(std::string_view begun) {
  if (begun.size() < 12) return VideoContainer::none;
  if (sim::starts_with(begun, "\x1a\x45\xdf\xa3"sv)) return VideoContainer::matroska;
  if (sim::starts_with(begun, "RIFF"sv) && begun.substr(8, 4) == "AVI ") return VideoContainer::avi;
  const std::string_view box = begun.substr(4, 4);
  if (box == "ftyp")
    return is_brand_of_pictures(begun.substr(8, 4)) ? VideoContainer::none : VideoContainer::mp4;
  // QuickTime before 2001.
  for (const std::string_view one : {"moov"sv, "mdat"sv, "wide"sv})
    if (box == one) return VideoContainer::mp4;
  return VideoContainer::none;
}

/// An EBML number of up to eight bytes, without the mark of its length; none if it is cut or "unknown".
std::optional<std::uint64_t> ebml_size(std::string_view bytes, std::size_t& at) {
  if (at >= bytes.size()) return std::nullopt;
  const auto first = static_cast<unsigned char>(bytes[at]);
  std::size_t length = 1;
  while (length <= 8 && (first & (0x80 >> (length - 1))) == 0) ++length;
  if (length > 8 || at + length > bytes.size()) return std::nullopt;
  const std::uint64_t all = (std::uint64_t{1} << (7 * length)) - 1;
  const std::uint64_t value = sim::unsigned_at(bytes, at, length) & all;
  at += length;
  return value == all ? std::nullopt : std::optional<std::uint64_t>(value);
}

/// Does a part at the top of the container reach beyond the file's end?
bool is_cut(const sim::RandomBytes& file, VideoContainer container) {
  const auto head_at = [&](std::uint64_t place) {
    std::string head(32, '\0');
    head.resize(file.read(place, head.data(), head.size()));
    return head;
  };
  if (container == VideoContainer::matroska) {
    std::size_t at = 4;
    const std::string head = head_at(0);
    const std::optional<std::uint64_t> header = ebml_size(head, at);
    if (!header || *header > file.size()) return true;
    const std::uint64_t place = at + *header;
    const std::string segment = head_at(place);
    at = 4;
    const std::optional<std::uint64_t> size = ebml_size(segment, at);
    return segment.size() < at || (size && *size > file.size() - place - at);
  }
  const bool is_riff = container == VideoContainer::avi;
  for (std::uint64_t place = 0; place < file.size();) {
    const std::string head = head_at(place);
    if (head.size() < 8) return !is_riff;
    std::uint64_t size = is_riff ? sim::unsigned_at(head, 4, 4, false) : sim::unsigned_at(head, 0, 4);
    // A size of 0: until the end, or of a recording that was not closed.
    if (size == 0) return false;
    if (is_riff) size += 8 + size % 2;
    if (!is_riff && size == 1) {
      if (head.size() < 16) return true;
      size = sim::unsigned_at(head, 8, 8);
    }
    if (size < 8) return false;  // the decoder's concern
    // The last byte of padding may be missing.
    if (size > file.size() - place + (is_riff ? 1 : 0)) return true;
    place += size;
  }
  return false;
}

class Bytes : public VideoBytes {
 public:
  explicit Bytes(const sim::RandomBytes& file) : file_(file) {}
  std::uint64_t size() const override { return file_.size(); }
  std::size_t read(std::uint64_t place, char* to, std::size_t count) const override {
    return place < file_.size() ? file_.read(place, to, count) : 0;
  }

 private:
  const sim::RandomBytes& file_;
};

/// "+69.6492+018.9553+010.0/" as the words of an imager.
ImagerWords place_words(const std::string& location) {
  ImagerWords words;
  const char* at = location.c_str();
  for (const char* key : {"Geodetic latitude", "Geodetic longitude", "Geodetic altitude"}) {
    if (*at != '+' && *at != '-') break;
    char* end = nullptr;
    words.emplace_back(key, fmt::format("{:.8g}", std::strtod(at, &end)));
    if (end == at) return {};
    at = end;
  }
  return words.size() >= 2 ? words : ImagerWords{};
}

const char* matrix_name(int matrix) {
  switch (matrix) {
    case 1:
      return "BT.709";
    case 4:
      return "FCC";
    case 5:
    case 6:
      return "BT.601";
    case 7:
      return "SMPTE 240M";
    case 9:
    case 10:
      return "BT.2020";
    default:
      return "unknown";
  }
}

class VideoFrames : public FrameStore {
 public:
  VideoFrames(const std::string& name, std::string_view bytes)
      : name_(name),
        file_(name, bytes),
        bytes_(file_),
        reader_(sim::module_functions<VideoModule>().reader()) {
    std::string begun(64, '\0');
    begun.resize(file_.read(0, begun.data(), begun.size()));
    const VideoContainer container = container_of(begun);
    is_cut_ = video_frames_of::is_cut(file_, container);
    const std::string problem = reader_->open(bytes_, container, kMaxPackedPixels, kMaxFrames - 1);
    if (!problem.empty() && is_cut_) throw sim::truncated(name, "what it promises goes beyond its end");
    if (!problem.empty())
      throw sim::unreadable(name, problem).expected("a film in MP4, QuickTime, AVI, Matroska or WebM");
    is_cut_ = is_cut_ || reader_->facts().is_cut;
    if (!reader_->facts().has_square_pixels)
      throw sim::unreadable(name, "its pixels are not square").hint("scale it to square pixels first");
    if (!reader_->facts().is_rgb && reader_->facts().channels == 3 &&
        std::string_view(matrix_name(reader_->facts().matrix_used)) == "unknown")
      throw sim::unreadable(
          name, fmt::format("its colours are mixed by matrix {} of ITU-T H.273, which is not known",
                            reader_->facts().matrix_used));
    find_start();
  }

  /// What is cut off counts as one more, so that it is reported.
  std::size_t size() const override { return reader_->seconds().size() + (is_cut_ ? 1 : 0); }
  std::string word_kind() const override { return "video's"; }

  StoredFrame frame(std::size_t number) override {
    const VideoFacts& facts = reader_->facts();
    if (number >= reader_->seconds().size())
      throw sim::truncated(name_, fmt::format("it ends behind its frame {}", number - 1));
    StoredFrame frame;
    frame.width_px = facts.quarter_turns % 2 == 0 ? facts.width_px : facts.height_px;
    frame.height_px = facts.quarter_turns % 2 == 0 ? facts.height_px : facts.width_px;
    frame.channels = facts.channels;
    if (number == 0) frame.words = place_words(facts.location);
    const double after_s = reader_->seconds()[number];
    frame.stream.seconds = after_s;
    if (begin_s_)
      frame.time = ImagerTime{sim::utc_text(*begin_s_ + after_s), *begin_s_ + after_s, begin_source_};
    if (const auto clock_s = sim::utc_seconds(facts.creation_time); clock_s && !begin_s_) {
      frame.stream.clock = sim::utc_text(*clock_s + after_s);
      frame.stream.clock.pop_back();
      frame.stream.clock_source =
          "the film's creation_time, counted from its first frame (often the end of the recording, often "
          "local time)";
    }
    return frame;
  }

  std::string picture(std::size_t number) override {
    std::string pixels;
    const std::string problem = reader_->picture(number, pixels);
    if (!problem.empty()) throw sim::damaged(name_, problem);
    const VideoFacts& facts = reader_->facts();
    int width = facts.width_px, height = facts.height_px;
    if (facts.quarter_turns != 0) pixels = turned(pixels, width, height);
    return fmt::format("P{}\n{}{}\n{} {}\n{}\n", facts.channels == 3 ? 6 : 5, kPnmOfVideo, light_words(),
                       width, height, facts.bytes_a_value > 1 ? 65535 : 255) +
           pixels;
  }

 private:
  void find_start() {
    const auto said = sim::time_in_name(std::filesystem::path(name_).filename().string());
    if (said && said->offset_minutes && said->unclear.empty()) {
      begin_s_ = said->utc_s();
      begin_source_ = "the file's name and the film's clock";
      return;
    }
    // "2021-03-05T21:14:03+0200"
    const std::string& date = reader_->facts().quicktime_date;
    constexpr std::size_t kClock = 19;
    const bool has_zone = date.size() > kClock && date.find_first_of("Z+-", kClock) != std::string::npos;
    begin_s_ = has_zone ? sim::utc_seconds(date) : std::nullopt;
    if (begin_s_) begin_source_ = "QuickTime's creationdate and the film's clock";
  }

  /// What the numbers of its frames are: H.273's numbers, as far as the kind of film has them.
  std::string light_words() const {
    constexpr int kUnspecified = 2, kBt709 = 1;
    const VideoFacts& facts = reader_->facts();
    std::string words = facts.codec, assumed;
    const auto assume = [&](bool is_said, const char* what) {
      if (!is_said) assumed += std::string(assumed.empty() ? "; assumed: " : ", ") + what;
    };
    // As of a PPM or PGM where the numbers are those of a camera or a screen, without video's conventions.
    const bool is_picture = facts.is_rgb || facts.channels == 1 || facts.codec == "mjpeg";
    if (facts.channels == 3 && !facts.is_rgb) {
      words += fmt::format(", matrix {}", matrix_name(facts.matrix_used));
      assume(facts.matrix != kUnspecified, "matrix");
    }
    if (!facts.is_rgb) {
      words += facts.has_limited_range ? ", limited range" : ", full range";
      assume(facts.declares_range, "range");
    }
    const bool says_transfer = facts.transfer != kUnspecified,
               says_primaries = facts.primaries != kUnspecified;
    if (!is_picture || says_transfer || says_primaries) {
      words += fmt::format("; H.273 primaries {}, transfer {}", says_primaries ? facts.primaries : kBt709,
                           says_transfer ? facts.transfer
                           : is_picture  ? kUnspecified
                                         : kBt709);
      assume(says_primaries, "primaries");
      assume(says_transfer, is_picture ? "sRGB" : "transfer (BT.709)");
    }
    return words + assumed;
  }

  std::string turned(const std::string& pixels, int& width, int& height) const {
    const VideoFacts& facts = reader_->facts();
    const auto size = static_cast<std::size_t>(facts.channels) * facts.bytes_a_value;
    const int wide = width, high = height, turns = facts.quarter_turns;
    if (turns % 2 == 1) std::swap(width, height);
    std::string upright(pixels.size(), '\0');
    for (int y = 0; y < high; ++y)
      for (int x = 0; x < wide; ++x) {
        const int to_x = turns == 1 ? high - 1 - y : turns == 2 ? wide - 1 - x : y;
        const int to_y = turns == 1 ? x : turns == 2 ? high - 1 - y : wide - 1 - x;
        pixels.copy(upright.data() + (static_cast<std::size_t>(to_y) * width + to_x) * size, size,
                    (static_cast<std::size_t>(y) * wide + x) * size);
      }
    return upright;
  }

  std::string name_;
  sim::RandomBytes file_;
  Bytes bytes_;
  std::unique_ptr<VideoReader> reader_;
  bool is_cut_ = false;
  std::optional<double> begin_s_;  ///< of the first frame, since 1970
  std::string begin_source_;
};

}  // namespace video_frames_of

bool begins_as_video(std::string_view beginning) {
  return video_frames_of::container_of(beginning) != VideoContainer::none;
}

std::unique_ptr<FrameStore> video_frames(const std::string& name, std::string_view bytes) {
  return std::make_unique<video_frames_of::VideoFrames>(name, bytes);
}

}  // namespace vegard::fit
