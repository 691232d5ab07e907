// What is drawn for one perturbed solution of a map: its data, its prior and its start.
//
// All is a pure function of the scene's seed and of the solution's number. Solutions of a sequence keep their
// numbers from frame to frame: what a picture leaves open, the prior and the smooth error of the model stay,
// and the noise is drawn anew.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/map/cell_reader.h"
#include "fit/map/map_observation.h"

namespace vegard::fit {

struct SolutionDraw {
  std::uint64_t seed = 0;
  std::uint32_t number = 0;

  /// A normal number; `picture` says of what.
  double normal(std::uint32_t picture, std::uint32_t i, std::uint64_t frame = 0) const;

  /// The light `truth` with noise, and with a smooth error of the model.
  MapLight data(const MapObservation& picture, const MapLight& truth, std::uint32_t picture_number,
                std::uint64_t frame, int threads) const;

  double sparsity(double of_map) const;
  /// Factors on the prior's strength, by cell.
  std::vector<float> prior_factors(int cells) const;
  /// The map `from` with fluxes and spectra drawn about it, so that what the data leave open does not come
  /// back to it, and with a little light everywhere, so that what the prior has put out may come back.
  /// `best`: flux and energy of the best map.
  std::vector<float> start(std::vector<float> from, const std::vector<CellFlux>& best,
                           const std::vector<double>& energies_kev) const;
};

}  // namespace vegard::fit
