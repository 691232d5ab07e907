#include "fit/photo/photo.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <future>

#include "fit/photo/codec/jpeg_rows.h"
#include "fit/photo/codec/picture_format.h"
#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/base/image.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {
namespace {

std::string file_name_of(const std::string& file) { return std::filesystem::path(file).filename().string(); }

/// Linear light of a file's number, white = 1.
double light_of(const Photo& photo, double stored) {
  return photo.tone ? photo.tone->decode(stored) : photo.srgb ? sim::srgb_decode(stored) : stored;
}

/// The light of a file's codes.
class CodeLight {
 public:
  CodeLight(const PictureCodes& codes, const Photo& photo) : codes_(codes), photo_(photo) {
    // If there are few codes, the light of each is computed once.
    constexpr double kMaxCodes = 65535.0;
    if (codes.floating || codes.white > kMaxCodes) return;
    for (int code = 0; code <= static_cast<int>(codes.white); ++code)
      light_of_code_.push_back(static_cast<float>(light_of(photo, code / codes.white)));
  }

  const std::vector<float>& of_codes() const { return light_of_code_; }

  /// Returns light and usability of the pixel and channel i, counted as in Photo::linear.
  void take(std::size_t i, float& light, std::uint8_t& usable) const {
    const std::size_t from = codes_.channels == 3 ? i : i / 3;
    const float value = codes_.value(from);
    usable = std::isfinite(value) && (codes_.floating || value < codes_.white) &&
             (codes_.usable.empty() || codes_.usable[from] != 0);
    light = std::isfinite(value) ? light_of_value(value) : 0.0f;
  }

 private:
  float light_of_value(float value) const {
    const auto code = static_cast<std::size_t>(std::clamp(value, 0.0f, 65535.0f));
    if (static_cast<float>(code) == value && code < light_of_code_.size()) return light_of_code_[code];
    return static_cast<float>(light_of(photo_, value / codes_.white));
  }

  const PictureCodes& codes_;
  const Photo& photo_;
  std::vector<float> light_of_code_;
};

void linearise(const PictureCodes& codes, Photo& photo) {
  const CodeLight light(codes, photo);
  photo.linear = sim::Image(codes.width, codes.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 0);
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i)
    light.take(i, photo.linear.data[i], photo.usable[i]);
}

/// Averages what `row(y, out)` says of every row of the file.
template <class Row>
void average(const Averaging& averaging, const Row& row, sim::Image& light,
             std::vector<std::uint8_t>& usable) {
  BlockAverager averager(averaging);
  LightRow out;
  for (int y = 0; y < averaging.from.height; ++y) {
    row(y, out);
    averager.add(out);
  }
  averager.take(light, usable);
}

void linearise_averaged(const PictureCodes& codes, const Averaging& averaging, Photo& photo) {
  const CodeLight light(codes, photo);
  const std::size_t of_row = 3 * static_cast<std::size_t>(codes.width);
  const auto row = [&](int y, LightRow& out) {
    out.light.resize(of_row);
    out.usable.resize(of_row);
    for (std::size_t i = 0; i < of_row; ++i) light.take(y * of_row + i, out.light[i], out.usable[i]);
  };
  average(averaging, row, photo.linear, photo.usable);
}

void average_light(const Averaging& averaging, Photo& photo) {
  const sim::Image whole = std::move(photo.linear);
  const std::vector<std::uint8_t> usable = std::move(photo.usable);
  const auto of_row = static_cast<std::ptrdiff_t>(3 * whole.width);
  const auto row = [&](int y, LightRow& out) {
    out.light.assign(whole.data.begin() + y * of_row, whole.data.begin() + (y + 1) * of_row);
    out.usable.assign(usable.begin() + y * of_row, usable.begin() + (y + 1) * of_row);
  };
  average(averaging, row, photo.linear, photo.usable);
}

/// The numbers of a JPEG's head, without its pixels.
PictureCodes head_of(const ImageFile& image, int channels) {
  PictureCodes head;
  const bool turned = image.orientation >= 5;
  head.width = static_cast<int>(turned ? image.height : image.width);
  head.height = static_cast<int>(turned ? image.width : image.height);
  head.channels = channels;
  head.block_error = image.block_error;
  head.kind = kind_of_codes(image);
  return head;
}

/// Returns the flags of the photograph's pixels of which a mask of the file's pixels masks no part.
std::vector<std::uint8_t> whole_blocks(const std::vector<std::uint8_t>& used, const Photo& photo) {
  const auto width = static_cast<std::size_t>(photo.averaged_from.width);
  const auto row = [&](int y, LightRow& out) {
    out.light.assign(3 * width, 0.0f);
    out.usable.resize(3 * width);
    for (std::size_t i = 0; i < out.usable.size(); ++i) out.usable[i] = used[y * width + i / 3];
  };
  sim::Image unlit;
  std::vector<std::uint8_t> channels, blocks;
  average({photo.averaged_from, {photo.linear.width, photo.linear.height}}, row, unlit, channels);
  for (std::size_t i = 0; i < channels.size(); i += 3) blocks.push_back(channels[i]);
  return blocks;
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

Photo read_photo(const std::string& file, const Decoding& decoding, const sim::Scene* scene,
                 const Averaging& averaging) {
  return read_photo_of(read_picture_bytes(file), decoding, scene, averaging);
}

Photo read_photo_of(const PictureBytes& picture, const Decoding& decoding, const sim::Scene* scene,
                    const Averaging& averaging) {
  Photo photo = read_photo_bytes(picture.bytes, picture.name, decoding, scene, averaging);
  if (!picture.file_sha256.empty()) photo.sha256 = picture.file_sha256;
  return photo;
}

Photo read_photo_bytes(std::string_view bytes, const std::string& file, const Decoding& decoding,
                       const sim::Scene* scene, const Averaging& averaging) {
  // One thread decodes; what identifies the file can be worked out beside it.
  std::future<std::string> sha256 = std::async(std::launch::async, [bytes] { return sim::sha256(bytes); });
  Photo photo;
  // An unknown curve is found by the codes of single pixels, and what a sensor has done to light is undone of
  // them; all else of a JPEG can be averaged while it is decoded.
  std::unique_ptr<JpegRows> jpeg;
  ImageFile image;
  if (averaging.any() && decoding.unknowns == 0 && decoding.kind != Decoding::Kind::sensor) {
    image = inspect_image_file(bytes, file);
    const bool turned = image.orientation >= 5;
    if (image.format->walk == walk_jpeg && (turned ? image.height : image.width) == averaging.from.width &&
        (turned ? image.width : image.height) == averaging.from.height)
      jpeg = std::make_unique<JpegRows>(bytes, file);
    // If libjpeg disagrees with the walk, OpenCV decodes the file, whose size is checked.
    if (jpeg != nullptr &&
        (jpeg->channels() == 0 || jpeg->width() != image.width || jpeg->height() != image.height))
      jpeg.reset();
  }
  PictureCodes codes = jpeg != nullptr ? head_of(image, jpeg->channels()) : picture_codes(bytes, file);
  photo.srgb = decoding == Decoding::automatic
                   ? !codes.linear
                   : decoding.kind != Decoding::Kind::linear && decoding.kind != Decoding::Kind::sensor;
  photo.tone = decoding.curve;
  photo.unknowns = decoding.unknowns;
  constexpr double kMaxCodes = 65535.0;
  if (photo.unknowns > 0 && (codes.floating || codes.white > kMaxCodes * codes.step))
    throw sim::unreadable(
        file,
        std::string("an unknown curve is found of integers of up to 16 bits only, and this file holds ") +
            (codes.floating ? "floats" : "wider ones"))
        .expected("JPEG, PNG or TIFF of integers")
        .hint("such files are linear light as a rule: --decoding linear");
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
  photo.sha256 = sha256.get();
  photo.words = std::move(codes.words);
  const bool averages = averaging.any() && averaging.from.width == codes.width &&
                        averaging.from.height == codes.height && photo.unknowns == 0;
  try {
    if (jpeg != nullptr) {
      const CodeTable table{CodeLight(codes, photo).of_codes(), static_cast<int>(codes.white)};
      average_jpeg(*jpeg, averaging, image.orientation, table, photo.linear, photo.usable);
    } else if (averages && decoding.kind != Decoding::Kind::sensor) {
      linearise_averaged(codes, averaging, photo);
    } else {
      linearise(codes, photo);
      if (decoding == Decoding::sensor)
        sim::recover_light(*scene, file_step(photo), photo.linear, photo.usable);
      codes.values = {};
      codes.bytes.reset();
      if (averages) average_light(averaging, photo);
    }
    if (averages) photo.averaged_from = averaging.from;
  } catch (const std::bad_alloc&) {
    throw sim::unreadable(
        file, "there is not enough memory for " + sim::size_text(codes.width, codes.height) + " pixels")
        .hint("scale or crop it first");
  }
  return photo;
}

sim::PictureSize size_of_file(const Photo& photo) {
  return photo.averaged_from.width > 0 ? photo.averaged_from
                                       : sim::PictureSize{photo.linear.width, photo.linear.height};
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
  const PictureBytes picture = read_picture_bytes(mask_file);
  const PictureCodes mask = picture_codes(picture.bytes, mask_file);
  const sim::PictureSize size = size_of_file(photo);
  if (mask.width != size.width || mask.height != size.height)
    throw sim::unreadable(mask_file, "the mask has " + sim::size_text(mask.width, mask.height) + " pixels")
        .expected(sim::size_text(size.width, size.height) + ", the size of " + photo.file_name);
  std::vector<std::uint8_t> used(static_cast<std::size_t>(mask.width) * mask.height);
  for (std::size_t pixel = 0; pixel < used.size(); ++pixel) {
    double sum = 0.0;
    for (int c = 0; c < mask.channels; ++c) sum += mask.value(pixel * mask.channels + c);
    used[pixel] = sum > 0.5 * mask.white * mask.channels;
  }
  if (photo.averaged_from.width > 0) used = whole_blocks(used, photo);
  for (std::size_t pixel = 0; pixel < used.size(); ++pixel)
    if (used[pixel] == 0)
      for (int c = 0; c < 3; ++c) photo.usable[3 * pixel + c] = 0;
  if (std::find(used.begin(), used.end(), 1) == used.end())
    throw sim::unreadable(mask_file, "the mask leaves no pixel")
        .expected("white where the photograph is to be used")
        .hint("invert it?");
  photo.mask_name = file_name_of(picture.name);
  photo.mask_sha256 = picture.file_sha256.empty() ? sim::sha256(picture.bytes) : picture.file_sha256;
}

Photo photo_of_light(const sim::Image& light, const std::vector<std::uint8_t>& used,
                     const std::string& name) {
  const auto channels = static_cast<std::size_t>(light.channels());
  assert(channels == 1 || channels == 3);
  assert(used.empty() || used.size() * channels == light.data.size());
  Photo photo;
  photo.srgb = false;
  photo.floating = true;
  photo.bits = 32;
  photo.decoding = "linear (32-bit float array, as given)";
  photo.file_name = name;
  photo.sha256 =
      sim::sha256({reinterpret_cast<const char*>(light.data.data()), light.data.size() * sizeof(float)});
  photo.linear = sim::Image(light.width, light.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 0);
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) {
    const float value = light.data[channels == 3 ? i : i / 3];
    if (!std::isfinite(value)) continue;
    photo.linear.data[i] = value;
    photo.usable[i] = used.empty() || used[i / 3] != 0;
  }
  return photo;
}

std::vector<char> pixels_left_by(const std::string& mask_file, const Photo& photo) {
  const std::size_t channels = photo.linear.channels(), pixels = photo.usable.size() / channels;
  // A star may be clipped, and stays one: only what the mask hides is left out, all channels at once.
  Photo blank = photo;
  std::fill(blank.usable.begin(), blank.usable.end(), std::uint8_t{1});
  apply_mask(blank, mask_file);
  std::vector<char> left;
  for (std::size_t i = 0; i < pixels; ++i) left.push_back(static_cast<char>(blank.usable[i * channels]));
  return left;
}

}  // namespace vegard::fit
