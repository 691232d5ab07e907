// Which spectra of the electrons, beside that of the map, a picture leaves open.
//
// A sharper lower border looks like a lower and nearer one, so that a map from one station has the error of
// its electrons' spectrum in its distances, heights and energies. A spectrum with which no map explains the
// picture adds no error.
#pragma once

#include <vector>

#include "fit/map/map_problem.h"

namespace vegard::fit {

/// Solves the coarse problem with electrons of the other kinds (Maxwellian, Gaussian with a spread of 0.25,
/// kappa 4: two of these), as the map was solved from `start`, and puts them in the result. `chi2`: of the
/// coarse map. The pictures keep the light of the last.
void try_other_spectra(MapProblem& problem, std::vector<MapObservation>& coarse,
                       const std::vector<float>& start, double chi2, MapResult& result);

/// Returns the spectrum with which a replicate of a one-station map is made. Every second one has that of the
/// map, the others take turns with those that are left open, if there are any.
sim::ElectronSpectrum replicate_spectrum(const MapResult& result, int replicate);

}  // namespace vegard::fit
