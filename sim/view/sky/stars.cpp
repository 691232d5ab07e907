#include "sim/view/sky/stars.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/normal_quantile.h"
#include "sim/base/number/random.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/illuminants.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/air.h"

namespace vegard::sim {
namespace {

constexpr double kSiderealDayS = 86164.0905;
constexpr double kPhotonsOfMagnitude0 = 1.0e6;  // V band: 1000 photons per cm2, s and 0.1 nm over 90 nm
constexpr double kStarNarrowestPx = 0.5;        // a narrower star would flicker from pixel to pixel
// Where sRGB's primaries are brightest to the eye, roughly: a star's channels are dimmed as these
// wavelengths.
constexpr std::array<double, 3> kChannelNm = {610.0, 550.0, 465.0};
constexpr double kStarReach = 6.0;  // in standard deviations: beyond it even the brightest star is dark

constexpr std::array<double, 7> kCounts = {4.0, 15.0, 49.0, 172.0, 511.0, 1600.0, 4800.0};  // at 0, 1 … 6
constexpr double kFaintSlope = 0.46;  // dex per magnitude

// Ours: about as blue and as red as what is seen without a telescope, without its two humps.
constexpr double kMeanColourIndex = 0.6, kSpreadOfColourIndex = 0.4;
constexpr double kBluest = -0.3, kReddest = 1.8;

/// In dex per magnitude, from the magnitude m of the table to m + 1 or above its end.
double slope_after(int m) {
  if (m >= static_cast<int>(kCounts.size()) - 1) return kFaintSlope;
  return std::log10(kCounts[m + 1] / kCounts[m]);
}

/// Tints at even steps of the colour index, to be interpolated: a mean of tints of luminance 1 has it too.
class Tints {
 public:
  explicit Tints(const SensorResponse& response) {
    for (int i = 0; i <= kSteps; ++i) tints_.push_back(star_tint(kBluest + i * kStep, response));
  }

  std::array<double, 3> at(double colour_index) const {
    const double place = (colour_index - kBluest) / kStep;
    const int i = std::clamp(static_cast<int>(place), 0, kSteps - 1);
    std::array<double, 3> tint{};
    for (int c = 0; c < 3; ++c) tint[c] = tints_[i][c] + (place - i) * (tints_[i + 1][c] - tints_[i][c]);
    return tint;
  }

 private:
  static constexpr int kSteps = 42;
  static constexpr double kStep = (kReddest - kBluest) / kSteps;
  std::vector<std::array<double, 3>> tints_;
};

/// What each of the pixels from `first` on has of a Gaussian around `centre`.
struct Spread {
  int first = 0;
  std::vector<double> shares;

  void set(double centre_px, double sigma_px, int pixels) {
    const auto below = [&](double edge) {
      return 0.5 * std::erfc((centre_px - edge) / (sigma_px * std::sqrt(2.0)));
    };
    first = std::max(0, static_cast<int>(std::floor(centre_px - kStarReach * sigma_px)));
    const int end = std::min(pixels, static_cast<int>(std::ceil(centre_px + kStarReach * sigma_px)));
    shares.clear();
    double before = below(first);
    for (int k = first; k < end; ++k) {
      const double after = below(k + 1.0);
      shares.push_back(after - before);
      before = after;
    }
  }
};

}  // namespace

double stars_brighter_than(double magnitude) {
  const int m = std::clamp(static_cast<int>(std::floor(magnitude)), 0, static_cast<int>(kCounts.size()) - 1);
  return kCounts[m] * std::pow(10.0, slope_after(m) * (magnitude - m));
}

double magnitude_of_count(double count) {
  const auto next = std::upper_bound(kCounts.begin(), kCounts.end(), count);
  const int m = std::max(0, static_cast<int>(next - kCounts.begin()) - 1);
  return m + std::log10(count / kCounts[m]) / slope_after(m);
}

Star star(std::uint64_t seed, std::uint32_t number) {
  const Words words = random_words(seed, Stream::stars, number);
  Star result;
  result.magnitude = magnitude_of_count(number + 0.5);
  result.colour_index = std::clamp(
      kMeanColourIndex + kSpreadOfColourIndex * normal_quantile(uniform(words[2])), kBluest, kReddest);
  result.declination_rad = std::asin(2.0 * uniform(words[0]) - 1.0);
  result.hour_angle_rad = 2.0 * kPi * uniform(words[1]);
  return result;
}

std::array<double, 3> star_direction(const Star& star, double latitude_deg, double instant_s) {
  const double latitude = latitude_deg * kRadiansPerDegree;
  const double hour_angle = star.hour_angle_rad + 2.0 * kPi * instant_s / kSiderealDayS;
  const double to_pole = std::sin(star.declination_rad), to_equator = std::cos(star.declination_rad);
  const double to_meridian = to_equator * std::cos(hour_angle);
  return {-to_equator * std::sin(hour_angle), to_pole * std::cos(latitude) - to_meridian * std::sin(latitude),
          to_pole * std::sin(latitude) + to_meridian * std::cos(latitude)};
}

double colour_temperature_k(double colour_index) {
  return 4600.0 * (1.0 / (0.92 * colour_index + 1.7) + 1.0 / (0.92 * colour_index + 0.62));
}

double star_photons_cm2_s(double magnitude) {
  return kPhotonsOfMagnitude0 * std::pow(10.0, -0.4 * magnitude);
}

std::array<double, 3> star_tint(double colour_index, const SensorResponse& response) {
  const double temperature = colour_temperature_k(colour_index);
  std::array<double, 3> channels{};
  double luminance = 0.0;
  constexpr double kStepNm = 5.0;
  for (double nm = response.first_nm(); nm <= response.last_nm(); nm += kStepNm) {
    const double power = black_body_power(nm, temperature);
    const Vector3 of_power = response.channels_of_power(nm);
    for (int i = 0; i < 3; ++i) channels[i] += power * of_power[i];
    luminance += power * colour_matching(nm)[1];
  }
  const Matrix3& to_rgb = response.rgb_from_channels();
  std::array<double, 3> rgb{};
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) rgb[c] += to_rgb[c][i] * channels[i] / luminance;
  return rgb;
}

Image star_light(const Scene& scene, const std::vector<double>& instants_s, const std::atomic<bool>* stop) {
  const Camera& camera = scene.camera;
  Image light(camera.width, camera.height, {"R", "G", "B"});
  if (!scene.stars.shown) return light;
  const CameraView<double> view = camera_view(camera);
  const double sigma_px = std::max(kStarNarrowestPx, scene.stars.width_deg * pixels_per_degree(camera));
  const double from_centre_km = kEarthRadiusKm + std::max(0.0, scene.site.altitude_m) * 1e-3;
  const double cos_of_dip = kEarthRadiusKm / from_centre_km;
  const double lowest_up = -std::sqrt(1.0 - cos_of_dip * cos_of_dip);
  // 1 R = 1e6 / 4 pi photons per cm2, s and sr.
  const double luminance_per_photon = scene.stars.gain * gain_per_kilorayleigh(scene) * 1e-3 * 4.0 * kPi *
                                      1e-6 / static_cast<double>(instants_s.size());
  const Tints tints{SensorResponse(scene)};

  const AirAbove air(scene);
  std::vector<LineDepths<double>> depths;
  for (const double nm : kChannelNm)
    depths.emplace_back(nm, scene.air.aerosol_optical_depth, scene.air.angstrom_exponent,
                        scene.air.ozone_dobson);

  Spread across, down;
  const double count = std::floor(stars_brighter_than(scene.stars.faintest_magnitude) + 0.5);
  for (std::uint32_t number = 0; number < count; ++number) {
    const Star one = star(scene.seed, number);
    const std::array<double, 3> above_the_air = tints.at(one.colour_index);
    const double brightness = luminance_per_photon * star_photons_cm2_s(one.magnitude);
    for (const double instant : instants_s) {
      if (stop != nullptr && stop->load(std::memory_order_relaxed)) return light;
      const std::array<double, 3> enu = star_direction(one, scene.site.latitude_deg, instant);
      if (enu[2] < lowest_up) continue;
      double x_px = 0.0, y_px = 0.0;
      if (!pixel_of_enu(view, enu.data(), x_px, y_px)) continue;
      const double reach_px = kStarReach * sigma_px;
      if (x_px < -reach_px || x_px > camera.width + reach_px || y_px < -reach_px ||
          y_px > camera.height + reach_px)
        continue;
      std::array<double, 3> tint = above_the_air;
      if (!air.none())
        for (int c = 0; c < 3; ++c) tint[c] *= depths[c].transmission(air.towards(enu[2]));
      const double steradians_of_pixel = pixel_steradians(view.lens, x_px, y_px);
      if (!(steradians_of_pixel > 0.0)) continue;
      across.set(x_px, sigma_px, camera.width);
      down.set(y_px, sigma_px, camera.height);
      for (std::size_t j = 0; j < down.shares.size(); ++j) {
        const double in_row = brightness / steradians_of_pixel * down.shares[j];
        for (std::size_t i = 0; i < across.shares.size(); ++i)
          for (int c = 0; c < 3; ++c)
            light.at(across.first + static_cast<int>(i), down.first + static_cast<int>(j), c) +=
                static_cast<float>(in_row * across.shares[i] * tint[c]);
      }
    }
  }
  return light;
}

}  // namespace vegard::sim
