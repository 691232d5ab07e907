// Checks that the bytes of a picture are complete. Decoders fill missing parts silently, or report them on
// the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vegard::sim {

/// True if the chunks of a PNG follow each other to its IEND and each has its checksum. Source: PNG (ISO/IEC
/// 15948:2004), 5.3 and 5.5.
bool png_is_whole(std::string_view bytes);

/// True if the segments of a JPEG follow each other to its EOI; what stands behind it is left alone, as is a
/// small picture inside a segment. Source: ITU-T T.81, B.1.
bool jpeg_is_whole(std::string_view bytes);

struct ExrSize {
  long long width = 0, height = 0;
};

/// Size of an EXR's first part. `beginning`: the first of the file's `file_bytes` bytes. Throws
/// Error(unreadable_input) naming `file` where a header is not within them, says no size, promises more than
/// the file holds, or is larger than pixel_limit.h allows: OpenEXR 3.1 takes the sizes in it for what they
/// say, and the memory for it. Source: the OpenEXR file layout: magic, version, then headers of attributes
/// (name, type, size, value), each up to an empty name; in files of several parts one more empty name ends
/// the headers.
ExrSize check_exr_header(std::string_view beginning, std::size_t file_bytes, const std::string& file);

}  // namespace vegard::sim
