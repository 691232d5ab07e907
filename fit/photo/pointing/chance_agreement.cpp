#include "fit/photo/pointing/chance_agreement.h"

#include <algorithm>
#include <string>

#include "sim/base/file/number_text.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::fit {
namespace {

constexpr double kNoChance_log10 = -8.0;
constexpr double kSeenShare = 0.25;
constexpr int kFewBright = 20;          // stars to magnitude 4.6 in view
constexpr double kBrightHidden = 1e-3;  // probability below which missing bright stars are no accident

/// The probability that of n stars, each seen with probability p, at most k are.
double at_most_of(int k, int n, double p) {
  if (p >= 1.0) return k >= n ? 1.0 : 0.0;
  double term = std::pow(1.0 - p, n), sum = term;
  for (int i = 1; i <= k; ++i) {
    term *= (n - i + 1.0) / i * p / (1.0 - p);
    sum += term;
  }
  return std::min(1.0, sum);
}

/// True if the bright half of the stars is seen less than half as often as the faint half, and not by
/// accident.
bool misses_the_bright(const std::vector<char>& seen) {
  const int half = static_cast<int>(seen.size()) / 2, rest = static_cast<int>(seen.size()) - half;
  if (half == 0) return false;
  const auto bright = static_cast<int>(std::count(seen.begin(), seen.begin() + half, 1));
  const auto faint = static_cast<int>(std::count(seen.begin() + half, seen.end(), 1));
  const double share = static_cast<double>(faint) / rest;
  return bright < 0.5 * share * half && at_most_of(bright, half, share) < kBrightHidden;
}

}  // namespace

double log10_poisson_tail(double n, double mean) {
  if (!(n > mean) || !(mean > 0.0)) return n > mean ? -300.0 : 0.0;
  // The first term, and the geometric series that bounds the rest.
  const double first = n * std::log(mean) - mean - std::lgamma(n + 1.0);
  return std::min(0.0, (first - std::log(1.0 - mean / (n + 1.0))) / std::log(10.0));
}

SkyPixels::SkyPixels(std::vector<char> usable_pixels) : usable(std::move(usable_pixels)) {
  if (!usable.empty())
    share = 1.0 - static_cast<double>(std::count(usable.begin(), usable.end(), 0)) /
                      static_cast<double>(usable.size());
}

PointCells::PointCells(const std::vector<FoundStar>& points, const Frame& frame, std::size_t first)
    : points_(points),
      cell_px_(std::max(8.0, std::max(frame.width_px, frame.height_px) / 64.0)),
      columns_(static_cast<int>(frame.width_px / cell_px_) + 1),
      rows_(static_cast<int>(frame.height_px / cell_px_) + 1),
      cells_(static_cast<std::size_t>(columns_) * rows_) {
  for (std::size_t i = 0; i < std::min(first, points.size()); ++i)
    cells_[static_cast<std::size_t>(row(points[i].y_px)) * columns_ + column(points[i].x_px)].push_back(
        static_cast<int>(i));
}

int PointCells::column(double x) const {
  return static_cast<int>(std::clamp(x / cell_px_, 0.0, columns_ - 1.0));
}
int PointCells::row(double y) const { return static_cast<int>(std::clamp(y / cell_px_, 0.0, rows_ - 1.0)); }

int PointCells::nearest(double x, double y, double radius, double& distance) const {
  int best = -1;
  double least = radius * radius;
  for (int j = row(y - radius); j <= row(y + radius); ++j)
    for (int i = column(x - radius); i <= column(x + radius); ++i)
      for (const int p : cells_[static_cast<std::size_t>(j) * columns_ + i]) {
        const double dx = points_[p].x_px - x, dy = points_[p].y_px - y;
        if (dx * dx + dy * dy < least) {
          least = dx * dx + dy * dy;
          best = p;
        }
      }
  distance = std::sqrt(least);
  return best;
}

int PointCells::within(double x, double y, double radius) const {
  int n = 0;
  for (int j = row(y - radius); j <= row(y + radius); ++j)
    for (int i = column(x - radius); i <= column(x + radius); ++i)
      for (const int p : cells_[static_cast<std::size_t>(j) * columns_ + i])
        n += std::hypot(points_[p].x_px - x, points_[p].y_px - y) < radius;
  return n;
}

std::vector<ExpectedStar> expected_stars(const SkyCamera& camera, const Frame& frame,
                                         const std::vector<StarSighting>& stars, const SkyPixels& pixels) {
  const std::vector<char>& usable = pixels.usable;
  const sim::Lens<double> lens = true_lens(camera);
  std::vector<ExpectedStar> expected;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const auto& enu = stars[i].enu;
    const Eigen::Vector3d v = camera.camera_from_enu * Eigen::Vector3d(enu[0], enu[1], enu[2]);
    const double in_camera[3] = {v[0], v[1], v[2]};
    double x = 0.0, y = 0.0;
    if (!sim::project(lens, in_camera, x, y) || !(x > 0.0 && y > 0.0 && x < frame.width_px) ||
        !(y < frame.height_px))
      continue;
    if (!usable.empty() && usable[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width_px) +
                                  static_cast<std::size_t>(x)] == 0)
      continue;
    expected.push_back({static_cast<int>(i), x, y});
  }
  return expected;
}

ChanceAgreement agreement_against_chance(const SkyCamera& camera, const Frame& frame,
                                         const std::vector<StarSighting>& stars,
                                         const std::vector<FoundStar>& points, const PointCells& cells,
                                         double numbers, double trials, const SkyPixels& pixels) {
  const std::vector<ExpectedStar> expected = expected_stars(camera, frame, stars, pixels);
  const double size = std::max(frame.width_px, frame.height_px);
  const double around = std::max(25.0, 0.06 * size);
  const double area = pixels.share * frame.width_px * frame.height_px;
  const double overall = static_cast<double>(points.size()) / std::max(area, 1.0);
  std::vector<double> density;
  for (const ExpectedStar& one : expected)
    density.push_back(std::max(overall, cells.within(one.x, one.y, around) / (M_PI * around * around)));
  const double unit = std::max(1.0, size / 1500.0);
  const std::vector<double> radii = {unit, 1.5 * unit, 2.2 * unit, 3.3 * unit};
  std::vector<double> faintest = {1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.6};
  // A narrow field has few stars so bright.
  const auto bright = std::count_if(expected.begin(), expected.end(), [&](const ExpectedStar& one) {
    return stars[static_cast<std::size_t>(one.star)].magnitude <= faintest.back();
  });
  const bool is_deep = !stars.empty() && stars.back().magnitude > sim::kFaintestCatalogued;
  if (bright < kFewBright) faintest.insert(faintest.end(), {5.2, 6.0});
  if (is_deep) faintest.insert(faintest.end(), {6.5, 7.0, 7.5, 8.0});
  const double ways = static_cast<double>(radii.size() * faintest.size());
  ChanceAgreement best;
  best.log10_false = std::log10(trials * ways);
  bool first = true;
  for (const double radius : radii) {
    const std::vector<StarMatch> matches =
        each_others_nearest(expected, points, cells, [&](const ExpectedStar&) { return radius; });
    std::vector<char> has_point(stars.size(), 0);
    for (const StarMatch& one : matches) has_point[static_cast<std::size_t>(one.star)] = 1;
    for (const double limit : faintest) {
      double mean = 0.0;
      std::vector<char> seen;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto star = static_cast<std::size_t>(expected[i].star);
        if (stars[star].magnitude > limit) break;
        seen.push_back(has_point[star]);
        mean += 1.0 - std::exp(-density[i] * M_PI * radius * radius);
      }
      const auto n = static_cast<double>(std::count(seen.begin(), seen.end(), 1));
      if (n < kSeenShare * static_cast<double>(seen.size()) || misses_the_bright(seen)) continue;
      const double log10_false =
          std::min(0.0, log10_poisson_tail(n - 0.5 * numbers, mean)) + std::log10(trials * ways);
      if (!first && log10_false >= best.log10_false) continue;
      first = false;
      best.matches.clear();
      for (const StarMatch& one : matches)
        if (stars[static_cast<std::size_t>(one.star)].magnitude <= limit) best.matches.push_back(one);
      best.log10_false = log10_false;
      best.by_chance = mean;
      best.radius_px = radius;
      best.faintest = limit;
      best.in_frame = static_cast<int>(seen.size());
    }
  }
  return best;
}

bool is_no_chance(const ChanceAgreement& agreement) { return agreement.log10_false < kNoChance_log10; }

std::string words_of(const ChanceAgreement& agreement) {
  return std::to_string(agreement.matches.size()) + " of the " + std::to_string(agreement.in_frame) +
         " stars to magnitude " + sim::short_number(agreement.faintest, 2) +
         " that it should show have a point within " + sim::short_number(agreement.radius_px, 2) +
         " px, where chance gives " + sim::short_number(agreement.by_chance, 2);
}

}  // namespace vegard::fit
