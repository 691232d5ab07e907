#include <algorithm>
#include <vector>

#include "fit/photo/codec/picture_format.h"
#include "sim/base/error.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace {

using namespace std::string_view_literals;
using namespace sim::tiff_tag;
using sim::TiffDirectory;

// Photometric interpretations of TIFF/EP and DNG 1.4; compressions of Nikon, Sony, Pentax and Samsung.
constexpr std::uint64_t kColourFilters = 32803, kLinearRaw = 34892;
constexpr std::uint64_t kMakersCompressions[] = {32767, 32769, 32770, 34713, 65535};

bool is_tiff(std::string_view bytes) {
  return sim::starts_with(bytes, "II\x2a\0"sv) || sim::starts_with(bytes, "MM\0\x2a"sv);
}

/// True for the first bytes of raw files that are no TIFFs: Fujifilm, Canon (CRW, CR3), Olympus, Panasonic,
/// Minolta, Sigma.
bool has_makers_start(std::string_view bytes) {
  for (const std::string_view start : {"FUJIFILMCCD-RAW"sv, "IIRO"sv, "IIRS"sv, "MMOR"sv, "IIU\0"sv,
                                       "\0MRM"sv, "FOVb"sv, "II\x1a\0\0\0HEAPCCDR"sv})
    if (sim::starts_with(bytes, start)) return true;
  return bytes.substr(4, 8) == "ftypcrx ";
}

/// The first directory and those below it.
std::vector<TiffDirectory> directories(std::string_view bytes) {
  std::vector<TiffDirectory> all = {TiffDirectory(bytes)};
  if (!all.front().complete()) return all;
  constexpr std::size_t kMax = 16;
  const auto below = all.front().values(kSubDirectories, kMax);
  if (below)
    for (const std::uint64_t at : *below) all.emplace_back(bytes, at);
  return all;
}

bool holds_raw(const TiffDirectory& directory) {
  if (!directory.complete()) return false;
  const auto photometric = directory.value(kPhotometric, 0);
  const auto compression = directory.value(kCompression, 1);
  return photometric == kColourFilters || photometric == kLinearRaw || directory.value(kDngVersion, 0) != 0 ||
         std::find(std::begin(kMakersCompressions), std::end(kMakersCompressions), compression) !=
             std::end(kMakersCompressions);
}

}  // namespace

bool is_camera_raw(std::string_view bytes) {
  if (bytes.size() < 16) return false;
  if (has_makers_start(bytes)) return true;
  if (!is_tiff(bytes)) return false;
  if (bytes.substr(8, 2) == "CR") return true;
  const auto all = directories(bytes);
  return std::any_of(all.begin(), all.end(), holds_raw);
}

ImageFile walk_camera_raw(std::string_view bytes, const std::string& file) {
  ImageFile image;
  image.size_comes_later = true;
  image.bits = 16;
  if (!is_tiff(bytes)) return image;
  for (const TiffDirectory& directory : directories(bytes)) {
    if (!directory.complete()) throw sim::truncated(file, "one of its TIFF directories lies beyond the end");
    // A size beyond 32 bits is no image's: cut where the check of the size still refuses it.
    constexpr std::uint64_t kMax = 0xffffffffu;
    const auto width = static_cast<long long>(std::min(directory.value(kWidth, 0), kMax));
    const auto height = static_cast<long long>(std::min(directory.value(kHeight, 0), kMax));
    if (width > image.width || height > image.height) image.width = width, image.height = height;
    constexpr std::uint64_t kMaxSamples = 4;
    const std::uint64_t samples = directory.value(kSamples, 1);
    if (samples < 1 || samples > kMaxSamples)
      throw sim::damaged(file, "a camera raw file of " + std::to_string(samples) + " samples per pixel");
    const bool has_picture =
        directory.values(kStripOffsets, 1).has_value() || directory.values(kTileOffsets, 1).has_value();
    if (has_picture) check_strips_are_inside(directory, bytes.size(), file);
  }
  return image;
}

}  // namespace vegard::fit
