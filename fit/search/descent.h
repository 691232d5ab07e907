// One way downhill: Levenberg-Marquardt from one start.
#pragma once

#include <string>
#include <vector>

#include "fit/compare/profile_cost.h"

namespace vegard::fit {

/// One evaluation that was accepted, or the best of a stage.
struct TraceRow {
  std::string stage;   ///< "scan", "descent 2", "polish"
  int evaluation = 0;  ///< residual evaluations so far
  double chi2 = 0.0;
  std::vector<double> values;  ///< of the free parameters, in the order of the fit
};

struct Descent {
  std::vector<double> values;  ///< where it ended
  double chi2 = 0.0;           ///< there; infinity if nothing was evaluated
  double chi2_initial = 0.0;
  bool converged = false;  ///< by Ceres' tests of the cost, the step or the gradient, or two negligible steps
  std::string termination;  ///< in words, Ceres' own after ours
};

/// "stopped by the user" or "stopped: the evaluations ran out".
std::string words_for_stop(const EvaluationLog& log);

/// Of what the cost moves. Runs Ceres (dense QR, of many parameters normal equations; one thread) from
/// `start` for at most `iterations`. Every accepted step goes to `trace`. A log that is exhausted ends the
/// descent after the step under way, or before the first.
Descent descend(const ProfileCost& cost, const std::vector<double>& start, int iterations,
                const std::string& stage, EvaluationLog& log, std::vector<TraceRow>& trace);

/// The same; where it ends with numbers at limits that it did not start from, it goes on once more with these
/// a step inside. At a limit a coordinate has next to no slope left, so that one long step towards it may be
/// the last. The better of both ends.
Descent descend_off_limits(const ProfileCost& cost, const std::vector<double>& start, int iterations,
                           const std::string& stage, EvaluationLog& log, std::vector<TraceRow>& trace);

}  // namespace vegard::fit
