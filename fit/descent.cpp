#include "fit/descent.h"

#include <ceres/ceres.h>

namespace vegard::fit {
namespace {

constexpr double kFunctionTolerance = 1e-4;  // of the cost: far below what an error bar could show
constexpr double kParameterTolerance = 1e-7;

class Tracer : public ceres::IterationCallback {
 public:
  Tracer(const std::vector<FreeNumber>& free, const std::vector<double>& coordinates,
         const std::string& stage, const EvaluationLog& log, std::vector<TraceRow>& trace)
      : free_(free), coordinates_(coordinates), stage_(stage), log_(log), trace_(trace) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.step_is_successful || summary.iteration == 0) {
      TraceRow row{stage_, log_.residuals, 2.0 * summary.cost, {}};
      for (std::size_t j = 0; j < free_.size(); ++j) row.values.push_back(free_[j].value(coordinates_[j]));
      trace_.push_back(std::move(row));
    }
    return log_.exhausted() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::vector<FreeNumber>& free_;
  const std::vector<double>& coordinates_;
  const std::string& stage_;
  const EvaluationLog& log_;
  std::vector<TraceRow>& trace_;
};

}  // namespace

Descent descend(const ProfileCost& cost, const std::vector<FreeNumber>& free,
                const std::vector<double>& start, int iterations, const std::string& stage,
                EvaluationLog& log, std::vector<TraceRow>& trace) {
  std::vector<double> coordinates(free.size());
  for (std::size_t j = 0; j < free.size(); ++j) coordinates[j] = free[j].coordinate(start[j]);

  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(const_cast<ProfileCost*>(&cost), nullptr, coordinates.data());

  Tracer tracer(free, coordinates, stage, log, trace);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;  // the simulator has the threads, and adds in a fixed order
  options.max_num_iterations = iterations;
  options.function_tolerance = kFunctionTolerance;
  options.parameter_tolerance = kParameterTolerance;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  options.callbacks.push_back(&tracer);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  Descent result;
  for (std::size_t j = 0; j < free.size(); ++j) result.values.push_back(free[j].value(coordinates[j]));
  result.chi2 = 2.0 * summary.final_cost;
  result.chi2_initial = 2.0 * summary.initial_cost;
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.termination = summary.message;
  return result;
}

}  // namespace vegard::fit
