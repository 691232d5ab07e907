#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "fit/photo/mask/horizon.h"
#include "fit/photo/mask/plane.h"

namespace vegard::fit {
namespace {

constexpr int kColumns = 1000;
constexpr int kRows = 4;         ///< above and below that are compared
constexpr float kBlack = 0.02f;  ///< added to both: black beside black is no contrast
constexpr float kEnough = 0.5f, kSkylineEdge = 0.2f, kSeen = 0.1f;
constexpr double kSeenIn = 0.5;
constexpr int kMostJumps = 2;
constexpr float kEdgesAbove = 0.5f;  ///< what an edge in the sky costs
constexpr float kRow = 0.02f, kJump = 0.6f;

/// How much the picture falls by at the boundary above row y, beyond what it falls by as much above and as
/// much below it (a soft slope has none), over the sum of both sides. 0 near the picture's edges.
Plane contrast_of(const Plane& shown) {
  Plane result(shown.width, shown.height + 1), mean(shown.width, shown.height + 1);
  for (int x = 0; x < shown.width; ++x) {
    for (int y = 0; y + kRows <= shown.height; ++y)
      for (int i = 0; i < kRows; ++i) mean.at(x, y) += shown.at(x, y + i) / kRows;
    for (int y = kRows; y + kRows <= shown.height; ++y) {
      const float above = mean.at(x, y - kRows), under = mean.at(x, y);
      const float far_above = y >= 2 * kRows ? mean.at(x, y - 2 * kRows) : above;
      const float far_under = y + 2 * kRows <= shown.height ? mean.at(x, y + kRows) : under;
      const float fall = above - under, sign = fall < 0.0f ? -1.0f : 1.0f;
      const float slope =
          0.5f * (std::max(0.0f, sign * (far_above - above)) + std::max(0.0f, sign * (under - far_under)));
      result.at(x, y) = sign * std::max(0.0f, std::abs(fall) - slope) / (above + under + 2.0f * kBlack);
    }
  }
  return result;
}

/// What a boundary costs by what is at and above it in its own column.
Plane cost_of(const Plane& contrast) {
  Plane cost(contrast.width, contrast.height);
  for (int x = 0; x < contrast.width; ++x) {
    float above = 0.0f;
    for (int y = 0; y < contrast.height; ++y) {
      // The slope of an edge is as wide as the rows compared: it does not count against itself.
      if (y >= kRows)
        above += kEdgesAbove / kRows * std::max(0.0f, std::abs(contrast.at(x, y - kRows)) - kSkylineEdge);
      cost.at(x, y) = above - std::min(kEnough, contrast.at(x, y));
    }
  }
  return cost;
}

/// For every row the least of before[from] + min(kRow · |row − from|, kJump), and where from; the upper of
/// two that are equal. Two sweeps do what a search of all pairs would.
void step(const std::vector<float>& before, std::vector<float>& least, std::vector<int>& from) {
  const int rows = static_cast<int>(before.size());
  least = before;
  for (int y = 0; y < rows; ++y) from[y] = y;
  for (int y = 1; y < rows; ++y)
    if (least[y - 1] + kRow < least[y]) least[y] = least[y - 1] + kRow, from[y] = from[y - 1];
  for (int y = rows - 2; y >= 0; --y)
    if (least[y + 1] + kRow < least[y]) least[y] = least[y + 1] + kRow, from[y] = from[y + 1];
  const auto best = std::min_element(before.begin(), before.end());
  for (int y = 0; y < rows; ++y)
    if (*best + kJump < least[y]) least[y] = *best + kJump, from[y] = static_cast<int>(best - before.begin());
}

std::vector<int> cheapest_path(const Plane& cost) {
  const int rows = cost.height;
  std::vector<std::vector<int>> from(cost.width, std::vector<int>(rows));
  std::vector<float> sum(rows), least(rows);
  for (int y = 0; y < rows; ++y) sum[y] = cost.at(0, y);
  for (int x = 1; x < cost.width; ++x) {
    step(sum, least, from[x]);
    for (int y = 0; y < rows; ++y) sum[y] = least[y] + cost.at(x, y);
  }
  std::vector<int> path(cost.width);
  path.back() = static_cast<int>(std::min_element(sum.begin(), sum.end()) - sum.begin());
  for (int x = cost.width - 1; x > 0; --x) path[x - 1] = from[x][path[x]];
  return path;
}

/// Between columns that are farther apart than it pays to climb.
int jumps_of(const std::vector<int>& path) {
  int jumps = 0;
  for (std::size_t x = 1; x < path.size(); ++x) jumps += kRow * std::abs(path[x] - path[x - 1]) > kJump;
  return jumps;
}

/// Moves the path up to the tips of trees, which the median and the means have cut off: a column climbs as
/// long as it is dark, seen against the darker part of the sky about it, over gaps between branches.
void climb(const Plane& shown, std::vector<int>& path) {
  constexpr int kSkylineHighest = 60, kBeside = 10, kDeep = 8, kGap = 6;
  constexpr double kDarkerPart = 0.3;
  const std::vector<int> line = path;
  std::vector<float> sky, ground;
  for (int x = 0; x < shown.width; ++x) {
    sky.clear();
    ground.clear();
    for (int u = std::max(0, x - kBeside); u <= std::min(shown.width - 1, x + kBeside); ++u) {
      for (int y = std::max(0, line[u] - kSkylineHighest / 2); y < line[u] - 2; ++y)
        sky.push_back(shown.at(u, y));
      for (int y = line[u]; y < std::min(shown.height, line[u] + kDeep); ++y)
        ground.push_back(shown.at(u, y));
    }
    if (sky.empty() || ground.empty()) continue;
    const auto darker =
        sky.begin() + static_cast<std::ptrdiff_t>(kDarkerPart * static_cast<double>(sky.size() - 1));
    std::nth_element(sky.begin(), darker, sky.end());
    const float above = *darker, under = median(ground);
    if (above - under < kSkylineEdge * (above + under)) continue;
    const int highest = std::max(0, line[x] - kSkylineHighest);
    for (int y = line[x] - 1; y >= highest && path[x] - y <= kGap; --y)
      if (shown.at(x, y) < 0.5f * (above + under)) path[x] = y;
  }
}

/// The row within `reach` of y under which the picture falls most, of means of `reach` rows.
double sharpest(const Plane& shown, int x, int y, int reach) {
  double most = -1.0;
  int best = std::clamp(y, 0, shown.height);
  for (int row = std::max(reach, y - reach); row <= std::min(shown.height - reach, y + reach); ++row) {
    double fall = 0.0;
    for (int i = 0; i < reach; ++i) fall += shown.at(x, row - 1 - i) - shown.at(x, row + i);
    if (fall > most) most = fall, best = row;
  }
  return best;
}

}  // namespace

std::optional<HorizonFound> find_horizon(const Photo& photo) {
  const int factor = (photo.linear.width + kColumns - 1) / kColumns;
  const Plane light = mean_light(photo);
  const Plane small = shown_brightness(binned(light, factor));
  if (small.height < 4 * kRows) return std::nullopt;
  Plane starless(small.width, small.height);
  const cv::Mat from(small.height, small.width, CV_32F, const_cast<float*>(small.value.data()));
  cv::Mat to(small.height, small.width, CV_32F, starless.value.data());
  cv::medianBlur(from, to, 5);
  const Plane contrast = contrast_of(starless);
  std::vector<int> path = cheapest_path(cost_of(contrast));

  HorizonFound found;
  std::vector<float> contrasts;
  int seen = 0;
  for (int x = 0; x < small.width; ++x) {
    contrasts.push_back(contrast.at(x, path[x]));
    seen += contrasts.back() >= kSeen;
  }
  found.seen = static_cast<double>(seen) / small.width;
  found.contrast = median(contrasts);
  if (found.seen < kSeenIn || jumps_of(path) > kMostJumps) return std::nullopt;
  climb(small, path);
  const Plane full = shown_brightness(light);
  for (int x = 0; x < full.width; ++x) {
    const int row = path[x / factor] * factor;
    found.horizon.y_px.push_back(factor > 1 ? sharpest(full, x, row, factor) : row);
  }
  return found;
}

}  // namespace vegard::fit
