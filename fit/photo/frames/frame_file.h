// Files with many frames in them: PGM or PPM of bytes (P5, P6) one behind the other, gzipped or not, as the
// imagers of THEMIS, REGO and TREx write a minute of them. Frames are numbered from 0.
//
// Frames of other files, of arrays and tars (frame_store.h), are handed on in the same way.
//
// A file is gone through once, from its beginning, and in room for one frame whatever its size: a night's
// survey asks frame_index() what there is, and a FrameReader for one frame after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/codec/pnm_header.h"
#include "fit/photo/frames/frame_store.h"
#include "fit/photo/frames/imager_words.h"
#include "sim/base/file/byte_stream.h"

namespace vegard::fit {

/// Of a frame's header: what stands before its pixels.
constexpr std::size_t kMaxFrameHeaderBytes = sim::kMaxPeekBytes;

struct FrameHead {
  int number = 0;  ///< from 0
  int width_px = 0, height_px = 0;
  std::uint64_t offset = 0;  ///< of its first byte in the unpacked file; 0 of a FrameStore's
  std::uint64_t bytes = 0;   ///< with its header; 0 of a FrameStore's
  std::optional<ImagerTime> time;
  std::optional<double> exposure_s;
  std::string word_kind = kPgmComment;  ///< what its words are, for messages
};

/// One frame of a file after another. All throws sim::Error(unreadable_input) with the file's name and the
/// frame's number for a file that is cut short, damaged or no such file, whose frames are out of their order
/// in time, or of another size than the first or than their own words say, or that has more than the limits
/// above and sim/base/picture/pixel_limit.h allow. What is wrong with a file is reported when its reader
/// comes to it: the checksum of gzip stands at its end.
class FrameReader {
 public:
  explicit FrameReader(const std::string& file);
  /// Of bytes that outlive it; `name` is for messages.
  FrameReader(std::string_view bytes, const std::string& name);

  /// Goes on to the next frame, the first to begin with; false behind the last.
  bool next();

  // Of the frame that next() has come to.
  const FrameHead& head() const { return head_; }
  /// What it says of itself, or the file's first frame for it.
  ImagerWords words() const;
  /// The frame as a picture of its own: a PGM or PPM, header and pixels, or what a FrameStore makes of it.
  /// Once a frame.
  std::string take();

  /// By gzip.
  bool is_packed() const { return stream_ && stream_->is_packed(); }
  /// Whether frames stand in the file as they are, one behind the other.
  bool is_plain() const { return stream_ && !stream_->is_packed(); }

 private:
  FrameReader(std::unique_ptr<FrameStore> store, std::string name);
  void read_header();
  bool next_of_store();
  void place_among_others();
  void check_against_others() const;
  [[noreturn]] void refuse(const std::string& problem, const std::string& hint = {}) const;
  [[noreturn]] void refuse_cut(std::uint64_t there) const;

  std::unique_ptr<FrameStore> store_;
  std::optional<sim::ByteStream> stream_;  ///< without a source
  std::string name_;
  FrameHead head_;
  PnmHeader pnm_;
  int channels_ = 1;
  std::string header_;        ///< bytes
  std::uint64_t pixels_ = 0;  ///< bytes of them that are still to be read
  ImagerWords own_, first_;
  int first_width_px_ = 0, first_height_px_ = 0, first_channels_ = 0;
  std::optional<ImagerTime> latest_;
  int latest_number_ = 0;
};

struct FrameIndex {
  std::vector<FrameHead> frames;  ///< at least one
  ImagerWords words;              ///< of the first frame
  bool is_packed = false;
};

/// Reads all of the file and keeps no pixels; what is not packed is passed over.
FrameIndex frame_index(const std::string& file);

/// Whether the file holds frames at all, by its first bytes: one, or many. False as well for a file that
/// cannot be read.
bool is_frame_file(const std::string& file);

}  // namespace vegard::fit
