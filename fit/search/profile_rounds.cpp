#include "fit/search/profile_rounds.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "fit/compare/profile_cost.h"

namespace vegard::fit {
namespace {

constexpr int kRounds = 5, kRoundsIterations = 40;
constexpr double kRoundsSettled = 0.1;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Coefficients go by their logarithms, the others by the solver's coordinates.
struct Coordinates {
  std::vector<double> at, slope;  // d value / d coordinate

  Coordinates(const SplinePrior& prior, const std::vector<FreeNumber>& free,
              const std::vector<double>& values) {
    for (std::size_t j = 0; j < free.size(); ++j) {
      at.push_back(free[j].coordinate(values[j]));
      slope.push_back(free[j].slope(at.back()));
    }
    for (const SplineLine& line : prior.lines)
      for (const int j : line.numbers) {
        at[j] = std::log(values[j]);
        slope[j] = values[j];
      }
  }
};

std::vector<double> products(const std::vector<double>& jacobian, std::size_t rows, double factor,
                             const Coordinates& coordinates) {
  const auto n = static_cast<Eigen::Index>(coordinates.slope.size());
  const Eigen::Map<const RowMajor> by_value(jacobian.data(), static_cast<Eigen::Index>(rows), n);
  const Eigen::VectorXd slope = Eigen::Map<const Eigen::VectorXd>(coordinates.slope.data(), n);
  const RowMajor all = factor * (slope.asDiagonal() * (by_value.transpose() * by_value) * slope.asDiagonal());
  return std::vector<double>(all.data(), all.data() + n * n);
}

double change(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(std::log(a[i] / b[i])));
  return most;
}

std::string stage_of(int round) { return "polish, again " + std::to_string(round + 1); }

/// One round: inflation and smoothness as the residuals have them, and a descent with these. False if they
/// are what they were, and nothing was done.
bool another_round(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                   const std::vector<CostTerm>& terms, int round, int unknowns, Settled& settled,
                   EvaluationLog& log, std::vector<TraceRow>& trace) {
  const bool any_profiles = settled.prior.any();
  const ProfileCost before(free, terms, log, {{}, {}, settled.prior, settled.inflation, {}});
  const ProfileCost::Point point = before.at(settled.descent.values, any_profiles);
  const double inflation = joint_inflation(before, point, unknowns).factor();
  SplinePrior prior = settled.prior;
  if (any_profiles) {
    std::vector<double> jacobian, prior_jacobian, ignored;
    before.data_jacobian(point, jacobian);
    const Coordinates coordinates(settled.prior, free, point.values);
    SplinePrior of_scale = settled.prior;
    of_scale.smoothness.assign(of_scale.lines.size(), 0.0);
    PriorRows others(free);
    append_rows(of_scale, scene, 1.0, others);
    others.evaluate(point.values, ignored, &prior_jacobian);
    const std::vector<double> probable =
        most_probable_smoothness(prior,
                                 products(jacobian, static_cast<std::size_t>(before.data_residuals()),
                                          1.0 / (inflation * inflation), coordinates),
                                 products(prior_jacobian, others.count(), 1.0, coordinates), coordinates.at,
                                 settled.inflation / inflation, &settled.determined);
    if (scene.fit.profile_smoothness <= 0.0) prior.smoothness = probable;
  }
  const bool same = (round > 0 || !any_profiles) &&
                    change(prior.smoothness, settled.prior.smoothness) < kRoundsSettled &&
                    std::abs(std::log(inflation / settled.inflation)) < kRoundsSettled;
  if (same) return false;
  settled.prior = prior;
  settled.inflation = inflation;
  sim::Scene there = terms.front().scene;
  terms.front().map.put(point.values, there);
  const ProfileCost cost(free, terms, log,
                         {{}, {}, prior, inflation, phase_anchors(there, free, point.values)});
  settled.descent = descend(cost, point.values, kRoundsIterations, stage_of(round), log, trace);
  return true;
}

/// What a round changes of `settled`, as a step's output, and back.
StepOutput output_of_round(const Settled& settled, bool went_on) {
  StepOutput output = output_of(settled.descent);
  output.numbers["smoothness"] = settled.prior.smoothness;
  output.numbers["inflation, determined"] = {settled.inflation, settled.determined};
  output.flags["went on"] = went_on;
  return output;
}

void take(const StepOutput& output, std::size_t free, Settled& settled) {
  settled.descent = descent_of(output, free);
  settled.prior.smoothness = output.numbers_at("smoothness", settled.prior.smoothness.size());
  const std::vector<double>& found = output.numbers_at("inflation, determined", 2);
  settled.inflation = found[0];
  settled.determined = found[1];
}

}  // namespace

double first_smoothness(const sim::Scene& scene) {
  return scene.fit.profile_smoothness > 0.0 ? scene.fit.profile_smoothness : 1.0;
}

Settled settle(const sim::Scene& scene, const std::vector<FreeNumber>& free,
               const std::vector<CostTerm>& terms, const Descent& from, EvaluationLog& log,
               std::vector<TraceRow>& trace, Journal* journal) {
  Settled settled;
  settled.descent = from;
  settled.prior = spline_prior(scene, free, first_smoothness(scene));
  settled.inflation = kFirstPriorWeight;
  int unknowns = static_cast<int>(free.size());
  for (const CostTerm& term : terms) unknowns += term.comparison->coefficients();
  for (int round = 0; round < kRounds && !log.exhausted(); ++round) {
    const StepOutput output = recorded_step(journal, stage_of(round), free.size(), log, trace, [&] {
      Settled next = settled;
      const bool went_on = another_round(scene, free, terms, round, unknowns, next, log, trace);
      return output_of_round(next, went_on);
    });
    take(output, free.size(), settled);
    if (!output.flag_at("went on")) break;
  }
  return settled;
}

}  // namespace vegard::fit
