#include "fit/map/mode_response.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr double kTold = 0.5;         // of the prior's information
constexpr int kSteps = 8;             // of conjugate gradients
constexpr double kEnoughFall = 1e-3;  // of the squared residual, in the preconditioner's metric

void add_times(std::vector<float>& to, double factor, const std::vector<float>& what) {
  const auto f = static_cast<float>(factor);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += f * what[i];
}

/// Light on the films of all pictures.
using Lights = std::vector<MapLight>;

class Answers {
 public:
  Answers(const MapCurvature& about, int modes) : about_(about) {
    for (int k = 0; k < modes; ++k) {
      Lights light(about.pictures.size());
      for (std::size_t p = 0; p < light.size(); ++p) {
        light[p].assign(about.light[p].size(), 0.0f);
        if (!stopped()) about.pictures[p].forward_by_mode(k, about.map, light[p]);
      }
      by_mode_.push_back(std::move(light));
    }
  }

  Lights along(const Eigen::VectorXd& shift) const {
    Lights sum;
    for (const MapLight& light : about_.light) sum.emplace_back(light.size(), 0.0f);
    for (std::size_t k = 0; k < by_mode_.size(); ++k)
      for (std::size_t p = 0; p < sum.size(); ++p)
        add_times(sum[p], shift(static_cast<Eigen::Index>(k)), by_mode_[k][p]);
    return sum;
  }

  Lights weighted(const Lights& light) const {
    Lights out(light.size());
    for (std::size_t p = 0; p < light.size(); ++p) about_.pictures[p].take_sky_away(light[p], out[p]);
    return out;
  }

  /// Solves for X, and takes its light from that of the shift, which is left of it then.
  std::vector<float> map(Lights& light) const {
    const std::size_t n = about_.map.size();
    std::vector<float> x(n, 0.0f), left = back(weighted(light)), z(n), along(n);
    precondition(left, z);
    along = z;
    double fall = dot(left, z);
    const double enough = kEnoughFall * fall;
    for (int step = 0; step < kSteps && fall > enough && !stopped(); ++step) {
      Lights seen(light.size());
      for (std::size_t p = 0; p < light.size(); ++p) about_.pictures[p].forward(along, seen[p]);
      const std::vector<float> curved = back(weighted(seen));
      const double curvature = dot(along, curved);
      if (!(curvature > 0.0)) break;
      const double length = fall / curvature;
      add_times(x, length, along);
      add_times(left, -length, curved);
      for (std::size_t p = 0; p < light.size(); ++p) add_times(light[p], -length, seen[p]);
      precondition(left, z);
      const double next = dot(left, z);
      for (std::size_t i = 0; i < n; ++i) along[i] = z[i] + static_cast<float>(next / fall) * along[i];
      fall = next;
    }
    return x;
  }

 private:
  bool stopped() const { return about_.stop != nullptr && *about_.stop; }

  std::vector<float> back(const Lights& light) const {
    std::vector<float> map(about_.map.size(), 0.0f);
    for (std::size_t p = 0; p < light.size(); ++p) about_.pictures[p].add_adjoint(light[p], map);
    return map;
  }

  void precondition(const std::vector<float>& left, std::vector<float>& out) const {
    for (std::size_t i = 0; i < left.size(); ++i) out[i] = about_.map[i] * about_.scale[i] * left[i];
  }

  const MapCurvature& about_;
  std::vector<Lights> by_mode_;
};

double product(const Lights& a, const Lights& b) {
  double sum = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p) sum += dot(a[p], b[p]);
  return sum;
}

}  // namespace

std::vector<float> ModeResponse::answer(const Eigen::VectorXd& shift) const {
  if (map_by_direction.empty()) return {};
  std::vector<float> change(map_by_direction.front().size(), 0.0f);
  for (std::size_t j = 0; j < map_by_direction.size(); ++j)
    add_times(change, -directions.col(static_cast<Eigen::Index>(j)).dot(shift), map_by_direction[j]);
  return change;
}

ModeResponse mode_response(const MapCurvature& about, int modes, double prior) {
  const Answers answers(about, modes);
  Eigen::MatrixXd direct(modes, modes);
  std::vector<Lights> light, weighted;
  for (int k = 0; k < modes; ++k) {
    light.push_back(answers.along(Eigen::VectorXd::Unit(modes, k)));
    weighted.push_back(answers.weighted(light.back()));
    for (int i = 0; i <= k; ++i)
      direct(i, k) = direct(k, i) =
          product(light[static_cast<std::size_t>(k)], weighted[static_cast<std::size_t>(i)]);
  }
  ModeResponse response;
  const sim::SymmetricEigen axes = sim::symmetric_eigen(direct);
  std::vector<std::vector<float>> map;
  std::vector<Eigen::Index> told;
  for (Eigen::Index j = 0; j < modes; ++j) {
    light[static_cast<std::size_t>(j)] = answers.along(axes.vectors.col(j));
    if (axes.values(j) < kTold * prior) continue;
    told.push_back(j);
    map.push_back(answers.map(light[static_cast<std::size_t>(j)]));
  }
  response.directions.resize(modes, static_cast<Eigen::Index>(told.size()));
  for (std::size_t t = 0; t < told.size(); ++t)
    response.directions.col(static_cast<Eigen::Index>(t)) = axes.vectors.col(told[t]);

  Eigen::MatrixXd information(modes, modes);
  Eigen::VectorXd gradient(modes);
  for (Eigen::Index j = 0; j < modes; ++j) {
    const Lights& of_j = light[static_cast<std::size_t>(j)];
    const Lights heavy = answers.weighted(of_j);
    for (Eigen::Index i = 0; i <= j; ++i)
      information(i, j) = information(j, i) = product(light[static_cast<std::size_t>(i)], heavy);
    gradient(j) = product(about.residual, answers.along(axes.vectors.col(j)));
  }
  for (std::size_t t = 0; t < told.size(); ++t) gradient(told[t]) -= dot(map[t], about.gradient);
  response.information = axes.vectors * information * axes.vectors.transpose();
  response.gradient = axes.vectors * gradient;
  response.map_by_direction = std::move(map);
  return response;
}

}  // namespace vegard::fit
