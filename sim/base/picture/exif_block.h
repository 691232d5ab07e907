// Finds the EXIF data in a picture's file.
//
// A small walk of its own, and not an image library's: files lie, and a library that decodes a picture on the
// way to its words is a long way to walk with them. Sources: JPEG ITU-T T.81 annex B and EXIF 2.32 section
// 4.5.4; PNG ISO/IEC 15948 and its extension eXIf; HEIF ISO/IEC 23008-12 annex A with the boxes of ISO/IEC
// 14496-12 section 8.11; TIFF, and the raw files that are built like one, hold them as they are.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace vegard::sim {

struct ExifBlock {
  std::string_view tiff;  ///< beginning with a TIFF header; empty if there is none
  /// Width and height as the container says, before orientation.
  std::optional<std::pair<int, int>> size_px;
  bool exif_turns = true;  ///< EXIF's orientation counts; a HEIC has a property of its own instead
};

/// Bytes of a JPEG, PNG, TIFF, HEIC or raw file, whole or not; empty for anything else. Never throws.
ExifBlock find_exif_block(std::string_view bytes);

/// True if the first bytes (32 are enough) are those of such a file.
bool may_have_exif(std::string_view bytes);

}  // namespace vegard::sim
