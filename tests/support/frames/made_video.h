// Films for tests, made by FFmpeg's encoders.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace vegard::tests {

struct MadeVideo {
  std::string container = "mp4";  ///< a format of FFmpeg: mp4, mov, avi, matroska
  std::string encoder = "mpeg4";
  std::string pixels = "yuv420p";
  std::map<std::string, std::string> words, options;  ///< metadata; options of the encoder
  int width_px = 64, height_px = 48;
  std::vector<int> times_ms;  ///< of its frames
  /// The codes of a frame's planes, Y, Cb and Cr (or grey), the same in all pixels.
  std::function<std::array<int, 3>(int frame)> codes;
  int transfer = 2, primaries = 2, matrix = 2;  ///< ITU-T H.273
  bool says_full_range = false;
  int quarter_turns = 0;  ///< clockwise, by the track's matrix
  bool has_sound = false;
  std::array<int, 2> pixel_aspect = {1, 1};
};

/// Returns the file. Needs the encoder: is_encoder_there().
std::string video_bytes(const MadeVideo& made);
bool is_encoder_there(const std::string& encoder);

}  // namespace vegard::tests
