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

/// When a frame of a film was shown.
struct StreamTime {
  std::optional<double> seconds;  ///< after the file's first frame; none: it is no film
  /// The same by a clock of which neither the zone nor what it marks is known, ISO 8601 without a zone; and
  /// what clock that is, for messages.
  std::string clock, clock_source;
};

struct StoredFrame {
  long long width_px = 0, height_px = 0;
  int channels = 1;
  ImagerWords words;
  std::optional<ImagerTime> time;  ///< the frame's time if its words do not give it
  StreamTime stream;
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

/// Opens a file, or bytes in memory, which must outlive the store (`name` is then for messages only). Returns
/// null for a file of another kind, or one that cannot be read. Throws sim::Error(unreadable_input) for a
/// file that is damaged or has no frames.
std::unique_ptr<FrameStore> frame_store(const std::string& name, std::string_view bytes = {});

/// True if the file is of a kind that frame_store() opens.
bool has_frame_store(const std::string& file);

/// Opens a tar; the parameters are those of frame_store(). Files whose names end with .png are frames, all
/// others are ignored. Throws sim::Error(unreadable_input) for a tar that is damaged or has no PNG. Only the
/// sizes of the PNGs are read before picture() is called.
std::unique_ptr<FrameStore> tar_frames(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::fit
