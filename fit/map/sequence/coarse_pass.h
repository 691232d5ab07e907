// The pass forward on the coarse film: where the light is, how it moves, and how strongly a map is held near
// the one before it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fit/map/sequence/sequence_level.h"

namespace vegard::fit {

inline constexpr double kLongestStep_s = 120.0;            ///< nothing is carried over longer gaps
inline constexpr int kBeginSteps = 160, kFrameSteps = 60;  ///< of the solver

/// What the pass forward knows after a frame, on the coarse film.
struct CoarseState {
  bool begun = false;
  double time_s = 0.0;
  std::vector<float> map;
  std::vector<std::uint8_t> in_view;  ///< cells_in_view()
  DriftField drift;                   ///< since the frame before
};

/// How a picture was predicted.
struct CoarsePrediction {
  bool wants_gain = false;  ///< whether `gain` is found, which costs another solution
  double chi2 = 0.0;        ///< of the picture as predicted
  std::size_t values = 0;
  double gain = 1.0;  ///< how far the picture takes the map from the prediction, of how far it does alone
};

class CoarsePass {
 public:
  /// `first_map`: a map of the level's grid, from which a frame begins that nothing predicts. The problem and
  /// the level must outlive it.
  CoarsePass(const MapProblem& problem, const SequenceLevel& level, std::vector<float> first_map,
             double sparsity)
      : problem_(problem), level_(level), first_map_(std::move(first_map)), sparsity_(sparsity) {}

  /// The next state. `bond`: MapSolverOptions::time_bond; `gains`: of the picture's channels to begin with.
  CoarseState step(const CoarseState& before, const Photo& photo, double time_s, double bond,
                   const std::array<double, 3>& gains, CoarsePrediction* prediction) const;

 private:
  MapSolution solved(std::vector<MapObservation>& picture, std::vector<float> start,
                     MapSolverOptions o) const;

  const MapProblem& problem_;
  const SequenceLevel& level_;
  std::vector<float> first_map_;
  double sparsity_ = 0.0;
};

/// How well maps predict the next picture with a bond (MapSolverOptions::time_bond).
struct TriedBond {
  double bond = 0.0, chi2_per_value = 0.0;
};

struct TimeBond {
  std::vector<TriedBond> tried;
  double bond = 0.0;    ///< at frames `step_s` apart
  double step_s = 0.0;  ///< the median from one frame to the next
  double gain = 1.0;    ///< how much of a frame's map is its own picture's; the rest is of the frames before
};

/// Chooses the bond by the first frames from number `from` on. `tell` is called now and then.
TimeBond choose_time_bond(const MapProblem& problem, const CoarsePass& pass,
                          const std::vector<double>& time_s, std::size_t from,
                          const std::function<Photo(std::size_t)>& read, const std::array<double, 3>& gains,
                          const std::function<void()>& tell);

}  // namespace vegard::fit
