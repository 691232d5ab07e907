// Reads and writes image files: linear EXR and display pictures. Only sim/base/picture/image_io/ uses
// OpenImageIO, which is loaded when a file is first read or written (sim/base/module.h).
//
// Files appear complete or not at all (whole_file.h). The same image and attributes give the same bytes on
// every run and for every number of threads: no time of writing, machine or path is in a file.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/image.h"

namespace vegard::sim {

/// Metadata of an image file, as text. Some keys have a meaning: "DateTime" (ISO 8601 or EXIF style; the time
/// of the scene, never of writing), "ImageDescription" and, in an EXR, "whiteLuminance" (cd m^-2 of a value
/// of 1 in R, G and B). Numbers are text too, since OpenImageIO drops 64-bit integers.
using ImageAttributes = std::map<std::string, std::string>;

enum class ImageFormat { exr, png, tiff, jpeg };

/// Returns the format by the extension, in either case: .exr .png .tif .tiff .jpg .jpeg. Throws Error(usage)
/// for others.
ImageFormat image_format(const std::string& path);

/// Returns the bytes of an EXR with the channels of all images, which must have the same size and different
/// channel names: 32-bit float, ZIP (lossless). Programs that show layers use the part of a name before its
/// last dot as the layer: "rayleigh.630" for "rayleigh.630.0". Attributes other than those above are stored
/// as "vegard:<key>", so that they do not collide with EXR's own names. Throws Error(unwritable_output),
/// about the file `name`, if the encoder fails.
std::string encode_exr(const std::vector<const Image*>& images, const ImageAttributes& attributes,
                       const std::string& name = {});

/// Write the bytes of encode_exr() to a file. Throw Error(usage) unless the extension is .exr,
/// Error(existing_output), Error(unwritable_output).
void write_exr(const std::string& path, const std::vector<const Image*>& images,
               const ImageAttributes& attributes, bool overwrite = false);
void write_exr(const std::string& path, const Image& image, const ImageAttributes& attributes,
               bool overwrite = false);

struct ExrFile {
  Image image;                 ///< R, G, B first, then the other channels by name
  ImageAttributes attributes;  ///< as given to write_exr(); without those of other programs
};

/// Reads all pixels of the data window of an EXR's first part. Throws Error(unreadable_input) for a file that
/// is missing, truncated, damaged, too large for the memory or not an EXR.
ExrFile read_exr(const std::string& path);

/// The same from the bytes of a file; messages show `name`.
ExrFile read_exr_bytes(std::string_view bytes, const std::string& name);

/// Reads a PNG, JPEG, TIFF or EXR, chosen by its extension, and rotates it upright; channels other than those
/// of PictureFile, and layers, are ignored. Throws Error(unreadable_input) for a file that is missing,
/// truncated, damaged, too large for the memory, of another format than its extension, without colour, or
/// with values that are not finite.
PictureFile read_picture(const std::string& path);

/// Returns the bytes of a display picture: one channel or three, already encoded for display, 0 = black, 1 =
/// full. Values are clamped to [0, 1] (NaN is black) and rounded to the nearest step. bits: 8, or 16 for PNG
/// and TIFF. jpeg_quality: 1-100, without chroma subsampling. PNG stores attributes as text chunks; TIFF and
/// JPEG as "key=value" lines of the image description, of which JPEG has the first 30 000 bytes. Throws
/// Error(usage), about the file `name`, for an EXR and for a depth or size that the format does not support;
/// Error(unwritable_output) if the encoder fails.
std::string encode_display(ImageFormat format, const Image& encoded, int bits, int jpeg_quality,
                           const ImageAttributes& attributes, const std::string& name = {});

/// Writes the bytes of encode_display() to a file, in the format of its extension. Also throws
/// Error(existing_output), Error(unwritable_output).
void write_display(const std::string& path, const Image& encoded, int bits, int jpeg_quality,
                   const ImageAttributes& attributes, bool overwrite = false);

/// Returns the version of OpenImageIO for which this was compiled, "2.4.7", without loading it.
std::string image_library_version();

}  // namespace vegard::sim
