// What a map of precipitation is asked for, and what it is.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fit/map/cell_reader.h"
#include "fit/map/map_numbers.h"
#include "fit/map/map_observation.h"
#include "fit/map/prior_choice.h"
#include "fit/photo/photo.h"
#include "fit/search/journal.h"
#include "sim/light/spectrum_profile.h"
#include "sim/render/ground/ground_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct MapOptions {
  int threads = 0;           ///< 0: all cores
  int replicates = 16;       ///< perturbed solutions; 0: no error bars
  double sparsity = 0.0;     ///< of the prior (fit/map/map_solver.h); 0: cross-validation chooses
  int pixels_per_cell = 0;   ///< of the fine film, along each side of a cell; 0: by the size of the picture
  double farthest_km = 0.0;  ///< farthest ground that is mapped; 0: by the lowest elevation in the picture
  double altitude_scale = 1.0;  ///< factor on the altitudes of light in the tables
  sim::ElectronSpectrum spectrum;
  Journal* journal = nullptr;
  std::string step_prefix;  ///< before the names of its steps
  const std::atomic<bool>* stop = nullptr;
  /// Called with the present stage and the finished share of all work.
  std::function<void(const std::string& stage, double chi2_per_value, double share)> progress;
};

/// How well a coarse map of electrons with another spectrum than the map's explains the pictures.
struct OtherSpectrum {
  sim::ElectronSpectrum spectrum;
  double chi2_per_value = 0.0;
  /// Fall of chi2 from that of the map's own spectrum, each with modes of the tables of its own and what
  /// these cost, with values that share smooth errors counted as one, and as if chi2 per value of the better
  /// of both were 1, where it is more.
  double better = 0.0;

  static constexpr double kTold = 9.0;  ///< the fall, or rise, of three standard errors
  bool is_open() const { return better > -kTold; }
  bool is_preferred() const { return better > kTold; }
};

/// One photograph and its model in the cells of the film: [cell * 3 + channel].
struct MappedPhoto {
  std::string name;
  sim::Scene scene;
  sim::FilmGeometry film;
  MapLight data, sigma, model, sky;  ///< sigma 0: not used
  std::array<double, 3> gain{1.0, 1.0, 1.0};
  double chi2 = 0.0;
  std::size_t values = 0;
};

struct MapResult {
  MapResult(sim::Scene mapped, sim::GroundGrid cells_of_map)
      : scene(std::move(mapped)), grid(std::move(cells_of_map)) {}

  sim::Scene scene;                ///< its emission has the modes that were found
  std::vector<MapNumber> numbers;  ///< numbers for which each replicate has its own values, as known before
  double altitude_scale = 1.0;     ///< factor on the altitudes of light in the tables
  sim::ElectronSpectrum spectrum;
  sim::GroundGrid grid;
  std::vector<double> energies_kev;  ///< E0 of the spectrum
  std::vector<float> map;            ///< in the layout of GroundLight
  std::vector<CellFlux> cells;
  std::vector<float> ln_energy_around;  ///< CellFlux::ln_energy over a wider neighbourhood of the cell
  std::vector<std::vector<CellFlux>> replicates;         ///< perturbed solutions
  std::vector<sim::ElectronSpectrum> replicate_spectra;  ///< of each; its E0 is that of `spectrum` at the
                                                         ///< same mean energy
  Eigen::MatrixXd modes_covariance;  ///< of the modes in `scene`; empty without modes or error bars
  std::vector<std::vector<double>>
      replicate_values;  ///< of `numbers`; the modes drawn from what the pictures leave open
  std::vector<std::uint8_t>
      border_in_view;  ///< whether light at the cell's lower border is in a used part of a picture
  std::vector<float> sensitivity;  ///< signal-to-noise ratio of 1 mW m^-2 in this cell alone
  double sparsity = 0.0;
  std::vector<MapTrial> trials;
  std::vector<OtherSpectrum> spectra;  ///< of one station's map with error bars; else empty
  double chi2 = 0.0, chi2_without_aurora = 0.0;
  std::size_t values = 0;
  std::vector<MappedPhoto> photos;
  bool interrupted = false;

  /// chi2 divided by the number of values; the number of unknowns is not subtracted, since it is not known
  /// how many the prior leaves free.
  double chi2_per_value() const { return values > 0 ? chi2 / static_cast<double>(values) : 0.0; }
};

/// Whether all pictures are from one place. Such a map cannot tell the height of a border from its distance.
bool is_of_one_station(const MapResult& result);
bool is_of_one_station(const std::vector<sim::Scene>& scenes);

/// Whether cross-validation chose the weakest prior that was tried.
bool is_prior_at_its_end(const MapResult& result);

/// Whether light 105 km high over a foot falls on a used part of one of the pictures.
bool is_border_in_view(const MapResult& result, sim::EastNorth foot_km);

/// Factor by which the replicates' spread of ln E0 is too small, found from synthetic pictures of curtains
/// (docs/validation.md).
inline constexpr double kEnergyInflation = 1.5;

/// Standard errors of the quantities of a cell; NaN without replicates.
struct CellError {
  double relative_flux = 0.0;
  double ln_energy = 0.0;
};

/// Returns standard errors from the replicates' spread about the best map. That of the energy includes in
/// quadrature the difference from the energy of a wider neighbourhood: one picture hardly constrains the
/// energy across a curtain.
std::vector<CellError> cell_errors(const MapResult& result);

/// Thrown if options.stop is set before there is a map; the finished steps are in the journal.
struct MapStopped : std::runtime_error {
  MapStopped() : std::runtime_error("the map was stopped before there was one") {}
};

}  // namespace vegard::fit
