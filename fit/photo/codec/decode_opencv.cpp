#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>  // for its flags alone: opencv_codecs.h
#include <opencv2/imgproc.hpp>

#include "fit/photo/codec/full_scale.h"
#include "fit/photo/codec/jpeg_rows.h"
#include "fit/photo/codec/opencv_codecs.h"
#include "fit/photo/codec/picture_format.h"
#include "sim/base/error.h"
#include "sim/base/module.h"
#include "sim/base/picture/png_pixels.h"

namespace vegard::fit {
namespace {

/// EXIF 2.3, tag 274: where the stored first row and column belong.
cv::Mat upright(const cv::Mat& stored, int orientation) {
  constexpr int kLeftRight = 1, kUpDown = 0;
  cv::Mat turned = stored;
  if (orientation >= 5) cv::transpose(stored, turned);
  switch (orientation) {
    case 2:
    case 6:
      cv::flip(turned, turned, kLeftRight);
      break;
    case 4:
    case 8:
      cv::flip(turned, turned, kUpDown);
      break;
    case 3:
    case 7:
      cv::flip(turned, turned, -1);
      break;
    default:
      break;
  }
  return turned;
}

/// Of what libjpeg says of damage, OpenCV passes nothing on. Empty for colours that only OpenCV converts.
cv::Mat decoded_jpeg(std::string_view bytes, const ImageFile& image, const std::string& file) {
  JpegRows rows(bytes, file, JpegRows::Order::blue_first);
  const bool turned = image.orientation >= 5;
  if (rows.channels() == 0 || rows.width() != (turned ? image.height : image.width) ||
      rows.height() != (turned ? image.width : image.height))
    return {};
  cv::Mat codes(rows.height(), rows.width(), CV_8UC(rows.channels()));
  rows.next_rows(codes.rows, codes.data);
  if (codes.channels() == 1) cv::cvtColor(codes, codes, cv::COLOR_GRAY2BGR);
  return codes;
}

/// Empty for what OpenCV has to decode.
cv::Mat decoded_png(std::string_view bytes, const ImageFile& image) {
  const bool turned = image.orientation >= 5;
  cv::Mat codes(turned ? image.width : image.height, turned ? image.height : image.width,
                image.bits == 16 ? CV_16UC3 : CV_8UC3);
  if (!sim::read_png_pixels(bytes, codes.cols, codes.rows, image.bits, codes.data)) return {};
  return codes;
}

cv::Mat decode(std::string_view bytes, const ImageFile& image, const std::string& file) {
  // What is wrong with an image is reported by sim::Error; OpenCV would write to the terminal as well.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  // OpenCV turns a TIFF by all eight orientations whatever the flags, and with IMREAD_COLOR fails on grey
  // floats; of the others it misses the orientation at times (fit/photo/codec/picture_format.h), so that is
  // done here.
  const bool tiff = image.format->walk == walk_tiff;
  const int flags = tiff ? static_cast<int>(cv::IMREAD_UNCHANGED)
                         : cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION;
  cv::Mat codes;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    if (image.format->walk == walk_jpeg) codes = decoded_jpeg(bytes, image, file);
    if (image.format->walk == walk_png) codes = decoded_png(bytes, image);
    if (codes.empty()) codes = sim::module_functions<OpenCvCodecs>().decode(buffer, flags);
    if (!codes.empty() && !tiff) codes = upright(codes, image.orientation);
    if (!codes.empty() && codes.channels() == 4) {
      cv::Mat alpha;
      cv::extractChannel(codes, alpha, 3);
      if (image.colour_times_alpha && cv::countNonZero(alpha != 255) > 0)
        throw sim::unreadable(file, "an 8-bit TIFF that is transparent in places is not read")
            .hint("save it without its alpha channel");
      cv::Mat colour(codes.size(), CV_MAKETYPE(codes.depth(), 3));
      cv::mixChannels(codes, colour, {0, 0, 1, 1, 2, 2});
      codes = colour;
    }
  } catch (const sim::Error&) {
    throw;
  } catch (const sim::MissingModule&) {
    throw;
  } catch (const std::exception&) {
    // OpenCV's own words name its source files and help nobody; memory may also be short.
    codes.release();
  }
  if (codes.empty())
    throw sim::unreadable(file, "the image cannot be decoded")
        .expected(std::string("a sound ") + image.format->name)
        .hint("open it in an image viewer and save it again");
  const bool turned = image.orientation >= 5;
  const int depth = image.floating ? CV_32F : image.bits == 16 ? CV_16U : CV_8U;
  const bool as_promised = codes.cols == (turned ? image.height : image.width) &&
                           codes.rows == (turned ? image.width : image.height) && codes.depth() == depth &&
                           (codes.channels() == 1 || codes.channels() == 3);
  if (!as_promised)
    throw sim::unreadable(file, "the image decodes to something else than its header promises")
        .hint("open it in an image viewer and save it again");
  return codes;
}

/// Keeps the codes of 8 bits as bytes, red first.
void keep_bytes(const cv::Mat& mat, PictureCodes& codes) {
  const auto kept = std::make_shared<cv::Mat>(mat.isContinuous() ? mat : mat.clone());
  if (codes.channels == 3) cv::cvtColor(*kept, *kept, cv::COLOR_BGR2RGB);
  codes.bytes = {kept, kept->data};
}

template <typename Code>
void take_codes(const cv::Mat& mat, PictureCodes& codes) {
  codes.values.resize(codes.size());
  std::size_t i = 0;
  for (int y = 0; y < mat.rows; ++y) {
    const Code* row = mat.ptr<Code>(y);
    for (int x = 0; x < mat.cols; ++x, row += codes.channels)
      // OpenCV has blue first.
      for (int c = codes.channels - 1; c >= 0; --c) codes.values[i++] = static_cast<float>(row[c]);
  }
}

/// By the colour type of its header; OpenCV may give such a file three channels.
bool is_grey_png(std::string_view bytes) {
  constexpr std::size_t kColourType = 25;
  return bytes.size() > kColourType && bytes.substr(1, 3) == "PNG" &&
         (bytes[kColourType] == 0 || bytes[kColourType] == 4);
}

}  // namespace

PictureCodes decode_by_opencv(std::string_view bytes, const ImageFile& image, const std::string& file) {
  const cv::Mat mat = decode(bytes, image, file);
  PictureCodes codes;
  codes.width = mat.cols;
  codes.height = mat.rows;
  codes.channels = mat.channels();
  // A PNG of fewer than 8 bits is stretched to 8 by libpng.
  codes.bits = std::max(8, image.bits);
  codes.floating = codes.linear = image.floating;
  codes.kind = kind_of_codes(image);
  switch (mat.depth()) {
    case CV_8U:
      codes.white = std::numeric_limits<std::uint8_t>::max();
      keep_bytes(mat, codes);
      break;
    case CV_16U:
      codes.white = std::numeric_limits<std::uint16_t>::max();
      assume_light(codes, codes.channels == 1 || is_grey_png(bytes));
      take_codes<std::uint16_t>(mat, codes);
      mark_full_scale(image.declared.converter_bits, codes);
      break;
    default:
      codes.white = 1.0;
      codes.step = 0.0;
      take_codes<float>(mat, codes);
      break;
  }
  return codes;
}

std::string encoded_png(const cv::Mat& picture, int zlib_level) {
  return sim::encode_plain_png(picture.data, picture.cols, picture.rows, picture.channels(), picture.step,
                               zlib_level);
}

}  // namespace vegard::fit
