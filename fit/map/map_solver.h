// Solves for the map that explains photographs: non-negative, sparse, and with spectra that vary along a
// curtain as little as the data allow.
//
// The minimised function of x >= 0 (energy flux by cell and energy) and of the photographs' skies is
//
//     chi2(x) / 2  +  lambda sum over cells  ln(1 + Q'_cell / epsilon)
//                  +  mu / 2 sum over cells  |x - Q p'|^2 / Q'^2
//
// where Q is the flux of a cell, Q' this flux smoothed over the neighbours, so that a cell beside bright ones
// costs little, and p' the neighbours' mean spectrum. Q' and p' are held for a few steps and then computed
// anew (reweighted l1: Candès, Wakin and Boyd 2008, doi:10.1007/s00041-008-9045-x). In between the problem is
// quadratic and is solved by scaled gradient projection (Bonettini, Zanella and Zanni 2009,
// doi:10.1088/0266-5611/25/1/015002): steps along the gradient times x / (A'W A x), which is the direction of
// the multiplicative method, with the step lengths of Barzilai and Borwein.
//
// Where another map predicts this one (that of the frame before, moved), it is held near the prediction y by
//
//     kappa / 2 sum over cells  |x - y|^2 / Q''^2
//
// with Q'' the larger of both smoothed fluxes; Q' then counts what the prediction has, too.
//
// Where the emission tables have modes of their uncertainty, their coefficients m are solved for as well,
// with T/2 |m - m0|^2 added to the function: T is how many values count as one for what changes the light as
// a whole, as they share smooth errors (times chi2 per value, where that is above 1). In between m takes
// steps of Gauss and Newton, with the map's answer (fit/map/mode_response.h).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "fit/map/map_observation.h"
#include "fit/map/mode_response.h"
#include "sim/render/ground/ground_grid.h"

namespace vegard::fit {

struct MapSolverOptions {
  int steps = 600;
  int held = 20;                          ///< steps between two updates of Q' and p'
  int gains_from = 40;                    ///< the step from which unknown gains are solved for
  double sparsity = 1.0;                  ///< lambda
  double energy_bond = 10.0;              ///< mu
  std::vector<float> cell_factor;         ///< factor on lambda, by cell; empty: 1
  std::vector<float> predicted;           ///< y; empty: none
  double time_bond = 0.0;                 ///< kappa
  std::vector<std::uint8_t> unpredicted;  ///< by cell, 1: y says nothing there; empty: it does everywhere
  /// Coefficients of the modes of the tables' uncertainty to begin with, and the means of their normal
  /// priors, whose standard deviation is 1. Empty: they are not solved for.
  std::vector<double> modes, modes_centre;
  int modes_steps = 2;  ///< steps of the modes, spread over the map's
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int step, double chi2)> progress;
};

/// The cells around each, over which Q' and p' are smoothed.
struct MapNeighbours {
  struct Near {
    int cell;
    float weight;
  };
  std::vector<std::vector<Near>> of_cell;  ///< weights sum to 1

  MapNeighbours() = default;
  explicit MapNeighbours(const sim::GroundGrid& grid);
};

struct MapSolution {
  std::vector<float> map;
  std::vector<double> modes;  ///< as the pictures have them now
  double chi2 = 0.0;
  int steps = 0;
};

/// Solves for the map from the initial one, `start`. MapObservation::look_at() must have been called for the
/// grid.
MapSolution solve_map(std::vector<MapObservation>& pictures, const MapNeighbours& near, int energies,
                      std::vector<float> start, const MapSolverOptions& options);

/// What the pictures have taught of the modes, at the solution.
struct MapModes {
  Eigen::MatrixXd spread;  ///< Cholesky's root of the coefficients' covariance
  ModeResponse response;
};

/// `map` is the solution, and options.modes are its coefficients, which the pictures must have.
MapModes solved_modes(std::vector<MapObservation>& pictures, const MapNeighbours& near, int energies,
                      const std::vector<float>& map, const MapSolverOptions& options);

/// A map after a change that is known to first order; no flux becomes negative.
std::vector<float> moved_map(const std::vector<float>& map, const std::vector<float>& change);

}  // namespace vegard::fit
