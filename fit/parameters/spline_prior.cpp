#include "fit/parameters/spline_prior.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "sim/base/number/dense_solvers.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

constexpr double kMinSmoothness = 0.05, kMaxSmoothness = 100.0;
constexpr double kSplineRankTolerance = 1e-12;
constexpr int kSplineMaxRounds = 300;
constexpr double kSplineSettled = 1e-3;  // of a smoothness

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool is_spline(const FreeNumber& number) {
  return number.id.role() == sim::ParameterRole::profile_coefficient;
}

int scale_line(const sim::Scene& scene) {
  return std::max(0, sim::line_index(scene.emission.lines, sim::kGreenNm));
}

/// Of one coefficient in the column of its line, as the scene's sheets add up.
double column_weight(const sim::Sheet& sheet, int knot) {
  return sheet.energy_flux_mw_m2 * sim::altitude_spline(sheet).integral_km(knot);
}

/// Inverse of a sum of informations. Where something has none at all, neither data nor bends depend on it:
/// its covariance is then 0, so that it takes no part.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& information) {
  const Eigen::Index n = information.rows();
  // Scaled to a unit diagonal, so that units do not matter.
  Eigen::VectorXd scale = information.diagonal().cwiseMax(0.0).cwiseSqrt();
  for (Eigen::Index i = 0; i < n; ++i) scale(i) = scale(i) > 0.0 ? 1.0 / scale(i) : 1.0;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  if (const auto regular = sim::inverse_of_definite(scaled, kSplineRankTolerance)) {
    result = *regular;
  } else {
    const sim::SymmetricEigen eigen = sim::symmetric_eigen(scaled);
    const double least = kSplineRankTolerance * eigen.values.cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < n; ++k)
      if (eigen.values(k) > least)
        result += eigen.vectors.col(k) * eigen.vectors.col(k).transpose() / eigen.values(k);
  }
  return scale.asDiagonal() * result * scale.asDiagonal();
}

}  // namespace

std::vector<SplineLine> spline_lines(const sim::Scene& scene, const std::vector<FreeNumber>& free) {
  // Sorted at every level: coefficients may be listed one by one and in any order.
  std::map<std::pair<int, int>, std::map<int, int>> found;  // [sheet, line][knot]
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (!is_spline(free[j])) continue;
    const int sheet = free[j].id.sheet(), knots = scene.sheets[sheet].spline_knots;
    const int index = sim::index_in(scene, free[j].id);
    found[{sheet, index / knots}][index % knots] = static_cast<int>(j);
  }
  std::vector<SplineLine> lines;
  for (const auto& [key, numbers] : found) {
    SplineLine line;
    std::tie(line.sheet, line.line) = key;
    for (const auto& [knot, number] : numbers) {
      line.knots.push_back(knot);
      line.numbers.push_back(number);
    }
    const sim::AltitudeSpline spline = sim::altitude_spline(scene.sheets[line.sheet]);
    for (std::size_t i = 1; i + 1 < line.knots.size(); ++i) {
      const int k = line.knots[i];
      if (line.knots[i - 1] != k - 1 || line.knots[i + 1] != k + 1) continue;
      const double below = spline.centre_km(k) - spline.centre_km(k - 1),
                   above = spline.centre_km(k + 1) - spline.centre_km(k), mean = 0.5 * (below + above);
      line.bends.push_back({{line.numbers[i - 1], line.numbers[i], line.numbers[i + 1]},
                            {mean / below, -mean / below - mean / above, mean / above}});
    }
    lines.push_back(line);
  }
  return lines;
}

SplinePrior spline_prior(const sim::Scene& scene, const std::vector<FreeNumber>& free, double smoothness) {
  SplinePrior prior;
  prior.lines = spline_lines(scene, free);
  prior.smoothness.assign(prior.lines.size(), smoothness);
  std::size_t coefficients = 0, splines = 0;
  for (const sim::Sheet& sheet : scene.sheets) coefficients += sheet.spline_rate.size();
  for (const SplineLine& line : prior.lines) splines += line.numbers.size();
  const bool all_sheets = std::all_of(scene.sheets.begin(), scene.sheets.end(), sim::has_spline_profile);
  prior.holds_scale = prior.any() && all_sheets && splines == coefficients;
  if (!prior.holds_scale) return prior;
  double column = 0.0;
  for (const SplineLine& line : prior.lines)
    for (std::size_t i = 0; i < line.numbers.size() && line.line == scale_line(scene); ++i)
      column += column_weight(scene.sheets[line.sheet], line.knots[i]) * free[line.numbers[i]].start;
  prior.log_column = std::log(column);
  return prior;
}

void append_rows(const SplinePrior& prior, const sim::Scene& scene, double weight, PriorRows& rows) {
  for (std::size_t l = 0; l < prior.lines.size(); ++l)
    for (const Bend& bend : prior.lines[l].bends) {
      std::vector<PriorRows::LogTerm> terms;
      for (int i = 0; i < 3; ++i)
        terms.push_back({bend.numbers[i], weight * prior.smoothness[l] * bend.factors[i]});
      rows.add_of_logarithms(terms);
    }
  if (!prior.holds_scale) return;
  std::vector<PriorRows::Weight> weights;
  for (const SplineLine& line : prior.lines)
    for (std::size_t i = 0; i < line.numbers.size() && line.line == scale_line(scene); ++i)
      weights.push_back({line.numbers[i], column_weight(scene.sheets[line.sheet], line.knots[i])});
  rows.add_of_sum(weight / SplinePrior::kScaleError, prior.log_column, 0.0, weights);
}

std::vector<double> most_probable_smoothness(const SplinePrior& prior, const std::vector<double>& information,
                                             const std::vector<double>& other_information,
                                             const std::vector<double>& at, double weight,
                                             double* determined) {
  const auto n = static_cast<Eigen::Index>(at.size());
  const Eigen::Map<const RowMajor> data(information.data(), n, n), other(other_information.data(), n, n);
  const Eigen::Map<const Eigen::VectorXd> optimum(at.data(), n);
  std::vector<Eigen::MatrixXd> differences;  // [line][row][coordinate]
  for (const SplineLine& line : prior.lines) {
    differences.emplace_back(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(line.bends.size()), n));
    for (std::size_t r = 0; r < line.bends.size(); ++r)
      for (int i = 0; i < 3; ++i)
        differences.back()(static_cast<Eigen::Index>(r), line.bends[r].numbers[i]) = line.bends[r].factors[i];
  }
  const auto smoothness_information = [&](const std::vector<double>& smoothness) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t l = 0; l < differences.size(); ++l)
      sum += smoothness[l] * smoothness[l] * differences[l].transpose() * differences[l];
    return sum;
  };
  const Eigen::MatrixXd before = weight * weight * smoothness_information(prior.smoothness);
  std::vector<double> result = prior.smoothness;
  for (int round = 0; round < kSplineMaxRounds; ++round) {
    const Eigen::MatrixXd now = smoothness_information(result);
    const Eigen::MatrixXd covariance = inverse(data + other + now);
    // At the optimum under `before` the gradients of the data and of that prior cancel.
    const Eigen::VectorXd moved = optimum + covariance * ((before - now) * optimum);
    if (determined != nullptr) *determined = (covariance * data).trace();
    double change = 0.0;
    for (std::size_t l = 0; l < differences.size(); ++l) {
      const Eigen::MatrixXd& d = differences[l];
      if (d.rows() == 0) continue;
      const double square = ((d * moved).squaredNorm() + (d * covariance * d.transpose()).trace()) /
                            static_cast<double>(d.rows());
      const double next = std::clamp(1.0 / std::sqrt(square), kMinSmoothness, kMaxSmoothness);
      change = std::max(change, std::abs(std::log(next / result[l])));
      result[l] = next;
    }
    if (change < kSplineSettled) break;
  }
  return result;
}

}  // namespace vegard::fit
