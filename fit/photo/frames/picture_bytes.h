// The one door to a picture's bytes: a file of its own, or a frame of a file with many.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_name.h"

namespace vegard::fit {

/// Of a FITS file that gzip has packed, in bytes.
constexpr std::size_t kMaxUnpackedFits = std::size_t{1} << 27;

struct PictureBytes {
  std::string bytes;
  /// As results tell it: that of the file, with the frame's number where there are several.
  std::string name;
  /// Of a file of one picture that gzip has packed, or a FrameStore made of it: that of the file as it stands
  /// there. Else empty: that of the bytes is what distinguishes the picture from others.
  std::string file_sha256;
  std::optional<FrameHead> frame;  ///< of a file of frames
  ImagerWords words;               ///< of that frame
};

/// Of a name as fit/photo/frames/frame_name.h has it. Throws sim::Error(unreadable_input) for what cannot be
/// read, and (usage) where a frame is to be chosen, or there is none to choose. All of a file of frames is
/// looked at, so that one that is damaged or out of order is refused whatever the frame.
PictureBytes read_picture_bytes(const std::string& name);

/// What a FITS file that gzip has packed begins with: its first header, as a rule; empty for any other file.
std::string beginning_of_packed_fits(const std::string& file);

/// Pictures one after another: where they are frames of one file in their order, it is gone through once, and
/// not looked at further than the last of them.
class PictureSeries {
 public:
  PictureBytes read(const std::string& name);

 private:
  /// None behind the last frame, and of a file's only one.
  std::optional<PictureBytes> next_of_file(const FrameName& wanted);

  std::string file_;
  std::unique_ptr<FrameReader> reader_;
  bool is_taken_ = false;  ///< the frame that the reader has come to
};

struct NamedPicture {
  std::string name;
  std::optional<ImagerTime> time;  ///< of a frame, if it has one
};

/// All pictures in a file: itself, or its frames where there are several, or the one that is chosen, by its
/// number. Throws as frame_index() does, and Error(usage) for a frame that there is not.
std::vector<NamedPicture> pictures_in(const std::string& name);

}  // namespace vegard::fit
