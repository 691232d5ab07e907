// Reads files with many frames: a sequence of binary PGMs or PPMs (P5, P6), gzipped or not, in which the
// imagers of THEMIS, REGO and TREx store a minute of frames. Frames are numbered from 0. Frames in arrays and
// tars (frame_store.h) are read through the same interface.
//
// A file is read once, from its beginning, with memory for one frame whatever its size: a night's survey
// lists the frames by frame_index() and reads them one by one by a FrameReader.
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
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"

namespace vegard::fit {

/// Largest size of a frame's header, which is all before its pixels.
constexpr std::size_t kMaxFrameHeaderBytes = sim::kMaxPeekBytes;

struct FrameHead {
  int number = 0;  ///< from 0
  int width_px = 0, height_px = 0;
  std::uint64_t offset = 0;  ///< of its first byte in the unpacked file; 0 for a frame of a FrameStore
  std::uint64_t bytes = 0;   ///< including its header; 0 for a frame of a FrameStore
  std::optional<ImagerTime> time;
  StreamTime stream;  ///< of a frame of a film
  std::optional<double> exposure_s;
  std::string word_kind = kPgmComment;  ///< what kind of metadata its words are, for messages
};

/// Reads the frames of a file one after another. Every function throws sim::Error(unreadable_input), with the
/// file's name and the frame's number, for a file that is truncated, damaged or of another kind; for frames
/// that are not in the order of time, or whose size differs from that of the first frame or of their own
/// words; and for more than the limits of this header, frame_store.h and sim/base/picture/pixel_limit.h
/// allow. An error is reported when the reader reaches it: gzip's checksum is at the file's end.
class FrameReader {
 public:
  explicit FrameReader(const std::string& file);
  /// Reads from bytes in memory, which must outlive the reader; `name` is for messages.
  FrameReader(std::string_view bytes, const std::string& name);

  /// Moves to the next frame (at first to the first one); returns false after the last.
  bool next();

  // The frame to which next() has moved.
  const FrameHead& head() const { return head_; }
  /// The frame's metadata, completed by those of the file's first frame.
  ImagerWords words() const;
  /// Returns the frame as the bytes of a picture file: a PGM or PPM with header and pixels, or
  /// FrameStore::picture(). May be called once for each frame.
  std::string take();

  /// True if the file is gzipped.
  bool is_packed() const { return stream_ && stream_->is_packed(); }
  /// True if the file is an uncompressed sequence of PGMs or PPMs.
  bool is_plain() const { return stream_ && !stream_->is_packed(); }

 private:
  FrameReader(std::unique_ptr<FrameStore> store, std::string name);
  void read_header();
  bool next_of_store();
  void place_among_others();
  void check_against_others() const;
  sim::Error bad_frame(const std::string& problem) const;
  sim::Error cut_frame(std::uint64_t there) const;

  std::unique_ptr<FrameStore> store_;
  std::optional<sim::ByteStream> stream_;  ///< none if there is a store_
  std::string name_;
  FrameHead head_;
  PnmHeader pnm_;
  int channels_ = 1;
  std::string header_;        ///< bytes
  std::uint64_t pixels_ = 0;  ///< bytes of the frame's pixels that are not read yet
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

/// Lists the frames of a file. It reads through the whole file without keeping pixels; in an uncompressed
/// file it skips them.
FrameIndex frame_index(const std::string& file);

/// True if the file's first bytes are those of a file with frames, be it one or many. False as well for a
/// file that cannot be read.
bool is_frame_file(const std::string& file);

}  // namespace vegard::fit
