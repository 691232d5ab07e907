// What the stages of a map share: the photographs' scenes, the electrons' energies, the numbers with known
// errors, the modes of the emission tables, and the films, lines of sight and solutions that are made of
// them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fit/map/map_result.h"
#include "fit/map/map_solver.h"

namespace vegard::fit {

inline constexpr int kCoarseSteps = 160, kFineSteps = 320, kReplicateSteps = 80;  ///< of the solver

/// The share of all work that is done at the end of each stage, as far as can be said before.
struct WorkShares {
  double prior = 0.0, coarse = 0.0, map = 0.0;

  explicit WorkShares(const MapOptions& options);
};
/// Solutions in which the prior is usually chosen; one of them is for the modes of the tables.
inline constexpr double kUsualTrials = 6.0;

/// The number of values of all pictures.
std::size_t all_values(const std::vector<MapObservation>& pictures);

class MapProblem {
 public:
  /// The arguments must outlive it. Throws as map_photos().
  MapProblem(const sim::Scene& scene, const std::vector<Photo>& photos, const MapOptions& options);

  const sim::Scene& scene;
  const std::vector<Photo>& photos;
  const MapOptions& options;
  const std::vector<sim::Scene> scenes;    ///< of the photographs
  const std::vector<MapNumber> numbers;    ///< what each replicate draws: of fit.free, and the modes
  const std::vector<double> energies_kev;  ///< E0 of the map's spectrum
  const WorkShares share;
  std::vector<double> modes_before;  ///< coefficients of the modes before a picture is looked at
  std::vector<double> modes;         ///< as they are now
  MapNeighbours near;                ///< of the grid in use

  /// Makes the films of the photographs, with cells that are `coarseness` times those of the fine film. Their
  /// sizes are those of the films of `like`.
  std::vector<MapObservation> pictures(int coarseness) const { return pictures(coarseness, scenes); }
  std::vector<MapObservation> pictures(int coarseness, const std::vector<sim::Scene>& of_scenes,
                                       const std::vector<MapObservation>* like = nullptr) const;
  /// The scenes of the photographs with other values of `numbers`.
  std::vector<sim::Scene> scenes_with(const std::vector<double>& values) const;
  /// Gives the pictures lines of sight over the grid, and the light of the map's electrons for any modes.
  void look(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid);
  /// The same with the light of other electrons, for the modes that the pictures' scenes have.
  void look(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid,
            const sim::ElectronSpectrum& spectrum) const;
  /// The light of other electrons on the lines of sight that the pictures have, for any modes, which are
  /// taken to change it as they change that of the map's electrons. After look().
  void look_by_light(std::vector<MapObservation>& pictures, const sim::ElectronSpectrum& spectrum) const;
  /// The same for the modes and other numbers that these scenes have.
  void look_by_light(std::vector<MapObservation>& pictures, const std::vector<sim::Scene>& of_scenes,
                     const sim::ElectronSpectrum& spectrum) const;
  /// Solves with the modes of the tables, or with what `options` says. Progress is told unless `stage` is
  /// empty.
  MapSolution solve(std::vector<MapObservation>& pictures, std::vector<float> start, double sparsity,
                    int steps, const std::string& stage, double from, double to) const;
  MapSolution solve(std::vector<MapObservation>& pictures, std::vector<float> start, const std::string& stage,
                    double from, double to, MapSolverOptions options) const;

  /// A step of the journal, or what it has of it.
  StepOutput step(const std::string& name, const std::function<StepOutput()>& work) const;
  bool stopped() const { return options.stop != nullptr && *options.stop; }
  void require_going() const {
    if (stopped()) throw MapStopped();
  }

 private:
  std::vector<std::shared_ptr<const sim::ModeRates>> rates_;  ///< of the map's electrons, by picture
};

/// What is wrong with a scene for a map.
sim::Error unfit_for_map(const sim::Scene& scene, const std::string& key, const std::string& problem);

}  // namespace vegard::fit
