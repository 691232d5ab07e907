#include "fit/photo/pointing/camera_fit.h"

#include <ceres/ceres.h>

#include <cmath>
#include <limits>

namespace vegard::fit {
namespace {

/// The fewest numbers that are fitted at once, and those of most lenses: a derivative costs as much as a
/// value.
constexpr int kFewTangents = 6, kSomeTangents = 9;

constexpr int kCameraMaxRounds = 4;
constexpr double kSmallTurn = 1e-9;  // radians

/// A star's place, and its derivatives by the free numbers, in their order.
struct PlaceWithSlopes {
  double x_px = 0.0, y_px = 0.0;
  std::array<double, lens_numbers> by_x{}, by_y{};
};

template <int N>
bool place_by_tangents(const SkyCamera& camera, const double numbers[lens_numbers],
                       const std::vector<LensNumber>& free, const std::array<double, 3>& enu,
                       PlaceWithSlopes& place) {
  using Number = sim::Dual<double, sim::Tangents<double, N>>;
  Number dual[lens_numbers];
  for (int i = 0; i < lens_numbers; ++i) dual[i] = Number(numbers[i]);
  for (std::size_t j = 0; j < free.size(); ++j) dual[free[j]].d.t[j] = 1.0;
  Number x(0.0), y(0.0);
  const bool has_image = place_of_star(camera, dual, enu, x, y);
  place.x_px = x.v;
  place.y_px = y.v;
  for (std::size_t j = 0; j < free.size(); ++j) {
    place.by_x[j] = x.d.t[j];
    place.by_y[j] = y.d.t[j];
  }
  return has_image;
}

bool place_with_slopes(const SkyCamera& camera, const double numbers[lens_numbers],
                       const std::vector<LensNumber>& free, const std::array<double, 3>& enu,
                       PlaceWithSlopes& place) {
  if (free.size() <= kFewTangents) return place_by_tangents<kFewTangents>(camera, numbers, free, enu, place);
  if (free.size() <= kSomeTangents)
    return place_by_tangents<kSomeTangents>(camera, numbers, free, enu, place);
  return place_by_tangents<lens_numbers>(camera, numbers, free, enu, place);
}

/// One star's residual, observed minus computed.
class StarCost : public ceres::CostFunction {
 public:
  StarCost(const SkyCamera& camera, const std::vector<LensNumber>& free, const StarSighting& star)
      : camera_(camera), free_(free), star_(star) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(free.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    std::array<double, lens_numbers> numbers = camera_.numbers;
    for (std::size_t j = 0; j < free_.size(); ++j) numbers[free_[j]] = parameters[0][j];
    if (!(numbers[focal_px_number] > 0.0) || !(numbers[aspect_ratio_number] > 0.0)) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) {
      double x = 0.0, y = 0.0;
      if (!place_of_star(camera_, numbers.data(), star_.enu, x, y)) return false;
      residuals[0] = star_.x_px - x;
      residuals[1] = star_.y_px - y;
      return std::isfinite(residuals[0]) && std::isfinite(residuals[1]);
    }
    PlaceWithSlopes place;
    if (!place_with_slopes(camera_, numbers.data(), free_, star_.enu, place)) return false;
    residuals[0] = star_.x_px - place.x_px;
    residuals[1] = star_.y_px - place.y_px;
    const std::size_t n = free_.size();
    for (std::size_t j = 0; j < n; ++j) {
      jacobians[0][j] = -place.by_x[j];
      jacobians[0][n + j] = -place.by_y[j];
    }
    return std::isfinite(residuals[0]) && std::isfinite(residuals[1]);
  }

 private:
  const SkyCamera& camera_;
  const std::vector<LensNumber>& free_;
  const StarSighting& star_;
};

ceres::Solver::Options solver_options() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  return options;
}

bool takes_part(const StarSet& used, std::size_t i) { return used.empty() || used[i] != 0; }

}  // namespace

CameraFit fit_camera(const SkyCamera& start, const std::vector<LensNumber>& free,
                     const std::vector<StarSighting>& stars, const StarSet& used, double cauchy_px) {
  CameraFit fit;
  fit.camera = start;
  for (int round = 0; round < kCameraMaxRounds; ++round) {
    // A star that has no image at the start would stop the descent before its first step.
    std::vector<double> values;
    for (const LensNumber number : free) values.push_back(fit.camera.numbers[number]);
    const SkyCamera base = fit.camera;
    ceres::Problem problem;
    for (std::size_t i = 0; i < stars.size(); ++i) {
      if (!takes_part(used, i)) continue;
      double x = 0.0, y = 0.0;
      if (!place_of_star(base, stars[i].enu, x, y)) {
        if (cauchy_px > 0.0) continue;
        return fit;
      }
      problem.AddResidualBlock(new StarCost(base, free, stars[i]),
                               cauchy_px > 0.0 ? new ceres::CauchyLoss(cauchy_px) : nullptr, values.data());
    }
    if (problem.NumResidualBlocks() == 0) return fit;
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(), &problem, &summary);
    if (!summary.IsSolutionUsable()) return fit;
    double turn = 0.0;
    for (std::size_t j = 0; j < free.size(); ++j) {
      fit.camera.numbers[free[j]] = values[j];
      if (free[j] <= turn_about_forward) turn = std::max(turn, std::abs(values[j]));
    }
    fit.camera = with_rotation_applied(fit.camera);
    if (turn < kSmallTurn) break;
  }
  const std::vector<Eigen::Vector2d> left = residuals(fit.camera, stars);
  fit.good = true;
  for (std::size_t i = 0; i < stars.size(); ++i)
    if (takes_part(used, i)) {
      fit.sum_of_squares += left[i].squaredNorm();
      fit.good = fit.good && std::isfinite(left[i].squaredNorm());
    }
  if (cauchy_px > 0.0) fit.good = true;
  return fit;
}

std::vector<Eigen::Vector2d> residuals(const SkyCamera& camera, const std::vector<StarSighting>& stars) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const sim::Lens<double> lens = true_lens(camera);
  std::vector<Eigen::Vector2d> all;
  for (const StarSighting& star : stars) {
    const Eigen::Vector3d v = camera.camera_from_enu * Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]);
    const double in_camera[3] = {v[0], v[1], v[2]};
    double x = 0.0, y = 0.0;
    if (sim::project(lens, in_camera, x, y))
      all.emplace_back(star.x_px - x, star.y_px - y);
    else
      all.emplace_back(kNone, kNone);
  }
  return all;
}

Eigen::MatrixXd place_jacobian(const SkyCamera& camera, const std::vector<LensNumber>& free,
                               const std::vector<StarSighting>& stars, const StarSet& used) {
  const int n = used.empty() ? static_cast<int>(stars.size()) : count(used);
  Eigen::MatrixXd jacobian(2 * n, static_cast<int>(free.size()));
  int row = 0;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    if (!takes_part(used, i)) continue;
    PlaceWithSlopes place;
    place_with_slopes(camera, camera.numbers.data(), free, stars[i].enu, place);
    for (std::size_t j = 0; j < free.size(); ++j) {
      jacobian(row, static_cast<int>(j)) = place.by_x[j];
      jacobian(row + 1, static_cast<int>(j)) = place.by_y[j];
    }
    row += 2;
  }
  return jacobian;
}

int count(const StarSet& used) {
  int n = 0;
  for (const char one : used) n += one != 0;
  return n;
}

}  // namespace vegard::fit
