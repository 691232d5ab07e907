#include "fit/sky_kind/sky_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace sky_lines {
namespace {

/// A map of numbers, of which some are of sky.
struct SkyMap {
  int width = 0, height = 0;
  std::vector<double> value;
  std::vector<std::uint8_t> sky;

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
  double at(int x, int y) const { return value[index(x, y)]; }
  double& at(int x, int y) { return value[index(x, y)]; }
  bool is_sky(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && sky[index(x, y)] != 0;
  }
  std::vector<double> of_sky() const {
    std::vector<double> values;
    for (std::size_t i = 0; i < value.size(); ++i)
      if (sky[i] != 0) values.push_back(value[i]);
    return values;
  }
};

/// The mean of channels [first, end), averaged over squares of pixels so that the longer side has at most
/// `longest`. A square is sky if half of its pixels are kept, and is their mean then.
SkyMap reduced(const Photo& photo, const PixelSet& left_out, int longest, int first, int end) {
  const sim::Image& image = photo.linear;
  const int factor = std::max(1, (std::max(image.width, image.height) + longest - 1) / longest);
  SkyMap map;
  map.width = image.width / factor;
  map.height = image.height / factor;
  const std::size_t size = static_cast<std::size_t>(map.width) * map.height;
  map.sky.assign(size, 0);
  std::vector<double> all(size, 0.0), kept(size, 0.0);
  std::vector<int> count(size, 0);
  for (int y = 0; y < map.height * factor; ++y)
    for (int x = 0; x < map.width * factor; ++x) {
      double light = 0.0;
      for (int c = first; c < end; ++c) light += image.at(x, y, c) / (end - first);
      const std::size_t i = map.index(x / factor, y / factor);
      all[i] += light;
      if (left_out.at(x, y) != 0) continue;
      kept[i] += light;
      ++count[i];
    }
  const int area = factor * factor;
  map.value.assign(size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    map.sky[i] = 2 * count[i] >= area ? 1 : 0;
    map.value[i] = map.sky[i] != 0 ? kept[i] / count[i] : all[i] / area;
  }
  return map;
}

/// Takes stars and trails off, which are thinner than any arc: a median of three by three pixels of sky.
SkyMap without_thin(const SkyMap& map) {
  SkyMap out = map;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      if (!map.is_sky(x, y)) continue;
      std::vector<double> about;
      for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u)
          if (map.is_sky(u, v)) about.push_back(map.at(u, v));
      out.at(x, y) = sim::quantile(about, 0.5);
    }
  return out;
}

/// Smooths by a Gaussian over the sky alone.
SkyMap smoothed(const SkyMap& map, double sigma) {
  constexpr double kReach = 3.0;
  const int reach = static_cast<int>(std::ceil(kReach * sigma));
  std::vector<double> kernel;
  for (int i = -reach; i <= reach; ++i) kernel.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
  const auto weight = [&](int off) { return kernel[static_cast<std::size_t>(off + reach)]; };
  SkyMap along = map;
  std::vector<double> share(map.value.size(), 0.0);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      double sum = 0.0, of = 0.0;
      for (int i = std::max(-reach, -x); i <= std::min(reach, map.width - 1 - x); ++i) {
        if (map.sky[map.index(x + i, y)] == 0) continue;
        sum += weight(i) * map.at(x + i, y);
        of += weight(i);
      }
      along.at(x, y) = sum;
      share[map.index(x, y)] = of;
    }
  SkyMap out = map;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      double sum = 0.0, of = 0.0;
      for (int i = std::max(-reach, -y); i <= std::min(reach, map.height - 1 - y); ++i) {
        sum += weight(i) * along.at(x, y + i);
        of += weight(i) * share[map.index(x, y + i)];
      }
      out.at(x, y) = of > 0.0 ? sum / of : 0.0;
    }
  return out;
}

/// What is dark and what is bright, as in sky_features.cpp: black is what lies around the sky, where that is
/// darker; else that of counts is a tenth below the sky's darkest part.
struct LightUnit {
  double black = 0.0, white = 1.0;

  LightUnit(const Photo& photo, const SkyMap& grey, const SkyMap& smooth) {
    constexpr double kBright = 0.95, kDarkest = 0.02, kDark = 0.1, kAbove = 0.1;
    constexpr std::size_t kEnough = 160;
    std::vector<double> dark, bright = smooth.of_sky();
    for (std::size_t i = 0; i < grey.value.size(); ++i)
      if (grey.sky[i] == 0) dark.push_back(grey.value[i]);
    white = sim::quantile(bright, kBright);
    const double darkest = sim::quantile(bright, kDarkest);
    if (dark.size() >= kEnough && sim::quantile(dark, kDark) < darkest) {
      black = sim::quantile(dark, kDark);
    } else if (!photo.srgb) {
      black = darkest - kAbove * (white - darkest);
    }
    if (!(white > black)) white = black + 1e-6;
  }
  SkyMap logarithm(SkyMap map) const {
    constexpr double kLeast = 0.02;
    for (double& light : map.value) light = std::log10(std::max(kLeast, (light - black) / (white - black)));
    return map;
  }
};

/// Strength of bright lines, in the map's unit, and the direction across them (radians).
struct LineMap {
  SkyMap bright, across;
};

LineMap lines_in(const SkyMap& smooth, double sigma) {
  LineMap lines{smooth, smooth};
  // The sky's edge is a line of its own.
  constexpr double kOfSigma = 1.5, kCorner = 0.7, kLong = 2.0;
  const int margin = std::max(3, static_cast<int>(std::lround(kOfSigma * sigma))) + 1;
  const int corner = static_cast<int>(kCorner * margin);
  for (int y = 0; y < smooth.height; ++y)
    for (int x = 0; x < smooth.width; ++x) {
      const std::size_t i = smooth.index(x, y);
      lines.bright.value[i] = lines.across.value[i] = 0.0;
      bool is_whole = smooth.is_sky(x, y);
      for (const int s : {-1, 1})
        is_whole = is_whole && smooth.is_sky(x + s * margin, y) && smooth.is_sky(x, y + s * margin) &&
                   smooth.is_sky(x + s * corner, y + s * corner) &&
                   smooth.is_sky(x + s * corner, y - s * corner);
      lines.bright.sky[i] = is_whole ? 1 : 0;
      if (!is_whole) continue;
      const double here = smooth.at(x, y);
      const double xx = smooth.at(x + 1, y) + smooth.at(x - 1, y) - 2.0 * here,
                   yy = smooth.at(x, y + 1) + smooth.at(x, y - 1) - 2.0 * here,
                   xy = 0.25 * (smooth.at(x + 1, y + 1) + smooth.at(x - 1, y - 1) - smooth.at(x + 1, y - 1) -
                                smooth.at(x - 1, y + 1));
      const double mean = 0.5 * (xx + yy), off = std::hypot(0.5 * (xx - yy), xy);
      const double low = mean - off, high = mean + off;
      if (-low > kLong * std::abs(high)) {
        lines.bright.value[i] = -low * sigma * sigma;
        lines.across.value[i] = 0.5 * (std::atan2(2.0 * xy, xx - yy) + sim::kPi);
      }
    }
  return lines;
}

/// Lengths of all lines at least a third as strong as the strongest, over the picture's longer side.
double length_of(const LineMap& lines) {
  constexpr double kStrongest = 0.99, kOfStrongest = 0.35;
  constexpr std::size_t kLeastPixels = 6;
  constexpr int kGap = 2;
  const SkyMap& bright = lines.bright;
  std::vector<double> strengths = bright.of_sky();
  if (strengths.empty()) return 0.0;
  const double least = kOfStrongest * sim::quantile(strengths, kStrongest);
  constexpr double kRounding = 1e-9;  // of an even sky without noise
  if (!(least > kRounding)) return 0.0;
  const int w = bright.width, h = bright.height;
  std::vector<char> is_line(bright.value.size(), 0);
  for (int y = 1; y + 1 < h; ++y)
    for (int x = 1; x + 1 < w; ++x) {
      const double here = bright.at(x, y), turn = lines.across.at(x, y);
      const int dx = static_cast<int>(std::lround(std::cos(turn))),
                dy = static_cast<int>(std::lround(std::sin(turn)));
      if (here >= least && bright.at(x + dx, y + dy) <= here && bright.at(x - dx, y - dy) < here)
        is_line[bright.index(x, y)] = 1;
    }
  double length = 0.0;
  for (std::size_t begin = 0; begin < is_line.size(); ++begin) {
    if (is_line[begin] == 0) continue;
    std::vector<std::size_t> part = {begin};
    is_line[begin] = 0;
    int left = w, right = 0, top = h, bottom = 0;
    for (std::size_t n = 0; n < part.size(); ++n) {
      const int x = static_cast<int>(part[n] % w), y = static_cast<int>(part[n] / w);
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
      for (int v = std::max(0, y - kGap); v <= std::min(h - 1, y + kGap); ++v)
        for (int u = std::max(0, x - kGap); u <= std::min(w - 1, x + kGap); ++u) {
          const std::size_t other = bright.index(u, v);
          if (is_line[other] == 0) continue;
          is_line[other] = 0;
          part.push_back(other);
        }
    }
    if (part.size() >= kLeastPixels) length += std::hypot(right - left, bottom - top) / std::max(w, h);
  }
  return length;
}

/// The share of tiles, eight along the longer side, with more points brighter than all about them than darker
/// ones: noise, clouds and the file's compression make as many of both.
double starry_share(const Photo& photo, const PixelSet& left_out) {
  constexpr int kLongest = 800, kOff = 3, kTiles = 8, kAcross = 10;
  constexpr double kSigmas = 5.0, kOfMad = 1.4826, kRound = 0.6;
  SkyMap root = reduced(photo, left_out, kLongest, 0, 3);
  for (double& light : root.value) light = std::sqrt(std::max(0.0, light));
  const int w = root.width, h = root.height;
  const auto is_inside = [&](int x, int y) {
    return root.is_sky(x, y) && root.is_sky(x - kOff, y) && root.is_sky(x + kOff, y) &&
           root.is_sky(x, y - kOff) && root.is_sky(x, y + kOff);
  };
  const auto above = [&](int x, int y) {
    return root.at(x, y) -
           0.25 * (root.at(x - kOff, y) + root.at(x + kOff, y) + root.at(x, y - kOff) + root.at(x, y + kOff));
  };
  std::vector<double> heights;
  for (int y = kOff; y + kOff < h; ++y)
    for (int x = kOff + 7 * y % 5; x + kOff < w; x += 5)  // a fifth of the pixels is enough for the noise
      if (is_inside(x, y)) heights.push_back(std::abs(above(x, y)));
  if (heights.empty()) return 0.0;
  // An eighth of a step near white is what rounding leaves of noise.
  const double rounding = photo.floating ? 1e-12 : 0.5 * std::sqrt(std::max(file_step(photo), 1e-6)) / 16.0;
  const double least = kSigmas * std::max(kOfMad * sim::quantile(heights, 0.5), rounding);
  const int tile = std::max(1, std::max(w, h) / kTiles);
  std::array<int, kAcross * kAcross> more{}, pixels{};
  for (int y = kOff; y + kOff < h; ++y)
    for (int x = kOff; x + kOff < w; ++x) {
      if (!is_inside(x, y)) continue;
      const auto t = static_cast<std::size_t>(std::min(kAcross - 1, y / tile) * kAcross +
                                              std::min(kAcross - 1, x / tile));
      ++pixels[t];
      const double height = above(x, y);
      if (std::abs(height) < least) continue;
      const double sign = height > 0.0 ? 1.0 : -1.0, here = sign * root.at(x, y);
      bool is_point = true;
      for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u) {
          const double other = sign * root.at(x + u, y + v);
          const bool is_before = v < 0 || (v == 0 && u < 0);
          if ((u != 0 || v != 0) && (other > here || (is_before && other == here))) is_point = false;
        }
      // It is as high above each of its sides: no edge.
      for (const auto& [u, v] :
           {std::array{kOff, 0}, std::array{-kOff, 0}, std::array{0, kOff}, std::array{0, -kOff}})
        is_point = is_point && here - sign * root.at(x + u, y + v) >= kRound * sign * height;
      if (is_point) more[t] += height > 0.0 ? 1 : -1;
    }
  double whole = 0.0, starry = 0.0;
  for (std::size_t t = 0; t < pixels.size(); ++t) {
    if (2 * pixels[t] <= tile * tile) continue;
    whole += 1.0;
    starry += more[t] > 0 ? 1.0 : 0.0;
  }
  return whole > 0.0 ? starry / whole : 0.0;
}

/// The strength of fine lines that cross the direction of the light at large, where it is bright (`light`, a
/// smooth map of its logarithm).
double strength_of_rays(const Photo& photo, const PixelSet& left_out, const LightUnit& unit,
                        const SkyMap& light) {
  constexpr int kLongest = 256, kGreen = 1;
  constexpr double kFine = 1.2, kLine = 1.5, kLarge = 3.0, kAround = 12.0, kTop = 0.99, kOfRange = 0.25,
                   kNone = 1e-4;
  const SkyMap green = reduced(photo, left_out, kLongest, kGreen, kGreen + 1);
  const LineMap fine = lines_in(unit.logarithm(smoothed(green, kFine)), kLine);
  const SkyMap large = smoothed(unit.logarithm(smoothed(green, 1.0)), kLarge);
  SkyMap xx = large, xy = large, yy = large;
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x) {
      double gx = 0.0, gy = 0.0;
      if (large.is_sky(x - 1, y) && large.is_sky(x + 1, y) && large.is_sky(x, y - 1) &&
          large.is_sky(x, y + 1)) {
        gx = large.at(x + 1, y) - large.at(x - 1, y);
        gy = large.at(x, y + 1) - large.at(x, y - 1);
      }
      xx.at(x, y) = gx * gx;
      xy.at(x, y) = gx * gy;
      yy.at(x, y) = gy * gy;
    }
  xx = smoothed(xx, kAround);
  xy = smoothed(xy, kAround);
  yy = smoothed(yy, kAround);
  std::vector<double> values = light.of_sky();
  const double middle = sim::quantile(values, 0.5),
               least = middle + kOfRange * (sim::quantile(values, kTop) - middle);
  double squares = 0.0, pixels = 0.0;
  for (int y = 0; y < green.height; ++y)
    for (int x = 0; x < green.width; ++x) {
      if (!fine.bright.is_sky(x, y)) continue;
      const int u = std::min(light.width - 1, x * light.width / green.width),
                v = std::min(light.height - 1, y * light.height / green.height);
      if (!light.is_sky(u, v) || light.at(u, v) < least) continue;
      pixels += 1.0;
      const std::size_t i = green.index(x, y);
      const double turn = 0.5 * std::atan2(2.0 * xy.value[i], xx.value[i] - yy.value[i]);
      const double crossing = fine.bright.value[i] * std::sin(fine.across.value[i] - turn);
      squares += crossing * crossing;
    }
  return std::log10(kNone + std::sqrt(squares / std::max(1.0, pixels)));
}

}  // namespace
}  // namespace sky_lines

void add_lines(const Photo& photo, const PixelSet& left_out, SkyFeatures& features) {
  using namespace sky_lines;
  constexpr int kLongest = 128;
  constexpr double kThin = 2.0, kWide = 4.0, kTop = 0.98, kNone = 1e-4;
  const SkyMap grey = without_thin(reduced(photo, left_out, kLongest, 0, 3)), smooth = smoothed(grey, 1.0);
  feature(features, SkyFeature::star_tiles) = starry_share(photo, left_out);
  feature(features, SkyFeature::thin_lines) = feature(features, SkyFeature::wide_lines) = 0.0;
  feature(features, SkyFeature::ridge_top) = feature(features, SkyFeature::ray_strength) = std::log10(kNone);
  if (smooth.of_sky().empty()) return;
  const LightUnit unit(photo, grey, smooth);
  const SkyMap light = unit.logarithm(smooth);
  const LineMap thin = lines_in(smoothed(light, kThin), kThin),
                wide = lines_in(smoothed(light, kWide), kWide);
  if (std::vector<double> strengths = thin.bright.of_sky(); !strengths.empty())
    feature(features, SkyFeature::ridge_top) = std::log10(kNone + sim::quantile(strengths, kTop));
  feature(features, SkyFeature::thin_lines) = length_of(thin);
  feature(features, SkyFeature::wide_lines) = length_of(wide);
  constexpr double kOfRays = 1.5;
  feature(features, SkyFeature::ray_strength) =
      strength_of_rays(photo, left_out, unit, smoothed(light, kOfRays));
}

}  // namespace vegard::fit
