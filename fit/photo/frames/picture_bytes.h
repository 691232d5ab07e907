// Reads the bytes of a picture, be it a file with one picture or a frame of a file with many.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/frames/frame_file.h"
#include "fit/photo/frames/frame_name.h"

namespace vegard::fit {

/// Largest unpacked size, in bytes, of a gzipped FITS file.
constexpr std::size_t kMaxUnpackedFits = std::size_t{1} << 27;

struct PictureBytes {
  std::string bytes;
  /// The picture's name in results: the file's name, with the frame's number if the file has several.
  std::string name;
  /// SHA-256 of the file, if `bytes` are not the file's own: for a file with one picture that is gzipped or
  /// read through a FrameStore. Otherwise empty: the SHA-256 of `bytes` identifies the picture.
  std::string file_sha256;
  std::optional<FrameHead> frame;  ///< for a file of frames
  ImagerWords words;               ///< metadata of that frame
};

/// Reads the picture with a name as in fit/photo/frames/frame_name.h. Throws sim::Error(unreadable_input) for
/// a file that cannot be read, and (usage) if the name must choose a frame and does not, or chooses one that
/// does not exist. A file of frames is checked as a whole, so that a damaged or unordered one is refused
/// whatever the frame.
PictureBytes read_picture_bytes(const std::string& name);

/// Returns the unpacked beginning of a gzipped FITS file, usually its first header; empty for any other file.
std::string beginning_of_packed_fits(const std::string& file);

/// Reads pictures one after another. If they are frames of one file in the file's order, the file is read
/// only once, and not beyond the last of them.
class PictureSeries {
 public:
  PictureBytes read(const std::string& name);

 private:
  /// The wanted frame, if the reader can reach it by reading on; none after the last frame, and for a file
  /// with one frame only.
  std::optional<PictureBytes> next_of_file(const FrameName& wanted);

  std::string file_;
  std::unique_ptr<FrameReader> reader_;
  bool is_taken_ = false;  ///< the reader's current frame has been returned
};

struct NamedPicture {
  std::string name;
  std::optional<ImagerTime> time;  ///< of a frame, if it has one
  StreamTime stream;               ///< of a frame of a film
};

/// Lists the pictures that a name stands for: the file itself, or its frames if it has several, or the frame
/// that the name chooses, named by its number. Throws as frame_index() does, and Error(usage) for a frame
/// that does not exist.
std::vector<NamedPicture> pictures_in(const std::string& name);

}  // namespace vegard::fit
