#include "fit/sky_kind/sky_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace sky_look {
namespace {

/// Light, in units of the sky's own, below which steps and noise hide differences: logarithms are taken of no
/// less.
constexpr double kMinLight = 0.02;

/// What a picture calls dark and bright, so that a camera's offset and gain do not count.
struct LightUnit {
  double black = 0.0, white = 1.0;
  double of(double light) const { return (light - black) / (white - black); }
};

/// Returns the sky's brighter cells as white. Black is that of the parts which are no sky, where they are
/// darker than nearly all of it: the surroundings of a fisheye's circle, or the ground. Counts without such
/// parts have an offset that nobody knows: the sky's darkest part then is a tenth above black. A picture for
/// the eye has none.
LightUnit unit_of(const Photo& photo, std::vector<double> of_sky, std::vector<double> dark) {
  constexpr double kBright = 0.95, kDarkest = 0.02, kDark = 0.1, kAbove = 0.1;
  constexpr std::size_t kEnough = 40;
  LightUnit unit;
  unit.white = sim::quantile(of_sky, kBright);
  const double darkest = sim::quantile(of_sky, kDarkest);
  if (dark.size() >= kEnough && sim::quantile(dark, kDark) < darkest) {
    unit.black = sim::quantile(dark, kDark);
  } else if (!photo.srgb) {
    unit.black = darkest - kAbove * std::max(unit.white - darkest, 0.0);
  }
  if (!(unit.white > unit.black)) unit.white = unit.black + 1e-6;
  return unit;
}

/// The same with what it is counted in.
struct SkyLight : CellLight {
  LightUnit unit;
  double white = 1.0;  ///< the file's

  double clipped() const { return kClippedLight * white; }
};

SkyLight light_of_sky(const Photo& photo, const FeatureCells& cells) {
  // Floats have no white.
  SkyLight light{light_of_cells(photo, cells, !photo.floating), {}, 1.0};
  std::vector<double> of_sky, dark;
  for (std::size_t i = 0; i < light.grey.size(); ++i)
    (cells.sky[i] != 0 ? of_sky : dark).push_back(light.grey[i]);
  if (photo.floating) light.white = std::numeric_limits<double>::infinity();
  light.unit = unit_of(photo, of_sky, dark);
  for (const double grey : light.grey)
    light.log_grey.push_back(std::log10(std::max(light.unit.of(grey), kMinLight)));
  take_smooth_sky_off(cells, light);
  return light;
}

using Part = std::vector<std::size_t>;

/// The parts of a map that hang together by sides or corners.
std::vector<Part> connected_parts(const std::vector<char>& in, int width, int height) {
  std::vector<Part> parts;
  std::vector<char> left = in;
  for (std::size_t begin = 0; begin < left.size(); ++begin) {
    if (left[begin] == 0) continue;
    Part part = {begin};
    left[begin] = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const int x = static_cast<int>(part[next] % width), y = static_cast<int>(part[next] / width);
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
          const std::size_t other = static_cast<std::size_t>(v) * width + u;
          if (left[other] == 0) continue;
          left[other] = 0;
          part.push_back(other);
        }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Whether the three channels differ at all: a grey file has none of the features of colour.
bool has_colour(const CellLight& light) {
  constexpr double kLeast = 1e-3;
  double differences = 0.0, sum = 0.0;
  for (const std::size_t i : light.sky) {
    const std::array<double, 3>& c = light.rgb[i];
    differences += std::abs(c[0] - c[1]) + std::abs(c[2] - c[1]);
    sum += c[0] + c[1] + c[2];
  }
  return sum > 0.0 && differences > kLeast * sum;
}

void add_colours(const SkyLight& light, SkyFeatures& features) {
  feature(features, SkyFeature::green) = feature(features, SkyFeature::warm) = 0.0;
  feature(features, SkyFeature::blue) = 0.0;
  const std::optional<TopAndBelow> mean = top_and_below(light, light.clipped());
  if (!mean) return;
  const std::array<double, 3>& below = mean->below;
  std::array<double, 3> more{};
  for (std::size_t c = 0; c < 3; ++c) more[c] = mean->top[c] - below[c];
  const double black = 3.0 * light.unit.black,
               least = 3.0 * kMinLight * (light.unit.white - light.unit.black);
  const double sum = more[0] + more[1] + more[2], sky = below[0] + below[1] + below[2] - black;
  if (sum > least) {
    feature(features, SkyFeature::green) = std::clamp((more[1] - 0.5 * (more[0] + more[2])) / sum, -1.0, 1.0);
    feature(features, SkyFeature::warm) = std::clamp((more[0] - more[2]) / sum, -1.0, 1.0);
  }
  if (sky > least) feature(features, SkyFeature::blue) = std::clamp((below[2] - below[0]) / sky, -1.0, 1.0);
}

constexpr int kLongestOfPoints = 800;

/// A channel averaged over squares of pixels, so that the longer side has at most so many: small points of
/// light are as wide in a large picture as in a small one.
struct ReducedLight {
  int width = 0, height = 0, factor = 1;
  std::vector<float> value;
};

ReducedLight reduced_green(const Photo& photo, int longest) {
  ReducedLight small;
  const int w = photo.linear.width, h = photo.linear.height;
  small.factor = std::max(1, (std::max(w, h) + longest - 1) / longest);
  small.width = w / small.factor;
  small.height = h / small.factor;
  small.value.assign(static_cast<std::size_t>(small.width) * small.height, 0.0f);
  const float share = 1.0f / static_cast<float>(small.factor * small.factor);
  for (int y = 0; y < small.height * small.factor; ++y) {
    const float* pixel = &photo.linear.data[photo.linear.index(0, y, 0)];
    float* to = &small.value[static_cast<std::size_t>(y / small.factor) * small.width];
    for (int x = 0; x < small.width * small.factor; ++x) to[x / small.factor] += share * pixel[3 * x + 1];
  }
  return small;
}

/// Counts star-like points. Adds the share of the sky's tiles, of eight by eight cells, that have one: clouds
/// hide the stars of a part of the sky.
void add_points(const Photo& photo, const FeatureCells& cells, SkyFeatures& features) {
  ReducedLight small = reduced_green(photo, kLongestOfPoints);
  constexpr int kTile = 8;
  feature(features, SkyFeature::points) = feature(features, SkyFeature::star_cover) = 0.0;
  for (float& value : small.value) value = std::sqrt(std::max(0.0f, value));
  const auto cell_of = [&](int x, int y) -> std::ptrdiff_t {
    const int column = x * small.factor / cells.size_px, row = y * small.factor / cells.size_px;
    if (column >= cells.columns || row >= cells.rows) return -1;
    const auto cell = static_cast<std::ptrdiff_t>(row) * cells.columns + column;
    return cells.sky[static_cast<std::size_t>(cell)] != 0 ? cell : -1;
  };
  const int tiles_across = (cells.columns + kTile - 1) / kTile;
  std::vector<int> tile_cells(static_cast<std::size_t>(tiles_across) * ((cells.rows + kTile - 1) / kTile), 0);
  std::vector<int> stars(tile_cells.size(), 0);
  const auto tile_of = [&](std::size_t cell) {
    return cell / cells.columns / kTile * tiles_across + cell % cells.columns / kTile;
  };
  for (std::size_t i = 0; i < cells.sky.size(); ++i)
    if (cells.sky[i] != 0) ++tile_cells[tile_of(i)];
  double points = 0.0;
  find_points(
      small.value, small.width, small.height, file_step(photo),
      [&](int x, int y) { return cell_of(x, y) >= 0; },
      [&](int x, int y) {
        const std::ptrdiff_t cell = cell_of(x, y);
        if (cell < 0) return;
        points += 1.0;
        ++stars[tile_of(static_cast<std::size_t>(cell))];
      });
  feature(features, SkyFeature::points) = std::log10(1.0 + points);
  double tiles = 0.0, starry = 0.0, of_tiles = 0.0;
  for (std::size_t t = 0; t < tile_cells.size(); ++t) {
    if (2 * tile_cells[t] < kTile * kTile) continue;
    tiles += 1.0;
    starry += stars[t] > 0 ? 1.0 : 0.0;
    of_tiles += stars[t];
  }
  feature(features, SkyFeature::star_gaps) = 0.0;
  if (tiles == 0.0) return;
  feature(features, SkyFeature::star_cover) = starry / tiles;
  feature(features, SkyFeature::star_gaps) = 1.0 - starry / tiles - std::exp(-of_tiles / tiles);
}

/// Adds the features of the largest connected area at white, in pixels of the reduced picture.
void add_disc(const Photo& photo, const FeatureCells& cells, SkyFeatures& features) {
  const ReducedLight small = reduced_green(photo, kLongestOfPoints);
  std::vector<char> white(small.value.size(), 0);
  double sky = 0.0;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const int column = x * small.factor / cells.size_px, row = y * small.factor / cells.size_px;
      if (column >= cells.columns || row >= cells.rows ||
          cells.sky[static_cast<std::size_t>(row) * cells.columns + column] == 0)
        continue;
      sky += 1.0;
      const std::size_t i = static_cast<std::size_t>(y) * small.width + x;
      constexpr float kNearlyWhite = 0.97f;
      // Floats have no white.
      white[i] = !photo.floating && small.value[i] > kNearlyWhite ? 1 : 0;
    }
  double largest = 0.0, round = 0.0;
  for (const Part& part : connected_parts(white, small.width, small.height)) {
    const auto area = static_cast<double>(part.size());
    if (area <= largest) continue;
    largest = area;
    double mx = 0.0, my = 0.0, farthest = 0.0;
    for (const std::size_t i : part) {
      mx += static_cast<double>(i % small.width) / area;
      my += static_cast<double>(i / small.width) / area;
    }
    for (const std::size_t i : part)
      farthest = std::max(farthest, std::hypot(static_cast<double>(i % small.width) - mx,
                                               static_cast<double>(i / small.width) - my));
    round = area / (sim::kPi * (farthest + 0.5) * (farthest + 0.5));
  }
  feature(features, SkyFeature::disc) = std::log10(1e-5 + largest / std::max(sky, 1.0));
  feature(features, SkyFeature::disc_round) = std::min(round, 1.0);
}

/// A map of cells, each the mean of itself and its neighbours.
struct SmoothMap {
  std::vector<double> value;
  double middle = 0.0, top = 0.0;  ///< the median, and what one cell in a hundred exceeds
};

SmoothMap smooth_map(const FeatureCells& cells, const CellLight& light, const std::vector<double>& map) {
  const int w = cells.columns, h = cells.rows;
  SmoothMap smooth;
  smooth.value.assign(map.size(), 0.0);
  std::vector<double> values;
  for (const std::size_t i : light.sky) {
    const int x = static_cast<int>(i % w), y = static_cast<int>(i / w);
    double sum = 0.0, count = 0.0;
    for (int v = std::max(0, y - 1); v <= std::min(h - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(w - 1, x + 1); ++u) {
        const std::size_t other = static_cast<std::size_t>(v) * w + u;
        if (cells.sky[other] == 0) continue;
        sum += map[other];
        count += 1.0;
      }
    smooth.value[i] = sum / count;
    values.push_back(smooth.value[i]);
  }
  constexpr double kTop = 0.99;
  smooth.middle = sim::quantile(values, 0.5);
  smooth.top = sim::quantile(values, kTop);
  return smooth;
}

/// Counts the bands that a walk meets: a band rises and falls by `least` at least, or ends with the walk.
int bands_along(const std::vector<double>& walk, double least) {
  int bands = 0;
  bool is_up = false;
  double turn = walk.empty() ? 0.0 : walk.front();  // the lowest since the last band, or the highest of this
  for (const double value : walk) {
    if (!is_up && value > turn + least) {
      ++bands;
      is_up = true;
      turn = value;
    } else if (is_up && value < turn - least) {
      is_up = false;
      turn = value;
    }
    turn = is_up ? std::max(turn, value) : std::min(turn, value);
  }
  return bands;
}

/// The direction in which the map changes most (radians from its rows), by the sum of the gradients' tensor.
double across_bands(const FeatureCells& cells, const SmoothMap& map) {
  const int w = cells.columns, h = cells.rows;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (int y = 1; y + 1 < h; ++y)
    for (int x = 1; x + 1 < w; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * w + x;
      if (cells.sky[i - 1] == 0 || cells.sky[i + 1] == 0 || cells.sky[i - w] == 0 || cells.sky[i + w] == 0)
        continue;
      const double gx = map.value[i + 1] - map.value[i - 1], gy = map.value[i + w] - map.value[i - w];
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  return 0.5 * std::atan2(2.0 * xy, xx - yy);
}

/// Mean number of bands that lines across them meet, of lines that meet any.
double crossings_of(const FeatureCells& cells, const SmoothMap& map) {
  constexpr double kOfRange = 0.25;
  constexpr int kStep = 2;
  constexpr std::size_t kLeastCells = 8;
  const double least = kOfRange * (map.top - map.middle), across = across_bands(cells, map);
  const double dx = std::cos(across), dy = std::sin(across);
  const int half = (std::max(cells.columns, cells.rows) * 3) / 4;
  double lines = 0.0, met = 0.0;
  for (int off = -half; off <= half; off += kStep) {
    std::vector<double> walk;
    for (int along = -half; along <= half; ++along) {
      const auto x = static_cast<int>(std::floor(0.5 * cells.columns + along * dx - off * dy)),
                 y = static_cast<int>(std::floor(0.5 * cells.rows + along * dy + off * dx));
      if (x < 0 || y < 0 || x >= cells.columns || y >= cells.rows) continue;
      const std::size_t i = static_cast<std::size_t>(y) * cells.columns + x;
      if (cells.sky[i] != 0) walk.push_back(map.value[i]);
    }
    if (walk.size() < kLeastCells) continue;
    const int bands = least > 0.0 ? bands_along(walk, least) : 0;
    if (bands == 0) continue;
    lines += 1.0;
    met += bands;
  }
  return lines > 0.0 ? met / lines : 0.0;
}

struct Ridges {
  double length = 0.0, count = 0.0, share = 0.0;
};

/// The bright parts of a map of cells, and which of them are long: many times longer than they are thick.
Ridges ridges_of(const FeatureCells& cells, const CellLight& light, const SmoothMap& smooth,
                 std::vector<char>& bright) {
  const int w = cells.columns, h = cells.rows;
  constexpr double kOfRange = 0.4;
  bright.assign(smooth.value.size(), 0);
  for (const std::size_t i : light.sky)
    bright[i] = smooth.value[i] > smooth.middle + kOfRange * (smooth.top - smooth.middle) ? 1 : 0;
  Ridges found;
  double all = 0.0;
  for (const Part& part : connected_parts(bright, w, h)) {
    constexpr std::size_t kLeastCells = 8;
    constexpr double kElongated = 4.0;
    all += static_cast<double>(part.size());
    if (part.size() < kLeastCells) continue;
    // Four times the mean depth is the thickness of a long part, wherever it bends.
    double depth = 0.0;
    for (const std::size_t i : part) {
      const int x = static_cast<int>(i % w), y = static_cast<int>(i / w);
      int in = 1;
      for (bool whole = true; whole && in < std::max(w, h); in += whole ? 1 : 0)
        for (const auto& [u, v] :
             {std::pair{x - in, y}, std::pair{x + in, y}, std::pair{x, y - in}, std::pair{x, y + in}}) {
          // The picture's edge cuts an arc off and does not make it thin.
          if (u < 0 || v < 0 || u >= w || v >= h) continue;
          if (bright[static_cast<std::size_t>(v) * w + u] == 0) whole = false;
        }
      depth += in;
    }
    const double thickness = std::max(1.0, 4.0 * (depth / static_cast<double>(part.size()) - 0.5));
    const double length = static_cast<double>(part.size()) / thickness;
    if (length < kElongated * thickness) continue;
    found.count += 1.0;
    found.share += static_cast<double>(part.size());
    found.length = std::max(found.length, length / std::max(w, h));
  }
  if (all > 0.0) found.share /= all;
  return found;
}

/// Adds the features of long parts in light and greenness, of rays, and of where the light is.
void add_ridges(const FeatureCells& cells, const SkyLight& light, SkyFeatures& features) {
  const int w = cells.columns, h = cells.rows;
  std::vector<char> bright;
  SmoothMap map = smooth_map(cells, light, light.residual);
  const Ridges of_light = ridges_of(cells, light, map, bright);
  feature(features, SkyFeature::ridge_length) = of_light.length;
  feature(features, SkyFeature::ridges) = of_light.count;
  feature(features, SkyFeature::ridge_share) = of_light.share;

  double differences = 0.0, squares = 0.0, n = 0.0;
  for (const std::size_t i : light.sky) {
    squares += light.residual[i] * light.residual[i];
    const int x = static_cast<int>(i % w), y = static_cast<int>(i / w);
    if (x + 1 >= w || y + 1 >= h || cells.sky[i + 1] == 0 || cells.sky[i + w] == 0) continue;
    n += 1.0;
    differences += std::abs(light.residual[i + 1] - light.residual[i]) +
                   std::abs(light.residual[i + w] - light.residual[i]);
  }
  const double deviation = std::sqrt(squares / static_cast<double>(light.sky.size()));
  feature(features, SkyFeature::texture) = n > 0.0 && deviation > 0.0 ? differences / n / deviation : 0.0;

  if (has_colour(light)) {
    std::vector<double> greenness(light.grey.size(), 0.0), values;
    double sg = 0.0, sl = 0.0, sgg = 0.0, sll = 0.0, sgl = 0.0;
    for (const std::size_t i : light.sky) {
      const std::array<double, 3>& c = light.rgb[i];
      const double sum = std::max(c[0] + c[1] + c[2] - 3.0 * light.unit.black,
                                  3.0 * kMinLight * (light.unit.white - light.unit.black));
      greenness[i] = light.grey[i] > light.clipped() ? 0.0 : (c[1] - 0.5 * (c[0] + c[2])) / sum;
      values.push_back(greenness[i]);
      sg += greenness[i];
      sl += light.residual[i];
      sgg += greenness[i] * greenness[i];
      sll += light.residual[i] * light.residual[i];
      sgl += greenness[i] * light.residual[i];
    }
    const auto count = static_cast<double>(light.sky.size());
    const double vg = sgg - sg * sg / count, vl = sll - sl * sl / count;
    feature(features, SkyFeature::green_light) =
        vg > 0.0 && vl > 0.0 ? (sgl - sg * sl / count) / std::sqrt(vg * vl) : 0.0;
    const double green_part = std::max(0.0, feature(features, SkyFeature::green_light));
    feature(features, SkyFeature::grey_light) =
        std::sqrt(std::max(0.0, vl / count * (1.0 - green_part * green_part)));
    constexpr double kTop = 0.98;
    feature(features, SkyFeature::green_spread) = sim::quantile(values, kTop) - sim::quantile(values, 0.5);
    std::vector<char> green;
    map = smooth_map(cells, light, greenness);
    const Ridges of_green = ridges_of(cells, light, map, green);
    feature(features, SkyFeature::green_length) = of_green.length;
    feature(features, SkyFeature::green_ridges) = of_green.count;
    feature(features, SkyFeature::green_share) = of_green.share;
    // Where there is colour the green is the aurora.
    bright = green;
  }
  feature(features, SkyFeature::crossings) = crossings_of(cells, map);

  // Rays: light changes along the ridge too. The ridge's direction is that of the light within four cells.
  constexpr int kHalf = 4;
  double along = 0.0, both = 0.0;
  const auto gradient = [&](int x, int y) -> std::array<double, 2> {
    if (x < 1 || y < 1 || x + 1 >= w || y + 1 >= h) return {0.0, 0.0};
    const std::size_t i = static_cast<std::size_t>(y) * w + x;
    if (cells.sky[i - 1] == 0 || cells.sky[i + 1] == 0 || cells.sky[i - w] == 0 || cells.sky[i + w] == 0)
      return {0.0, 0.0};
    return {light.residual[i + 1] - light.residual[i - 1], light.residual[i + w] - light.residual[i - w]};
  };
  double mx = 0.0, my = 0.0, spread = 0.0, of_bright = 0.0, brights = 0.0;
  for (const std::size_t i : light.sky) {
    mx += static_cast<double>(i % w) / static_cast<double>(light.sky.size());
    my += static_cast<double>(i / w) / static_cast<double>(light.sky.size());
  }
  for (const std::size_t i : light.sky) {
    const int x = static_cast<int>(i % w), y = static_cast<int>(i / w);
    const double away = std::hypot(x - mx, y - my);
    spread += away / static_cast<double>(light.sky.size());
    if (bright[i] == 0) continue;
    of_bright += away;
    brights += 1.0;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (int v = y - kHalf; v <= y + kHalf; ++v)
      for (int u = x - kHalf; u <= x + kHalf; ++u) {
        const std::array<double, 2> g = gradient(u, v);
        xx += g[0] * g[0];
        xy += g[0] * g[1];
        yy += g[1] * g[1];
      }
    const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const std::array<double, 2> g = gradient(x, y);
    const double off = g[1] * std::cos(turn) - g[0] * std::sin(turn);
    along += off * off;
    both += g[0] * g[0] + g[1] * g[1];
  }
  feature(features, SkyFeature::crossed) = both > 0.0 ? along / both : 0.0;
  feature(features, SkyFeature::central) = brights > 0.0 && spread > 0.0 ? of_bright / brights / spread : 0.0;
}

/// Adds how much of the light's small changes lies along bright ridges. Stars are taken off by a median of
/// three by three pixels; the ridges' direction is that of the light at a coarser scale.
void add_fine_rays(const Photo& photo, const FeatureCells& cells, SkyFeatures& features) {
  constexpr int kLongest = 256, kHalf = 6;
  const ReducedLight small = reduced_green(photo, kLongest);
  const int w = small.width, h = small.height;
  const auto index = [&](int x, int y) { return static_cast<std::size_t>(y) * w + x; };
  std::vector<double> fine(small.value.size(), 0.0), sky_values;
  std::vector<char> sky(small.value.size(), 0);
  std::array<float, 9> nine;
  for (int y = 1; y + 1 < h; ++y)
    for (int x = 1; x + 1 < w; ++x) {
      const int column = x * small.factor / cells.size_px, row = y * small.factor / cells.size_px;
      if (column >= cells.columns || row >= cells.rows ||
          cells.sky[static_cast<std::size_t>(row) * cells.columns + column] == 0)
        continue;
      std::size_t n = 0;
      for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) nine[n++] = small.value[index(u, v)];
      std::nth_element(nine.begin(), nine.begin() + 4, nine.end());
      sky[index(x, y)] = 1;
      fine[index(x, y)] = nine[4];
      sky_values.push_back(nine[4]);
    }
  feature(features, SkyFeature::fine_rays) = 0.0;
  if (sky_values.empty()) return;
  constexpr double kOfRange = 0.4, kTop = 0.99;
  const double middle = sim::quantile(sky_values, 0.5), top = sim::quantile(sky_values, kTop);
  if (!(top > middle)) return;
  // Sums over rectangles by a table, of the coarse light's gradients: differences over four pixels.
  const auto whole = [&](int x, int y, int reach) {
    return x >= reach && y >= reach && x + reach < w && y + reach < h && sky[index(x - reach, y)] != 0 &&
           sky[index(x + reach, y)] != 0 && sky[index(x, y - reach)] != 0 && sky[index(x, y + reach)] != 0;
  };
  std::vector<std::array<double, 3>> table(static_cast<std::size_t>(w + 1) * (h + 1), {0.0, 0.0, 0.0});
  const auto at = [&](int x, int y) -> std::array<double, 3>& {
    return table[static_cast<std::size_t>(y) * (w + 1) + x];
  };
  constexpr int kCoarse = 4;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      std::array<double, 3> own{};
      if (whole(x, y, kCoarse)) {
        const double gx = fine[index(x + kCoarse, y)] - fine[index(x - kCoarse, y)],
                     gy = fine[index(x, y + kCoarse)] - fine[index(x, y - kCoarse)];
        own = {gx * gx, gx * gy, gy * gy};
      }
      for (std::size_t k = 0; k < own.size(); ++k)
        at(x + 1, y + 1)[k] = own[k] + at(x, y + 1)[k] + at(x + 1, y)[k] - at(x, y)[k];
    }
  double along = 0.0, both = 0.0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      if (!whole(x, y, 1) || fine[index(x, y)] < middle + kOfRange * (top - middle)) continue;
      const int x0 = std::max(0, x - kHalf), x1 = std::min(w, x + kHalf + 1), y0 = std::max(0, y - kHalf),
                y1 = std::min(h, y + kHalf + 1);
      std::array<double, 3> sum{};
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] = at(x1, y1)[k] - at(x0, y1)[k] - at(x1, y0)[k] + at(x0, y0)[k];
      const double across = 0.5 * std::atan2(2.0 * sum[1], sum[0] - sum[2]);
      const double gx = fine[index(x + 1, y)] - fine[index(x - 1, y)],
                   gy = fine[index(x, y + 1)] - fine[index(x, y - 1)];
      const double off = gy * std::cos(across) - gx * std::sin(across);
      along += off * off;
      both += gx * gx + gy * gy;
    }
  if (both > 0.0) feature(features, SkyFeature::fine_rays) = along / both;
}

/// Adds how far the sky's brightest blob outshines the sky about it.
void add_peak(const FeatureCells& cells, const SkyLight& light, SkyFeatures& features) {
  double highest = 0.0, top = -1e9;
  std::size_t brightest = 0;
  for (const std::size_t i : light.sky) {
    const std::optional<double> peak = peak_above_ring(cells, light, i);
    if (!peak) continue;
    highest = std::max(highest, *peak);
    if (light.log_grey[i] <= top) continue;
    top = light.log_grey[i];
    brightest = i;
  }
  feature(features, SkyFeature::peak) = highest;
  feature(features, SkyFeature::halo) = 0.0;
  if (top < -1e8) return;
  constexpr int kNear = 3, kFar = 5;
  const int w = cells.columns, x = static_cast<int>(brightest % w), y = static_cast<int>(brightest / w);
  std::vector<double> ring, all;
  for (const std::size_t i : light.sky) {
    const int away = std::max(std::abs(static_cast<int>(i % w) - x), std::abs(static_cast<int>(i / w) - y));
    if (away >= kNear && away <= kFar) ring.push_back(light.log_grey[i]);
    all.push_back(light.log_grey[i]);
  }
  if (!ring.empty()) feature(features, SkyFeature::halo) = sim::quantile(ring, 0.5) - sim::quantile(all, 0.5);
}

SkyFeatures no_features() {
  SkyFeatures features;
  features.fill(std::numeric_limits<double>::quiet_NaN());
  return features;
}

SkyFeatures all(const Photo& photo, const FeatureCells& cells) {
  SkyFeatures features = no_features();
  const SkyLight light = light_of_sky(photo, cells);
  std::vector<double> logs;
  logs.reserve(light.sky.size());
  double squares = 0.0;
  for (const std::size_t i : light.sky) {
    logs.push_back(light.log_grey[i]);
    squares += light.residual[i] * light.residual[i];
  }
  std::vector<double> smooth;
  for (const std::size_t i : light.sky) smooth.push_back(light.log_grey[i] - light.residual[i]);
  constexpr double kHigh = 0.95, kLow = 0.05;
  feature(features, SkyFeature::smooth) = sim::quantile(smooth, kHigh) - sim::quantile(smooth, kLow);
  constexpr double kLeastLevel = 1e-5;
  std::vector<double> greys;
  for (const std::size_t i : light.sky) greys.push_back(light.grey[i]);
  feature(features, SkyFeature::brightness) = std::log10(std::max(sim::quantile(greys, 0.5), kLeastLevel));
  feature(features, SkyFeature::level) = std::log10(std::max(sim::quantile(greys, kHigh), kLeastLevel));
  feature(features, SkyFeature::contrast) = sim::quantile(logs, kHigh) - sim::quantile(logs, kLow);
  feature(features, SkyFeature::structure) = std::sqrt(squares / static_cast<double>(light.sky.size()));
  feature(features, SkyFeature::elongated) = elongation(cells, residual_gradients(cells, light));
  if (has_colour(light)) add_colours(light, features);
  add_points(photo, cells, features);
  add_peak(cells, light, features);
  feature(features, SkyFeature::clipped) = std::log10(0.01 + light.clipped_share);
  add_disc(photo, cells, features);
  add_ridges(cells, light, features);
  add_fine_rays(photo, cells, features);
  return features;
}

}  // namespace
}  // namespace sky_look

const std::array<SkyFeatureWords, kSkyFeatures>& sky_feature_words() {
  using F = SkyFeature;
  static constexpr std::array<SkyFeatureWords, kSkyFeatures> words = {{
      {F::brightness, "brightness", "dex"},
      {F::contrast, "contrast", "dex"},
      {F::structure, "structure", "dex"},
      {F::elongated, "elongated", ""},
      {F::green, "green", ""},
      {F::blue, "blue", ""},
      {F::points, "points", "dex"},
      {F::clipped, "clipped", "dex"},
      {F::peak, "peak", "dex"},
      {F::green_spread, "green spread", ""},
      {F::green_light, "green light", ""},
      {F::warm, "warm", ""},
      {F::star_cover, "star cover", ""},
      {F::disc, "disc", "dex"},
      {F::disc_round, "disc round", ""},
      {F::texture, "texture", ""},
      {F::ridge_length, "ridge length", ""},
      {F::ridges, "ridges", ""},
      {F::ridge_share, "ridge share", ""},
      {F::green_length, "green length", ""},
      {F::green_ridges, "green ridges", ""},
      {F::green_share, "green share", ""},
      {F::crossed, "crossed", ""},
      {F::central, "central", ""},
      {F::level, "level", "dex"},
      {F::smooth, "smooth", "dex"},
      {F::crossings, "crossings", ""},
      {F::fine_rays, "fine rays", ""},
      {F::halo, "halo", "dex"},
      {F::star_gaps, "star gaps", ""},
      {F::grey_light, "grey light", "dex"},
      {F::banded, "banded", ""},
      {F::crosswise, "crosswise", ""},
      {F::moon_peak, "moon peak", "dex"},
      {F::lamp_peak, "lamp peak", "dex"},
      {F::sunward, "sunward", "dex"},
      {F::sun_elevation, "sun elevation", "deg"},
      {F::moon_elevation, "moon elevation", "deg"},
      {F::moon_light, "moon light", ""},
      {F::star_tiles, "star tiles", ""},
      {F::ridge_top, "ridge top", "dex"},
      {F::thin_lines, "thin lines", ""},
      {F::wide_lines, "wide lines", ""},
      {F::ray_strength, "ray strength", "dex"},
  }};
  return words;
}

FeatureCells sky_cells(int width, int height, const std::vector<std::uint8_t>& is_kept,
                       const std::string& file) {
  FeatureCells cells = cells_of(width, height);
  bool any = false;
  for (std::size_t i = 0; i < cells.sky.size(); ++i) {
    cells.sky[i] = is_cell_kept(cells, i, width, is_kept) ? 1 : 0;
    any = any || cells.sky[i] != 0;
  }
  if (!any) throw sim::unreadable(file, "has no sky that the mask leaves");
  return cells;
}

CellLight sky_light(const Photo& photo, const FeatureCells& cells) {
  return static_cast<CellLight>(sky_look::light_of_sky(photo, cells));
}

SkyFeatures sky_features(const Photo& photo, const FeatureCells& cells) {
  return sky_look::all(photo, cells);
}

}  // namespace vegard::fit
