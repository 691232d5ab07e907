#include "fit/photo/photo.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

#include "fit/photo/codec/picture_codes.h"
#include "sim/base/file/sha256.h"
#include "sim/base/image.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sensor/transfer_curve.h"

namespace vegard::fit {
namespace {

std::string file_name_of(const std::string& file) { return std::filesystem::path(file).filename().string(); }

std::string read_bytes(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status))
    refuse_image(file, error ? error.message() : "no such file", "an image file", "check the path");
  if (fs::is_directory(status)) refuse_image(file, "this is a folder", "an image file");
  if (!fs::is_regular_file(status)) refuse_image(file, "this is not a regular file", "an image file");
  const auto size = fs::file_size(file, error);
  if (error) refuse_image(file, error.message());
  // cv::imdecode counts bytes in an int, and no photograph has more.
  if (size > static_cast<std::uintmax_t>(std::numeric_limits<int>::max()))
    refuse_image(file, "the file is larger than 2 GiB", "", "scale or crop it first");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse_image(file, "the file cannot be opened", "", "check its permissions");
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size)
    refuse_image(file, "the file cannot be read to its end");
  return bytes;
}

/// Linear light of a file's number, white = 1.
double light_of(const Photo& photo, double stored) {
  return photo.tone ? photo.tone->decode(stored) : photo.srgb ? sim::srgb_decode(stored) : stored;
}

void linearise(const PictureCodes& codes, Photo& photo) {
  // Of few codes each is worked out once.
  constexpr double kMostCodes = 65535.0;
  std::vector<float> light_of_code;
  if (!codes.floating && codes.white <= kMostCodes)
    for (int code = 0; code <= static_cast<int>(codes.white); ++code)
      light_of_code.push_back(static_cast<float>(light_of(photo, code / codes.white)));
  const int channels = codes.channels;
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) {
    const std::size_t from = channels == 3 ? i : i / 3;
    const float value = codes.values[from];
    const bool usable = std::isfinite(value) && (codes.floating || value < codes.white) &&
                        (codes.usable.empty() || codes.usable[from] != 0);
    photo.usable[i] = usable;
    if (!std::isfinite(value)) {
      photo.linear.data[i] = 0.0f;
      continue;
    }
    const auto code = static_cast<std::size_t>(std::clamp(value, 0.0f, 65535.0f));
    if (static_cast<float>(code) == value && code < light_of_code.size())
      photo.linear.data[i] = light_of_code[code];
    else
      photo.linear.data[i] = static_cast<float>(light_of(photo, value / codes.white));
  }
}

std::string decoding_text(const PictureCodes& codes, const Photo& photo, const Decoding& asked) {
  std::string text = photo.srgb ? "sRGB (" : "linear (";
  if (asked.curve) text = asked.words + " (";
  if (asked.kind == Decoding::Kind::sensor) text = "sensor: " + photo.tone->name() + " (";
  if (photo.unknowns > 0) text = "unknown, taken as sRGB (";
  if (photo.unknowns > 1) text = "unknown with two exponents, taken as sRGB (";
  return text + codes.kind + (asked == Decoding::automatic ? ", assumed)" : ", as asked)");
}

}  // namespace

Photo read_photo(const std::string& file, const Decoding& decoding, const sim::Scene* scene) {
  return read_photo_bytes(read_bytes(file), file, decoding, scene);
}

Photo read_photo_bytes(std::string_view bytes, const std::string& file, const Decoding& decoding,
                       const sim::Scene* scene) {
  PictureCodes codes = picture_codes(bytes, file);
  Photo photo;
  photo.srgb = decoding == Decoding::automatic
                   ? !codes.linear
                   : decoding.kind != Decoding::Kind::linear && decoding.kind != Decoding::Kind::sensor;
  photo.tone = decoding.curve;
  photo.unknowns = decoding.unknowns;
  constexpr double kMostCodes = 65535.0;
  if (photo.unknowns > 0 && (codes.floating || codes.white > kMostCodes * codes.step))
    refuse_image(
        file,
        std::string("an unknown curve is found of integers of up to 16 bits only, and this file holds ") +
            (codes.floating ? "floats" : "wider ones"),
        "JPEG, PNG or TIFF of integers", "such files are linear light as a rule: --decoding linear");
  if (decoding == Decoding::sensor) {
    assert(scene != nullptr);
    sim::Scene decoded = *scene;
    // Its tone curve is that of display files.
    if (codes.linear) decoded.sensor.tone = sim::ToneKind::linear;
    photo.tone = std::make_shared<const sim::ToneCurve>(decoded);
  }
  photo.decoding = decoding_text(codes, photo, decoding);
  photo.bits = codes.bits;
  photo.floating = codes.floating;
  photo.step = codes.step / codes.white;
  photo.block_error = codes.block_error;
  photo.file_name = file_name_of(file);
  photo.sha256 = sim::sha256(bytes);
  photo.words = std::move(codes.words);
  try {
    photo.linear = sim::Image(codes.width, codes.height, {"R", "G", "B"});
    photo.usable.assign(photo.linear.data.size(), 0);
  } catch (const std::bad_alloc&) {
    refuse_image(file,
                 "there is not enough memory for " + sim::size_text(codes.width, codes.height) + " pixels",
                 "", "scale or crop it first");
  }
  linearise(codes, photo);
  if (decoding == Decoding::sensor) sim::recover_light(*scene, file_step(photo), photo.linear, photo.usable);
  return photo;
}

bool keeps_negative_light(const Photo& photo) { return photo.floating && !photo.srgb; }

double file_step(const Photo& photo) {
  if (photo.floating) return 0.0;
  return photo.step > 0.0 ? photo.step : 1.0 / ((1 << photo.bits) - 1);
}

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
  const std::string bytes = read_bytes(mask_file);
  const PictureCodes mask = picture_codes(bytes, mask_file);
  if (mask.width != photo.linear.width || mask.height != photo.linear.height)
    refuse_image(mask_file, "the mask has " + sim::size_text(mask.width, mask.height) + " pixels",
                 sim::size_text(photo.linear.width, photo.linear.height) + ", the size of " + photo.file_name,
                 "");
  bool any = false;
  for (std::size_t pixel = 0; pixel < mask.values.size() / mask.channels; ++pixel) {
    double sum = 0.0;
    for (int c = 0; c < mask.channels; ++c) sum += mask.values[pixel * mask.channels + c];
    const bool use = sum > 0.5 * mask.white * mask.channels;
    any = any || use;
    if (!use)
      for (int c = 0; c < 3; ++c) photo.usable[3 * pixel + c] = 0;
  }
  if (!any)
    refuse_image(mask_file, "the mask leaves no pixel", "white where the photograph is to be used",
                 "invert it?");
  photo.mask_name = file_name_of(mask_file);
  photo.mask_sha256 = sim::sha256(bytes);
}

}  // namespace vegard::fit
