// The numbers of an image file as stored, turned upright and not yet converted to light: one structure for
// all formats.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/codec/declared_light.h"

namespace vegard::fit {

struct PictureCodes {
  int width = 0, height = 0;
  int channels = 3;  ///< 1 (grey) or 3 (red, green, blue)
  /// Row by row from the top, channels interleaved; for most files of 8 bits they are in `bytes` instead,
  /// which needs a quarter of the memory.
  std::vector<float> values;
  std::shared_ptr<const std::uint8_t> bytes;
  std::vector<std::uint8_t>
      usable;            ///< indexed as `values`: 0 if unusable although below white; empty: all 1
  double white = 255.0;  ///< the number of white; 1 for floats
  double step = 1.0;     ///< between two codes; 0 for floats
  int bits = 8;
  bool floating = false;
  bool linear = false;                       ///< the format's usual encoding: linear light, or sRGB if false
  bool is_light_assumed = false;             ///< `linear` is assume_light()'s
  std::array<double, 3> block_error{};       ///< as in ImageFile
  std::string kind;                          ///< "8-bit JPEG", with what else has a part in its numbers
  DeclaredLight declared;                    ///< what the file declares about its light
  std::map<std::string, std::string> words;  ///< that came with it: FITS keywords, EXR attributes

  std::size_t size() const { return static_cast<std::size_t>(width) * height * channels; }
  float value(std::size_t i) const { return bytes ? static_cast<float>(bytes.get()[i]) : values[i]; }
};

/// The one rule for integers of more than eight bits in a format that shows pictures (PNG, TIFF, PGM, PPM),
/// of a file that does not say what they are: grey ones are a camera's counts, and so light; colours have
/// been developed for a display (and PPM is by its definition).
inline void assume_light(PictureCodes& codes, bool is_grey) {
  codes.linear = is_grey;
  codes.is_light_assumed = true;
}

/// Reads any format of fit/photo/codec/picture_format.h. `file` is for messages. Throws
/// sim::Error(unreadable_input).
PictureCodes picture_codes(std::string_view bytes, const std::string& file);

}  // namespace vegard::fit
