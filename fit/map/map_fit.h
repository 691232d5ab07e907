// The fit of a precipitation map to photographs: all of `vegard map` between reading and writing.
//
// Stages, each a finished step of the journal: the map on a coarse film at several strengths of the prior, of
// which left-out blocks of the picture choose one (cross-validation, Stone 1974); the map on the fine film,
// over the cells where the coarse one has light; solutions of perturbed data, from which error bars follow.
// The same scene and photographs give the same bytes for every number of threads.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "fit/map/map_numbers.h"
#include "fit/map/map_picture.h"
#include "fit/photo/photo.h"
#include "fit/search/journal.h"
#include "sim/render/ground/ground_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct MapOptions {
  int threads = 0;              ///< 0: all cores
  int replicates = 16;          ///< perturbed solutions; 0: no error bars
  double sparsity = 0.0;        ///< of the prior (fit/map/map_solver.h); 0: cross-validation chooses
  int pixels_per_cell = 0;      ///< of the fine film, along either side; 0: by the size of the picture
  double farthest_km = 0.0;     ///< of the ground; 0: by the lowest elevation in the picture
  double altitude_scale = 1.0;  ///< at so many times the tables' altitudes stands all light
  Journal* journal = nullptr;
  const std::atomic<bool>* stop = nullptr;
  /// What is being done, and which share of all work is behind.
  std::function<void(const std::string& stage, double chi2_per_value, double share)> progress;
};

/// What one solution says of a cell.
struct CellFlux {
  float flux_mw_m2 = 0.0f;
  float ln_energy = 0.0f;  ///< mean of ln(E0 / keV) by energy flux; of an empty cell without a meaning
};

/// One photograph and its model, in the cells of the film: as [cell * 3 + channel].
struct MappedPhoto {
  std::string name;
  sim::Scene scene;
  sim::FilmGeometry film;
  MapLight data, sigma, model, sky;  ///< sigma 0: not used
  std::array<double, 3> gain{1.0, 1.0, 1.0};
  double chi2 = 0.0;
  std::size_t values = 0;
};

struct MapTrial {
  double sparsity = 0.0;
  double left_out = 0.0;  ///< mean of ln(1 + r²/2) over values left out, and its standard error
  double error = 0.0;
};

struct MapResult {
  sim::Scene scene;
  std::vector<MapNumber> numbers;  ///< that the replicates have values of their own for
  double altitude_scale = 1.0;     ///< at so many times the tables' altitudes stands all light
  sim::GroundGrid grid;
  std::vector<double> energies_kev;
  std::vector<float> map;  ///< as GroundLight has it
  std::vector<CellFlux> cells;
  std::vector<float> ln_energy_around;            ///< as CellFlux, of a wider neighbourhood
  std::vector<std::vector<CellFlux>> replicates;  ///< perturbed solutions
  std::vector<std::uint8_t>
      border_in_view;  ///< whether light at the cell's lower border is in a used part of a picture
  std::vector<float> sensitivity;  ///< signal to noise ratio of 1 mW m^-2 in the cell by itself
  double sparsity = 0.0;
  std::vector<MapTrial> trials;
  double chi2 = 0.0, chi2_without_aurora = 0.0;
  std::size_t values = 0;
  std::vector<MappedPhoto> photos;
  bool interrupted = false;

  /// How many unknowns the prior leaves free is not known, so none are taken off the values.
  double chi2_per_value() const { return values > 0 ? chi2 / static_cast<double>(values) : 0.0; }
};

/// Whether the prior that left-out blocks asked for is the weakest that was tried.
bool is_prior_at_its_end(const MapResult& result);

/// Whether light 105 km high over a foot falls on a used part of one of the pictures.
bool is_border_in_view(const MapResult& result, sim::EastNorth foot_km);

/// On made pictures of curtains the replicates' spread of ln E0 is by so much too small (docs/validation.md).
inline constexpr double kEnergyInflation = 1.5;

/// Standard errors of what is said of a cell; NaN without replicates.
struct CellError {
  double relative_flux = 0.0;
  double ln_energy = 0.0;
};

/// From the replicates' spread about the best map. To that of the energy comes how far it is from that of a
/// wider neighbourhood: across a curtain one picture hardly constrains it.
std::vector<CellError> cell_errors(const MapResult& result);

/// Maps the scene's photographs: `photos` are those of scene.fit.photos in their order, or the only one.
/// Sheets and other emitters of the scene are left out. Throws sim::Error(scene) for sizes that differ, a
/// picture without usable sky (a camera that looks down), stations without a common volume, and
/// sim::Error(unreadable_input) for a picture without light above its noise.
MapResult map_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const MapOptions& options);

}  // namespace vegard::fit
