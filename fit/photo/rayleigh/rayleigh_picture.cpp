#include "fit/photo/rayleigh/rayleigh_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

constexpr const char* kBelowAir = "light below the air: extinction is not undone";

std::string noise_words(const RayleighFilter& filter) {
  return filter.gain_e_per_count
             ? "photons, reading, rounding and dark level"
             : "reading, rounding and dark level; the photons' is not known without a gain";
}

}  // namespace

RayleighPicture rayleigh_picture(const CountPicture& counts, const RayleighFilter& filter) {
  const RayleighFactor& factor = *filter.factor;
  const std::string line = fmt::format("{:.0f}", 10.0 * filter.band.line_nm);
  RayleighPicture picture;
  picture.image = sim::Image(counts.rate.width, counts.rate.height, {"rayleigh." + line, "error." + line});
  picture.scale_error = std::hypot(factor.error / factor.value, filter.flat_error);
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
  std::nth_element(known.begin(), known.begin() + known.size() / 2, known.end());
  picture.median = known[known.size() / 2];
  picture.least = *std::min_element(known.begin(), known.end());
  picture.most = *std::max_element(known.begin(), known.end());
  return picture;
}

std::string encode_rayleigh_fits(const RayleighPicture& picture, const RayleighFilter& filter,
                                 const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                 const std::string& name) {
  const std::vector<sim::FitsKeyword> keywords = {
      {"BUNIT", std::string("R"), "rayleigh, of both planes"},
      {"PLANE1", std::string("brightness; ") + kBelowAir, ""},
      {"PLANE2", "standard error of a pixel by itself: " + noise_words(filter), ""},
      {"SCALEERR", picture.scale_error, "relative error of the scale, of all pixels alike"},
      {"RAYCOUNT", filter.factor->value, "rayleighs of a count per second"},
      {"RAYERR", filter.factor->error, "standard error of that"},
      {"WAVELEN", filter.band.line_nm, "line, nm"},
      {"FILTER", filter.name, ""},
      {"EXPTIME", exposure_s, "s"},
      {"CAMERA", camera.name, ""},
      {"PHOTO", photo, ""},
      {"ORIGIN", "vegard " + sim::version(), ""}};
  return sim::encode_fits(picture.image, keywords, name);
}

std::string encode_rayleigh_exr(const RayleighPicture& picture, const RayleighFilter& filter,
                                const RayleighCamera& camera, const std::string& photo, double exposure_s,
                                const std::string& name) {
  const sim::ImageAttributes attributes = {
      {"version", sim::version()},
      {"photograph", photo},
      {"camera", camera.name},
      {"filter", filter.name},
      {"exposure_s", fmt::format("{:g}", exposure_s)},
      {"rayleigh_per_count_s", fmt::format("{:g}", filter.factor->value)},
      {"scale_error", fmt::format("{:g}", picture.scale_error)},
      {"units", std::string("rayleigh.*: rayleighs, ") + kBelowAir +
                    "; error.*: standard error of a pixel by itself, " + noise_words(filter) +
                    "; scale_error: relative, of all pixels alike"}};
  return sim::encode_exr({&picture.image}, attributes, name);
}

}  // namespace vegard::fit
