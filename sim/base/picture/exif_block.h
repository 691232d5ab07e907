// Finds the EXIF data in a picture's file.
//
// This is a small parser instead of an image library, because untrusted files should not be decoded only for
// their metadata. Sources: JPEG ITU-T T.81 annex B and EXIF 2.32 section 4.5.4; PNG ISO/IEC 15948 and its
// extension eXIf; HEIF ISO/IEC 23008-12 annex A with the boxes of ISO/IEC 14496-12 section 8.11. TIFF, and
// raw files with the structure of a TIFF, have the data directly.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace vegard::sim {

struct ExifBlock {
  std::string_view tiff;  ///< the EXIF data from their TIFF header on; empty: none
  /// Width and height by the container, before orientation.
  std::optional<std::pair<int, int>> size_px;
  bool exif_turns = true;  ///< EXIF's orientation applies; false for HEIC, which has its own property
};

/// Finds the data in the bytes of a JPEG, PNG, TIFF, HEIC or raw file, complete or truncated. Never throws.
ExifBlock find_exif_block(std::string_view bytes);

/// True if the first bytes (32 are enough) are those of such a file.
bool may_have_exif(std::string_view bytes);

}  // namespace vegard::sim
