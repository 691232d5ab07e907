#include "fit/map/map_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/radar/radar_refusal.h"
#include "sim/base/error.h"
#include "sim/scene/table/photo_scene.h"
#include "sim/scene/table/value_check.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kMinEnergy_kev = 0.4, kMaxEnergy_kev = 14.0;  // E0 of Maxwellian electrons
constexpr double kFluxOfRates = 1.0;                           // mW m^-2, the tables' own
constexpr double kFilmCells = 40000.0;
constexpr double kFineCost = 3.5;   // of a step on the fine film, in those on the coarse one
constexpr int kStepsOfModes = 160;  // steps of the map to one of the modes

/// E0 of a spectrum at the mean energies that Maxwellian electrons have.
std::vector<double> energy_nodes(const sim::ElectronSpectrum& spectrum) {
  std::vector<double> energies;
  const double least = kMinEnergy_kev * (sim::mean_energy_over_e0({}) / sim::mean_energy_over_e0(spectrum));
  for (int k = 0; k < kGroundEnergies; ++k)
    energies.push_back(least * std::pow(kMaxEnergy_kev / kMinEnergy_kev, k / (kGroundEnergies - 1.0)));
  return energies;
}

std::vector<sim::Scene> scenes_of(const sim::Scene& scene, const std::vector<Photo>& photos) {
  refuse_radars(scene, "a map");
  std::vector<sim::Scene> scenes;
  if (scene.fit.photos.empty())
    scenes.push_back(scene);
  else
    for (const sim::PhotoEntry& entry : scene.fit.photos) scenes.push_back(sim::scene_of_photo(scene, entry));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const sim::Field& field = scenes[i].field;
    if (field.inclination_deg != scene.field.inclination_deg ||
        field.declination_deg != scene.field.declination_deg || field.model != scene.field.model)
      throw unfit_for_map(scene, "fit.photo.set",
                          "the photograph " + scene.fit.photos[i].name + " sets a magnetic field of its own")
          .expected("one field for the map, that of the scene")
          .hint("field.model = \"dipole\" has at each place what belongs there");
    const sim::Emission& light = scenes[i].emission;
    if (light.tables != scene.emission.tables || light.uncertainty != scene.emission.uncertainty ||
        light.modes != scene.emission.modes)
      throw unfit_for_map(scene, "fit.photo.set",
                          "the photograph " + scene.fit.photos[i].name + " sets emission tables of its own")
          .expected("emission.tables, .uncertainty and .modes of all photographs");
    if (scenes[i].blur.model != sim::BlurModel::angle || scenes[i].blur.order != sim::BlurOrder::lines)
      throw unfit_for_map(scene, scenes[i].blur.model != sim::BlurModel::angle ? "blur.model" : "blur.order",
                          "a map blurs each line by its angle")
          .expected("blur.model = \"angle\" and blur.order = \"lines\"");
    const sim::Camera& camera = scenes[i].camera;
    const sim::Image& picture = photos[i].linear;
    if (camera.width != picture.width || camera.height != picture.height)
      throw unfit_for_map(scene, "camera.width",
                          "the camera has " + sim::size_text(camera.width, camera.height) + " pixels, " +
                              photos[i].file_name + " has " + sim::size_text(picture.width, picture.height))
          .expected("the photograph's size")
          .hint("set camera.width and camera.height");
  }
  return scenes;
}

int fine_pixels(const sim::Camera& camera) {
  const double pixels = static_cast<double>(camera.width) * camera.height;
  return std::max(1, static_cast<int>(std::sqrt(pixels / kFilmCells)));
}

std::vector<MapNumber> numbers_of(const sim::Scene& scene) {
  std::vector<MapNumber> numbers = map_numbers(scene);
  const std::vector<MapNumber> modes = mode_numbers(scene);
  numbers.insert(numbers.end(), modes.begin(), modes.end());
  return numbers;
}

}  // namespace

sim::Error unfit_for_map(const sim::Scene& scene, const std::string& key, const std::string& problem) {
  return sim::Error(sim::ErrorKind::scene, problem).file(scene.file).key(key);
}

std::size_t all_values(const std::vector<MapObservation>& pictures) {
  std::size_t sum = 0;
  for (const MapObservation& p : pictures) sum += p.values();
  return sum;
}

WorkShares::WorkShares(const MapOptions& options) {
  const double trials = options.sparsity > 0.0 ? 0.0 : kUsualTrials * kCoarseSteps;
  const double fine = kFineCost * kFineSteps, bars = kFineCost * kReplicateSteps * options.replicates;
  const double all = trials + kCoarseSteps + fine + bars;
  prior = trials / all;
  coarse = prior + kCoarseSteps / all;
  map = coarse + fine / all;
}

MapProblem::MapProblem(const sim::Scene& of_scene, const std::vector<Photo>& of_photos,
                       const MapOptions& with_options)
    : scene(of_scene),
      photos(of_photos),
      options(with_options),
      scenes(scenes_of(of_scene, of_photos)),
      numbers(numbers_of(of_scene)),
      energies_kev(energy_nodes(with_options.spectrum)),
      share(with_options) {
  for (const MapNumber& number : numbers)
    if (number.mode >= 0) modes_before.push_back(number.value);
  modes = modes_before;
}

std::vector<MapObservation> MapProblem::pictures(int coarseness, const std::vector<sim::Scene>& of_scenes,
                                                 const std::vector<MapObservation>* like) const {
  std::vector<MapObservation> all;
  for (std::size_t i = 0; i < of_scenes.size(); ++i) {
    MapObservationOptions o;
    o.pixels_per_cell = coarseness * (options.pixels_per_cell > 0 ? options.pixels_per_cell
                                                                  : fine_pixels(of_scenes[i].camera));
    o.model_error = of_scenes[i].fit.model_error;
    o.threads = options.threads;
    o.stop = options.stop;
    require_going();
    if (like != nullptr) {
      const sim::FilmGeometry& film = (*like)[i].film();
      o.margin_cells = static_cast<int>(std::lround(-film.x0_px / film.cell_width_px));
    }
    all.emplace_back(of_scenes[i], photos[i], o);
    if (all.back().values() == 0)
      throw unfit_for_map(scene, "camera.elevation_deg",
                          "no usable pixel of " + photos[i].file_name + " looks at the sky")
          .expected("a camera that sees the sky above its horizon, and a mask that leaves it")
          .hint("check the camera's direction, the mask and fit.roi_px");
  }
  return all;
}

std::vector<sim::Scene> MapProblem::scenes_with(const std::vector<double>& values) const {
  return scenes_of(scene_with(scene, numbers, values), photos);
}

void MapProblem::look(std::vector<MapObservation>& of_pictures, const sim::GroundGrid& grid,
                      const sim::ElectronSpectrum& spectrum) const {
  for (MapObservation& picture : of_pictures)
    picture.look_at(scene.site, grid, energy_nodes(spectrum), kFluxOfRates, options.altitude_scale, spectrum);
  require_going();  // light that was not finished is none to go on with
}

void MapProblem::look(std::vector<MapObservation>& of_pictures, const sim::GroundGrid& grid) {
  look(of_pictures, grid, options.spectrum);
  for (std::size_t p = rates_.size(); p < of_pictures.size(); ++p)
    rates_.push_back(std::make_shared<sim::ModeRates>(scenes[p], energies_kev, kFluxOfRates,
                                                      options.altitude_scale, options.spectrum));
  for (std::size_t p = 0; p < of_pictures.size(); ++p) of_pictures[p].set_light(rates_[p], modes);
}

void MapProblem::look_by_light(std::vector<MapObservation>& of_pictures,
                               const sim::ElectronSpectrum& spectrum) const {
  for (std::size_t p = 0; p < of_pictures.size(); ++p) {
    sim::Scene without = scenes[p];
    if (!modes.empty()) without.emission.modes.clear();
    std::vector<float> rates =
        sim::ground_rates(without, energy_nodes(spectrum), kFluxOfRates, options.altitude_scale, spectrum);
    of_pictures[p].set_light(std::make_shared<sim::ModeRates>(rates_.at(p)->of_other(std::move(rates))),
                             modes);
  }
}

void MapProblem::look_by_light(std::vector<MapObservation>& of_pictures,
                               const std::vector<sim::Scene>& of_scenes,
                               const sim::ElectronSpectrum& spectrum) const {
  for (std::size_t p = 0; p < of_pictures.size(); ++p)
    of_pictures[p].look_by_light_of(of_scenes[p], energy_nodes(spectrum), kFluxOfRates,
                                    options.altitude_scale, spectrum);
}

MapSolution MapProblem::solve(std::vector<MapObservation>& pictures, std::vector<float> start,
                              double sparsity, int steps, const std::string& stage, double from,
                              double to) const {
  MapSolverOptions o;
  o.steps = steps;
  o.sparsity = sparsity;
  o.modes = modes;
  o.modes_centre = modes_before;
  o.modes_steps = steps / kStepsOfModes;
  return solve(pictures, std::move(start), stage, from, to, std::move(o));
}

MapSolution MapProblem::solve(std::vector<MapObservation>& pictures, std::vector<float> start,
                              const std::string& stage, double from, double to, MapSolverOptions o) const {
  o.stop = options.stop;
  const auto values = static_cast<double>(all_values(pictures));
  const int steps = o.steps;
  if (options.progress && !stage.empty())
    o.progress = [&](int step, double chi2) {
      if (step % 10 == 0) options.progress(stage, chi2 / values, from + (to - from) * step / steps);
    };
  return solve_map(pictures, near, static_cast<int>(energies_kev.size()), std::move(start), o);
}

StepOutput MapProblem::step(const std::string& name, const std::function<StepOutput()>& work) const {
  return options.journal != nullptr ? options.journal->step(options.step_prefix + name, work) : work();
}

}  // namespace vegard::fit
