#include "fit/triangulation/curtain_profiles.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/triangulation/light_ranks.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace curtain_profiles {

constexpr std::size_t kFewestPlaces = 40;  ///< of a piece that counts
constexpr std::size_t kFewestPieces = 4;
constexpr double kShorterHighest_km = 20.0;
constexpr double kScanStep_km = 4.0, kScanAcross_km = 4.0;
constexpr int kMostAcross = 8;  ///< steps to each side
constexpr int kHalf = 2;        ///< steps of the fine grid to each side
constexpr double kFineStep_km = 1.5, kFineAcross_km = 0.75;
constexpr double kFieldError_deg = 1.5;  ///< ESTIMATED: of the main field's direction, by currents and waves
constexpr double kMostCorrelated = 0.999;
/// The likelihood's logarithm this far off its peak is below this part of it, or there is no height.
constexpr double kContrastReach_km = 32.0, kLeastContrast = 0.7;

/// The correlation of ranks in each piece; NaN in pieces with too few places.
std::vector<double> correlations(const std::vector<BorderFieldLine>& lines, const std::vector<double>& first,
                                 const std::vector<double>& second) {
  std::vector<double> found(kBorderPieces, sim::kNaN);
  const std::size_t count = lines.empty() ? 0 : first.size() / lines.size();
  std::size_t line = 0;
  for (std::size_t piece = 0; piece < kBorderPieces; ++piece) {
    std::vector<double> a, b;
    for (; line < lines.size() && lines[line].piece == piece; ++line)
      for (std::size_t i = line * count; i < (line + 1) * count; ++i)
        if (std::isfinite(first[i]) && std::isfinite(second[i])) {
          a.push_back(first[i]);
          b.push_back(second[i]);
        }
    if (a.size() < kFewestPlaces) continue;
    Eigen::VectorXd ranks_a = ranks_of(a), ranks_b = ranks_of(b);
    ranks_a.array() -= ranks_a.mean();
    ranks_b.array() -= ranks_b.mean();
    const double squares = ranks_a.squaredNorm() * ranks_b.squaredNorm();
    found[piece] = squares > 0.0 ? ranks_a.dot(ranks_b) / std::sqrt(squares) : 0.0;
  }
  return found;
}

std::vector<double> correlations_at(const CurtainLight& light, const CurtainSupposition& supposed,
                                    double height_km, double across_km) {
  CurtainSupposition moved = supposed;
  moved.across_km = across_km;
  const std::vector<BorderFieldLine> lines = light.lines_at(moved, height_km);
  return correlations(lines, light.along(moved, lines, 0), light.along(moved, lines, 1));
}

double likelihood_of(double correlation) {
  const double r = std::isfinite(correlation) ? std::clamp(correlation, 0.0, kMostCorrelated) : 0.0;
  return -0.5 * std::log1p(-r * r);
}

/// The mean of all pieces; what one picture does not show says nothing, and counts as 0.
double mean_likelihood(const std::vector<double>& correlations) {
  double sum = 0.0;
  for (const double correlation : correlations) sum += likelihood_of(correlation);
  return sum / static_cast<double>(correlations.size());
}

/// The correlations on a grid about a height and a movement across the base.
struct FineGrid {
  double height_km = 0.0, across_km = 0.0;        ///< of its middle
  double scale = 1.0;                             ///< of its steps
  std::vector<std::vector<double>> correlations;  ///< [height][across] of [piece]
  std::vector<std::size_t> pieces;                ///< that both pictures show on all of the grid
};

constexpr int kSide = 2 * kHalf + 1;

FineGrid fine_grid(const CurtainLight& curtain, const CurtainSupposition& as, double height_km,
                   double across_km, double scale, int threads) {
  FineGrid grid{height_km, across_km, scale, std::vector<std::vector<double>>(kSide * kSide), {}};
  sim::parallel_for(kSide * kSide, threads, [&](std::size_t i, int) {
    grid.correlations[i] =
        correlations_at(curtain, as, height_km + scale * kFineStep_km * (static_cast<int>(i) / kSide - kHalf),
                        across_km + scale * kFineAcross_km * (static_cast<int>(i) % kSide - kHalf));
  });
  for (std::size_t piece = 0; piece < kBorderPieces; ++piece)
    if (std::all_of(grid.correlations.begin(), grid.correlations.end(),
                    [&](const std::vector<double>& one) { return std::isfinite(one[piece]); }))
      grid.pieces.push_back(piece);
  return grid;
}

/// The likelihood on the grid, with a piece left out.
Eigen::VectorXd likelihoods(const FineGrid& grid, std::size_t without = kBorderPieces) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(kSide * kSide);
  for (int i = 0; i < kSide * kSide; ++i)
    for (const std::size_t piece : grid.pieces)
      if (piece != without) values[i] += likelihood_of(grid.correlations[static_cast<std::size_t>(i)][piece]);
  return values;
}

/// The place (height, across) of the largest likelihood by a surface of second order through the grid; none
/// if that has no maximum.
std::optional<Eigen::Vector2d> summit(const FineGrid& grid, const Eigen::VectorXd& values) {
  Eigen::MatrixXd terms(kSide * kSide, 6);
  for (int i = 0; i < kSide * kSide; ++i) {
    const double h = i / kSide - kHalf, c = i % kSide - kHalf;
    terms.row(i) << 1.0, h, c, h * h, h * c, c * c;
  }
  const Eigen::VectorXd k = (terms.transpose() * terms).ldlt().solve(terms.transpose() * values);
  Eigen::Matrix2d curvature;
  curvature << 2.0 * k[3], k[4], k[4], 2.0 * k[5];
  if (!(curvature(0, 0) < 0.0) || !(curvature.determinant() > 1e-12)) return std::nullopt;
  Eigen::Vector2d steps = curvature.inverse() * Eigen::Vector2d(-k[1], -k[2]);
  for (int axis = 0; axis < 2; ++axis) steps[axis] = std::clamp(steps[axis], -2.0 * kHalf, 2.0 * kHalf);
  return Eigen::Vector2d(grid.height_km + grid.scale * kFineStep_km * steps[0],
                         grid.across_km + grid.scale * kFineAcross_km * steps[1]);
}

struct Found {
  Eigen::Vector2d at;  ///< height and movement across
  FineGrid grid;       ///< about it
};

/// Whether the likelihood falls so fast beside the middle of the grid that finer steps show it better.
bool is_steep(const FineGrid& grid, const Eigen::VectorXd& values) {
  constexpr double kSteep = 0.25;  // of a piece
  constexpr int kMiddle = kHalf * kSide + kHalf;
  double most = -HUGE_VAL;
  for (const int neighbour : {kMiddle - kSide, kMiddle + kSide, kMiddle - 1, kMiddle + 1})
    most = std::max(most, values[neighbour]);
  return values[kMiddle] - most > kSteep * static_cast<double>(grid.pieces.size());
}

/// Climbs to the nearest summit, from grid to grid until the largest value is inside; none if it is not
/// reached in some steps. `grid` is where it begins, without its correlations.
std::optional<Found> climbed(const CurtainLight& curtain, const CurtainSupposition& as, FineGrid grid,
                             int threads) {
  constexpr int kMostSteps = 14;
  constexpr double kLeastScale = 0.25;
  for (int i = 0; i < kMostSteps; ++i) {
    grid = fine_grid(curtain, as, grid.height_km, grid.across_km, grid.scale, threads);
    if (grid.pieces.size() < kFewestPieces) return std::nullopt;
    const Eigen::VectorXd values = likelihoods(grid);
    Eigen::Index best = 0;
    values.maxCoeff(&best);
    const int up = static_cast<int>(best) / kSide - kHalf, left = static_cast<int>(best) % kSide - kHalf;
    const bool is_finer = up == 0 && left == 0 && grid.scale > kLeastScale && is_steep(grid, values);
    if (std::abs(up) < kHalf && std::abs(left) < kHalf && !is_finer) {
      const std::optional<Eigen::Vector2d> at = summit(grid, values);
      if (!at) return std::nullopt;
      return Found{*at, std::move(grid)};
    }
    grid.height_km += grid.scale * kFineStep_km * up;
    grid.across_km += grid.scale * kFineAcross_km * left;
    if (is_finer) grid.scale *= 0.5;
  }
  return std::nullopt;
}

Eigen::Matrix2d left_out_covariance(const FineGrid& grid) {
  std::vector<Eigen::Vector2d> found;
  for (const std::size_t piece : grid.pieces) {
    const std::optional<Eigen::Vector2d> at = summit(grid, likelihoods(grid, piece));
    if (!at) return Eigen::Matrix2d::Constant(sim::kNaN);  // one piece alone has made the summit
    found.push_back(*at);
  }
  const double n = static_cast<double>(found.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& one : found) mean += one / n;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& one : found)
    covariance += (n - 1.0) / n * (one - mean) * (one - mean).transpose();
  return covariance;
}

/// Number of independent places in a piece, by what the ranks of the two pictures do not share.
double independent_places(const std::vector<double>& first, const std::vector<double>& second,
                          std::size_t lines) {
  const std::size_t count = first.size() / lines;
  std::vector<double> a, b;
  std::vector<std::size_t> where;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (std::isfinite(first[i]) && std::isfinite(second[i])) {
      a.push_back(first[i]);
      b.push_back(second[i]);
      where.push_back(i);
    }
  if (a.size() < kFewestPlaces) return 0.0;
  const Eigen::VectorXd differ = ranks_of(a) - ranks_of(b);
  std::vector<double> grid(first.size(), sim::kNaN);
  for (std::size_t i = 0; i < where.size(); ++i) grid[where[i]] = differ[static_cast<Eigen::Index>(i)];
  return independent_values(grid, lines, count) / kBorderPieces;
}

/// The height with the largest likelihood on a rough grid, and the curve for the report.
std::optional<Eigen::Vector2d> scanned(ProfileMatch& match, const CurtainLight& curtain,
                                       const CurtainSupposition& as, const ProfileSettings& settings) {
  const HeightRange& range = settings.range;
  for (double h = range.lowest_km; h <= range.highest_km + 1e-9; h += kScanStep_km)
    match.height_km.push_back(h);
  const std::size_t count = match.height_km.size();
  // Two standard deviations of the movement, and a step at least.
  const int aside =
      std::clamp(static_cast<int>(std::ceil(2.0 * settings.moved_km / kScanAcross_km)), 1, kMostAcross);
  const auto wide = static_cast<std::size_t>(2 * aside + 1);
  const auto across_km = [&](std::size_t i) {
    return kScanAcross_km * (static_cast<double>(i % wide) - aside);
  };
  std::vector<double> values(wide * count);
  sim::parallel_for(wide * count, settings.threads, [&](std::size_t i, int) {
    values[i] = mean_likelihood(correlations_at(curtain, as, match.height_km[i / wide], across_km(i)));
  });
  for (std::size_t i = 0; i < count; ++i)
    match.likelihood.push_back(
        *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(wide * i),
                          values.begin() + static_cast<std::ptrdiff_t>(wide * (i + 1))));
  const auto best = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  // Smooth light has a gradient in common at any height; only a peak tells one.
  const std::size_t height = best / wide;
  const auto far = static_cast<std::size_t>(kContrastReach_km / kScanStep_km);
  const double most = kLeastContrast * values[best];
  if (height == 0 || height + 1 == count || !(match.likelihood[height > far ? height - far : 0] < most) ||
      !(match.likelihood[std::min(count - 1, height + far)] < most))
    return std::nullopt;
  return Eigen::Vector2d(match.height_km[height], across_km(best));
}

/// The share of the probability within some errors of the height, among all heights and no match.
double weight_of(const ProfileMatch& match, double at_best, double independent) {
  const double reach_km = 3.0 * std::sqrt(match.covariance_km2(0, 0)) + kScanStep_km;
  const auto logarithm = [&](double likelihood) {
    // Each piece has a correlation of its own, which is not known before (Schwarz 1978).
    return kBorderPieces * (independent * likelihood - 0.5 * std::log(std::max(1.0, independent)));
  };
  double best = std::max(0.0, logarithm(at_best));
  for (const double likelihood : match.likelihood) best = std::max(best, logarithm(likelihood));
  double here = std::exp(logarithm(at_best) - best), others = std::exp(-best);
  for (std::size_t i = 0; i < match.height_km.size(); ++i)
    (std::abs(match.height_km[i] - match.border_km) <= reach_km ? here : others) +=
        std::exp(logarithm(match.likelihood[i]) - best);
  return here / (here + others);
}

}  // namespace curtain_profiles

ProfileMatch::ProfileMatch()
    : border_km(sim::kNaN),
      across_km(sim::kNaN),
      covariance_km2(Eigen::Matrix2d::Constant(sim::kNaN)),
      level_error_km(sim::kNaN),
      border_km_per_km(sim::kNaN),
      contradicting_km(sim::kNaN),
      contradicting_error_km(sim::kNaN),
      along(Eigen::Vector3d::Zero()),
      across(Eigen::Vector3d::Zero()) {}

bool ProfileMatch::is_given() const { return std::isfinite(border_km) && covariance_km2.allFinite(); }

bool ProfileMatch::is_clear() const {
  constexpr double kClearWeight = 0.9, kLeastAlike = 0.5;
  return is_given() && weight >= kClearWeight && correlation >= kLeastAlike && alike >= kLeastAlike;
}

ProfileMatch profile_match(const std::vector<ViewPoint>& cameras, const std::vector<const Photo*>& photos,
                           const BorderCurve& curve, const ProfileSettings& settings) {
  using namespace curtain_profiles;
  ProfileMatch match;
  if (curve.border.points.size() < 2) return match;
  CurtainLight curtain(cameras, photos, settings.channel, settings.year, settings.lowest_elevation_deg);
  CurtainSupposition as;
  as.cameras = &cameras;
  as.border = &curve.border;
  // The base on the level of the light.
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const auto& line : curtain.lines_at(as, 110.0)) up += line.foot_km.normalized();
  if (!(up.norm() > 0.0)) return match;
  up.normalize();
  const Eigen::Vector3d base = cameras[1].place_km() - cameras[0].place_km();
  match.along = (base - up * up.dot(base)).normalized();
  match.across = up.cross(match.along);
  curtain.set_base(match.along, match.across);

  const std::optional<Eigen::Vector2d> start = scanned(match, curtain, as, settings);
  if (!start) return match;
  const std::optional<Found> found =
      climbed(curtain, as, {(*start)[0], (*start)[1], 1.0, {}, {}}, settings.threads);
  if (!found || found->at[0] < settings.range.lowest_km || found->at[0] > settings.range.highest_km)
    return match;
  Eigen::Matrix2d covariance = left_out_covariance(found->grid);
  const auto off = [&](const CurtainSupposition& other) -> std::optional<Eigen::Vector2d> {
    const std::optional<Found> again =
        climbed(curtain, other, {found->at[0], found->at[1], found->grid.scale, {}, {}}, settings.threads);
    if (!again) return std::nullopt;
    return (again->at - found->at).eval();
  };
  bool is_steady = true;
  const auto add = [&](const CurtainSupposition& other) {
    const std::optional<Eigen::Vector2d> by = off(other);
    is_steady = is_steady && by;
    if (by) covariance += *by * by->transpose();
  };
  for (std::size_t i = 0; i < 2; ++i)
    for (int axis = 0; axis < 3 && cameras[i].camera().pointing_error_deg > 0.0; ++axis) {
      std::vector<ViewPoint> other = cameras;
      other[i] = turned(cameras[i], axis, cameras[i].camera().pointing_error_deg);
      CurtainSupposition turned_as = as;
      turned_as.cameras = &other;
      add(turned_as);
    }
  CurtainSupposition shorter = as, north = as, east = as, higher = as, moved = as;
  shorter.highest_km = kShorterHighest_km;
  north.field_north_deg = east.field_east_deg = kFieldError_deg;
  for (const CurtainSupposition* other : {&shorter, &north, &east}) add(*other);
  higher.border = &curve.higher;
  moved.along_km = 1.0;
  const std::optional<Eigen::Vector2d> by_level = off(higher), by_movement = off(moved);
  if (!is_steady || !by_level || !by_movement) return match;
  covariance += *by_level * by_level->transpose();

  match.border_km = found->at[0];
  match.across_km = found->at[1];
  match.covariance_km2 = covariance;
  match.level_error_km = std::abs((*by_level)[0]);
  match.border_km_per_km = -(*by_movement)[0];
  const auto lines = curtain.lines_at(as, match.border_km);
  CurtainSupposition best = as;
  best.across_km = match.across_km;
  const std::vector<double> first = curtain.along(best, lines, 0), second = curtain.along(best, lines, 1);
  const std::vector<double> all = correlations(lines, first, second);
  std::vector<double> known;
  for (const double one : all)
    if (std::isfinite(one)) known.push_back(one);
  if (known.size() < kFewestPieces) return ProfileMatch();
  match.correlation = sim::median(known);
  match.alike =
      static_cast<double>(std::count_if(known.begin(), known.end(), [](double r) { return r > 0.5; })) /
      static_cast<double>(kBorderPieces);
  match.weight = weight_of(match, mean_likelihood(all), independent_places(first, second, lines.size()));
  match.profiles = mean_profiles(curtain, best, match.border_km);
  return match;
}

ProfileMatch joined_profiles(const ProfileMatch& a, const ProfileMatch& b) {
  if (!a.is_given() || !b.is_given()) return a.is_given() ? a : b;
  const ProfileMatch& better = a.weight * a.correlation >= b.weight * b.correlation ? a : b;
  const double square_a = a.covariance_km2(0, 0), square_b = b.covariance_km2(0, 0);
  if (std::abs(a.border_km - b.border_km) > 3.0 * std::sqrt(square_a + square_b)) {
    if (a.is_clear() != b.is_clear()) return a.is_clear() ? a : b;
    const ProfileMatch& worse = &better == &a ? b : a;
    ProfileMatch contradicted = better;
    contradicted.contradicting_km = worse.border_km;
    contradicted.contradicting_error_km = std::sqrt(worse.covariance_km2(0, 0));
    return contradicted;
  }
  ProfileMatch joined = better;
  const double share = square_b / (square_a + square_b);  // of a
  const auto mean = [&](double first, double second) { return share * first + (1.0 - share) * second; };
  joined.border_km = mean(a.border_km, b.border_km);
  joined.across_km = mean(a.across_km, b.across_km);
  const Eigen::Vector2d half(0.5 * (a.border_km - b.border_km), 0.5 * (a.across_km - b.across_km));
  // The same pixels and cameras: the errors are common to both.
  joined.covariance_km2 =
      share * a.covariance_km2 + (1.0 - share) * b.covariance_km2 + half * half.transpose();
  joined.level_error_km = mean(a.level_error_km, b.level_error_km);
  joined.border_km_per_km = mean(a.border_km_per_km, b.border_km_per_km);
  joined.correlation = mean(a.correlation, b.correlation);
  joined.alike = mean(a.alike, b.alike);
  joined.weight = mean(a.weight, b.weight);
  const MeanProfiles &of_a = a.profiles, &of_b = b.profiles;
  if (std::isfinite(of_a.peak_above_km) && std::isfinite(of_b.peak_above_km)) {
    joined.profiles.peak_above_km = mean(of_a.peak_above_km, of_b.peak_above_km);
    joined.profiles.peak_above_error_km = std::hypot(mean(of_a.peak_above_error_km, of_b.peak_above_error_km),
                                                     0.5 * (of_a.peak_above_km - of_b.peak_above_km));
  }
  return joined;
}

}  // namespace vegard::fit
