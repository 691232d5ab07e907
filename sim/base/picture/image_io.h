// Image files: linear EXR and display pictures, in and out. OpenImageIO is behind this door and those of
// sim/base/image_io/, and nowhere else.
//
// Files appear whole or not at all (whole_file.h). The same image and attributes give the same bytes on every
// run and for every number of threads: no clock, machine or path goes into a file.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/image.h"

namespace vegard::sim {

/// Words that travel with an image. Some keys have a meaning: "DateTime" (ISO 8601 or EXIF style; the time of
/// the scene, never of the writing), "ImageDescription" and, in an EXR, "whiteLuminance" (cd m^-2 of a value
/// of 1 in R, G and B). Numbers are given as text: OpenImageIO drops 64-bit integers.
using ImageAttributes = std::map<std::string, std::string>;

enum class ImageFormat { exr, png, tiff, jpeg };

/// By the extension, in either case: .exr .png .tif .tiff .jpg .jpeg. Throws Error(usage) for any other.
ImageFormat image_format(const std::string& path);

/// The channels of all images, which have one size and no channel name in common, as the bytes of one EXR:
/// 32-bit float, ZIP (lossless). A name with a dot, "rayleigh.630.0", makes a layer of what stands before its
/// last dot in programs that show layers. Attributes other than those above are stored as "vegard:<key>",
/// out of the way of EXR's own names. Throws Error(unwritable_output), with `name` as the file it is about,
/// if the encoder gives up.
std::string encode_exr(const std::vector<const Image*>& images, const ImageAttributes& attributes,
                       const std::string& name = {});

/// The same into a file. Throws Error(usage) unless the extension is .exr, Error(existing_output),
/// Error(unwritable_output).
void write_exr(const std::string& path, const std::vector<const Image*>& images,
               const ImageAttributes& attributes, bool overwrite = false);
void write_exr(const std::string& path, const Image& image, const ImageAttributes& attributes,
               bool overwrite = false);

struct ExrFile {
  Image image;                 ///< R, G, B first, then the other channels by name
  ImageAttributes attributes;  ///< as given to write_exr; those of other programs are left out
};

/// Reads the data window of an EXR's first part, every pixel of it. Throws Error(unreadable_input) for a file
/// that is missing, truncated, damaged, too large for the memory or no EXR.
ExrFile read_exr(const std::string& path);

/// The same from the bytes of a file, which `name` is for messages.
ExrFile read_exr_bytes(std::string_view bytes, const std::string& name);

/// Reads a PNG, JPEG, TIFF or EXR, known by its extension, and turns it upright; of other channels than
/// these, layers included, nothing is seen. Throws Error(unreadable_input) for a file that is missing,
/// truncated, damaged, too large for the memory, not what its extension says, without colour, or with values
/// that are no finite numbers.
PictureFile read_picture(const std::string& path);

/// A picture for the eye: one channel or three, already encoded for display, 0 = black, 1 = full. Values are
/// limited to [0, 1] (NaN is black) and rounded to the nearest step. bits: 8, or 16 for PNG and TIFF.
/// jpeg_quality: 1-100, colour at full resolution. PNG keeps attributes as text chunks; TIFF and JPEG keep
/// them as "key=value" lines of the image description, JPEG the first 30 000 bytes of it. Returns the bytes
/// of the file. Throws Error(usage) for an EXR, a depth or a size that the format cannot hold, with `name` as
/// the file it is about; Error(unwritable_output) if the encoder gives up.
std::string encode_display(ImageFormat format, const Image& encoded, int bits, int jpeg_quality,
                           const ImageAttributes& attributes, const std::string& name = {});

/// The same into a file, its format by the extension. Throws Error(existing_output), Error(unwritable_output)
/// as well.
void write_display(const std::string& path, const Image& encoded, int bits, int jpeg_quality,
                   const ImageAttributes& attributes, bool overwrite = false);

/// "2.4.7", for `vegard --version`.
std::string image_library_version();

}  // namespace vegard::sim
