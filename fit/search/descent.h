// One local minimisation of chi2 (a descent) by the Levenberg-Marquardt method.
#pragma once

#include <ceres/cost_function.h>

#include <string>
#include <vector>

#include "fit/compare/profile_cost.h"

namespace vegard::fit {

/// An accepted step, or the best evaluation of a stage.
struct TraceRow {
  std::string stage;   ///< "scan", "descent 2", "polish"
  int evaluation = 0;  ///< residual evaluations so far
  double chi2 = 0.0;
  std::vector<double> values;  ///< of the free parameters, in the order of the fit
};

struct Descent {
  std::vector<double> values;  ///< of the free parameters at the end
  double chi2 = 0.0;           ///< at the end; infinity if nothing was evaluated
  double chi2_initial = 0.0;
  bool converged = false;  ///< by Ceres' tests of the cost, the step or the gradient, or two negligible steps
  std::string termination;  ///< why it ended: vegard's words, then Ceres' message
};

/// Returns "stopped by the user" or "stopped: the evaluations ran out".
std::string words_for_stop(const EvaluationLog& log);

/// Minimises the cost over its free parameters by Ceres (dense QR, or normal equations for many parameters;
/// one thread) from `start`, with at most `iterations` iterations. Every accepted step is added to `trace`.
/// An exhausted log ends the descent after the current step, or before the first.
Descent descend(const ProfileCost& cost, const std::vector<double>& start, int iterations,
                const std::string& stage, EvaluationLog& log, std::vector<TraceRow>& trace);

/// Like descend(). If parameters end at limits at which they did not start, a second descent starts with
/// these a step inside their limits, and the better of the two is returned. Reason: the slope by a coordinate
/// nearly vanishes at a limit, so that a parameter stays there after one long step.
Descent descend_off_limits(const ProfileCost& cost, const std::vector<double>& start, int iterations,
                           const std::string& stage, EvaluationLog& log, std::vector<TraceRow>& trace);

// The relative gradient of chi2 at the end of a descent: a measure of convergence that does not depend on
// units.

/// Returns the largest |cos| of the angle between the residuals and a column of the Jacobian. Its square is
/// the share of chi2 that a change of this one coordinate would remove if the model were linear: 0 at a
/// minimum, 1 if one coordinate could remove all of chi2. Columns that are 0, and those marked in `left_out`,
/// are ignored; NaN if none remains, or if the cost cannot be evaluated.
double gradient_cosine(const ceres::CostFunction& cost, const std::vector<double>& coordinates,
                       const std::vector<bool>& left_out = {});

/// Returns it for a fit's cost at these values, without the parameters that are at a limit.
double gradient_cosine(const ProfileCost& cost, const std::vector<double>& values);

}  // namespace vegard::fit
