// How a map of precipitation answers to the modes of the emission tables' uncertainty: if the light of the
// electrons is another, the map that explains the photographs best is another as well.
//
// About a map x and the modes' coefficients m, the function that the map's solver minimises
// (fit/map/map_solver.h) is quadratic. For a shift of m along v the map answers with -X, the solution of
//
//     A' W A X = A' W B v
//
// where A x is the light of a map, B v that which the shift adds, and W the weights with what the sky
// explains taken away. Cells without light have none to answer with. Sparsity and the bond between spectra
// are left out: they do not ask how bright a map is, nor where its light is, and would else hold it. What the
// photographs tell of the modes, whatever the map, is Schur's complement
//
//     S = (B - A X)' W (B - A X).
//
// X is found by conjugate gradients, preconditioned by x over the positive part of the gradient, which leads
// the solver's steps too. They are ended early: small details of the map have no part in its answer. Nor have
// gains that are solved for beside the map.
#pragma once

#include <atomic>
#include <vector>

#include <Eigen/Core>

#include "fit/map/map_observation.h"

namespace vegard::fit {

/// A map and the function about it.
struct MapCurvature {
  std::vector<MapObservation>& pictures;
  const std::vector<float>& map;
  const std::vector<MapLight>& light;     ///< of the map, by picture
  const std::vector<float>& scale;        ///< x times it preconditions
  const std::vector<MapLight>& residual;  ///< by picture, times the weights
  const std::vector<float>&
      gradient;  ///< of the function by the map, but for what sparsity wants of all light
  const std::atomic<bool>* stop = nullptr;  ///< once true, what is left has no answer
};

struct ModeResponse {
  /// [mode][direction]: shifts of the modes, of which the data might tell; orthonormal.
  Eigen::MatrixXd directions;
  std::vector<std::vector<float>> map_by_direction;  ///< X, by direction
  Eigen::MatrixXd information;                       ///< S, of all modes
  Eigen::VectorXd gradient;  ///< of the function by the modes, where the map answers; without their prior

  /// The map's answer to a shift of the modes.
  std::vector<float> answer(const Eigen::VectorXd& shift) const;
};

/// Computes it for modes with a prior of this precision beside chi2 / 2. Directions of which the photographs
/// tell less than half of what the prior does are left without an answer of the map.
ModeResponse mode_response(const MapCurvature& about, int modes, double prior);

}  // namespace vegard::fit
