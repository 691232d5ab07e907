#include "fit/photo.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "fit/image_file.h"
#include "sim/base/error.h"
#include "sim/base/sha256.h"
#include "sim/view/sensor.h"
#include "sim/view/transfer_curve.h"

namespace vegard::fit {
namespace {

/// A file's pixels as OpenCV gives them, upright: 1 or 3 (blue, green, red) channels of 8U, 16U or 32F.
struct Pixels {
  cv::Mat codes;
  ImageFile file;
  std::string sha256;
};

[[noreturn]] void refuse(const std::string& file, const std::string& problem,
                         const std::string& expected = {}, const std::string& hint = {}) {
  sim::ErrorDetails details;
  details.file = file;
  details.problem = problem;
  details.expected = expected;
  details.hint = hint;
  throw sim::Error(sim::ErrorKind::unreadable_input, details);
}

std::string file_name_of(const std::string& file) { return std::filesystem::path(file).filename().string(); }

std::string size_text(long long width, long long height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

std::string read_bytes(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status))
    refuse(file, error ? error.message() : "no such file", "an image file", "check the path");
  if (fs::is_directory(status)) refuse(file, "this is a folder", "an image file");
  if (!fs::is_regular_file(status)) refuse(file, "this is not a regular file", "an image file");
  const auto size = fs::file_size(file, error);
  if (error) refuse(file, error.message());
  // cv::imdecode counts bytes in an int.
  if (size > static_cast<std::uintmax_t>(std::numeric_limits<int>::max()))
    refuse(file, "the file is larger than 2 GiB", "", "scale or crop it first");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, "the file cannot be opened", "", "check its permissions");
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size)
    refuse(file, "the file cannot be read to its end");
  return bytes;
}

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

cv::Mat decode(const std::string& bytes, const ImageFile& image, const std::string& file) {
  // What is wrong with an image is told through sim::Error; OpenCV would tell the terminal as well.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  // OpenCV turns a TIFF by all eight orientations whatever the flags, and with IMREAD_COLOR fails on grey
  // floats; of the others it misses the orientation at times (fit/image_file.h), so that is done here.
  const bool tiff = image.format == ImageFormat::tiff;
  const int flags = tiff ? static_cast<int>(cv::IMREAD_UNCHANGED)
                         : cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION;
  cv::Mat codes;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    codes = cv::imdecode(buffer, flags);
    if (!codes.empty() && !tiff) codes = upright(codes, image.orientation);
    if (!codes.empty() && codes.channels() == 4) {
      cv::Mat alpha;
      cv::extractChannel(codes, alpha, 3);
      if (image.colour_times_alpha && cv::countNonZero(alpha != 255) > 0)
        refuse(file, "an 8-bit TIFF that is transparent in places is not read", "",
               "save it without its alpha channel");
      cv::Mat colour(codes.size(), CV_MAKETYPE(codes.depth(), 3));
      cv::mixChannels(codes, colour, {0, 0, 1, 1, 2, 2});
      codes = colour;
    }
  } catch (const sim::Error&) {
    throw;
  } catch (const std::exception&) {
    // OpenCV's own words name its source files and help nobody; memory may also be short.
    codes.release();
  }
  if (codes.empty())
    refuse(file, "the image cannot be decoded", std::string("a sound ") + format_name(image.format),
           "open it in an image viewer and save it anew");
  const bool turned = image.orientation >= 5;
  const int depth = image.floating ? CV_32F : image.bits == 16 ? CV_16U : CV_8U;
  const bool as_promised = codes.cols == (turned ? image.height : image.width) &&
                           codes.rows == (turned ? image.width : image.height) && codes.depth() == depth &&
                           (codes.channels() == 1 || codes.channels() == 3);
  if (!as_promised)
    refuse(file, "the image decodes to something else than its header promises", "",
           "open it in an image viewer and save it anew");
  return codes;
}

Pixels read_pixels(const std::string& file) {
  const std::string bytes = read_bytes(file);
  Pixels pixels;
  pixels.file = inspect_image_file(bytes, file);
  pixels.codes = decode(bytes, pixels.file, file);
  pixels.sha256 = sim::sha256(bytes);
  return pixels;
}

/// Calls visit(x, y, channel R = 0 … B = 2, code) for every value.
template <typename Code, typename Visit>
void for_each_code(const cv::Mat& codes, const Visit& visit) {
  const int channels = codes.channels();
  for (int y = 0; y < codes.rows; ++y) {
    const Code* row = codes.ptr<Code>(y);
    for (int x = 0; x < codes.cols; ++x)
      for (int c = 0; c < 3; ++c) visit(x, y, c, row[x * channels + (channels == 3 ? 2 - c : 0)]);
  }
}

template <typename Code>
void linearise_integers(const cv::Mat& codes, Photo& photo) {
  constexpr int kLargest = std::numeric_limits<Code>::max();
  std::vector<float> linear_of_code(kLargest + 1);
  for (int code = 0; code <= kLargest; ++code) {
    const double stored = static_cast<double>(code) / kLargest;
    linear_of_code[code] = static_cast<float>(photo.tone   ? photo.tone->decode(stored)
                                              : photo.srgb ? sim::srgb_decode(stored)
                                                           : stored);
  }
  for_each_code<Code>(codes, [&](int x, int y, int c, Code code) {
    const std::size_t i = photo.linear.index(x, y, c);
    photo.linear.data[i] = linear_of_code[code];
    photo.usable[i] = code < kLargest;
  });
}

void linearise_floats(const cv::Mat& codes, Photo& photo) {
  for_each_code<float>(codes, [&](int x, int y, int c, float value) {
    const std::size_t i = photo.linear.index(x, y, c);
    const bool finite = std::isfinite(value);
    photo.usable[i] = finite;
    photo.linear.data[i] = !finite      ? 0.0f
                           : photo.tone ? static_cast<float>(photo.tone->decode(value))
                           : photo.srgb ? static_cast<float>(sim::srgb_decode(value))
                                        : value;
  });
}

std::string decoding_text(const ImageFile& file, const Photo& photo, const Decoding& asked) {
  std::string text = photo.srgb ? "sRGB (" : "linear (";
  if (asked.curve) text = asked.words + " (";
  if (asked.kind == Decoding::Kind::sensor) text = "sensor: " + photo.tone->name() + " (";
  if (photo.unknowns > 0) text = "unknown, taken as sRGB (";
  if (photo.unknowns > 1) text = "unknown with two exponents, taken as sRGB (";
  text += std::to_string(file.bits) + (file.floating ? "-bit float " : "-bit ") + format_name(file.format);
  return text + (asked == Decoding::automatic ? ", assumed)" : ", as asked)");
}

}  // namespace

Photo read_photo(const std::string& file, const Decoding& decoding, const sim::Scene* scene) {
  const Pixels pixels = read_pixels(file);
  Photo photo;
  photo.srgb = decoding == Decoding::automatic
                   ? !pixels.file.floating
                   : decoding.kind != Decoding::Kind::linear && decoding.kind != Decoding::Kind::sensor;
  photo.tone = decoding.curve;
  photo.unknowns = decoding.unknowns;
  if (photo.unknowns > 0 && pixels.file.floating)
    refuse(file, "an unknown curve is found of integers only, and this file holds floats",
           "JPEG, PNG or TIFF of integers", "floats are linear light as a rule: --decoding linear");
  if (decoding == Decoding::sensor) {
    assert(scene != nullptr);
    sim::Scene decoded = *scene;
    if (pixels.file.floating) decoded.sensor.tone = "linear";
    photo.tone = std::make_shared<const sim::ToneCurve>(decoded);
  }
  photo.decoding = decoding_text(pixels.file, photo, decoding);
  // A PNG of fewer than 8 bits is stretched to 8 by libpng.
  photo.bits = std::max(8, pixels.file.bits);
  photo.floating = pixels.file.floating;
  photo.file_name = file_name_of(file);
  photo.sha256 = pixels.sha256;
  try {
    photo.linear = sim::Image(pixels.codes.cols, pixels.codes.rows, {"R", "G", "B"});
    photo.usable.assign(photo.linear.data.size(), 0);
  } catch (const std::bad_alloc&) {
    refuse(file,
           "there is not enough memory for " + size_text(pixels.codes.cols, pixels.codes.rows) + " pixels",
           "", "scale or crop it first");
  }
  switch (pixels.codes.depth()) {
    case CV_8U:
      linearise_integers<std::uint8_t>(pixels.codes, photo);
      break;
    case CV_16U:
      linearise_integers<std::uint16_t>(pixels.codes, photo);
      break;
    default:
      linearise_floats(pixels.codes, photo);
      break;
  }
  if (decoding == Decoding::sensor) sim::recover_light(*scene, file_step(photo), photo.linear, photo.usable);
  return photo;
}

bool keeps_negative_light(const Photo& photo) { return photo.floating && !photo.srgb; }

double file_step(const Photo& photo) { return photo.floating ? 0.0 : 1.0 / ((1 << photo.bits) - 1); }

double code_step(const Photo& photo, double linear) {
  if (photo.floating) return 0.0;
  const double step = file_step(photo);
  if (photo.tone) {
    const double code =
        std::clamp(photo.tone->encode(std::clamp(linear, 0.0, 1.0)), 0.5 * step, 1.0 - 0.5 * step);
    return photo.tone->decode(code + 0.5 * step) - photo.tone->decode(code - 0.5 * step);
  }
  if (!photo.srgb) return step;
  const double stored = std::clamp(sim::srgb_encode(linear), 0.0, 1.0);
  return sim::srgb_decode(stored + 0.5 * step) - sim::srgb_decode(stored - 0.5 * step);
}

void apply_mask(Photo& photo, const std::string& mask_file) {
  const Pixels mask = read_pixels(mask_file);
  if (mask.codes.cols != photo.linear.width || mask.codes.rows != photo.linear.height)
    refuse(mask_file, "the mask has " + size_text(mask.codes.cols, mask.codes.rows) + " pixels",
           size_text(photo.linear.width, photo.linear.height) + ", the size of " + photo.file_name, "");
  cv::Mat values;
  mask.codes.convertTo(values, CV_64F);
  const double largest = mask.file.floating ? 1.0 : mask.codes.depth() == CV_16U ? 65535.0 : 255.0;
  const int channels = values.channels();
  bool any = false;
  for (int y = 0; y < values.rows; ++y) {
    const double* row = values.ptr<double>(y);
    for (int x = 0; x < values.cols; ++x) {
      double sum = 0.0;
      for (int c = 0; c < channels; ++c) sum += row[x * channels + c];
      const bool use = sum > 0.5 * largest * channels;
      any = any || use;
      if (!use)
        for (int c = 0; c < 3; ++c) photo.usable[photo.linear.index(x, y, c)] = 0;
    }
  }
  if (!any)
    refuse(mask_file, "the mask leaves no pixel", "white where the photograph is to be used", "invert it?");
  photo.mask_name = file_name_of(mask_file);
  photo.mask_sha256 = mask.sha256;
}

}  // namespace vegard::fit
