#include "sim/view/film/depth_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::sim {

double DepthImage::end_km(double x_px, double y_px, double cosine) const {
  if (km.empty()) return std::numeric_limits<double>::infinity();
  // Limited before it becomes an integer: a film may reach far past the picture.
  const auto nearest = [](double at, int count) {
    return static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(count - 1)));
  };
  const double depth = km[nearest(y_px, height) * width + nearest(x_px, width)];
  if (!along_axis) return depth;
  return cosine > 0.0 ? depth / cosine : std::numeric_limits<double>::infinity();
}

DepthImage depth_image(const March& march, const Image& values) {
  const bool is_log = march.depth_is == DepthMeaning::log;
  DepthImage depth;
  depth.width = values.width;
  depth.height = values.height;
  depth.along_axis = is_log || march.depth_is == DepthMeaning::forward;
  const double log_far = std::log1p(march.depth_far_km / march.depth_gain);
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      const double value = values.at(x, y, 0);
      double km = value * march.depth_gain;
      if (is_log)
        km = value < 1.0 ? march.depth_gain * std::expm1(value * log_far)
                         : std::numeric_limits<double>::infinity();
      depth.km.push_back(static_cast<float>(km));
    }
  }
  return depth;
}

namespace {

constexpr double kTolerance = 0.1;   // of the relative difference of distances
constexpr double kMinWeight = 0.05;  // of a full one, below which neighbours say too little

/// Returns how alike two ends are, 0 to 1; 0 if one is no ray.
double likeness(float a, float b) {
  if (a == b) return 1.0;  // both infinite, or both at the observer's feet
  if (std::isnan(a) || std::isnan(b) || std::isinf(a) || std::isinf(b)) return 0.0;
  const double differ =
      (1.0 - static_cast<double>(std::min(a, b)) / static_cast<double>(std::max(a, b))) / kTolerance;
  return std::exp(-0.5 * differ * differ);
}

/// The two coarse cells around a fine one, and the share of the second.
struct Between {
  int low, high;
  double share;

  Between(int at, int shrink, int count) {
    const double place = (at + 0.5) / shrink - 0.5;
    const double below = std::floor(place);
    share = place - below;
    low = std::clamp(static_cast<int>(below), 0, count - 1);
    high = std::clamp(static_cast<int>(below) + 1, 0, count - 1);
  }
};

}  // namespace

FilmGeometry coarse_film(const FilmGeometry& film, int shrink) {
  FilmGeometry coarse = film;
  coarse.cell_width_px *= shrink;
  coarse.cell_height_px *= shrink;
  coarse.columns = (film.columns + shrink - 1) / shrink;
  coarse.rows = (film.rows + shrink - 1) / shrink;
  return coarse;
}

float DepthTaps::mean(const float* coarse) const {
  // Differences from one of them, so that equal values stay what they are.
  const double first = coarse[cell[0]];
  double sum = first;
  for (int i = 1; i < 4; ++i) sum += weight[i] * (coarse[cell[i]] - first);
  return static_cast<float>(sum);
}

std::size_t DepthTaps::nearest() const { return cell[std::max_element(weight, weight + 4) - weight]; }

DepthTaps depth_taps(const FilmGeometry& coarse, int shrink, const float* coarse_end_km, int row, int column,
                     float end_km) {
  const Between down(row, shrink, coarse.rows), across(column, shrink, coarse.columns);
  DepthTaps taps;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const bool lower = i >= 2, right = i % 2 == 1;
    taps.cell[i] = static_cast<std::size_t>(lower ? down.high : down.low) * coarse.columns +
                   (right ? across.high : across.low);
    taps.weight[i] = (lower ? down.share : 1.0 - down.share) * (right ? across.share : 1.0 - across.share) *
                     likeness(coarse_end_km[taps.cell[i]], end_km);
    sum += taps.weight[i];
  }
  taps.matched = sum >= kMinWeight;
  for (double& weight : taps.weight) weight = taps.matched ? weight / sum : 0.0;
  return taps;
}

}  // namespace vegard::sim
