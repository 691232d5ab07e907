#include "sim/view/sky/stars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/base/parallel.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/sky_of_scene.h"
#include "sim/view/sky/star_photometry.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim {
namespace {

constexpr double kSiderealDayS = 86164.0905;
constexpr double kStarNarrowestPx = 0.5;  // a narrower star would flicker from pixel to pixel
constexpr double kStarReach = 6.0;        // in standard deviations: beyond it even the brightest star is dark

constexpr std::array<double, 7> kCounts = {4.0, 15.0, 49.0, 172.0, 511.0, 1600.0, 4800.0};  // at 0, 1 … 6
constexpr double kFaintSlope = 0.46;  // dex per magnitude

// Our own choice: about as blue and as red as what is seen without a telescope, without its two humps.
constexpr double kMeanColourIndex = 0.6, kSpreadOfColourIndex = 0.4;
constexpr double kBluest = -0.3, kReddest = 1.8;

/// Returns the slope in dex per magnitude from the magnitude m of the table to m + 1, or above its end.
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

/// The shares of a Gaussian around `centre` in the pixels from `first` on.
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

/// Puts stars on a picture, each as a Gaussian in pixels.
class StarPainter {
 public:
  StarPainter(const Scene& scene, std::size_t instants, Image& light)
      : camera_(scene.camera),
        view_(camera_view(scene.camera)),
        sigma_px_(std::max(kStarNarrowestPx, scene.stars.width_deg * pixels_per_degree(scene.camera))),
        lowest_up_(sine_of_horizon(std::max(0.0, scene.site.altitude_m) * 1e-3, scene.body.radius_km)),
        luminance_per_photon_(luminance_per_photon(scene) / static_cast<double>(instants)),
        tints_(SensorResponse(scene)),
        air_(scene),
        light_(light) {}

  void add(const std::array<double, 3>& enu, double magnitude, double colour_index, double gain) {
    if (enu[2] < lowest_up_) return;
    double x_px = 0.0, y_px = 0.0;
    if (!pixel_of_enu(view_, enu.data(), x_px, y_px)) return;
    const double reach_px = kStarReach * sigma_px_;
    if (x_px < -reach_px || x_px > camera_.width + reach_px || y_px < -reach_px ||
        y_px > camera_.height + reach_px)
      return;
    const std::array<double, 3> above_the_air = tints_.at(colour_index), let_through = air_.towards(enu[2]);
    std::array<double, 3> tint = above_the_air;
    for (int c = 0; c < 3; ++c) tint[c] *= let_through[c];
    const double brightness = gain * luminance_per_photon_ * star_photons_cm2_s(magnitude);
    if (camera_.model == LensModel::equirectangular)
      add_around(x_px, y_px, brightness, tint);
    else
      add_within(x_px, y_px, brightness, tint);
  }

 private:
  void add_within(double x_px, double y_px, double brightness, const std::array<double, 3>& tint) {
    const double steradians_of_pixel = pixel_steradians(view_.lens, x_px, y_px);
    if (!(steradians_of_pixel > 0.0)) return;
    across_.set(x_px, sigma_px_, camera_.width);
    down_.set(y_px, sigma_px_, camera_.height);
    for (std::size_t j = 0; j < down_.shares.size(); ++j) {
      const double in_row = brightness / steradians_of_pixel * down_.shares[j];
      for (std::size_t i = 0; i < across_.shares.size(); ++i)
        for (int c = 0; c < 3; ++c)
          light_.at(across_.first + static_cast<int>(i), down_.first + static_cast<int>(j), c) +=
              static_cast<float>(in_row * across_.shares[i] * tint[c]);
    }
  }

  /// Adds a star near a pole: rows beyond it are those before it, half a turn on; a row is the narrower the
  /// nearer to a pole.
  void add_around(double x_px, double y_px, double brightness, const std::array<double, 3>& tint) {
    const int width = camera_.width, height = camera_.height;
    const double px_per_rad = height / kPi;
    const int margin = static_cast<int>(std::ceil(kStarReach * sigma_px_));
    down_.set(y_px + margin, sigma_px_, height + 2 * margin);
    for (std::size_t j = 0; j < down_.shares.size(); ++j) {
      int row = down_.first + static_cast<int>(j) - margin;
      const bool beyond = row < 0 || row >= height;
      row = row < 0 ? -1 - row : row >= height ? 2 * height - 1 - row : row;
      if (row < 0 || row >= height) continue;  // of a picture of a few rows
      const double narrow = std::cos((row + 0.5 - 0.5 * height) / px_per_rad);
      const double steradians =
          (std::sin((row + 1.0 - 0.5 * height) / px_per_rad) - std::sin((row - 0.5 * height) / px_per_rad)) /
          px_per_rad;
      const double in_row = brightness / steradians * down_.shares[j], sigma_px = sigma_px_ / narrow;
      const auto put = [&](int column, double share) {
        const int x = ((column + (beyond ? width / 2 : 0)) % width + width) % width;
        for (int c = 0; c < 3; ++c) light_.at(x, row, c) += static_cast<float>(in_row * share * tint[c]);
      };
      if (2.0 * kStarReach * sigma_px >= width) {
        for (int x = 0; x < width; ++x) put(x, 1.0 / width);
        continue;
      }
      across_.set(x_px + width, sigma_px, 3 * width);
      for (std::size_t i = 0; i < across_.shares.size(); ++i)
        put(across_.first + static_cast<int>(i) - width, across_.shares[i]);
    }
  }

  const Camera& camera_;
  CameraView<double> view_;
  double sigma_px_, lowest_up_, luminance_per_photon_;
  Tints tints_;
  StarExtinction air_;
  Image& light_;
  Spread across_, down_;
};

// Lengths in kpc.
constexpr double kSun = 8.2, kDiscLength = 2.6, kDiscHeight = 0.30;
constexpr double kDiscBegins = 3.0;  // within, its stars are no denser
constexpr double kDustLength = 3.2, kDustHeight = 0.10, kDustMagPerKpc = 0.7;
constexpr double kBulgeLength = 0.7, kBulgeOverDisc = 7.0;  // of stars at the centre over those near the Sun
constexpr double kPoles_s10 = 30.0;
constexpr double kMilkyWayColourIndex = 0.75;

/// Returns the sum along a line of sight, in units of the stars' density near the Sun.
double light_along(double longitude_deg, double latitude_deg) {
  const double l = longitude_deg * kRadiansPerDegree, b = latitude_deg * kRadiansPerDegree;
  constexpr int kSteps = 240;
  constexpr double kFirst = 0.01, kLast = 30.0;
  const double ratio = std::pow(kLast / kFirst, 1.0 / kSteps);
  double sum = 0.0, depth = 0.0, near = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double far = kFirst * std::pow(ratio, i), step = far - near, middle = 0.5 * (near + far);
    const double level = middle * std::cos(b), height = std::abs(middle * std::sin(b));
    const double from_centre = std::sqrt(kSun * kSun + level * level - 2.0 * kSun * level * std::cos(l));
    const double disc =
        std::exp(-(std::max(from_centre, kDiscBegins) - kSun) / kDiscLength - height / kDiscHeight);
    const double bulge = kBulgeOverDisc * std::exp(-std::hypot(from_centre, height / 0.6) / kBulgeLength);
    const double dust = std::exp(-(from_centre - kSun) / kDustLength - height / kDustHeight);
    const double step_depth = dust * kDustMagPerKpc / 1.0857362 * step;
    sum += (disc + bulge) * std::exp(-depth - 0.5 * step_depth) * step;
    depth += step_depth;
    near = far;
  }
  return sum;
}

/// A table of the light at even steps of |longitude| and |latitude|.
class MilkyWayTable {
 public:
  MilkyWayTable() : values_(static_cast<std::size_t>(kLongitudes + 1) * (kLatitudes + 1)) {
    const double scale = kPoles_s10 / light_along(0.0, 90.0);
    for (int i = 0; i <= kLongitudes; ++i)
      for (int j = 0; j <= kLatitudes; ++j)
        values_[at(i, j)] = scale * light_along(180.0 * i / kLongitudes, 90.0 * j / kLatitudes);
  }

  double s10(double longitude_deg, double latitude_deg) const {
    const double x = std::abs(std::remainder(longitude_deg, 360.0)) / 180.0 * kLongitudes,
                 y = std::min(std::abs(latitude_deg), 90.0) / 90.0 * kLatitudes;
    const int i = std::min(static_cast<int>(x), kLongitudes - 1),
              j = std::min(static_cast<int>(y), kLatitudes - 1);
    const double u = x - i, v = y - j;
    return (1.0 - v) * ((1.0 - u) * values_[at(i, j)] + u * values_[at(i + 1, j)]) +
           v * ((1.0 - u) * values_[at(i, j + 1)] + u * values_[at(i + 1, j + 1)]);
  }

 private:
  static constexpr int kLongitudes = 90, kLatitudes = 180;
  static std::size_t at(int i, int j) { return static_cast<std::size_t>(i) * (kLatitudes + 1) + j; }
  std::vector<double> values_;
};

const MilkyWayTable& milky_way_table() {
  static const MilkyWayTable table;
  return table;
}

/// The galactic axes at J2000 (the IAU's of 1958, precessed): to the centre, to l = 90 degrees, to the pole.
constexpr std::array<Equatorial, 3> kGalacticAxes = {
    {{266.40499, -28.93617}, {318.00438, 48.32964}, {192.85948, 27.12825}}};

/// Adds the Milky Way to linear RGB of the scene's camera, at the middle of the instants.
void add_milky_way(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light) {
  const double date = julian_date_at(scene, 0.5 * (instants_s.front() + instants_s.back()));
  Observer observer = observer_of(scene);
  observer.refracting_air = false;  // half a degree at most, at the horizon
  std::array<std::array<double, 3>, 3> axes{};
  for (int a = 0; a < 3; ++a) axes[a] = direction_of_star({kGalacticAxes[a], 0.0, 0.0}, observer, date);
  constexpr double kSquareDegree = kRadiansPerDegree * kRadiansPerDegree;
  const double of_s10 = luminance_per_photon(scene) * star_photons_cm2_s(10.0) / kSquareDegree;
  const std::array<double, 3> tint = star_tint(kMilkyWayColourIndex, SensorResponse(scene));
  const StarExtinction air(scene);
  const CameraView<double> view = camera_view(scene.camera);
  const double lowest = sine_of_horizon(std::max(0.0, scene.site.altitude_m) * 1e-3);
  const MilkyWayTable& table = milky_way_table();
  parallel_for(static_cast<std::size_t>(light.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width; ++x) {
      double enu[3];
      if (!enu_of_pixel(view, x + 0.5, y + 0.5, enu) || enu[2] < lowest) continue;
      double along[3];
      for (int a = 0; a < 3; ++a) along[a] = enu[0] * axes[a][0] + enu[1] * axes[a][1] + enu[2] * axes[a][2];
      const double s10 = table.s10(std::atan2(along[1], along[0]) / kRadiansPerDegree,
                                   std::atan2(along[2], std::hypot(along[0], along[1])) / kRadiansPerDegree);
      const std::array<double, 3> let_through = air.towards(enu[2]);
      for (int c = 0; c < 3; ++c)
        light.at(x, y, c) += static_cast<float>(of_s10 * s10 * tint[c] * let_through[c]);
    }
  });
}

/// Calls `add(enu, magnitude, colour index)` for the stars and planets of a scene at each instant.
template <class Add>
void each_star(const Scene& scene, const std::vector<double>& instants_s, const std::atomic<bool>* stop,
               const Add& add) {
  const auto stopped = [&] { return stop != nullptr && stop->load(std::memory_order_relaxed); };
  if (scene.stars.shown && scene.stars.source == StarSource::random) {
    const double count = std::floor(stars_brighter_than(scene.stars.faintest_magnitude) + 0.5);
    for (std::uint32_t number = 0; number < count && !stopped(); ++number) {
      const Star one = star(scene.seed, number);
      for (const double instant : instants_s)
        add(star_direction(one, scene.site.latitude_deg, instant), one.magnitude, one.colour_index);
    }
  }
  const Observer observer = observer_of(scene);
  if (scene.stars.shown && scene.stars.source == StarSource::catalogue)
    for (const BrightStar& one : catalogue_stars()) {
      if (one.magnitude > scene.stars.faintest_magnitude || stopped()) break;
      for (const double instant : instants_s)
        add(direction_of_star(one.place, observer, julian_date_at(scene, instant)), one.magnitude,
            std::clamp(one.colour_index, kBluest, kReddest));
    }
  if (scene.stars.planets)
    for (const Planet planet : kPlanets)
      for (const double instant : instants_s) {
        const double date = julian_date_at(scene, instant);
        const PlanetLight of_planet = light_of_planet(planet, date);
        add(direction_of_star({place_of_planet(planet, date), 0.0, 0.0}, observer, date), of_planet.magnitude,
            of_planet.colour_index);
      }
}

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

bool has_stars(const Scene& scene) {
  return scene.stars.shown || scene.stars.planets || scene.stars.milky_way || scene.moon.shown;
}

Image star_light(const Scene& scene, const std::vector<double>& instants_s, const std::atomic<bool>* stop,
                 int threads) {
  Image light(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  if (!has_stars(scene)) return light;
  const auto stopped = [&] { return stop != nullptr && stop->load(std::memory_order_relaxed); };
  if (scene.stars.milky_way) add_milky_way(scene, instants_s, threads, light);
  if (scene.moon.shown && !stopped()) add_moon_disc(scene, instants_s, threads, light);
  StarPainter painter(scene, instants_s.size(), light);
  each_star(scene, instants_s, stop,
            [&](const std::array<double, 3>& enu, double magnitude, double colour_index) {
              painter.add(enu, magnitude, colour_index, scene.stars.gain);
            });
  return light;
}

std::vector<PointOfLight> star_points(const Scene& scene, double instant_s, std::size_t most) {
  const Tints tints{SensorResponse(scene)};
  const StarExtinction air(scene);
  const double per_photon = luminance_per_photon(scene) * scene.stars.gain;
  const double lowest = sine_of_horizon(std::max(0.0, scene.site.altitude_m) * 1e-3, scene.body.radius_km);
  std::vector<std::pair<double, PointOfLight>> stars;
  each_star(scene, {instant_s}, nullptr,
            [&](const std::array<double, 3>& enu, double magnitude, double colour_index) {
              if (enu[2] < lowest) return;
              PointOfLight point{enu, tints.at(colour_index)};
              const std::array<double, 3> let_through = air.towards(enu[2]);
              for (int c = 0; c < 3; ++c)
                point.rgb_steradian[c] *= let_through[c] * per_photon * star_photons_cm2_s(magnitude);
              stars.emplace_back(magnitude, point);
            });
  std::stable_sort(stars.begin(), stars.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (stars.size() > most) stars.resize(most);
  std::vector<PointOfLight> points;
  points.reserve(stars.size());
  for (const auto& [magnitude, point] : stars) points.push_back(point);
  return points;
}

double milky_way_s10(double longitude_deg, double latitude_deg) {
  return milky_way_table().s10(longitude_deg, latitude_deg);
}

}  // namespace vegard::sim
