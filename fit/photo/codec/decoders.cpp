#include <algorithm>
#include <cstdlib>
#include <limits>

#include "fit/photo/codec/full_scale.h"
#include "fit/photo/codec/picture_format.h"
#include "fit/photo/codec/pnm_header.h"
#include "fit/photo/codec/sensor_mosaic.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/coded_picture.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"

namespace vegard::fit {
namespace {

/// A keyword's number, or that if there is none.
double number_of(const sim::FitsKeywords& keywords, const char* key, double if_absent) {
  const auto found = keywords.find(key);
  if (found == keywords.end()) return if_absent;
  char* end = nullptr;
  const double value = std::strtod(found->second.c_str(), &end);
  return end == found->second.c_str() ? if_absent : value;
}

}  // namespace

PictureCodes decode_exr(std::string_view bytes, const ImageFile& /*image*/, const std::string& file) {
  sim::ExrFile exr = sim::read_exr_bytes(bytes, file);
  const sim::Image& all = exr.image;
  const auto place = [&](const char* name) {
    const auto at = std::find(all.channel_names.begin(), all.channel_names.end(), name);
    return at == all.channel_names.end() ? -1 : static_cast<int>(at - all.channel_names.begin());
  };
  std::vector<int> from = {place("R"), place("G"), place("B")};
  if (*std::min_element(from.begin(), from.end()) < 0) {
    from = {place("Y")};
    if (from[0] < 0 && all.channels() == 1) from[0] = 0;
    if (from[0] < 0)
      throw sim::unreadable(file, "there is no picture in it")
          .expected("the channels R, G and B, or Y, or only one channel");
  }
  PictureCodes codes;
  codes.width = all.width;
  codes.height = all.height;
  codes.channels = static_cast<int>(from.size());
  codes.white = 1.0;
  codes.step = 0.0;
  codes.bits = 32;
  codes.floating = codes.linear = true;
  codes.kind = "float EXR";
  codes.values.reserve(static_cast<std::size_t>(all.width) * all.height * from.size());
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x)
      for (const int channel : from) codes.values.push_back(all.at(x, y, channel));
  codes.words = std::move(exr.attributes);
  return codes;
}

ImageFile walk_fits(std::string_view /*bytes*/, const std::string& /*file*/) {
  ImageFile image;  // checked by sim/base/picture/fits_io.h
  image.size_comes_later = true;
  return image;
}

PictureCodes decode_fits(std::string_view bytes, const ImageFile& image, const std::string& file) {
  sim::FitsImage fits = sim::read_fits_image(bytes, file);
  const int planes = fits.image.channels();
  if (planes != 1 && planes != 3)
    throw sim::unreadable(file, "this FITS image has " + std::to_string(planes) + " planes")
        .expected("one, or three for red, green and blue");
  PictureCodes codes;
  codes.width = fits.image.width;
  codes.height = fits.image.height;
  codes.channels = planes;
  codes.bits = fits.bits;
  codes.linear = true;
  codes.kind = std::to_string(fits.bits) + (fits.floating ? "-bit float FITS" : "-bit FITS");
  constexpr double kNone = std::numeric_limits<double>::infinity();
  // The standard's DATAMAX is the largest valid value; SATURATE is where it is none any more.
  double saturate = number_of(fits.keywords, "SATURATE", kNone);
  const double valid = number_of(fits.keywords, "DATAMAX", kNone);
  codes.floating = fits.floating || !(fits.largest > 0.0);
  codes.white = codes.floating ? 1.0 : fits.largest;
  codes.step = codes.floating ? 0.0 : fits.step;
  // Below the first step above zero nothing is white.
  if (!codes.floating && !(saturate >= codes.step)) saturate = kNone;
  if (!codes.floating && saturate < codes.white) codes.white = saturate;
  codes.usable = std::move(fits.known);
  for (std::size_t i = 0; i < codes.usable.size(); ++i) {
    const double value = fits.image.data[i];
    if (value >= saturate || value > valid) codes.usable[i] = 0;
  }
  codes.values = std::move(fits.image.data);
  codes.words = std::move(fits.keywords);
  mark_full_scale(image.declared.converter_bits, codes);
  if (planes == 1)
    if (const auto mosaic = fits_mosaic(codes.words, codes.height, file)) demosaic(*mosaic, codes);
  return codes;
}

PictureCodes decode_heif(std::string_view bytes, const ImageFile& /*image*/, const std::string& file) {
  const sim::CodedPicture picture = sim::read_heif(bytes, file);
  if (!heif_promises(bytes, picture.width, picture.height, file))
    throw sim::unreadable(file, "the image decodes to something else than its header promises")
        .hint("open it in an image viewer and save it again");
  PictureCodes codes;
  codes.width = picture.width;
  codes.height = picture.height;
  codes.values.assign(picture.codes.begin(), picture.codes.end());
  codes.kind = "8-bit HEIC by " + picture.library;
  return codes;
}

PictureCodes decode_pnm(std::string_view bytes, const ImageFile& image, const std::string& file) {
  const PnmHeader header = pnm_header(bytes, file);
  PictureCodes codes;
  codes.width = static_cast<int>(header.width);
  codes.height = static_cast<int>(header.height);
  codes.channels = header.channels;
  codes.white = header.largest;
  codes.bits = image.bits;
  constexpr int kLargestOfEightBits = 255;
  const bool are_counts = bytes.substr(0, header.data).find(kPnmOfCounts) != std::string_view::npos;
  if (header.largest > kLargestOfEightBits) assume_light(codes, header.channels == 1 || are_counts);
  codes.kind = kind_of_codes(image);
  codes.values.resize(static_cast<std::size_t>(codes.width) * codes.height * codes.channels);
  const int size = header.largest > 255 ? 2 : 1;
  std::size_t at = header.data;
  for (float& value : codes.values) {
    long long number = 0;
    if (header.in_words) {
      number = next_pnm_number(bytes, at);
      if (number < 0 && at >= bytes.size()) throw sim::truncated(file, "it ends before its last pixel");
      if (number < 0) throw sim::damaged(file, "there is something else than numbers among its pixels");
    } else {
      number = static_cast<long long>(sim::unsigned_at(bytes, at, size));
      at += size;
    }
    if (number > header.largest)
      throw sim::damaged(file, "a pixel is " + std::to_string(number) +
                                   ", above the header's largest value " + std::to_string(header.largest));
    value = static_cast<float>(number);
  }
  mark_full_scale(0, codes);
  return codes;
}

PictureCodes decode_camera_raw(std::string_view bytes, const ImageFile& /*image*/, const std::string& file) {
  const sim::CodedPicture picture = sim::read_camera_raw(bytes, file);
  PictureCodes codes;
  codes.width = picture.width;
  codes.height = picture.height;
  codes.bits = 16;
  codes.white = 65535.0;
  codes.linear = true;
  codes.kind = "camera raw by " + picture.library + ", gains 1, 1, 1, bilinear";
  codes.values.assign(picture.codes.begin(), picture.codes.end());
  // A full site has had a part in its channel of the eight pixels around it.
  codes.usable.assign(codes.values.size(), 1);
  for (int y = 0; y < codes.height; ++y)
    for (int x = 0; x < codes.width; ++x)
      for (int c = 0; c < 3; ++c) {
        if (picture.codes[(static_cast<std::size_t>(y) * codes.width + x) * 3 + c] < 65535) continue;
        for (int v = std::max(0, y - 1); v <= std::min(codes.height - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(codes.width - 1, x + 1); ++u)
            codes.usable[(static_cast<std::size_t>(v) * codes.width + u) * 3 + c] = 0;
      }
  return codes;
}

}  // namespace vegard::fit
