// Checks that the bytes of a picture are complete. Decoders fill missing parts silently, or report them only
// on the terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Returns the CRC-32 of a PNG's chunk, from its type to the end of its data (annex D).
std::uint32_t png_checksum(std::string_view type_and_data);

/// True if a PNG is a sequence of complete chunks with valid checksums up to IEND. Source: PNG (ISO/IEC
/// 15948:2004), 5.3 and 5.5.
bool png_is_whole(std::string_view bytes);

/// True if a JPEG is a sequence of complete segments up to EOI; bytes after it, and thumbnails inside of a
/// segment, are not checked. Source: ITU-T T.81, B.1.
bool jpeg_is_whole(std::string_view bytes);

struct ExrSize {
  long long width = 0, height = 0;
};

/// Returns the size of the frame of an EXR's first part, the display window. `beginning` has the first of the
/// file's `file_bytes` bytes. Throws Error(unreadable_input) naming `file` if a header is not completely in
/// `beginning`, has no size, needs more bytes than the file has, or has a size beyond pixel_limit.h:
/// OpenEXR 3.1 trusts the sizes in headers and allocates memory for them. Source: the OpenEXR file layout:
/// magic number, version, then headers of attributes (name, type, size, value), each up to an empty name; in
/// multi-part files one more empty name ends the headers.
ExrSize check_exr_header(std::string_view beginning, std::size_t file_bytes, const std::string& file);

}  // namespace vegard::sim
