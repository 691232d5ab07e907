#include "fit/survey/filter/frame_features.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/base/utc_time.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

constexpr int kFilterCells = 64;
constexpr double kLowestSky_deg = 5.0;
/// Linear light from which on a channel counts as clipped: white, less what rounding takes.
constexpr float kClippedLight = 0.995f;
/// Linear light below which a file's steps hide differences: logarithms are taken of no less.
constexpr double kMinLight = 1e-4;
constexpr int kMeridianBins = 40;

using SkyDirection = std::array<double, 3>;

double cosine_between(const SkyDirection& a, const SkyDirection& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Light of cells and its residual above the smooth sky; only cells of sky count.
struct CellLight {
  std::vector<std::array<double, 3>> rgb;
  std::vector<double> grey;      ///< mean of the three
  std::vector<double> log_grey;  ///< log10
  std::vector<double> residual;  ///< log_grey less a smooth sky
  std::vector<std::size_t> sky;  ///< numbers of cells
  double clipped_share = 0.0;    ///< of pixels, of the cell that has most
};

CellLight light_of_cells(const Photo& photo, const FilterCells& cells) {
  CellLight light;
  const std::size_t count = cells.sky.size();
  light.rgb.assign(count, {0.0, 0.0, 0.0});
  const int size = cells.size_px;
  std::vector<float> sums(static_cast<std::size_t>(cells.columns) * 3);
  std::vector<int> clipped(count, 0);
  for (int row = 0; row < cells.rows; ++row) {
    std::fill(sums.begin(), sums.end(), 0.0f);
    for (int y = row * size; y < (row + 1) * size; ++y) {
      const float* pixel = &photo.linear.data[photo.linear.index(0, y, 0)];
      for (int column = 0; column < cells.columns; ++column)
        for (int x = 0; x < size; ++x, pixel += 3) {
          for (int c = 0; c < 3; ++c) sums[static_cast<std::size_t>(column) * 3 + c] += pixel[c];
          if (std::max({pixel[0], pixel[1], pixel[2]}) > kClippedLight)
            ++clipped[static_cast<std::size_t>(row) * cells.columns + column];
        }
    }
    for (int column = 0; column < cells.columns; ++column)
      for (int c = 0; c < 3; ++c)
        light.rgb[static_cast<std::size_t>(row) * cells.columns + column][c] =
            sums[static_cast<std::size_t>(column) * 3 + c] / (static_cast<double>(size) * size);
  }
  light.grey.resize(count);
  light.log_grey.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    light.grey[i] = (light.rgb[i][0] + light.rgb[i][1] + light.rgb[i][2]) / 3.0;
    light.log_grey[i] = std::log10(std::max(light.grey[i], kMinLight));
    if (cells.sky[i] == 0) continue;
    light.sky.push_back(i);
    light.clipped_share = std::max(light.clipped_share, clipped[i] / (static_cast<double>(size) * size));
  }
  return light;
}

/// Subtracts a smooth sky from the light: a quadratic function of the cells' place, by least squares over the
/// sky.
void take_smooth_sky_off(const FilterCells& cells, CellLight& light) {
  constexpr int kTerms = 6;
  const auto basis = [&](std::size_t i) {
    const double x = 2.0 * static_cast<double>(i % cells.columns) / cells.columns - 1.0;
    const double y = 2.0 * static_cast<double>(i / cells.columns) / cells.rows - 1.0;
    Eigen::Matrix<double, kTerms, 1> b;
    b << 1.0, x, y, x * x, x * y, y * y;
    return b;
  };
  Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Identity() * 1e-9;
  Eigen::Matrix<double, kTerms, 1> right = Eigen::Matrix<double, kTerms, 1>::Zero();
  for (const std::size_t i : light.sky) {
    const auto b = basis(i);
    normal += b * b.transpose();
    right += b * light.log_grey[i];
  }
  const Eigen::Matrix<double, kTerms, 1> terms = normal.ldlt().solve(right);
  light.residual.assign(light.grey.size(), 0.0);
  for (const std::size_t i : light.sky) light.residual[i] = light.log_grey[i] - basis(i).dot(terms);
}

/// Returns each cell's angle along the magnetic meridian, in degrees from the magnetic northern horizon.
std::vector<double> meridian_angles(const FilterCells& cells, double declination_deg) {
  const double east = std::sin(declination_deg * sim::kRadiansPerDegree),
               north = std::cos(declination_deg * sim::kRadiansPerDegree);
  std::vector<double> angles(cells.sky.size(), 0.0);
  for (std::size_t i = 0; i < angles.size(); ++i)
    angles[i] = std::atan2(cells.enu[i][2], cells.enu[i][0] * east + cells.enu[i][1] * north) /
                sim::kRadiansPerDegree;
  return angles;
}

double banded_share(const CellLight& light, const std::vector<double>& angles) {
  double low = 180.0, high = 0.0, all = 0.0;
  for (const std::size_t i : light.sky) {
    low = std::min(low, angles[i]);
    high = std::max(high, angles[i]);
    all += light.residual[i] * light.residual[i];
  }
  if (!(all > 0.0) || !(high > low)) return 0.0;
  std::array<double, kMeridianBins> sum{}, count{};
  for (const std::size_t i : light.sky) {
    const auto bin = std::min<std::size_t>(
        kMeridianBins - 1, static_cast<std::size_t>((angles[i] - low) / (high - low) * kMeridianBins));
    sum[bin] += light.residual[i];
    count[bin] += 1.0;
  }
  double explained = 0.0;
  for (std::size_t bin = 0; bin < sum.size(); ++bin)
    if (count[bin] > 0.0) explained += sum[bin] * sum[bin] / count[bin];
  return explained / all;
}

/// Adds the features of the residual's gradients: how much of them lies across arcs, and how elongated things
/// are at all.
void add_gradients(const FilterCells& cells, const CellLight& light, const std::vector<double>& angles,
                   FrameFeatures& features) {
  const int w = cells.columns, h = cells.rows;
  std::vector<std::array<double, 3>> tensor(light.grey.size(), {0.0, 0.0, 0.0});
  double across = 0.0, along = 0.0;
  const auto is_sky = [&](int x, int y) { return cells.sky[static_cast<std::size_t>(y) * w + x] != 0; };
  for (int y = 1; y + 1 < h; ++y)
    for (int x = 1; x + 1 < w; ++x) {
      if (!is_sky(x - 1, y) || !is_sky(x + 1, y) || !is_sky(x, y - 1) || !is_sky(x, y + 1)) continue;
      const std::size_t i = static_cast<std::size_t>(y) * w + x;
      const double gx = light.residual[i + 1] - light.residual[i - 1],
                   gy = light.residual[i + w] - light.residual[i - w];
      tensor[i] = {gx * gx, gx * gy, gy * gy};
      const double nx = angles[i + 1] - angles[i - 1], ny = angles[i + w] - angles[i - w];
      const double length = std::hypot(nx, ny);
      if (!(length > 0.0)) continue;
      const double one = (gx * nx + gy * ny) / length, other = (gy * nx - gx * ny) / length;
      across += one * one;
      along += other * other;
    }
  feature(features, FrameFeature::crosswise) =
      across + along > 0.0 ? (across - along) / (across + along) : 0.0;
  // The structure tensor is averaged over five by five cells: what is long is so over more than a cell.
  constexpr int kHalf = 2;
  double coherent = 0.0, energy = 0.0;
  for (int y = kHalf; y + kHalf < h; ++y)
    for (int x = kHalf; x + kHalf < w; ++x) {
      std::array<double, 3> sum{};
      for (int v = y - kHalf; v <= y + kHalf; ++v)
        for (int u = x - kHalf; u <= x + kHalf; ++u)
          for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += tensor[static_cast<std::size_t>(v) * w + u][k];
      energy += sum[0] + sum[2];
      coherent += std::hypot(sum[0] - sum[2], 2.0 * sum[1]);
    }
  feature(features, FrameFeature::elongated) = energy > 0.0 ? coherent / energy : 0.0;
}

void add_colours(const CellLight& light, FrameFeatures& features) {
  std::vector<double> residuals;
  residuals.reserve(light.sky.size());
  for (const std::size_t i : light.sky) residuals.push_back(light.residual[i]);
  constexpr double kBright = 0.9, kMiddle = 0.5;
  const double bright = sim::quantile(residuals, kBright), middle = sim::quantile(residuals, kMiddle);
  std::array<double, 3> top{}, below{};
  double tops = 0.0, belows = 0.0;
  for (const std::size_t i : light.sky) {
    // A clipped cell has lost its colour.
    if (light.grey[i] > kClippedLight) continue;
    std::array<double, 3>* to = light.residual[i] >= bright   ? &top
                                : light.residual[i] <= middle ? &below
                                                              : nullptr;
    if (to == nullptr) continue;
    (to == &top ? tops : belows) += 1.0;
    for (std::size_t c = 0; c < 3; ++c) (*to)[c] += light.rgb[i][c];
  }
  if (tops == 0.0 || belows == 0.0) return;
  std::array<double, 3> more{};
  for (std::size_t c = 0; c < 3; ++c) {
    top[c] /= tops;
    below[c] /= belows;
    more[c] = top[c] - below[c];
  }
  const double sum = more[0] + more[1] + more[2], sky = below[0] + below[1] + below[2];
  if (sum > kMinLight)
    feature(features, FrameFeature::green) =
        std::clamp((more[1] - 0.5 * (more[0] + more[2])) / sum, -1.0, 1.0);
  if (sky > 0.0) feature(features, FrameFeature::blue) = std::clamp((below[2] - below[0]) / sky, -1.0, 1.0);
}

/// Counts stars by their look alone: pixels brighter than their eight neighbours, and well above those three
/// pixels off. The root of light has the same noise everywhere where that is the photons'.
double count_points(const Photo& photo, const FilterCells& cells) {
  const int w = photo.linear.width, h = photo.linear.height;
  constexpr int kOff = 3;
  constexpr double kSigmas = 7.0, kOfMad = 1.4826;
  if (w <= 2 * kOff || h <= 2 * kOff) return 0.0;
  std::vector<float> root(static_cast<std::size_t>(w) * h);
  for (std::size_t i = 0; i < root.size(); ++i)
    root[i] = std::sqrt(std::max(0.0f, photo.linear.data[3 * i + 1]));
  const auto height = [&](int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y) * w + x, down = static_cast<std::size_t>(kOff) * w;
    return root[i] - 0.25f * (root[i - kOff] + root[i + kOff] + root[i - down] + root[i + down]);
  };
  // Every eleventh pixel measures the noise.
  std::vector<double> heights;
  const int area = (w - 2 * kOff) * (h - 2 * kOff);
  for (int n = 0; n < area; n += 11)
    heights.push_back(std::abs(height(kOff + n % (w - 2 * kOff), kOff + n / (w - 2 * kOff))));
  const double step = std::max(file_step(photo), 1e-6);
  const double noise = std::max(kOfMad * sim::quantile(heights, 0.5), 0.5 * std::sqrt(step) / 16.0);
  const auto least = static_cast<float>(kSigmas * noise);
  double points = 0.0;
  for (int y = kOff; y + kOff < h; ++y)
    for (int x = kOff; x + kOff < w; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * w + x;
      const float here = root[i];
      if (here < root[i - 1] || here <= root[i + 1] || here < root[i - w] || here <= root[i + w]) continue;
      if (height(x, y) < least) continue;
      if (here < root[i - w - 1] || here < root[i - w + 1] || here <= root[i + w - 1] ||
          here <= root[i + w + 1])
        continue;
      const int column = x / cells.size_px, row = y / cells.size_px;
      if (column < cells.columns && row < cells.rows &&
          cells.sky[static_cast<std::size_t>(row) * cells.columns + column] != 0)
        points += 1.0;
    }
  return points;
}

/// Adds the features of blobs: cells no darker than their neighbours, against the ring about them. An arc
/// crosses its ring and does not rise above it.
void add_blobs(const FilterCells& cells, const CellLight& light, const SkyDirection& moon,
               FrameFeatures& features) {
  const int w = cells.columns, h = cells.rows;
  constexpr int kRing = 5;
  constexpr double kOfRing = 0.9;
  constexpr double kOfMoon_deg = 6.0;  // its halo's, and the error of its place
  const double moon_cosine = std::cos(kOfMoon_deg * sim::kRadiansPerDegree);
  double at_moon = 0.0, elsewhere = 0.0;
  for (const std::size_t i : light.sky) {
    const int x = static_cast<int>(i % w), y = static_cast<int>(i / w);
    bool is_top = true;
    std::vector<double> ring;
    for (int v = std::max(0, y - kRing); v <= std::min(h - 1, y + kRing) && is_top; ++v)
      for (int u = std::max(0, x - kRing); u <= std::min(w - 1, x + kRing) && is_top; ++u) {
        const std::size_t other = static_cast<std::size_t>(v) * w + u;
        const int away = std::max(std::abs(u - x), std::abs(v - y));
        if (cells.sky[other] == 0) continue;
        if (away <= 1 && light.grey[other] > light.grey[i]) is_top = false;
        if (away == kRing) ring.push_back(light.log_grey[other]);
      }
    constexpr std::size_t kMinOfRing = 8;
    if (!is_top || ring.size() < kMinOfRing) continue;
    const double peak = light.log_grey[i] - sim::quantile(ring, kOfRing);
    const bool is_moon = moon[2] > 0.0 && cosine_between(cells.enu[i], moon) > moon_cosine;
    double& brightest = is_moon ? at_moon : elsewhere;
    brightest = std::max(brightest, peak);
  }
  feature(features, FrameFeature::moon_peak) = at_moon;
  feature(features, FrameFeature::lamp_peak) = elsewhere;
}

/// Returns the slope of log10 brightness against the cosine of the angle to the horizon under the Sun.
double sunward_slope(const FilterCells& cells, const CellLight& light, const SkyDirection& sun) {
  const double level = std::max(std::hypot(sun[0], sun[1]), 1e-9);
  double n = 0.0, s = 0.0, ss = 0.0, v = 0.0, sv = 0.0;
  for (const std::size_t i : light.sky) {
    const double q = (cells.enu[i][0] * sun[0] + cells.enu[i][1] * sun[1]) / level;
    n += 1.0;
    s += q;
    ss += q * q;
    v += light.log_grey[i];
    sv += q * light.log_grey[i];
  }
  const double spread = ss - s * s / n;
  return spread > 0.0 ? (sv - s * v / n) / spread : 0.0;
}

}  // namespace

const std::array<FeatureWords, kFrameFeatures>& feature_words() {
  using F = FrameFeature;
  static constexpr std::array<FeatureWords, kFrameFeatures> words = {{
      {F::sun_elevation, "sun elevation", "deg"},
      {F::moon_elevation, "moon elevation", "deg"},
      {F::moon_light, "moon light", ""},
      {F::brightness, "brightness", "dex"},
      {F::contrast, "contrast", "dex"},
      {F::structure, "structure", "dex"},
      {F::banded, "banded", ""},
      {F::crosswise, "crosswise", ""},
      {F::elongated, "elongated", ""},
      {F::green, "green", ""},
      {F::blue, "blue", ""},
      {F::points, "points", "dex"},
      {F::moon_peak, "moon peak", "dex"},
      {F::lamp_peak, "lamp peak", "dex"},
      {F::clipped, "clipped", "dex"},
      {F::sunward, "sunward", "dex"},
  }};
  return words;
}

FilterCells filter_cells(const sim::Scene& scene, const std::vector<std::uint8_t>& is_kept) {
  const sim::Camera& camera = scene.camera;
  FilterCells cells;
  cells.size_px = std::max(1, (std::max(camera.width, camera.height) + kFilterCells / 2) / kFilterCells);
  cells.columns = camera.width / cells.size_px;
  cells.rows = camera.height / cells.size_px;
  const std::size_t count = static_cast<std::size_t>(cells.columns) * cells.rows;
  cells.sky.assign(count, 0);
  cells.enu.assign(count, {0.0, 0.0, 1.0});
  const sim::CameraView<double> view = sim::camera_view(camera);
  const double lowest = std::sin(kLowestSky_deg * sim::kRadiansPerDegree);
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const int x0 = static_cast<int>(i % cells.columns) * cells.size_px,
              y0 = static_cast<int>(i / cells.columns) * cells.size_px;
    double enu[3];
    if (!sim::enu_of_pixel(view, x0 + 0.5 * cells.size_px, y0 + 0.5 * cells.size_px, enu) || enu[2] < lowest)
      continue;
    cells.enu[i] = {enu[0], enu[1], enu[2]};
    int kept = 0;
    for (int y = y0; y < y0 + cells.size_px; ++y)
      for (int x = x0; x < x0 + cells.size_px; ++x)
        kept += is_kept.empty() || is_kept[static_cast<std::size_t>(y) * camera.width + x] != 0 ? 1 : 0;
    if (2 * kept < cells.size_px * cells.size_px) continue;
    cells.sky[i] = 1;
    any = true;
  }
  if (!any) throw sim::unreadable(scene.file, "the camera sees no sky above 5 degrees that its mask leaves");
  return cells;
}

FrameFeatures frame_features(const Photo& photo, const sim::Scene& scene, const FilterCells& cells,
                             double utc_s) {
  if (photo.linear.width != scene.camera.width || photo.linear.height != scene.camera.height)
    throw sim::unreadable(photo.file_name,
                          "is of " + sim::size_text(photo.linear.width, photo.linear.height) + " pixels")
        .expected(sim::size_text(scene.camera.width, scene.camera.height) + ", the camera's");
  FrameFeatures features{};
  constexpr double kUnixEpoch = 2440587.5, kSecondsPerDay = 86400.0;
  const double date = kUnixEpoch + utc_s / kSecondsPerDay;
  sim::Observer observer;
  observer.latitude_deg = scene.site.latitude_deg;
  observer.longitude_deg = scene.site.longitude_deg;
  observer.refracting_air = false;
  const SkyDirection sun = sim::direction_of_star({sim::place_of_sun(date), 0.0, 0.0}, observer, date);
  const SkyDirection moon = sim::direction_of_moon(observer, date);
  const auto elevation = [](const SkyDirection& enu) {
    return std::asin(std::clamp(enu[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
  };
  feature(features, FrameFeature::sun_elevation) = elevation(sun);
  feature(features, FrameFeature::moon_elevation) = elevation(moon);
  feature(features, FrameFeature::moon_light) = moon[2] > 0.0 ? sim::lit_share_of_moon(date) : 0.0;

  CellLight light = light_of_cells(photo, cells);
  take_smooth_sky_off(cells, light);
  std::vector<double> logs;
  logs.reserve(light.sky.size());
  double squares = 0.0;
  for (const std::size_t i : light.sky) {
    logs.push_back(light.log_grey[i]);
    squares += light.residual[i] * light.residual[i];
  }
  feature(features, FrameFeature::brightness) = sim::quantile(logs, 0.5);
  feature(features, FrameFeature::contrast) = sim::quantile(logs, 0.95) - sim::quantile(logs, 0.05);
  feature(features, FrameFeature::structure) = std::sqrt(squares / static_cast<double>(light.sky.size()));
  const std::vector<double> angles = meridian_angles(cells, scene.field.declination_deg);
  feature(features, FrameFeature::banded) = banded_share(light, angles);
  add_gradients(cells, light, angles, features);
  add_colours(light, features);
  feature(features, FrameFeature::points) = std::log10(1.0 + count_points(photo, cells));
  add_blobs(cells, light, moon, features);
  feature(features, FrameFeature::clipped) = std::log10(0.01 + light.clipped_share);
  feature(features, FrameFeature::sunward) = sunward_slope(cells, light, sun);
  return features;
}

}  // namespace vegard::fit
