#include "fit/photo/rayleigh/count_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "fit/photo/codec/picture_format.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"
#include "sim/base/number/quantile.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/text.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

/// Numbers of one channel as they stand in a file.
struct FileCounts {
  int width = 0, height = 0;
  std::vector<float> numbers;
  std::vector<char> usable;
  double step = 0.0;
  std::optional<double> exposure_s;  ///< by the words of a FITS header
};

/// EXPTIME or EXPOSURE, in seconds, where one of them is a number above 0.
std::optional<double> exposure_in(const std::map<std::string, std::string>& words) {
  for (const char* key : {"EXPTIME", "EXPOSURE"}) {
    const auto found = words.find(key);
    if (found == words.end()) continue;
    const double seconds = std::strtod(found->second.c_str(), nullptr);
    if (std::isfinite(seconds) && seconds > 0.0) return seconds;
  }
  return std::nullopt;
}

/// Refuses numbers that are declared to be something else than a camera's counts: brightnesses, rates,
/// electrons.
void require_counts(const std::map<std::string, std::string>& words, const std::string& name) {
  const auto found = words.find("BUNIT");
  if (found == words.end()) return;
  const std::string unit = sim::lowered(sim::trimmed(found->second));
  for (const char* counts : {"", "adu", "adus", "ct", "count", "counts", "cts", "dn", "adu/pixel", "dn/pixel",
                             "count/pixel", "counts/pixel", "adu pixel-1", "none"})
    if (unit == counts) return;
  throw sim::unreadable(name, "BUNIT is '" + found->second + "'")
      .key("BUNIT")
      .expected("counts: ADU, DN or count")
      .hint("the camera's factor is that of raw counts; correct or remove BUNIT if they are such");
}

int channel_number(const std::string& channel) { return channel == "red" ? 0 : channel == "green" ? 1 : 2; }

FileCounts file_counts(const std::string& name, const std::string& channel) {
  const PictureBytes picture = read_picture_bytes(name);
  if (inspect_image_file(picture.bytes, name).format->is_lossy)
    throw sim::unreadable(name, "its numbers are no counts: they were bent and packed for the eye")
        .expected("FITS, PGM, TIFF, PNG or an imager's frame");
  const PictureCodes codes = picture_codes(picture.bytes, name);
  require_counts(codes.words, name);
  int from = 0;
  if (codes.channels == 3) {
    if (channel.empty()) {
      throw sim::Error(sim::ErrorKind::usage, "it has three colours, and its filter is one of them")
          .file(name)
          .expected("channel = \"green\" in the filter's table");
    }
    from = channel_number(channel);
  }
  FileCounts counts{codes.width, codes.height, {}, {}, codes.step, exposure_in(codes.words)};
  const auto pixels = static_cast<std::size_t>(codes.width) * codes.height;
  counts.numbers.resize(pixels);
  counts.usable.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t at = i * codes.channels + from;
    const float number = codes.value(at);
    const bool is_known = std::isfinite(number) && (codes.usable.empty() || codes.usable[at] != 0);
    counts.usable[i] = static_cast<char>(is_known && (codes.floating || number < codes.white));
    counts.numbers[i] = std::isfinite(number) ? number : 0.0f;
  }
  return counts;
}

FileCounts counts_beside(const std::string& name, const std::string& what, const FileCounts& picture,
                         const std::string& channel) {
  FileCounts counts = file_counts(name, channel);
  if (counts.width != picture.width || counts.height != picture.height)
    throw sim::unreadable(name, what + " has " + sim::size_text(counts.width, counts.height) + " pixels")
        .expected(sim::size_text(picture.width, picture.height) + ", the picture's size");
  return counts;
}

/// Over its mean in the middle.
std::vector<float> flat_field(const std::string& name, const FileCounts& picture,
                              const std::string& channel) {
  const FileCounts counts = counts_beside(name, "the flat field", picture, channel);
  constexpr int kHalfOfMiddle = 5;
  double sum = 0.0;
  int pixels = 0;
  for (int y = 0; y < counts.height; ++y)
    for (int x = 0; x < counts.width; ++x) {
      const auto at = static_cast<std::size_t>(y) * counts.width + x;
      if (std::abs(x - counts.width / 2) > kHalfOfMiddle || std::abs(y - counts.height / 2) > kHalfOfMiddle ||
          counts.usable[at] == 0)
        continue;
      sum += counts.numbers[at];
      ++pixels;
    }
  if (!(sum > 0.0))
    throw sim::unreadable(name, "the flat field is dark in its middle").expected("light on an even screen");
  std::vector<float> flat = counts.numbers;
  for (std::size_t i = 0; i < flat.size(); ++i)
    flat[i] = counts.usable[i] != 0 ? static_cast<float>(flat[i] * pixels / sum) : 0.0f;
  return flat;
}

double seconds_of(const std::string& picture, const FileCounts& counts, const RayleighFilter& filter,
                  std::optional<double> exposure_s) {
  if (!exposure_s) exposure_s = counts.exposure_s;
  if (!exposure_s) exposure_s = photo_metadata(picture).exposure_s;
  if (!exposure_s) exposure_s = filter.exposure_s;
  if (!exposure_s || !(*exposure_s > 0.0))
    throw sim::unreadable(picture, "it does not say how long it was exposed")
        .expected("--exposure SECONDS")
        .hint("or exposure_s in the camera's file");
  return *exposure_s;
}

constexpr const char* kBelowAir = "light below the air: extinction is not undone";

std::string noise_words(const RayleighFilter& filter) {
  return filter.gain_e_per_count
             ? "photons, reading, rounding and dark level"
             : "reading, rounding and dark level; the photons' is not known without a gain";
}

}  // namespace

CountPicture count_picture(const std::string& picture, const RayleighFilter& filter,
                           std::optional<double> exposure_s) {
  const FileCounts counts = file_counts(picture, filter.channel);
  CountPicture result;
  result.exposure_s = seconds_of(picture, counts, filter, exposure_s);
  result.is_noise_known = filter.gain_e_per_count.has_value();
  result.rate = sim::Image(counts.width, counts.height, {"counts_s"});
  result.variance.resize(counts.numbers.size());
  result.usable = counts.usable;
  std::vector<float> flat;
  std::optional<FileCounts> dark;
  if (!filter.flat_file.empty()) flat = flat_field(filter.flat_file, counts, filter.channel);
  if (!filter.dark_file.empty())
    dark = counts_beside(filter.dark_file, "the dark picture", counts, filter.channel);
  constexpr double kVarianceOfRounding = 1.0 / 12.0, kMinFlat = 0.01;
  const double fixed =
      filter.read_noise_counts * filter.read_noise_counts + kVarianceOfRounding * counts.step * counts.step;
  for (std::size_t i = 0; i < counts.numbers.size(); ++i) {
    const double share = flat.empty() ? 1.0 : flat[i];
    if (!(share > kMinFlat) || (dark && dark->usable[i] == 0)) result.usable[i] = 0;
    if (result.usable[i] == 0) continue;
    const double above = counts.numbers[i] - (dark ? dark->numbers[i] : filter.dark_counts);
    const double to_rate = 1.0 / (share * result.exposure_s);
    const double photons = filter.gain_e_per_count ? std::max(above, 0.0) / *filter.gain_e_per_count : 0.0;
    result.rate.data[i] = static_cast<float>(above * to_rate);
    result.variance[i] = static_cast<float>((photons + fixed) * to_rate * to_rate);
  }
  return result;
}

RayleighPicture rayleigh_picture(const CountPicture& counts, const RayleighFilter& filter) {
  const RayleighFactor& factor = *filter.factor;
  const std::string line = fmt::format("{:.0f}", 10.0 * filter.band.line_nm);
  RayleighPicture picture;
  picture.image = sim::Image(counts.rate.width, counts.rate.height, {"rayleigh." + line, "error." + line});
  // Of a factor without an error the scale's is unknown, however well the flat field is known.
  if (factor.error > 0.0) picture.scale_error = std::hypot(factor.error / factor.value, filter.flat_error);
  const double dark = filter.dark_error_counts / counts.exposure_s;
  std::vector<float> known;
  for (std::size_t i = 0; i < counts.rate.data.size(); ++i) {
    float& rayleighs = picture.image.data[2 * i];
    float& error = picture.image.data[2 * i + 1];
    if (counts.usable[i] == 0) {
      rayleighs = error = std::numeric_limits<float>::quiet_NaN();
      ++picture.unknown;
      continue;
    }
    rayleighs = static_cast<float>(factor.value * counts.rate.data[i]);
    error = static_cast<float>(factor.value * std::sqrt(counts.variance[i] + dark * dark));
    known.push_back(rayleighs);
  }
  if (known.empty()) return picture;
  picture.median = sim::median(known);
  picture.least = *std::min_element(known.begin(), known.end());
  picture.most = *std::max_element(known.begin(), known.end());
  return picture;
}

std::string encode_rayleigh_fits(const RayleighPicture& picture, const RayleighFilter& filter,
                                 const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                 const std::string& name) {
  std::vector<sim::FitsKeyword> keywords = {
      {"BUNIT", std::string("R"), "rayleigh, of both planes"},
      {"PLANE1", std::string("brightness; ") + kBelowAir, ""},
      {"PLANE2", "standard error of a pixel by itself: " + noise_words(filter), ""},
      {"RAYCOUNT", filter.factor->value, "rayleighs of a count per second"},
      {"WAVELEN", filter.band.line_nm, "line, nm"},
      {"FILTER", filter.name, ""},
      {"EXPTIME", exposure_s, "s"},
      {"CAMERA", camera.name, ""},
      {"PHOTO", photo, ""},
      {"ORIGIN", "vegard " + sim::version(), ""}};
  if (picture.scale_error > 0.0) {
    keywords.push_back({"SCALEERR", picture.scale_error, "relative error of the scale, of all pixels alike"});
    keywords.push_back({"RAYERR", filter.factor->error, "standard error of RAYCOUNT"});
  }
  return sim::encode_fits(picture.image, keywords, name);
}

std::string encode_rayleigh_exr(const RayleighPicture& picture, const RayleighFilter& filter,
                                const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                const std::string& name) {
  sim::ImageAttributes attributes = {
      {"version", sim::version()},
      {"photograph", photo},
      {"camera", camera.name},
      {"filter", filter.name},
      {"exposure_s", fmt::format("{:g}", exposure_s)},
      {"rayleigh_per_count_s", fmt::format("{:g}", filter.factor->value)},
      {"units", std::string("rayleigh.*: rayleighs, ") + kBelowAir +
                    "; error.*: standard error of a pixel by itself, " + noise_words(filter) +
                    "; scale_error: relative, of all pixels alike"}};
  if (picture.scale_error > 0.0) attributes["scale_error"] = fmt::format("{:g}", picture.scale_error);
  return sim::encode_exr({&picture.image}, attributes, name);
}

}  // namespace vegard::fit
