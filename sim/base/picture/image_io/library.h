// What the readers and writers of this folder share: the library's set-up, its errors, the encoder.
//
// This folder is the only place that knows of OpenImageIO, and this header is for this folder alone.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "sim/base/error.h"

namespace vegard::sim {

/// No threads of the library's own; to be called before anything else of it.
void configure_library();

/// An Error about the file `name`.
/// The library's words, in which the user's name stands for that under which the library knows the bytes.
std::string with_name(std::string words, const std::string& stand_in, const std::string& name);

Error failure(ErrorKind kind, const std::string& name, std::string problem, std::string expected = {});

/// Throws Error(unreadable_input) unless the path leads to a file.
void check_is_file(const std::string& path);

/// The same of an EXR whose header promises what it does not hold: check_exr_header().
void check_exr_file(const std::string& path);

/// Throws Error(unreadable_input) for an image without pixels, or of more than 2^30 numbers (4 GiB of
/// floats).
void check_size(const OIIO::ImageSpec& spec, const std::string& path);

/// What decodes a format and its version, "LibRaw 0.20.2-Release" of "raw"; "" if the library does not say.
std::string decoder_version(const std::string& format);

/// The whole file in memory. Encoders that write to a disk themselves do not all look at what their last,
/// buffered bytes came to; WholeFile does. The encoder is that of the extension of `file_name`; errors are
/// about `name`. Throws Error(unwritable_output).
std::string encode(const std::string& file_name, const std::string& name, const OIIO::ImageSpec& spec,
                   const void* pixels);

}  // namespace vegard::sim
