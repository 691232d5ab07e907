#include "fit/photo/rayleigh/count_picture.h"

#include <cmath>
#include <cstdlib>
#include <map>

#include <fmt/format.h>

#include "fit/photo/codec/picture_format.h"
#include "fit/photo/frames/picture_bytes.h"
#include "fit/photo/photo_metadata.h"
#include "sim/base/error.h"

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

int channel_number(const std::string& channel) { return channel == "red" ? 0 : channel == "green" ? 1 : 2; }

FileCounts file_counts(const std::string& name, const std::string& channel) {
  const PictureBytes picture = read_picture_bytes(name);
  if (inspect_image_file(picture.bytes, name).format->is_lossy)
    throw sim::unreadable(name, "its numbers are no counts: they were bent and packed for the eye")
        .expected("FITS, PGM, TIFF, PNG or an imager's frame");
  const PictureCodes codes = picture_codes(picture.bytes, name);
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

}  // namespace vegard::fit
