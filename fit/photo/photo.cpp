#include "fit/photo/photo.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <future>

#include <Eigen/Dense>

#include "fit/photo/codec/jpeg_rows.h"
#include "fit/photo/codec/picture_format.h"
#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/base/image.h"
#include "sim/view/colour/colour.h"
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
  /// `as_coded`: the codes over white take the place of their light.
  CodeLight(const PictureCodes& codes, const Photo& photo, bool as_coded = false)
      : codes_(codes), photo_(photo), as_coded_(as_coded) {
    // If there are few codes, the light of each is computed once.
    constexpr double kMaxCodes = 65535.0;
    if (codes.floating || codes.white > kMaxCodes) return;
    for (int code = 0; code <= static_cast<int>(codes.white); ++code)
      light_of_code_.push_back(light_of_share(code / codes.white));
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
    return light_of_share(value / codes_.white);
  }
  float light_of_share(double share) const {
    return static_cast<float>(as_coded_ ? share : light_of(photo_, share));
  }

  const PictureCodes& codes_;
  const Photo& photo_;
  bool as_coded_;
  std::vector<float> light_of_code_;
};

/// From linear light of sRGB's primaries to that of the scene's sensor.
Eigen::Matrix3d from_srgb_to(sim::Primaries primaries) {
  const auto matrix_of = [](sim::Primaries one) {
    const sim::Matrix3 rows = sim::rgb_from_xyz(one);
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) matrix(i, j) = rows[i][j];
    return matrix;
  };
  return matrix_of(primaries) * matrix_of(sim::Primaries::srgb).inverse();
}

/// Converts linear light of the file's primaries, or what a table takes, to linear light of sRGB's primaries,
/// or of those of the scene's sensor.
class Primaries {
 public:
  Primaries(const PictureCodes& codes, bool counts, const sim::Scene* scene) : floating_(codes.floating) {
    if (!counts || codes.channels != 3) return;
    matrix_ = codes.declared.to_srgb;
    table_ = codes.declared.table;
    if (scene == nullptr || scene->sensor.primaries == sim::Primaries::srgb || !any()) return;
    ColourMatrix all = matrix_.value_or(ColourMatrix{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}});
    const Eigen::Matrix3d to_scene = from_srgb_to(scene->sensor.primaries);
    const ColourMatrix to_srgb = all;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        all[i][j] =
            to_scene(i, 0) * to_srgb[0][j] + to_scene(i, 1) * to_srgb[1][j] + to_scene(i, 2) * to_srgb[2][j];
    matrix_ = all;
  }

  bool any() const { return matrix_ || table_; }
  const std::optional<ColourMatrix>& matrix() const { return matrix_; }
  bool takes_codes() const { return table_ != nullptr; }

  /// A colour that is not known in one of the file's channels is not known in any.
  void convert(float* light, std::uint8_t* usable, std::size_t pixels) const {
    if (!any()) return;
    std::vector<float> made(table_ ? 3 * pixels : 0);
    if (table_) table_->to_light(light, made.data(), pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      float* const rgb = light + 3 * pixel;
      std::uint8_t* const flags = usable + 3 * pixel;
      if (table_) {
        std::copy_n(made.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, rgb);
        if (std::max({rgb[0], rgb[1], rgb[2]}) > table_->brightest()) std::fill_n(flags, 3, std::uint8_t{0});
      }
      if (matrix_) {
        const double r = rgb[0], g = rgb[1], b = rgb[2];
        // Grey stays what it is, to the last bit.
        for (std::size_t c = 0; c < 3 && (r != g || g != b); ++c) {
          const auto& row = (*matrix_)[c];
          rgb[c] = static_cast<float>(row[0] * r + row[1] * g + row[2] * b);
        }
      }
      if (!floating_)
        for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::max(rgb[c], 0.0f);
      const bool is_known = flags[0] != 0 && flags[1] != 0 && flags[2] != 0;
      if (!is_known) std::fill_n(flags, 3, std::uint8_t{0});
    }
  }

 private:
  bool floating_;
  std::optional<ColourMatrix> matrix_;
  std::shared_ptr<const LightTable> table_;
};

void linearise(const PictureCodes& codes, const Primaries& primaries, Photo& photo) {
  const CodeLight light(codes, photo, primaries.takes_codes());
  photo.linear = sim::Image(codes.width, codes.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 0);
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i)
    light.take(i, photo.linear.data[i], photo.usable[i]);
  const std::size_t of_row = 3 * static_cast<std::size_t>(codes.width);
  for (std::size_t i = 0; primaries.any() && i < photo.linear.data.size(); i += of_row)
    primaries.convert(&photo.linear.data[i], &photo.usable[i], static_cast<std::size_t>(codes.width));
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

void linearise_averaged(const PictureCodes& codes, const Primaries& primaries, const Averaging& averaging,
                        Photo& photo) {
  const CodeLight light(codes, photo, primaries.takes_codes());
  const std::size_t of_row = 3 * static_cast<std::size_t>(codes.width);
  const auto row = [&](int y, LightRow& out) {
    out.light.resize(of_row);
    out.usable.resize(of_row);
    for (std::size_t i = 0; i < of_row; ++i) light.take(y * of_row + i, out.light[i], out.usable[i]);
    primaries.convert(out.light.data(), out.usable.data(), static_cast<std::size_t>(codes.width));
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
  head.declared = image.declared;
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

/// Returns the flags of the photograph's pixels that a mask keeps.
std::vector<std::uint8_t> kept_by(const PictureBytes& picture, const std::string& mask_file,
                                  const Photo& photo) {
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
  if (std::find(used.begin(), used.end(), 1) == used.end())
    throw sim::unreadable(mask_file, "the mask leaves no pixel")
        .expected("white where the photograph is to be used")
        .hint("invert it?");
  return used;
}

/// What is declared: "gamma 2.19922, primaries of Adobe RGB (8-bit JPEG, by its EXIF, Adobe RGB)".
std::string declared_text(const PictureCodes& codes, const Photo& photo) {
  const DeclaredLight& declared = codes.declared;
  std::string text = declared.curve   ? declared.curve->name
                     : declared.table ? "the profile's table"
                     : photo.srgb     ? "sRGB"
                                      : "linear";
  if (declared.to_srgb && codes.channels == 3) text += ", primaries of " + declared.primaries;
  return text + " (" + codes.kind + ", by " + declared.source + ")";
}

std::string decoding_text(const PictureCodes& codes, const Photo& photo, const Decoding& asked) {
  if (asked == Decoding::automatic && codes.declared.counts()) return declared_text(codes, photo);
  std::string text = photo.srgb ? "sRGB (" : "linear (";
  if (asked.curve) text = asked.words + " (";
  if (asked.kind == Decoding::Kind::sensor) text = "sensor: " + photo.tone->name() + " (";
  if (photo.unknowns > 0) text = "unknown, taken as sRGB (";
  if (photo.unknowns > 1) text = "unknown with two exponents, taken as sRGB (";
  if (asked != Decoding::automatic) return text + codes.kind + ", as asked)";
  return text + codes.kind + (codes.is_light_assumed ? ", assumed; --decoding overrides)" : ", assumed)");
}

/// Takes over the declared curve. Throws if what is declared cannot be applied.
void take_declared(const DeclaredLight& declared, const std::string& file, Photo& photo) {
  if (!declared.problem.empty())
    throw sim::unreadable(file, declared.source + " cannot be applied: " + declared.problem)
        .expected("a profile of RGB or grey, or none")
        .hint("--decoding srgb or --decoding linear takes its numbers without it");
  if (declared.curve) {
    photo.srgb = !declared.curve->is_linear;
    photo.tone = declared.curve->tone;
  }
  // A table takes the numbers as they are; their steps are about those of sRGB.
  if (declared.table) photo.srgb = true;
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
    if (image.format->walk == walk_jpeg && image.declared.table == nullptr &&
        (turned ? image.height : image.width) == averaging.from.width &&
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
  const bool declared_counts = decoding == Decoding::automatic && codes.declared.counts();
  if (declared_counts) take_declared(codes.declared, file, photo);
  const Primaries primaries(codes, declared_counts, scene);
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
    if (!codes.linear && scene->sensor.tone == sim::ToneKind::filmic)
      throw sim::Error(sim::ErrorKind::scene,
                       "the tone \"filmic\" mixes the channels, and no sensor's numbers "
                       "come back from it")
          .file(scene->file)
          .key("sensor.tone")
          .expected("a tone of each channel by itself")
          .hint("a picture by vegard says that it is filmic: the decoding \"auto\" undoes it");
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
  // Errors grow as primaries are converted: a step is as wide as it becomes in the colour where it grows
  // most.
  if (primaries.matrix()) {
    double growth = 1.0;
    for (const auto& row : *primaries.matrix()) growth = std::max(growth, std::hypot(row[0], row[1], row[2]));
    photo.step *= growth;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& row = (*primaries.matrix())[c];
      const auto& codes_of = codes.block_error;
      photo.block_error[c] =
          std::hypot(row[0] * codes_of[0], row[1] * codes_of[1], row[2] * codes_of[2]) / growth;
    }
  }
  photo.file_name = file_name_of(file);
  photo.sha256 = sha256.get();
  photo.words = std::move(codes.words);
  const bool averages = averaging.any() && averaging.from.width == codes.width &&
                        averaging.from.height == codes.height && photo.unknowns == 0;
  try {
    if (jpeg != nullptr) {
      const CodeTable table{CodeLight(codes, photo).of_codes(), static_cast<int>(codes.white)};
      average_jpeg(*jpeg, averaging, image.orientation, table, photo.linear, photo.usable);
      primaries.convert(photo.linear.data.data(), photo.usable.data(), photo.usable.size() / 3);
    } else if (averages && decoding.kind != Decoding::Kind::sensor) {
      linearise_averaged(codes, primaries, averaging, photo);
    } else {
      linearise(codes, primaries, photo);
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
  const std::vector<std::uint8_t> used = kept_by(picture, mask_file, photo);
  for (std::size_t pixel = 0; pixel < used.size(); ++pixel)
    if (used[pixel] == 0)
      for (int c = 0; c < 3; ++c) photo.usable[3 * pixel + c] = 0;
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
  // A star may be clipped, and stays one: only what the mask hides is left out.
  const std::vector<std::uint8_t> used = kept_by(read_picture_bytes(mask_file), mask_file, photo);
  return {used.begin(), used.end()};
}

}  // namespace vegard::fit
