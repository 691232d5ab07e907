// Whether the bytes of a picture are all there: decoders fill up what is missing without a word, or say it on
// the terminal.
#pragma once

#include <string_view>

namespace vegard::sim {

/// True if the chunks of a PNG follow each other to its IEND and each has its checksum. Source: PNG (ISO/IEC
/// 15948:2004), 5.3 and 5.5.
bool png_is_whole(std::string_view bytes);

/// True if the segments of a JPEG follow each other to its EOI; what stands behind it is left alone, as is a
/// small picture inside a segment. Source: ITU-T T.81, B.1.
bool jpeg_is_whole(std::string_view bytes);

}  // namespace vegard::sim
