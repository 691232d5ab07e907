// The error bars of a map: solutions for perturbed data, each with its own values of what is known with
// errors.
//
// The data of a replicate are the best map's light with noise drawn anew (parametric bootstrap, Efron and
// Tibshirani 1993), and its prior, its start, its modes and, from one station, its electrons differ as well.
#pragma once

#include <vector>

#include "fit/map/map_problem.h"

namespace vegard::fit {

/// Adds MapOptions::replicates perturbed solutions to the result, and what the pictures teach of the modes;
/// fewer if it is stopped. `fine`: the pictures of the result.
void add_replicates(MapProblem& problem, std::vector<MapObservation>& fine, MapResult& result);

}  // namespace vegard::fit
