#include "fit/photo/codec/picture_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "fit/photo/codec/pnm_header.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/base/picture/whole_picture.h"

namespace vegard::fit {
namespace {

// ITU-T T.81, table B.1.
constexpr int kStartOfImage = 0xd8, kEndOfImage = 0xd9, kStartOfScan = 0xda, kQuantisation = 0xdb,
              kApp1 = 0xe1, kTemporary = 0x01;

bool is_restart(int marker) { return marker >= 0xd0 && marker <= 0xd7; }

/// SOF0 to SOF15 without DHT, JPG and DAC, which lie between them.
bool is_start_of_frame(int marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

using namespace sim::tiff_tag;
using sim::TiffDirectory;

int checked_orientation(std::uint64_t value) {
  return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
}

sim::Error unsupported_picture(const std::string& file, const std::string& kind) {
  return sim::unreadable(file, kind + " is not read")
      .expected("8 or 16 bits, or a TIFF of 32-bit floats, grey or RGB")
      .hint("save it again as a plain PNG or TIFF");
}

void check_kind(const TiffDirectory& directory, ImageFile& image, const std::string& file) {
  const auto samples = directory.value(kSamples, 1);
  const auto photometric = directory.value(kPhotometric, 1);
  const auto format = directory.value(kSampleFormat, 1);
  const auto bits = directory.values(kBits);
  image.bits = bits && !bits->empty() ? static_cast<int>(std::min<std::uint64_t>(bits->front(), 1000)) : 1;
  image.floating = format == 3;
  if (bits && std::adjacent_find(bits->begin(), bits->end(), std::not_equal_to<>()) != bits->end())
    throw unsupported_picture(file, "a TIFF with channels of different depth");
  if (!(image.floating ? image.bits == 32 : format == 1 && (image.bits == 8 || image.bits == 16)))
    throw unsupported_picture(file, "a TIFF of " + std::to_string(image.bits) + "-bit " +
                                        (image.floating ? "floats"
                                         : format == 1  ? "integers"
                                                        : "signed or odd numbers"));
  if (samples != 1 && samples != 3 && samples != 4)
    throw unsupported_picture(file, "a TIFF of " + std::to_string(samples) + " samples per pixel");
  // libtiff's own conversion, which OpenCV uses for 8 bits, also does palettes and YCbCr.
  const bool plain = photometric == 1 || photometric == 2;
  const bool converted = image.bits == 8 && (photometric == 3 || photometric == 6);
  if (!plain && !converted)
    throw unsupported_picture(file, "a TIFF that is neither grey from black up nor RGB");
  if (image.bits != 8 && samples > 1 && directory.value(kPlanar, 1) != 1)
    throw unsupported_picture(file, "a TIFF of more than 8 bits with its channels in separate planes");
  constexpr std::uint64_t kUnassociatedAlpha = 2;
  image.colour_times_alpha =
      image.bits == 8 && samples == 4 && directory.value(kExtraSamples, 0) == kUnassociatedAlpha;
}

}  // namespace

/// The lowest frequencies of a JPEG's quantisation table, in the file's zigzag order: sums of the two
/// directions' numbers up to 2, whose errors neighbouring pixels share.
constexpr std::size_t kLowFrequencies = 6;
using LowSteps = std::array<double, kLowFrequencies>;

/// Reads a segment of quantisation tables (ITU-T T.81, B.2.4.1) as far as it is whole.
void read_low_steps(std::string_view segment, std::array<LowSteps, 4>& steps) {
  while (!segment.empty()) {
    const auto kind = static_cast<unsigned>(sim::unsigned_at(segment, 0, 1));
    const int size = kind >> 4 == 0 ? 1 : 2;
    const std::size_t length = 1 + 64 * static_cast<std::size_t>(size);
    if (segment.size() < length || (kind & 15) >= steps.size()) return;
    for (std::size_t k = 0; k < kLowFrequencies; ++k)
      steps[kind & 15][k] = static_cast<double>(sim::unsigned_at(segment, 1 + k * size, size));
    segment.remove_prefix(length);
  }
}

/// Returns the errors in R, G and B by the rounding of luma's and chroma's lowest frequencies and of the
/// colours. A coefficient that is rounded to steps of q is wrong by q^2 / 12 in the mean square, and a pixel
/// by 1 / 64 of that (T.81, A.3.3: the transform is orthonormal); colours by JFIF 1.02. The colours' own
/// rounding is alike over a block where the picture is smooth, and counts in full. A frame of one component
/// is grey; of one whose components are called R, G and B nothing is told.
std::array<double, 3> block_error(std::string_view frame, const std::array<LowSteps, 4>& steps) {
  const auto components = static_cast<std::size_t>(sim::unsigned_at(frame, 5, 1));
  if ((components != 1 && components != 3) || frame.size() < 6 + 3 * components) return {};
  if (components == 3 && frame[6] == 'R') return {};
  constexpr double kRounding = 1.0 / 12.0;
  std::array<double, 3> variance{};
  for (std::size_t i = 0; i < components; ++i) {
    const auto table = static_cast<std::size_t>(sim::unsigned_at(frame, 6 + 3 * i + 2, 1));
    if (table >= steps.size()) return {};
    for (const double q : steps[table]) variance[i] += q * q * kRounding / 64.0;
  }
  constexpr double kRedOfCr = 1.402, kGreenOfCb = 0.344136, kGreenOfCr = 0.714136, kBlueOfCb = 1.772;
  const auto [luma, cb, cr] = variance;
  return {std::sqrt(luma + kRedOfCr * kRedOfCr * cr + kRounding),
          std::sqrt(luma + kGreenOfCb * kGreenOfCb * cb + kGreenOfCr * kGreenOfCr * cr + kRounding),
          std::sqrt(luma + kBlueOfCb * kBlueOfCb * cb + kRounding)};
}

ImageFile walk_jpeg(std::string_view bytes, const std::string& file) {
  ImageFile image;
  bool frame_seen = false, scan_seen = false, exif_seen = false;
  std::array<LowSteps, 4> steps{};
  std::string_view frame;
  std::size_t at = 2;
  while (true) {
    // To the next marker. Inside a scan 0xff is followed by a stuffed zero or a restart marker; bytes that
    // belong to nothing are skipped, as libjpeg does.
    while (at + 1 < bytes.size()) {
      const int next = static_cast<unsigned char>(bytes[at + 1]);
      if (bytes[at] == '\xff' && next != 0 && next != 0xff && !is_restart(next)) break;
      ++at;
    }
    if (at + 1 >= bytes.size())
      throw sim::truncated(
          file, scan_seen ? "the JPEG end-of-image marker is missing" : "it ends before the picture");
    const int marker = static_cast<unsigned char>(bytes[at + 1]);
    at += 2;
    if (marker == kEndOfImage) break;
    if (marker == kTemporary || marker == kStartOfImage) continue;

    if (at + 2 > bytes.size()) throw sim::truncated(file, "it ends inside a JPEG segment");
    const std::size_t length = sim::unsigned_at(bytes, at, 2);
    if (length < 2) throw sim::damaged(file, "a JPEG segment of impossible length");
    if (at + length > bytes.size()) throw sim::truncated(file, "it ends inside a JPEG segment");
    const std::string_view segment = bytes.substr(at + 2, length - 2);
    at += length;

    if (marker == kApp1 && !exif_seen && segment.substr(0, 6) == std::string_view("Exif\0\0", 6)) {
      image.orientation = exif_orientation(segment.substr(6));
      exif_seen = true;
    } else if (is_start_of_frame(marker) && segment.size() >= 6) {
      image.bits = static_cast<int>(sim::unsigned_at(segment, 0, 1));
      image.height = static_cast<long long>(sim::unsigned_at(segment, 1, 2));
      image.width = static_cast<long long>(sim::unsigned_at(segment, 3, 2));
      frame_seen = true;
      frame = segment;
    } else if (marker == kQuantisation) {
      read_low_steps(segment, steps);
    } else if (marker == kStartOfScan) {
      scan_seen = true;
    }
  }
  if (!frame_seen || !scan_seen) throw sim::damaged(file, "a JPEG without a picture in it");
  if (image.bits != 8) throw unsupported_picture(file, "a JPEG of " + std::to_string(image.bits) + " bits");
  image.block_error = block_error(frame, steps);
  return image;
}

ImageFile walk_png(std::string_view bytes, const std::string& file) {
  ImageFile image;
  bool first = true, data_seen = false;
  std::size_t at = 8;
  while (true) {
    if (at + 12 > bytes.size()) throw sim::truncated(file, "the PNG end chunk is missing");
    const std::size_t length = sim::unsigned_at(bytes, at, 4);
    if (length > bytes.size() - at - 12) throw sim::truncated(file, "it ends inside a PNG chunk");
    const std::string_view type = bytes.substr(at + 4, 4);
    const std::string_view data = bytes.substr(at + 8, length);
    const bool critical = type[0] >= 'A' && type[0] <= 'Z';
    // A wrong checksum in an ancillary chunk (lower-case initial) harms no pixel.
    if (critical &&
        sim::png_checksum(bytes.substr(at + 4, 4 + length)) != sim::unsigned_at(bytes, at + 8 + length, 4))
      throw sim::damaged(file, "the checksum of its PNG chunk " + std::string(type) + " is wrong");
    at += 12 + length;

    if (first) {
      if (type != "IHDR" || length != 13) throw sim::damaged(file, "a PNG without its header");
      image.width = static_cast<long long>(sim::unsigned_at(data, 0, 4));
      image.height = static_cast<long long>(sim::unsigned_at(data, 4, 4));
      image.bits = static_cast<int>(sim::unsigned_at(data, 8, 1));
      first = false;
    } else if (type == "IDAT") {
      data_seen = true;
    } else if (type == "eXIf") {
      image.orientation = exif_orientation(data);
    } else if (type == "IEND") {
      break;
    }
  }
  if (!data_seen) throw sim::damaged(file, "a PNG without a picture in it");
  return image;
}

int exif_orientation(std::string_view tiff) {
  using namespace std::string_view_literals;
  if (tiff.substr(0, 4) != "II\x2a\0"sv && tiff.substr(0, 4) != "MM\0\x2a"sv) return 1;
  const TiffDirectory directory(tiff);
  return directory.complete() ? checked_orientation(directory.value(kOrientation, 1)) : 1;
}

ImageFile walk_tiff(std::string_view bytes, const std::string& file) {
  const TiffDirectory directory(bytes);
  if (!directory.complete()) throw sim::truncated(file, "its TIFF directory lies beyond the end");
  ImageFile image;
  // A size beyond 32 bits is no image's: cut where the check of the size still refuses it.
  constexpr std::uint64_t kMax = 0xffffffffu;
  image.width = static_cast<long long>(std::min(directory.value(kWidth, 0), kMax));
  image.height = static_cast<long long>(std::min(directory.value(kHeight, 0), kMax));
  image.orientation = checked_orientation(directory.value(kOrientation, 1));
  check_kind(directory, image, file);
  check_strips_are_inside(directory, bytes.size(), file);
  return image;
}

void check_strips_are_inside(const TiffDirectory& directory, std::size_t file_size, const std::string& file) {
  const bool tiled = directory.values(kTileOffsets, 1).has_value();
  const auto offsets = directory.values(tiled ? kTileOffsets : kStripOffsets);
  const auto counts = directory.values(tiled ? kTileBytes : kStripBytes);
  if (!directory.inside()) throw sim::truncated(file, "the list of its TIFF strips lies beyond the end");
  if (!offsets || offsets->empty()) throw sim::damaged(file, "a TIFF without a picture in it");
  for (std::size_t i = 0; i < offsets->size(); ++i) {
    const std::uint64_t begin = (*offsets)[i];
    const std::uint64_t length = counts && i < counts->size() ? (*counts)[i] : 1;
    if (begin > file_size || length > file_size - begin)
      throw sim::truncated(file, "TIFF strip " + std::to_string(i + 1) + " of " +
                                     std::to_string(offsets->size()) + " reaches beyond the end");
  }
}

ImageFile walk_pnm(std::string_view bytes, const std::string& file) {
  const PnmHeader header = pnm_header(bytes, file);
  ImageFile image;
  image.width = header.width;
  image.height = header.height;
  image.bits = 1;
  while (header.largest >> image.bits != 0) ++image.bits;
  sim::check_pixel_limit(image.width, image.height, file);
  const auto numbers = static_cast<std::size_t>(image.width * image.height * header.channels);
  // A number in words is a digit and a space at least, the last one without it.
  const std::size_t least = header.in_words ? 2 * numbers - 1 : numbers * (header.largest > 255 ? 2 : 1);
  const std::size_t there = bytes.size() - header.data;
  if (there < least)
    throw sim::truncated(file, "its header promises " + std::to_string(least) + " bytes of pixels and " +
                                   std::to_string(there) + " are there");
  return image;
}

ImageFile walk_exr(std::string_view bytes, const std::string& file) {
  const sim::ExrSize size = sim::check_exr_header(bytes, bytes.size(), file);
  ImageFile image;
  image.bits = 32;
  image.floating = true;
  image.width = size.width;
  image.height = size.height;
  return image;
}

}  // namespace vegard::fit
