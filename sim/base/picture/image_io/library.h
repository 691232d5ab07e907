// Common parts of the readers and writers of this folder: errors, the encoder, files in memory, and
// ImageAttributes in the forms of the file formats. Only this folder may include this header.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/picture/image_io/picture_codecs.h"

namespace vegard::sim {

/// Returns the library's message with `stand_in`, the library's name of the bytes, replaced by the user's
/// `name`.
std::string with_name(std::string words, const std::string& stand_in, const std::string& name);

/// Returns an Error about the file `name`.
Error failure(ErrorKind kind, const std::string& name, std::string problem, std::string expected = {});

/// Throws Error(unreadable_input) unless the path is that of a regular file.
void check_is_file(const std::string& path);

/// The same, and for an EXR with an invalid header: check_exr_header().
void check_exr_file(const std::string& path);

/// Throws Error(unreadable_input) for an image without pixels, or of more than 2^30 numbers (4 GiB of
/// floats).
void check_size(const PictureLayout& layout, const std::string& path);

/// Converts the pixels of an EXR's data window to those of its frame, the display window: `outside` where the
/// data window does not reach. `layout` has the size of the frame afterwards. Throws Error(unreadable_input)
/// for a frame of a size that check_size() refuses.
std::vector<float> framed(std::vector<float> data_window, PictureLayout& layout, float outside,
                          const std::string& path);

/// Opens an EXR, and no other picture that happens to be called .exr, by OpenEXR, or one that that module
/// does not read by OpenImageIO. Null if that fails.
std::unique_ptr<PictureDecoder> open_exr(const std::string& path, const std::string_view* bytes,
                                         OpenProblem& problem);

/// Returns the decoder of a format with its version, "LibRaw 0.20.2-Release" for "raw"; "" if unknown.
std::string decoder_version(const std::string& format);

/// Returns the encoded file. It is encoded in memory because not all encoders check whether their last,
/// buffered bytes reach the disk; WholeFile does. The extension of `file_name` selects the encoder; errors
/// are about `name`. Throws Error(unwritable_output).
std::string encode(const std::string& file_name, const std::string& name, const PictureLayout& layout,
                   PixelType type, const CodecSettings& settings, const void* pixels);

/// Returns a PNG of 1 or 3 channels, sRGB-encoded, of 8 or 16 bits, by libpng: most pictures are PNGs, and
/// OpenImageIO would have to be loaded first, which takes half a second. The bytes are those that
/// OpenImageIO writes. Errors are about `name`. Throws Error(unwritable_output).
std::string encode_png(const PictureLayout& layout, int bits, const ImageAttributes& attributes,
                       const void* pixels, const std::string& name);

/// Returns a JPEG of 1 or 3 channels of 8 bits, sRGB-encoded, without subsampling of the colours, by libjpeg.
/// The time and description_of() the attributes, at most 30 000 bytes of it, stand in its EXIF, the latter as
/// a comment too. Errors are about `name`. Throws Error(unwritable_output).
std::string encode_jpeg(const PictureLayout& layout, int quality, const ImageAttributes& attributes,
                        const unsigned char* pixels, const std::string& name);

/// A file in memory, in no folder, for decoders that open files by name, that exists as long as this object.
/// Linux only (memfd_create, /proc).
class MemoryFile {
 public:
  /// Throws Error(unreadable_input) about the file `name` if there is no memory for it.
  MemoryFile(std::string_view bytes, const std::string& name);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const;

 private:
  int descriptor_ = -1;
};

/// EXIF's value for an unknown time. Without a DateTime, OpenImageIO writes the computer's time into EXR and
/// TIFF.
inline const char* const unknown_time = "    :  :     :  :  ";
inline const char* const own_prefix = "vegard:";

/// Converts "2019-09-05T10:11:12Z" to EXIF's form; returns other text unchanged, and unknown_time for an
/// empty text.
std::string exif_time(std::string time);

std::string value_or_empty(const ImageAttributes& attributes, const std::string& key);

/// Returns all attributes except the time as lines of one text.
std::string description_of(const ImageAttributes& attributes);

}  // namespace vegard::sim
