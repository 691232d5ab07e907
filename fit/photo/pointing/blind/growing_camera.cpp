#include "fit/photo/pointing/blind/growing_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::fit {
namespace {

constexpr double kCertain_log10 = -8.0;
constexpr double kSeenShare = 0.25;
constexpr double kReachGrowth = 1.5;
constexpr double kGrowthScatter_px = 2.5;
constexpr int kMaxRounds = 14;

bool inside(const Frame& frame, double x, double y) {
  return x > 0.0 && y > 0.0 && x < frame.width_px && y < frame.height_px;
}

struct Seen {
  int star;
  double x, y;
};

/// The stars that should be seen, the brightest first.
std::vector<Seen> predicted(const SkyCamera& camera, const Frame& frame,
                            const std::vector<StarSighting>& stars) {
  const sim::Lens<double> lens = true_lens(camera);
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    const auto& enu = stars[i].enu;
    const Eigen::Vector3d v = camera.camera_from_enu * Eigen::Vector3d(enu[0], enu[1], enu[2]);
    const double in_camera[3] = {v[0], v[1], v[2]};
    double x = 0.0, y = 0.0;
    if (sim::project(lens, in_camera, x, y) && inside(frame, x, y))
      seen.push_back({static_cast<int>(i), x, y});
  }
  return seen;
}

/// Each other's nearest.
template <class Tolerance>
std::vector<StarMatch> match(const std::vector<Seen>& seen, const std::vector<FoundStar>& points,
                             const PointCells& cells, const Tolerance& tolerance) {
  std::vector<int> of_point(points.size(), -1);
  std::vector<double> distance_of(points.size(), 0.0);
  for (const Seen& one : seen) {
    const double radius = tolerance(one);
    if (!(radius > 0.0)) continue;
    double distance = 0.0;
    const int p = cells.nearest(one.x, one.y, radius, distance);
    if (p < 0 || (of_point[p] >= 0 && distance_of[p] <= distance)) continue;
    of_point[p] = one.star;
    distance_of[p] = distance;
  }
  std::vector<StarMatch> matches;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (of_point[p] >= 0) matches.push_back({of_point[p], static_cast<int>(p)});
  return matches;
}

/// Returns the expected number of stars with a point among random points of this density.
template <class Tolerance>
double strewn_matches(const std::vector<Seen>& seen, const Tolerance& tolerance, double density) {
  double sum = 0.0;
  for (const Seen& one : seen) {
    const double radius = tolerance(one);
    sum += 1.0 - std::exp(-density * M_PI * radius * radius);
  }
  return sum;
}

std::vector<StarSighting> sightings(const std::vector<StarSighting>& stars,
                                    const std::vector<FoundStar>& points,
                                    const std::vector<StarMatch>& matches) {
  std::vector<StarSighting> all;
  for (const StarMatch& one : matches) {
    all.push_back(stars[one.star]);
    all.back().x_px = points[one.point].x_px;
    all.back().y_px = points[one.point].y_px;
  }
  return all;
}

/// Cauchy's loss over the stars, in px^2.
double loss_of(const SkyCamera& camera, const std::vector<StarSighting>& stars, double scale_px) {
  double sum = 0.0;
  for (const Eigen::Vector2d& left : residuals(camera, stars)) {
    const double square = left.squaredNorm() / (scale_px * scale_px);
    sum += std::isfinite(square) ? std::log1p(square) : 20.0;
  }
  return sum * scale_px * scale_px;
}

/// A start of another model: the same scale about the middle of its reach.
SkyCamera as_model(const SkyCamera& camera, const LensForm& form) {
  SkyCamera other = camera;
  other.model = form.model;
  for (int i = radial_1_number; i < lens_numbers; ++i) other.numbers[i] = 0.0;
  if (form.model == camera.model)
    for (int i = 0; i < form.radial; ++i)
      other.numbers[radial_1_number + i] = camera.numbers[radial_1_number + i];
  return other;
}

std::vector<LensForm> forms_for(std::size_t matches) {
  using sim::LensModel;
  std::vector<LensForm> forms = {{LensModel::pinhole, 0, false, false},
                                 {LensModel::stereographic, 0, false, false},
                                 {LensModel::equidistant, 0, false, false},
                                 {LensModel::equisolid, 0, false, false}};
  if (matches >= 12) {
    forms.push_back({LensModel::polynomial, 1, false, false});
    forms.push_back({LensModel::pinhole, 1, false, false});
  }
  if (matches >= 18) forms.push_back({LensModel::polynomial, 2, false, false});
  return forms;
}

/// The lens with the least loss, each number that it has more paid by two residuals of the scale.
void fit_best_form(GrownCamera& grown, const std::vector<StarSighting>& seen, double scale_px) {
  const bool centre_free = seen.size() >= 8;
  if (seen.size() < 7) {
    const CameraFit fit = fit_camera(grown.camera, free_numbers(grown.form, false), seen, {}, scale_px);
    if (fit.good) grown.camera = fit.camera;
    return;
  }
  double least = std::numeric_limits<double>::infinity();
  const SkyCamera before = grown.camera;
  for (const LensForm& form : forms_for(seen.size())) {
    CameraFit fit = fit_camera(as_model(before, form), free_numbers(form, centre_free), seen, {}, scale_px);
    if (!fit.good || !(fit.camera.numbers[focal_px_number] > 0.0)) continue;
    const double loss = loss_of(fit.camera, seen, scale_px) + 2.0 * form.radial * scale_px * scale_px;
    if (loss < least) {
      least = loss;
      grown.camera = fit.camera;
      grown.form = form;
    }
  }
}

/// log10 of the probability that a Poisson variable is at least n (which need not be whole).
double log10_tail(double n, double mean) {
  if (!(n > mean) || !(mean > 0.0)) return n > mean ? -300.0 : 0.0;
  // The first term, and the geometric series that bounds the rest.
  const double first = n * std::log(mean) - mean - std::lgamma(n + 1.0);
  return std::min(0.0, (first - std::log(1.0 - mean / (n + 1.0))) / std::log(10.0));
}

void tell_chance(GrownCamera& grown, const Frame& frame, const std::vector<StarSighting>& stars,
                 const std::vector<FoundStar>& points, const PointCells& cells, double trials) {
  const std::vector<Seen> seen = predicted(grown.camera, frame, stars);
  const double size = std::max(frame.width_px, frame.height_px);
  const double around = std::max(25.0, 0.06 * size);
  const double overall = points.size() / (static_cast<double>(frame.width_px) * frame.height_px);
  std::vector<double> density;
  for (const Seen& one : seen)
    density.push_back(std::max(overall, cells.within(one.x, one.y, around) / (M_PI * around * around)));
  const double numbers = 4.0 + (grown.matches.size() >= 8 ? 2.0 : 0.0) + grown.form.radial;
  grown.log10_false = 0.0;
  const double unit = std::max(1.0, size / 1500.0);
  const std::vector<double> radii = {unit, 1.5 * unit, 2.2 * unit, 3.3 * unit};
  const std::vector<double> faintest = {1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.6};
  const double ways = static_cast<double>(radii.size() * faintest.size());
  bool first = true;
  for (const double radius : radii) {
    const std::vector<StarMatch> matches = match(seen, points, cells, [&](const Seen&) { return radius; });
    for (const double limit : faintest) {
      double mean = 0.0;
      int in_frame = 0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        if (stars[seen[i].star].magnitude > limit) break;
        ++in_frame;
        mean += 1.0 - std::exp(-density[i] * M_PI * radius * radius);
      }
      std::vector<StarMatch> bright;
      for (const StarMatch& one : matches)
        if (stars[one.star].magnitude <= limit) bright.push_back(one);
      const double n = static_cast<double>(bright.size());
      if (n < kSeenShare * in_frame) continue;
      const double log10_false =
          std::min(0.0, log10_tail(n - 0.5 * numbers, mean)) + std::log10(trials * ways);
      if (!first && log10_false >= grown.log10_false) continue;
      first = false;
      grown.log10_false = log10_false;
      grown.by_chance = mean;
      grown.radius_px = radius;
      grown.faintest = limit;
      grown.in_frame = in_frame;
      grown.matches = bright;
    }
  }
  if (first) {
    grown.matches.clear();
    grown.log10_false = std::log10(trials * ways);
  }
  double sum = 0.0;
  const std::vector<StarSighting> matched = sightings(stars, points, grown.matches);
  for (const Eigen::Vector2d& left : residuals(grown.camera, matched)) sum += left.squaredNorm();
  grown.rms_px = matched.empty() ? 0.0 : std::sqrt(sum / matched.size());
}

}  // namespace

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

GrownCamera grow_camera(const SkyCamera& start, const Frame& frame, const std::vector<StarSighting>& stars,
                        const std::vector<FoundStar>& points, const PointCells& cells,
                        const std::vector<StarMatch>& seed, double reach_px, double trials) {
  GrownCamera grown;
  grown.camera = start;
  grown.form = {start.model, 0, false, false};
  grown.matches = seed;
  double middle_x = 0.0, middle_y = 0.0;
  for (const StarMatch& one : seed) {
    middle_x += points[one.point].x_px / seed.size();
    middle_y += points[one.point].y_px / seed.size();
  }
  const double whole = std::hypot(frame.width_px, frame.height_px);
  const double unit = std::max(1.0, whole / 1800.0);
  fit_best_form(grown, sightings(stars, points, seed), 4.0 * unit);
  const double overall = points.size() / (static_cast<double>(frame.width_px) * frame.height_px);
  double reach = reach_px;
  int at_whole = 0;
  for (int round = 0; round < kMaxRounds && at_whole < 3; ++round) {
    reach = std::min(reach * kReachGrowth, whole);
    at_whole += reach >= whole;
    const double share = at_whole == 0 ? 0.025 : at_whole == 1 ? 0.012 : 0.0;
    const auto tolerance = [&](const Seen& one) {
      const double from = std::hypot(one.x - middle_x, one.y - middle_y);
      return from > reach ? 0.0 : kGrowthScatter_px * unit + share * std::max(from, 0.2 * reach);
    };
    const std::vector<Seen> seen = predicted(grown.camera, frame, stars);
    const std::vector<StarMatch> matches = match(seen, points, cells, tolerance);
    // Chance hits find no more stars as they grow than points strewn at random have: most of a long search's
    // time would go into them.
    const double by_chance = strewn_matches(seen, tolerance, overall);
    const double excess = static_cast<double>(matches.size()) - by_chance;
    if (matches.size() < 4 || (round >= 1 && matches.size() < 6) ||
        (round >= 2 && excess < 3.0 + 3.0 * std::sqrt(by_chance)))
      break;
    grown.matches = matches;
    fit_best_form(grown, sightings(stars, points, matches), (at_whole >= 2 ? 1.0 : 2.0) * unit);
  }
  tell_chance(grown, frame, stars, points, cells, trials);
  return grown;
}

bool is_certain(const GrownCamera& grown) { return grown.log10_false < kCertain_log10; }

}  // namespace vegard::fit
