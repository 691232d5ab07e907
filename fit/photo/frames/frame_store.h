// The interface of frame stores: files whose frames are not a sequence of PGMs, but arrays of HDF5, MATLAB
// and CDF files, or PNGs in a tar. A FrameReader (frame_file.h) reads them like other files with frames. A
// new kind is a .cpp of this folder and a row in open_frame_store.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "fit/photo/frames/imager_words.h"

namespace vegard::fit {

constexpr int kMaxFrames = 100000;
/// Largest number of pixels, 8192 x 4096, of a gzipped frame, whose unpacked size may be a thousand times the
/// file's.
constexpr long long kMaxPackedPixels = 1LL << 25;

struct StoredFrame {
  long long width_px = 0, height_px = 0;
  int channels = 1;
  ImagerWords words;
  std::optional<ImagerTime> time;  ///< the frame's time if its words do not give it
};

class FrameStore {
 public:
  virtual ~FrameStore() = default;
  /// Number of frames.
  virtual std::size_t size() const = 0;
  /// Returns a frame's size and metadata, without its pixels. Throws sim::Error(unreadable_input).
  virtual StoredFrame frame(std::size_t number) = 0;
  /// Returns a frame as the bytes of a picture file in a format of fit/photo/codec/picture_format.h. Throws
  /// sim::Error(unreadable_input).
  virtual std::string picture(std::size_t number) = 0;
  /// Name of the kind of metadata that the frames' words are, for messages: "HDF5 word".
  virtual std::string word_kind() const = 0;
};

}  // namespace vegard::fit
