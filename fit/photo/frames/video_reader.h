// FFmpeg's reader of films, which a module calls (sim/base/module.h). It opens no file by itself: what it
// reads comes through VideoBytes, so that a film cannot name other files or addresses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace vegard::fit {

enum class VideoContainer { none, mp4, avi, matroska };

/// The bytes of a film.
class VideoBytes {
 public:
  virtual ~VideoBytes() = default;
  virtual std::uint64_t size() const = 0;
  /// Reads `count` bytes from `place` on, or as many as there are; returns their number.
  virtual std::size_t read(std::uint64_t place, char* to, std::size_t count) const = 0;
};

struct VideoFacts {
  std::string codec;                ///< "h264"
  int width_px = 0, height_px = 0;  ///< as stored
  int quarter_turns = 0;            ///< clockwise, which make the picture upright: 0 to 3
  bool has_square_pixels = true;
  int channels = 3;       ///< 1 or 3, of the frames that picture() gives
  int bytes_a_value = 1;  ///< 1 or 2 of the same, the first one high
  /// Numbers of ITU-T H.273, 2 where the film does not say. `is_rgb`: without a matrix and a limited range.
  int primaries = 2, transfer = 2, matrix = 2;
  int matrix_used = 2;
  bool is_rgb = false, has_limited_range = false, declares_range = false;
  std::string creation_time;   ///< of the container, ISO 8601; empty: none
  std::string quicktime_date;  ///< QuickTime's creationdate, with a zone; empty: none
  std::string location;        ///< ISO 6709; empty: none
  bool is_cut = false;         ///< a frame is not all there: the list ends before it
};

/// One film, whose frames are numbered from 0 in the order in which they are shown.
class VideoReader {
 public:
  virtual ~VideoReader() = default;

  /// Opens the first film in the bytes, which must outlive the reader, and goes through it for the times of
  /// its frames, without decoding them. Returns what is wrong, "there is no film in it: only sound"; empty if
  /// nothing is. `max_pixels` bounds what a decoder may make room for.
  virtual std::string open(const VideoBytes& bytes, VideoContainer container, long long max_pixels,
                           std::size_t max_frames) = 0;
  virtual const VideoFacts& facts() const = 0;
  /// Seconds after the first frame, in ascending order.
  virtual const std::vector<double>& seconds() const = 0;
  /// Decodes a frame: rows from the top, channels interleaved. The same bytes in whatever order frames are
  /// asked for. Returns what is wrong, empty if nothing is.
  virtual std::string picture(std::size_t number, std::string& pixels) = 0;
};

struct VideoModule {
  static constexpr const char* module = "vegard_video";

  std::unique_ptr<VideoReader> (*reader)();
};

}  // namespace vegard::fit
