#include "fit/search/descent.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/base/text.h"

namespace vegard::fit {
namespace {

constexpr double kFunctionTolerance = 3e-5;  // of the cost: far below what an error bar could show
constexpr double kParameterTolerance = 1e-7;
/// Of chi2 over the inflation squared: a seventh of a standard deviation. A model with its own Monte-Carlo
/// noise creeps on for dozens of steps like that.
constexpr double kNegligible = 0.02;
constexpr int kSmallSteps = 2;
constexpr double kStepInside = 2.0;  // from the start, in the solver's coordinate

constexpr std::size_t kMaxForQr = 40;

class Tracer : public ceres::IterationCallback {
 public:
  Tracer(const ProfileCost& cost, const std::vector<double>& coordinates, const std::string& stage,
         const EvaluationLog& log, std::vector<TraceRow>& trace)
      : cost_(cost), coordinates_(coordinates), stage_(stage), log_(log), trace_(trace) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.step_is_successful || summary.iteration == 0) {
      trace_.push_back({stage_, log_.residuals, 2.0 * summary.cost, cost_.values(coordinates_.data())});
    }
    const bool little = summary.step_is_successful && summary.iteration > 0 &&
                        2.0 * summary.cost_change < kNegligible * cost_.prior_weight() * cost_.prior_weight();
    small_steps_ = little ? small_steps_ + 1 : 0;
    level_ = small_steps_ >= kSmallSteps;
    if (level_) return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    // Not an abort, which would be a failure and leave the best point behind.
    return log_.exhausted() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  /// The last steps were of no account.
  bool level() const { return level_; }

 private:
  const ProfileCost& cost_;
  const std::vector<double>& coordinates_;
  const std::string& stage_;
  const EvaluationLog& log_;
  std::vector<TraceRow>& trace_;
  int small_steps_ = 0;
  bool level_ = false;
};

/// What the solver's message means, then the message.
std::string in_words(const ceres::Solver::Summary& summary) {
  std::string words;
  switch (summary.termination_type) {
    case ceres::USER_SUCCESS:  // the tracer, and not because the evaluations ran out
      words = "converged: the last steps hardly changed chi2";
      break;
    case ceres::CONVERGENCE:
      words = "converged";
      if (sim::starts_with(summary.message, "Function tolerance"))
        words += ": another step would hardly change chi2";
      else if (sim::starts_with(summary.message, "Parameter tolerance"))
        words += ": another step would hardly move the parameters";
      else if (sim::starts_with(summary.message, "Gradient tolerance"))
        words += ": the gradient of chi2 vanishes";
      break;
    case ceres::NO_CONVERGENCE:
      words = "not converged within the iterations of a descent";
      break;
    default:
      words = "the solver failed";
  }
  return words + " (Ceres: " + summary.message + ")";
}

}  // namespace

std::string words_for_stop(const EvaluationLog& log) {
  return log.stop != nullptr && log.stop->load() ? "stopped by the user" : "stopped: the evaluations ran out";
}

Descent descend(const ProfileCost& cost, const std::vector<double>& start, int iterations,
                const std::string& stage, EvaluationLog& log, std::vector<TraceRow>& trace) {
  Descent result;
  if (log.exhausted()) {
    result.values = start;
    result.chi2 = result.chi2_initial = std::numeric_limits<double>::infinity();
    result.termination = words_for_stop(log);
    return result;
  }
  std::vector<double> coordinates = cost.coordinates(start);

  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(const_cast<ProfileCost*>(&cost), nullptr, coordinates.data());

  Tracer tracer(cost, coordinates, stage, log, trace);
  ceres::Solver::Options options;
  // Orthogonalising tens of thousands of rows by a hundred columns takes longer than the rest, and gains
  // nothing where the columns are logarithms and the priors' rows tie them together.
  options.linear_solver_type =
      coordinates.size() > kMaxForQr ? ceres::DENSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  options.num_threads = 1;  // the simulator has the threads, and adds in a fixed order
  options.max_num_iterations = iterations;
  options.function_tolerance = kFunctionTolerance;
  options.parameter_tolerance = kParameterTolerance;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  options.callbacks.push_back(&tracer);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  result.values = cost.values(coordinates.data());
  result.chi2 = 2.0 * summary.final_cost;
  result.chi2_initial = 2.0 * summary.initial_cost;
  if (summary.initial_cost < 0.0) {  // Ceres' word for a start that could not be evaluated
    result.values = start;
    result.chi2 = result.chi2_initial = std::numeric_limits<double>::infinity();
  }
  result.converged = summary.termination_type == ceres::CONVERGENCE || tracer.level();
  const bool stopped = summary.termination_type == ceres::USER_SUCCESS && !tracer.level();
  result.termination = stopped ? words_for_stop(log) : in_words(summary);
  return result;
}

Descent descend_off_limits(const ProfileCost& cost, const std::vector<double>& start, int iterations,
                           const std::string& stage, EvaluationLog& log, std::vector<TraceRow>& trace) {
  Descent end = descend(cost, start, iterations, stage, log, trace);
  if (!std::isfinite(end.chi2) || log.exhausted()) return end;
  const std::vector<FreeNumber>& moved = cost.moved();
  std::vector<double> inside = end.values;
  for (std::size_t j = 0; j < moved.size(); ++j) {
    if (!moved[j].at_limit(end.values[j]) || moved[j].at_limit(start[j])) continue;
    const double from = moved[j].coordinate(start[j]), to = moved[j].coordinate(end.values[j]);
    if (std::abs(to - from) <= kStepInside) continue;
    inside[j] = moved[j].value(from + std::clamp(to - from, -kStepInside, kStepInside));
  }
  if (inside == end.values) return end;
  Descent again = descend(cost, inside, iterations, stage, log, trace);
  again.chi2_initial = end.chi2_initial;
  return again.chi2 < end.chi2 ? again : end;
}

double gradient_cosine(const ceres::CostFunction& cost, const std::vector<double>& coordinates,
                       const std::vector<bool>& left_out) {
  const auto rows = static_cast<std::size_t>(cost.num_residuals());
  const std::size_t n = coordinates.size();
  std::vector<double> residuals(rows), jacobian(rows * n);
  const double* parameters[] = {coordinates.data()};
  double* jacobians[] = {jacobian.data()};
  if (!cost.Evaluate(parameters, residuals.data(), jacobians))
    return std::numeric_limits<double>::quiet_NaN();
  double chi2 = 0.0;
  for (const double r : residuals) chi2 += r * r;
  double steepest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t j = 0; j < n; ++j) {
    if (j < left_out.size() && left_out[j]) continue;
    double along = 0.0, square = 0.0;
    for (std::size_t k = 0; k < rows; ++k) {
      along += jacobian[k * n + j] * residuals[k];
      square += jacobian[k * n + j] * jacobian[k * n + j];
    }
    if (square > 0.0 && chi2 > 0.0)
      steepest = std::fmax(steepest, std::abs(along) / std::sqrt(square * chi2));
  }
  return steepest;
}

double gradient_cosine(const ProfileCost& cost, const std::vector<double>& values) {
  std::vector<double> coordinates;
  std::vector<bool> at_limit;
  for (std::size_t j = 0; j < values.size(); ++j) {
    coordinates.push_back(cost.moved()[j].coordinate(values[j]));
    at_limit.push_back(cost.moved()[j].at_limit(values[j]));
  }
  return gradient_cosine(cost, coordinates, at_limit);
}

}  // namespace vegard::fit
