// A frame store holds frames that do not stand in their file as a sequence of PGMs: arrays of HDF5, MATLAB
// and CDF files, PNGs in a tar. A FrameReader gives them out as it does its own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "fit/photo/frames/imager_words.h"

namespace vegard::fit {

constexpr int kMaxFrames = 100000;
/// Of a frame that gzip has packed, which may claim a thousand times the file's size: 8192 x 4096.
constexpr long long kMaxPackedPixels = 1LL << 25;

struct StoredFrame {
  long long width_px = 0, height_px = 0;
  int channels = 1;
  ImagerWords words;
  std::optional<ImagerTime> time;  ///< where no word gives it
};

class FrameStore {
 public:
  virtual ~FrameStore() = default;
  /// How many frames there are.
  virtual std::size_t size() const = 0;
  /// Of frame `number`, without its pixels. Throws sim::Error(unreadable_input).
  virtual StoredFrame frame(std::size_t number) = 0;
  /// A picture of its own of a format of fit/photo/codec/image_file.h. Throws sim::Error(unreadable_input).
  virtual std::string picture(std::size_t number) = 0;
  /// Which of what a frame says of itself its words are, for messages: "HDF5 word".
  virtual std::string word_kind() const = 0;
};

}  // namespace vegard::fit
