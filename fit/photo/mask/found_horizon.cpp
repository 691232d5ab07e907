#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "fit/photo/mask/circle.h"
#include "fit/photo/mask/horizon.h"
#include "fit/photo/mask/plane.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr int kColumns = 1000;
constexpr int kRows = 4;         ///< above and below that are compared
constexpr float kBlack = 0.02f;  ///< added to both: black beside black is no contrast
constexpr float kEnough = 0.5f, kSkylineEdge = 0.2f, kSeen = 0.1f;
constexpr double kSeenIn = 0.5, kBrightSeenIn = 0.8;
constexpr int kMaxJumps = 2;
constexpr float kEdgesAbove = 0.5f;    ///< what an edge in the sky costs
constexpr float kBrightGround = 0.5f;  ///< what an edge to a brighter ground is worth
constexpr float kRow = 0.02f, kJump = 0.6f;

/// Returns the contrast at the boundary above each row y: the fall of the brightness there, less the falls at
/// the same distance above and below (a soft slope has no contrast), over the sum of both sides; 0 near the
/// picture's edges.
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

/// Returns the cost of a boundary by the contrasts at and above it in its column. `bright_ground`: the weight
/// of an edge to a ground brighter than the sky, relative to one to a darker ground.
Plane cost_of(const Plane& contrast, float bright_ground) {
  Plane cost(contrast.width, contrast.height);
  for (int x = 0; x < contrast.width; ++x) {
    float above = 0.0f;
    for (int y = 0; y < contrast.height; ++y) {
      // The slope of an edge is as wide as the rows compared: it does not count against itself.
      if (y >= kRows)
        above += kEdgesAbove / kRows * std::max(0.0f, std::abs(contrast.at(x, y - kRows)) - kSkylineEdge);
      const float fall = contrast.at(x, y);
      cost.at(x, y) =
          above - (fall >= 0.0f ? std::min(kEnough, fall) : bright_ground * std::min(kEnough, -fall));
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

/// Between columns that are farther apart than it pays to climb, where no upright edge is seen between them:
/// walls and trunks have one, a path that finds no ground leaps without.
int jumps_of(const Plane& shown, const std::vector<int>& path) {
  int jumps = 0;
  for (int x = 1; x < shown.width; ++x) {
    const int top = std::min(path[x - 1], path[x]), foot = std::max(path[x - 1], path[x]);
    if (kRow * static_cast<float>(foot - top) <= kJump) continue;
    int upright = 0, rows = 0;
    for (int y = top; y < std::min(foot, shown.height); ++y, ++rows) {
      // Two columns beside each other on either side: the edge itself is some columns wide.
      const float left = shown.at(std::max(x - 2, 0), y),
                  right = shown.at(std::min(x + 1, shown.width - 1), y);
      upright += std::abs(left - right) >= kSeen * (left + right + 2.0f * kBlack);
    }
    jumps += 2 * upright < rows;
  }
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
    const float above = sim::quantile(sky, kDarkerPart), under = sim::median(ground);
    if (above - under < kSkylineEdge * (above + under)) continue;
    const int highest = std::max(0, line[x] - kSkylineHighest);
    for (int y = line[x] - 1; y >= highest && path[x] - y <= kGap; --y)
      if (shown.at(x, y) < 0.5f * (above + under)) path[x] = y;
  }
}

/// The row within `reach` of y under which the picture falls most (`sign` 1) or rises most (-1), of means of
/// `reach` rows.
double sharpest(const Plane& shown, int x, int y, int reach, float sign) {
  double most = -1.0;
  int best = std::clamp(y, 0, shown.height);
  for (int row = std::max(reach, y - reach); row <= std::min(shown.height - reach, y + reach); ++row) {
    double fall = 0.0;
    for (int i = 0; i < reach; ++i) fall += sign * (shown.at(x, row - 1 - i) - shown.at(x, row + i));
    if (fall > most) most = fall, best = row;
  }
  return best;
}

/// True if the picture is a fisheye's circle, whose rim is no skyline. A skyline may be an arc of some
/// circle, but of a fisheye's rim most is visible, and at least three of its four sides are in the picture.
bool is_fisheye(const Photo& photo) {
  constexpr double kMaxOfARim = 0.6;
  const std::optional<CircleFound> found = find_circle(photo);
  if (!found || found->agreeing < kMaxOfARim) return false;
  const Circle& c = found->circle;
  return (c.x_px - c.radius_px >= 0.0) + (c.x_px + c.radius_px <= photo.linear.width) +
             (c.y_px - c.radius_px >= 0.0) + (c.y_px + c.radius_px <= photo.linear.height) >=
         3;
}

struct Skyline {
  std::vector<int> row;       ///< per column
  std::vector<float> across;  ///< the contrast at it
  double seen = 0.0;
};

/// The cheapest path, if it is that of a ground: seen in so many columns, and without leaps.
std::optional<Skyline> skyline_of(const Plane& starless, const Plane& contrast, float bright_ground,
                                  double seen_in) {
  Skyline line;
  line.row = cheapest_path(cost_of(contrast, bright_ground));
  int seen = 0;
  for (int x = 0; x < starless.width; ++x) {
    line.across.push_back(contrast.at(x, line.row[x]));
    seen += std::abs(line.across.back()) >= kSeen;
  }
  line.seen = static_cast<double>(seen) / starless.width;
  if (line.seen < seen_in || jumps_of(starless, line.row) > kMaxJumps) return std::nullopt;
  return line;
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
  // A dark ground first: where there is one, a foreground of snow has an edge as well, below it.
  std::optional<Skyline> line = skyline_of(starless, contrast, 0.0f, kSeenIn);
  if (!line) line = skyline_of(starless, contrast, kBrightGround, kBrightSeenIn);
  if (!line || is_fisheye(photo)) return std::nullopt;

  HorizonFound found;
  std::vector<float> contrasts;
  for (const float across : line->across) contrasts.push_back(std::abs(across));
  found.seen = line->seen;
  found.contrast = sim::median(contrasts);
  climb(small, line->row);
  const Plane full = shown_brightness(light);
  for (int x = 0; x < full.width; ++x) {
    const int row = line->row[x / factor] * factor;
    const float sign = line->across[x / factor] < 0.0f ? -1.0f : 1.0f;
    found.horizon.y_px.push_back(factor > 1 ? sharpest(full, x, row, factor, sign) : row);
  }
  return found;
}

}  // namespace vegard::fit
