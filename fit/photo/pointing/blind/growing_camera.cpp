#include "fit/photo/pointing/blind/growing_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::fit {
namespace {

constexpr double kReachGrowth = 1.5;
constexpr double kGrowthScatter_px = 2.5;
constexpr int kMaxRounds = 14;

/// Returns the expected number of stars with a point among random points of this density.
template <class Tolerance>
double strewn_matches(const std::vector<ExpectedStar>& seen, const Tolerance& tolerance, double density) {
  double sum = 0.0;
  for (const ExpectedStar& one : seen) {
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

std::vector<LensForm> forms_for(std::size_t matches, bool is_narrow) {
  using sim::LensModel;
  if (is_narrow && matches < 12) return {{LensModel::pinhole, 0, false, false}};
  if (is_narrow) return {{LensModel::pinhole, 0, false, false}, {LensModel::pinhole, 1, false, false}};
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
void fit_best_form(GrownCamera& grown, const std::vector<StarSighting>& seen, double scale_px,
                   bool is_narrow) {
  const bool centre_free = seen.size() >= 8 && !is_narrow;
  if (seen.size() < 7) {
    const CameraFit fit = fit_camera(grown.camera, free_numbers(grown.form, false), seen, {}, scale_px);
    if (fit.good) grown.camera = fit.camera;
    return;
  }
  double least = std::numeric_limits<double>::infinity();
  const SkyCamera before = grown.camera;
  for (const LensForm& form : forms_for(seen.size(), is_narrow)) {
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

void tell_chance(GrownCamera& grown, const Frame& frame, const std::vector<StarSighting>& stars,
                 const std::vector<FoundStar>& points, const PointCells& cells, double trials,
                 const SkyPixels& pixels, bool is_narrow) {
  const bool centre_free = grown.agreement.matches.size() >= 8 && !is_narrow;
  const double numbers = 4.0 + (centre_free ? 2.0 : 0.0) + grown.form.radial;
  grown.agreement =
      agreement_against_chance(grown.camera, frame, stars, points, cells, numbers, trials, pixels);
  const std::vector<StarSighting> matched = sightings(stars, points, grown.agreement.matches);
  double sum = 0.0;
  for (const Eigen::Vector2d& left : residuals(grown.camera, matched)) sum += left.squaredNorm();
  grown.rms_px = matched.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(matched.size()));
}

}  // namespace

GrownCamera grow_camera(const SkyCamera& start, const Frame& frame, const std::vector<StarSighting>& stars,
                        const std::vector<FoundStar>& points, const PointCells& cells,
                        const std::vector<StarMatch>& seed, double reach_px, double trials,
                        const SkyPixels& pixels, bool is_narrow) {
  GrownCamera grown;
  grown.camera = start;
  grown.form = {start.model, 0, false, false};
  grown.agreement.matches = seed;
  double middle_x = 0.0, middle_y = 0.0;
  for (const StarMatch& one : seed) {
    middle_x += points[one.point].x_px / seed.size();
    middle_y += points[one.point].y_px / seed.size();
  }
  const double whole = std::hypot(frame.width_px, frame.height_px);
  const double unit = std::max(1.0, whole / 1800.0);
  fit_best_form(grown, sightings(stars, points, seed), 4.0 * unit, is_narrow);
  const double overall = points.size() / (static_cast<double>(frame.width_px) * frame.height_px);
  double reach = reach_px;
  int at_whole = 0;
  for (int round = 0; round < kMaxRounds && at_whole < 3; ++round) {
    reach = std::min(reach * kReachGrowth, whole);
    at_whole += reach >= whole;
    const double share = at_whole == 0 ? 0.025 : at_whole == 1 ? 0.012 : 0.0;
    const auto tolerance = [&](const ExpectedStar& one) {
      const double from = std::hypot(one.x - middle_x, one.y - middle_y);
      return from > reach ? 0.0 : kGrowthScatter_px * unit + share * std::max(from, 0.2 * reach);
    };
    const std::vector<ExpectedStar> seen = expected_stars(grown.camera, frame, stars, pixels);
    const std::vector<StarMatch> matches = each_others_nearest(seen, points, cells, tolerance);
    // Chance hits find no more stars as they grow than points strewn at random have: most of a long search's
    // time would go into them.
    const double by_chance = strewn_matches(seen, tolerance, overall);
    const double excess = static_cast<double>(matches.size()) - by_chance;
    if (matches.size() < 4 || (round >= 1 && matches.size() < 6) ||
        (round >= 2 && excess < 3.0 + 3.0 * std::sqrt(by_chance)))
      break;
    grown.agreement.matches = matches;
    fit_best_form(grown, sightings(stars, points, matches), (at_whole >= 2 ? 1.0 : 2.0) * unit, is_narrow);
  }
  tell_chance(grown, frame, stars, points, cells, trials, pixels, is_narrow);
  return grown;
}

bool is_certain(const GrownCamera& grown) { return is_no_chance(grown.agreement); }

}  // namespace vegard::fit
