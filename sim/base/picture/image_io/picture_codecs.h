// What is used of OpenEXR and of OpenImageIO, in plain types: the functions of the modules vegard_openexr and
// vegard_openimageio (sim/base/module.h). Only openexr_module.cpp and openimageio_module.cpp include them.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace vegard::sim {

/// Numbers of a pixel in memory.
enum class PixelType { uint8, uint16, float32 };

/// What a decoder says of a picture, or an encoder is told.
struct PictureLayout {
  int x = 0, y = 0, width = 0, height = 0;                      ///< the data window
  int full_x = 0, full_y = 0, full_width = 0, full_height = 0;  ///< the frame; decoders only
  int channels = 0;
  std::vector<std::string> channel_names;  ///< for an encoder, empty: the format's own
  int alpha_channel = -1;
  bool deep = false;
  bool floating = false;
  bool unassociated_alpha = false;                         ///< the colours are not multiplied by it
  int orientation = 1;                                     ///< EXIF 2.3, tag 274
  std::vector<std::pair<std::string, std::string>> texts;  ///< attributes, in the decoder's order
};

/// Settings of a decoder or encoder by the library's names, among them the attributes that are written.
using CodecSettings =
    std::vector<std::pair<std::string, std::variant<int, float, std::string, std::array<float, 4>>>>;

/// An open picture.
class PictureDecoder {
 public:
  virtual ~PictureDecoder() = default;
  virtual const PictureLayout& layout() const = 0;
  /// Reads the first `channels` channels of all pixels; `to` has room for them. False if the picture is not
  /// complete, even if the library is content; `problem` has its words.
  virtual bool read(int channels, PixelType type, void* to, std::string& problem) = 0;
};

/// Why a picture was not opened.
struct OpenProblem {
  bool no_decoder = false;  ///< the library was built without this format
  std::string words;        ///< the library's
};

/// EXRs without OpenImageIO, which has 190 libraries behind it that take half a second to load.
struct OpenExr {
  static constexpr const char* module = "vegard_openexr";

  /// Opens the file `path`; or `bytes`, which must outlive the decoder. The layout, and the order of its
  /// channels, are as OpenImageIo::open() has them; channels are read as floats. Null if that fails, with
  /// no_decoder for an EXR that is sound so far but of several parts, deep, or with channels of whole numbers
  /// or of unlike size.
  std::unique_ptr<PictureDecoder> (*open)(const std::string& path, const std::string_view* bytes,
                                          OpenProblem& problem);
  /// Returns the encoded file: floats, channels by name, zip. Of the settings texts and numbers are written
  /// under their names. `problem` is empty on success.
  std::string (*encode)(const PictureLayout& layout, const CodecSettings& settings, const float* pixels,
                        std::string& problem);
};

struct OpenImageIo {
  static constexpr const char* module = "vegard_openimageio";

  /// Opens the file `path` by the decoder of the format, "openexr", and no other; or `bytes`, which must
  /// outlive the decoder, with `path` as their name in messages. Null if that fails.
  std::unique_ptr<PictureDecoder> (*open)(const std::string& format, const std::string& path,
                                          const std::string_view* bytes, const CodecSettings& settings,
                                          OpenProblem& problem);
  /// Returns the encoded file; its name's extension selects the encoder. `problem` is empty on success.
  std::string (*encode)(const std::string& file_name, const PictureLayout& layout, PixelType type,
                        const CodecSettings& settings, const void* pixels, std::string& problem);
  /// Returns the decoders with their versions, "openexr:OpenEXR 3.1.5;raw:libraw 0.20.2-Release;...".
  std::string (*libraries)();
};

}  // namespace vegard::sim
