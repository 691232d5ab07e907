// The first bytes of picture formats, for messages about files of another kind than expected.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vegard::sim {

/// The number of bytes of a file's beginning that are needed.
inline constexpr std::size_t kSignatureBytes = 16;

struct PictureSignature {
  std::size_t at;
  std::string_view bytes;
  const char* format;
};

// JPEG (ITU-T T.81), annex B; PNG (ISO/IEC 15948), 5.2; TIFF 6.0, section 2 (raw files of most makers have
// its head, Olympus's and Fujifilm's one of their own); FITS 4.0, section 4.4.1; OpenEXR's magic number;
// ISO/IEC 14496-12 for HEIC, AVIF and CR3; RFC 9649 for WebP.
inline constexpr PictureSignature kPictureSignatures[] = {
    {0, {"\xff\xd8\xff", 3}, "JPEG"}, {0, {"\x89PNG\r\n\x1a\n", 8}, "PNG"},
    {0, {"II*\0", 4}, "TIFF or raw"}, {0, {"MM\0*", 4}, "TIFF or raw"},
    {0, {"IIRO", 4}, "raw"},          {0, {"FUJIFILMCCD-RAW", 15}, "raw"},
    {0, {"SIMPLE  =", 9}, "FITS"},    {0, {"\x76\x2f\x31\x01", 4}, "EXR"},
    {4, {"ftyphei", 7}, "HEIC"},      {4, {"ftypmif1", 8}, "HEIC"},
    {4, {"ftypavif", 8}, "AVIF"},     {4, {"ftypcrx ", 8}, "raw"},
    {8, {"WEBP", 4}, "WebP"},         {0, {"GIF8", 4}, "GIF"},
};

/// Returns the format whose signature the bytes have, "JPEG", "TIFF or raw", "PNM", …; empty for any other
/// bytes, such as those of a text.
inline std::string picture_format_of(std::string_view beginning) {
  for (const PictureSignature& one : kPictureSignatures)
    if (beginning.substr(0, kSignatureBytes).size() >= one.at + one.bytes.size() &&
        beginning.substr(one.at, one.bytes.size()) == one.bytes)
      return one.format;
  // "BM", four bytes of size, four zeros; "P5", white space and a number: no TOML file begins like this.
  if (beginning.size() >= 10 && beginning.substr(0, 2) == "BM" &&
      beginning.substr(6, 4) == std::string_view("\0\0\0\0", 4))
    return "BMP";
  const auto one_of = [&](std::size_t at, std::string_view any) {
    return beginning.size() > at && any.find(beginning[at]) != std::string_view::npos;
  };
  if (one_of(0, "P") && one_of(1, "123456") && one_of(2, " \t\r\n") && one_of(3, "0123456789#")) return "PNM";
  return {};
}

}  // namespace vegard::sim
