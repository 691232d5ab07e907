#include "fit/map/map_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "fit/map/map_grid.h"
#include "fit/map/map_solver.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/scene/table/photo_scene.h"
#include "sim/scene/table/value_check.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kMinEnergy_kev = 0.4, kMaxEnergy_kev = 14.0;  // E0 of Maxwellian electrons
constexpr double kFluxOfRates = 1.0;                           // mW m^-2, the tables' own
constexpr double kFilmCells = 40000.0;
constexpr double kKeptShare = 3e-3, kKeptReach_km = 12.0;
constexpr double kFineCost = 3.5;     // of a step on the fine film, in those on the coarse one
constexpr double kUsualTrials = 6.0;  // one of them for the modes of the tables
constexpr int kCoarseSteps = 160, kFineSteps = 320, kReplicateSteps = 80;
constexpr int kStepsOfModes = 160;  // steps of the map to one of the modes
// Priors are tried from the strongest on, until what is left out has been predicted worse for so many in a
// row. There are no weaker ones: of real photographs left-out blocks of the coarse film ask for ever weaker
// ones, which make up for the film's coarseness, explain the fine film no better, and leave error bars up to
// twice as wide.
constexpr double kTrials[] = {16.0, 8.0, 4.0, 2.0, 1.0, 0.5};
constexpr int kWorseTrials = 2;
constexpr double kWideReach_km = 10.0;
constexpr double kUsualSparsity = 4.0;
constexpr double kPriorSpread = 0.7;  // standard deviation of the logarithm of a replicate's sparsity
// How far a replicate starts from the best map, as standard deviations of logarithms: by cell the prior's
// strength, the flux, and the spectrum's slope (d ln x / d ln E).
constexpr double kCellPriorSpread = 1.0, kFluxSpread = 0.7, kTiltSpread = 1.4;

/// E0 of a spectrum at the mean energies that Maxwellian electrons have.
std::vector<double> energy_nodes(const sim::ElectronSpectrum& spectrum) {
  std::vector<double> energies;
  const double least = kMinEnergy_kev * (sim::mean_energy_over_e0({}) / sim::mean_energy_over_e0(spectrum));
  for (int k = 0; k < kGroundEnergies; ++k)
    energies.push_back(least * std::pow(kMaxEnergy_kev / kMinEnergy_kev, k / (kGroundEnergies - 1.0)));
  return energies;
}

sim::Error unfit_for_map(const sim::Scene& scene, const std::string& key, const std::string& problem) {
  return sim::Error(sim::ErrorKind::scene, problem).file(scene.file).key(key);
}

std::vector<sim::Scene> scenes_of(const sim::Scene& scene, const std::vector<Photo>& photos) {
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

std::size_t all_values(const std::vector<MapObservation>& pictures) {
  std::size_t sum = 0;
  for (const MapObservation& p : pictures) sum += p.values();
  return sum;
}

/// The share of all work that is done at the end of each stage, as far as can be said before.
struct WorkShares {
  double prior = 0.0, coarse = 0.0, map = 0.0;

  explicit WorkShares(const MapOptions& options) {
    const double trials = options.sparsity > 0.0 ? 0.0 : kUsualTrials * kCoarseSteps;
    const double fine = kFineCost * kFineSteps, bars = kFineCost * kReplicateSteps * options.replicates;
    const double all = trials + kCoarseSteps + fine + bars;
    prior = trials / all;
    coarse = prior + kCoarseSteps / all;
    map = coarse + fine / all;
  }
};

/// Returns what each replicate draws: the numbers of fit.free and the tables' uncertainty.
std::vector<MapNumber> numbers_of(const sim::Scene& scene) {
  std::vector<MapNumber> numbers = map_numbers(scene);
  const std::vector<MapNumber> modes = mode_numbers(scene);
  numbers.insert(numbers.end(), modes.begin(), modes.end());
  return numbers;
}

/// Solves the coarse and then the fine problem.
class Mapping {
 public:
  Mapping(const sim::Scene& scene, const std::vector<Photo>& photos, const MapOptions& options)
      : scene_(scene),
        photos_(photos),
        options_(options),
        scenes_(scenes_of(scene, photos)),
        numbers_(numbers_of(scene)),
        share_(options) {
    for (const MapNumber& number : numbers_)
      if (number.mode >= 0) centre_.push_back(number.value);
    modes_ = centre_;
  }

  MapResult run();

 private:
  /// Throws if light explains next to nothing of the pictures.
  void require_light(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                     double chi2) const;
  /// Keeps the fine cells near coarse ones that have light.
  void keep_lit(const sim::GroundGrid& coarse, const std::vector<float>& rough, sim::GroundGrid& fine) const;
  void put_photos(std::vector<MapObservation>& pictures, MapResult& result) const;
  void add_replicates(std::vector<MapObservation>& fine, MapResult& result);
  std::vector<MapObservation> pictures(int coarseness) const { return pictures(coarseness, scenes_); }
  std::vector<MapObservation> pictures(int coarseness, const std::vector<sim::Scene>& scenes,
                                       const std::vector<MapObservation>* like = nullptr) const;
  /// With the light of the map's electrons, for any modes.
  void look(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid);
  void look(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid,
            const sim::ElectronSpectrum& spectrum) const;
  std::vector<float> flat_start(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid) const;
  void keep_seen(std::vector<MapObservation>& pictures, sim::GroundGrid& grid);
  MapSolution solve(std::vector<MapObservation>& pictures, std::vector<float> start, double sparsity,
                    int steps, const std::string& stage, double from, double to) const;
  MapSolution solve(std::vector<MapObservation>& pictures, std::vector<float> start, const std::string& stage,
                    double from, double to, MapSolverOptions options) const;
  /// Solves with one prior after the other, each time without some cells, and writes how well it predicts
  /// them.
  StepOutput try_priors(std::vector<MapObservation>& pictures, const std::vector<float>& start) const;
  double choose_sparsity(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                         MapResult& result);
  std::vector<float> recorded(const std::string& name, int cells, std::vector<MapObservation>& pictures,
                              double& chi2, const std::function<MapSolution()>& work);
  /// The shift of the modes that a replicate has, of what is drawn for it.
  Eigen::VectorXd drawn_shift(const std::vector<double>& values) const;
  /// Adds one to the result, unless it was stopped.
  void add_replicate(std::vector<MapObservation>& fine, const std::vector<MapLight>& truth,
                     std::uint32_t number, MapResult& result);
  /// The pictures for values of the numbers beside the map. If all of these are modes of the light, `fine`
  /// take this light and nothing is returned: the lines of sight, the larger part, stay, and `fine` have it
  /// from then on.
  std::vector<MapObservation> pictures_drawn(std::vector<MapObservation>& fine, const sim::GroundGrid& grid,
                                             const std::vector<double>& values,
                                             const sim::ElectronSpectrum& spectrum) const;
  void set_drawn_data(const MapLight& truth, std::uint32_t number, std::uint32_t p,
                      MapObservation& picture) const;
  /// `shift`: of the modes from those of the best map.
  MapSolution solve_drawn(std::vector<MapObservation>& pictures, const MapResult& best, std::uint32_t number,
                          const Eigen::VectorXd& shift, double from, double to) const;
  void tell_what_is_seen(const std::vector<MapObservation>& pictures, MapResult& result) const;
  bool stopped() const { return options_.stop != nullptr && *options_.stop; }
  void require_going() const {
    if (stopped()) throw MapStopped();
  }

  const sim::Scene& scene_;
  const std::vector<Photo>& photos_;
  const MapOptions& options_;
  std::vector<sim::Scene> scenes_;
  std::vector<MapNumber> numbers_;
  WorkShares share_;
  std::vector<double> energies_ = energy_nodes(options_.spectrum);
  /// Coefficients of the modes of the tables' uncertainty, and what they are before a picture is looked at.
  std::vector<double> modes_, centre_;
  MapNeighbours near_;                                        ///< of the grid in use
  MapModes learnt_;                                           ///< of the modes, from the pictures
  std::vector<std::shared_ptr<const sim::ModeRates>> rates_;  ///< of the map's electrons, by picture
};

/// The films get the sizes that those of `like` have.
std::vector<MapObservation> Mapping::pictures(int coarseness, const std::vector<sim::Scene>& scenes,
                                              const std::vector<MapObservation>* like) const {
  std::vector<MapObservation> all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    MapObservationOptions o;
    o.pixels_per_cell = coarseness * (options_.pixels_per_cell > 0 ? options_.pixels_per_cell
                                                                   : fine_pixels(scenes[i].camera));
    o.model_error = scenes[i].fit.model_error;
    o.threads = options_.threads;
    o.stop = options_.stop;
    require_going();
    if (like != nullptr) {
      const sim::FilmGeometry& film = (*like)[i].film();
      o.margin_cells = static_cast<int>(std::lround(-film.x0_px / film.cell_width_px));
    }
    all.emplace_back(scenes[i], photos_[i], o);
    if (all.back().values() == 0)
      throw unfit_for_map(scene_, "camera.elevation_deg",
                          "no usable pixel of " + photos_[i].file_name + " looks at the sky")
          .expected("a camera that sees the sky above its horizon, and a mask that leaves it")
          .hint("check the camera's direction, the mask and fit.roi_px");
  }
  return all;
}

void Mapping::look(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid,
                   const sim::ElectronSpectrum& spectrum) const {
  for (MapObservation& picture : pictures)
    picture.look_at(scene_.site, grid, energy_nodes(spectrum), kFluxOfRates, options_.altitude_scale,
                    spectrum);
  require_going();  // light that was not finished is none to go on with
}

void Mapping::look(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid) {
  look(pictures, grid, options_.spectrum);
  for (std::size_t p = rates_.size(); p < pictures.size(); ++p)
    rates_.push_back(std::make_shared<sim::ModeRates>(scenes_[p], energies_, kFluxOfRates,
                                                      options_.altitude_scale, options_.spectrum));
  for (std::size_t p = 0; p < pictures.size(); ++p) pictures[p].set_light(rates_[p], modes_);
}

void Mapping::keep_seen(std::vector<MapObservation>& pictures, sim::GroundGrid& grid) {
  std::vector<std::vector<bool>> seen;
  for (const MapObservation& picture : pictures) {
    seen.emplace_back(grid.cells(), false);
    for (const sim::SightStretch& stretch : picture.light().sight().stretch) seen.back()[stretch.cell] = true;
  }
  std::vector<bool> kept(grid.cells(), false);
  bool common = pictures.size() == 1;
  for (int c = 0; c < grid.cells(); ++c) {
    int by = 0;
    for (const auto& one : seen) by += one[c] ? 1 : 0;
    kept[c] = by > 0;
    common = common || by > 1;
  }
  if (!common)
    throw unfit_for_map(scene_, "fit.photo", "no part of the sky is seen from two of the stations")
        .expected("stations whose pictures show a common volume between 80 and 640 km altitude")
        .hint("check the sites and the cameras' directions, or map each photograph by itself");
  grid.keep(kept);
  look(pictures, grid);
}

std::vector<float> Mapping::flat_start(std::vector<MapObservation>& pictures,
                                       const sim::GroundGrid& grid) const {
  std::vector<float> map(static_cast<std::size_t>(grid.cells()) * kGroundEnergies,
                         1.0f / static_cast<float>(energies_.size()));
  double by = 0.0, square = 0.0;
  for (MapObservation& picture : pictures) {
    MapLight light;
    picture.forward(map, light);
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double w = picture.weight()[i];
      by += w * light[i] * picture.data()[i];
      square += w * light[i] * light[i];
    }
  }
  constexpr double kBelow = 0.3;  // of what the mean light asks for
  const double scale = square > 0.0 && by > 0.0 ? kBelow * by / square : 0.0;
  for (float& x : map) x *= static_cast<float>(scale);
  return map;
}

MapSolution Mapping::solve(std::vector<MapObservation>& pictures, std::vector<float> start, double sparsity,
                           int steps, const std::string& stage, double from, double to) const {
  MapSolverOptions o;
  o.steps = steps;
  o.sparsity = sparsity;
  o.modes = modes_;
  o.modes_centre = centre_;
  o.modes_steps = steps / kStepsOfModes;
  return solve(pictures, std::move(start), stage, from, to, std::move(o));
}

MapSolution Mapping::solve(std::vector<MapObservation>& pictures, std::vector<float> start,
                           const std::string& stage, double from, double to, MapSolverOptions o) const {
  o.stop = options_.stop;
  const auto values = static_cast<double>(all_values(pictures));
  const int steps = o.steps;
  if (options_.progress)
    o.progress = [&](int step, double chi2) {
      if (step % 10 == 0) options_.progress(stage, chi2 / values, from + (to - from) * step / steps);
    };
  return solve_map(pictures, near_, static_cast<int>(energies_.size()), std::move(start), o);
}

std::vector<float> Mapping::recorded(const std::string& name, int cells,
                                     std::vector<MapObservation>& pictures, double& chi2,
                                     const std::function<MapSolution()>& work) {
  const auto step = [&] {
    const MapSolution solution = work();
    StepOutput out;
    std::vector<double>& place = out.numbers["place"];
    std::vector<double>& value = out.numbers["value"];
    for (std::size_t i = 0; i < solution.map.size(); ++i)
      if (solution.map[i] != 0.0f) {
        place.push_back(static_cast<double>(i));
        value.push_back(solution.map[i]);
      }
    out.numbers["chi2"] = {solution.chi2};
    out.numbers["modes"] = solution.modes;
    out.numbers["size"] = {static_cast<double>(solution.map.size())};
    for (const MapObservation& picture : pictures)
      for (const double g : picture.gain) out.numbers["gain"].push_back(g);
    out.whole = !stopped();
    return out;
  };
  const StepOutput out = options_.journal != nullptr ? options_.journal->step(name, step) : step();
  const std::size_t size =
      out.count_of(out.number_at("size"), "size", static_cast<std::size_t>(cells) * kGroundEnergies);
  if (size != static_cast<std::size_t>(cells) * kGroundEnergies) throw out.error_at("size");
  std::vector<float> map(size, 0.0f);
  const std::vector<double>& place = out.numbers_at("place");
  const std::vector<double>& value = out.numbers_at("value", place.size());
  for (std::size_t i = 0; i < place.size(); ++i)
    map[out.count_of(place[i], "place", size - 1)] = static_cast<float>(value[i]);
  chi2 = out.number_at("chi2");
  modes_ = out.numbers_at("modes", centre_.size());
  for (MapObservation& picture : pictures) picture.set_modes(modes_);
  const std::vector<double>& gain = out.numbers_at("gain", 3 * pictures.size());
  for (std::size_t p = 0; p < pictures.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) pictures[p].gain[c] = gain[3 * p + c];
  return map;
}

StepOutput Mapping::try_priors(std::vector<MapObservation>& pictures, const std::vector<float>& start) const {
  std::vector<std::vector<std::uint8_t>> left_out;
  for (std::size_t p = 0; p < pictures.size(); ++p)
    left_out.push_back(left_out_blocks(pictures[p], scene_.seed, static_cast<std::uint32_t>(p)));
  StepOutput trials;
  const int count = static_cast<int>(std::size(kTrials));
  double least = std::numeric_limits<double>::infinity();
  int worse = 0;
  // All are tried with the same modes, which the usual one teaches.
  std::vector<double> modes;
  if (!modes_.empty())
    modes = solve(pictures, start, kUsualSparsity, kCoarseSteps, "choosing the prior", 0.0,
                  share_.prior / kUsualTrials)
                .modes;
  for (int t = 0; t < count && worse < kWorseTrials && !stopped(); ++t) {
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      pictures[p].leave_out(left_out[p]);
      pictures[p].set_modes(modes);
    }
    MapSolverOptions o;
    o.steps = kCoarseSteps;
    o.sparsity = kTrials[t];
    const MapSolution s =
        solve(pictures, start, "choosing the prior", share_.prior * std::min(1.0, (t + 1) / kUsualTrials),
              share_.prior * std::min(1.0, (t + 2) / kUsualTrials), std::move(o));
    const PredictionLoss loss = prediction_loss(pictures, s.map, left_out);
    trials.numbers["sparsity"].push_back(kTrials[t]);
    trials.numbers["left_out"].push_back(loss.mean());
    trials.numbers["error"].push_back(loss.error());
    worse = loss.mean() > least ? worse + 1 : 0;
    least = std::min(least, loss.mean());
  }
  for (MapObservation& picture : pictures) {
    picture.leave_out({});
    picture.gain = {1.0, 1.0, 1.0};
  }
  trials.numbers["modes"] = modes;
  trials.whole = !stopped();
  return trials;
}

double Mapping::choose_sparsity(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                                MapResult& result) {
  const auto try_all = [&] { return try_priors(pictures, start); };
  const StepOutput trials =
      options_.journal != nullptr ? options_.journal->step("prior", try_all) : try_all();
  if (trials.numbers.count("sparsity") == 0) return kUsualSparsity;  // stopped before the first
  const std::vector<double>& sparsity = trials.numbers_at("sparsity");
  const std::vector<double>& left = trials.numbers_at("left_out", sparsity.size());
  const std::vector<double>& error = trials.numbers_at("error", sparsity.size());
  if (sparsity.empty()) throw trials.error_at("sparsity");
  modes_ = trials.numbers_at("modes", centre_.size());
  for (MapObservation& picture : pictures) picture.set_modes(modes_);
  for (std::size_t t = 0; t < left.size(); ++t) result.trials.push_back({sparsity[t], left[t], error[t]});
  return strongest_good_prior(result.trials);
}

/// Returns one number of a film of independent normal numbers, drawn again for each replicate.
double normal(std::uint64_t seed, std::uint32_t replicate, std::uint32_t picture, std::uint32_t i) {
  const sim::Words w = sim::random_words(seed, sim::Stream::bootstrap, i, replicate + 1000u, picture);
  const double u = sim::fine_uniform(w[0], w[1]);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * 3.141592653589793 * sim::fine_uniform(w[2], w[3]));
}

/// Returns smooth normal numbers of variance 1 over a film: a model's error, which neighbours share.
std::vector<float> smooth_error(const sim::FilmGeometry& film, std::uint64_t seed, int replicate, int picture,
                                int threads) {
  std::vector<float> drawn(static_cast<std::size_t>(film.rows) * film.columns), blurred(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i)
    drawn[i] = static_cast<float>(normal(seed, static_cast<std::uint32_t>(replicate),
                                         static_cast<std::uint32_t>(picture) * 4u + 3u,
                                         static_cast<std::uint32_t>(i)));
  const sim::BlurKernel kernel = sim::gaussian_kernel(kModelErrorReach_cells);
  sim::blur_window(drawn.data(), film.rows, film.columns, {{kernel, kernel}}, {0, 0, film.rows, film.columns},
                   blurred.data(), threads);
  // The variance of a mean with these weights, both ways.
  double squares = kernel.weights[0] * kernel.weights[0];
  for (std::size_t k = 1; k < kernel.weights.size(); ++k)
    squares += 2.0 * kernel.weights[k] * kernel.weights[k];
  for (float& x : blurred) x = static_cast<float>(x / squares);
  return blurred;
}

std::vector<MapObservation> Mapping::pictures_drawn(std::vector<MapObservation>& fine,
                                                    const sim::GroundGrid& grid,
                                                    const std::vector<double>& values,
                                                    const sim::ElectronSpectrum& spectrum) const {
  const std::vector<sim::Scene> drawn = scenes_of(scene_with(scene_, numbers_, values), photos_);
  if (centre_.size() == numbers_.size()) {
    for (std::size_t p = 0; p < fine.size(); ++p)
      fine[p].look_by_light_of(drawn[p], energy_nodes(spectrum), kFluxOfRates, options_.altitude_scale,
                               spectrum);
    return {};
  }
  std::vector<MapObservation> all = pictures(1, drawn, &fine);
  look(all, grid, spectrum);
  return all;
}

void Mapping::set_drawn_data(const MapLight& truth, std::uint32_t number, std::uint32_t p,
                             MapObservation& picture) const {
  const std::vector<float> shared = smooth_error(picture.film(), scene_.seed, static_cast<int>(number),
                                                 static_cast<int>(p), options_.threads);
  MapLight data = truth;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double sigma = picture.sigma()[i], noise = picture.noise()[i];
    if (sigma == 0.0) continue;
    const double model_error = std::sqrt(std::max(0.0, sigma * sigma - noise * noise));
    data[i] +=
        static_cast<float>(noise * normal(scene_.seed, number, p * 4u + static_cast<std::uint32_t>(i % 3),
                                          static_cast<std::uint32_t>(i / 3)) +
                           model_error * shared[i / 3]);
  }
  picture.set_data(std::move(data));
}

MapSolution Mapping::solve_drawn(std::vector<MapObservation>& pictures, const MapResult& best,
                                 std::uint32_t number, const Eigen::VectorXd& shift, double from,
                                 double to) const {
  const double spread = kPriorSpread * normal(scene_.seed, number, 0xffffu, 0u);
  // A little light everywhere, so that what the prior has put out may come back.
  // Fluxes and spectra are drawn about the best, so that what the data leave open does not come back to it.
  std::vector<float> start = moved_map(best.map, learnt_.response.answer(shift)),
                     factor(static_cast<std::size_t>(best.grid.cells()));
  double most = 0.0, flux_of_all = 0.0, ln_energy_of_all = 0.0;
  for (const float x : start) most = std::max(most, static_cast<double>(x));
  for (const CellFlux& cell : best.cells) {
    flux_of_all += cell.flux_mw_m2;
    ln_energy_of_all += static_cast<double>(cell.flux_mw_m2) * cell.ln_energy;
  }
  ln_energy_of_all /= std::max(1e-30, flux_of_all);
  const auto draw = [&](std::size_t c, std::uint32_t what) {
    return normal(scene_.seed, number, 0xfff0u + what, static_cast<std::uint32_t>(c));
  };
  for (std::size_t c = 0; c < factor.size(); ++c) {
    factor[c] = static_cast<float>(std::exp(kCellPriorSpread * draw(c, 0u)));
    const double flux = kFluxSpread * draw(c, 1u), tilt = kTiltSpread * draw(c, 2u);
    // A cell without light has no energy of its own.
    const double about = best.cells[c].flux_mw_m2 > 0.0f ? best.cells[c].ln_energy : ln_energy_of_all;
    for (std::size_t k = 0; k < energies_.size(); ++k) {
      float& x = start[c * kGroundEnergies + k];
      x += static_cast<float>(1e-4 * most);
      x *= static_cast<float>(std::exp(flux + tilt * (std::log(energies_[k]) - about)));
    }
  }
  MapSolverOptions o;
  o.cell_factor = std::move(factor);
  o.steps = kReplicateSteps;
  o.sparsity = best.sparsity * std::exp(spread);
  return solve(pictures, std::move(start), "error bars", from, to, std::move(o));
}

Eigen::VectorXd Mapping::drawn_shift(const std::vector<double>& values) const {
  Eigen::VectorXd drawn(static_cast<Eigen::Index>(modes_.size()));
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    if (numbers_[i].mode >= 0) drawn(k++) = (values[i] - numbers_[i].value) / numbers_[i].error;
  return learnt_.spread * drawn;
}

void Mapping::add_replicate(std::vector<MapObservation>& fine, const std::vector<MapLight>& truth,
                            std::uint32_t number, MapResult& result) {
  const sim::ElectronSpectrum spectrum = is_of_one_station(result)
                                             ? replicate_spectrum(options_.spectrum, static_cast<int>(number))
                                             : options_.spectrum;
  const double each = (1.0 - share_.map) / options_.replicates, from = share_.map + each * number;
  std::vector<double> values = drawn_numbers(scene_.seed, numbers_, number);
  const Eigen::VectorXd shift = drawn_shift(values);
  for (std::size_t i = 0, k = 0; i < numbers_.size(); ++i)
    if (numbers_[i].mode >= 0) {
      values[i] = modes_[k] + shift(static_cast<Eigen::Index>(k));
      ++k;
    }
  const auto work = [&] {
    std::vector<MapObservation> drawn = pictures_drawn(fine, result.grid, values, spectrum);
    std::vector<MapObservation>& pictures = drawn.empty() ? fine : drawn;
    // Each starts from the map's gains, not from those of the replicate before, which may have been resumed.
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      pictures[p].gain = result.photos[p].gain;
      set_drawn_data(truth[p], number, static_cast<std::uint32_t>(p), pictures[p]);
    }
    const MapSolution s = solve_drawn(pictures, result, number, shift, from, from + each);
    StepOutput out;
    for (const CellFlux& cell : CellReader(result.grid, energies_).cells(s.map)) {
      out.numbers["flux"].push_back(cell.flux_mw_m2);
      out.numbers["ln_energy"].push_back(cell.ln_energy);
    }
    out.whole = !stopped();
    return out;
  };
  std::string name = "replicate " + std::to_string(number);
  if (spectrum.kind != options_.spectrum.kind) name += std::string(" ") + sim::spectrum_word(spectrum.kind);
  const StepOutput out = options_.journal != nullptr ? options_.journal->step(name, work) : work();
  if (stopped()) return;
  std::vector<CellFlux> cells(static_cast<std::size_t>(result.grid.cells()));
  const std::vector<double>& flux = out.numbers_at("flux", cells.size());
  const std::vector<double>& ln_energy = out.numbers_at("ln_energy", cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c] = {static_cast<float>(flux[c]), static_cast<float>(ln_energy[c])};
  result.replicates.push_back(std::move(cells));
  result.replicate_spectra.push_back(spectrum);
  result.replicate_values.push_back(std::move(values));
}

void Mapping::tell_what_is_seen(const std::vector<MapObservation>& pictures, MapResult& result) const {
  const auto cells = static_cast<std::size_t>(result.grid.cells());
  result.border_in_view.assign(cells, 0);
  for (std::size_t c = 0; c < cells; ++c)
    result.border_in_view[c] = is_border_in_view(result, result.grid.middle_km(static_cast<int>(c))) ? 1 : 0;
  // Signal over noise of a cell by itself, at the median of the flux-weighted energies: sqrt(a' W a), where a
  // and W are taken as if a cell's light fell on pixels of like weight.
  result.sensitivity.assign(cells, 0.0f);
  for (const MapObservation& picture : pictures) {
    MapLight weighted = picture.weight();
    std::vector<float> back(cells * kGroundEnergies, 0.0f);
    std::vector<float> ones(cells * kGroundEnergies, 1.0f);
    for (float& w : weighted) w = std::sqrt(w);
    picture.add_adjoint(weighted, back);
    const std::size_t middle = energies_.size() / 2;
    for (std::size_t c = 0; c < cells; ++c)
      result.sensitivity[c] = static_cast<float>(
          std::hypot(result.sensitivity[c], std::max(0.0f, back[c * kGroundEnergies + middle])));
  }
}

void Mapping::require_light(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                            double chi2) const {
  double dark = 0.0;
  for (MapObservation& picture : pictures) {
    MapLight none(picture.cells() * 3, 0.0f), residual;
    dark += picture.residual(none, residual);
  }
  constexpr double kMinGain = 0.05;  // of chi2 per value, that light explains
  if (stopped() ||
      (start[0] != 0.0f && !(dark - chi2 < kMinGain * static_cast<double>(all_values(pictures)))))
    return;
  throw sim::unreadable(photos_.front().file_name, "no light is above the noise and the sky")
      .expected("a photograph with aurora")
      .hint("check the mask and fit.roi_px; a smooth sky explains all of the picture");
}

void Mapping::keep_lit(const sim::GroundGrid& coarse, const std::vector<float>& rough,
                       sim::GroundGrid& fine) const {
  const std::vector<CellFlux> cells = CellReader(coarse, energies_).cells(rough);
  std::vector<std::uint8_t> lit(cells.size(), 0);
  float most = 0.0f;
  for (const CellFlux& cell : cells) most = std::max(most, cell.flux_mw_m2);
  for (std::size_t c = 0; c < lit.size(); ++c)
    if (cells[c].flux_mw_m2 > kKeptShare * most)
      for (const auto& near : coarse.near(
               static_cast<int>(c), std::max(kKeptReach_km, 2.5 * coarse.depth_km(static_cast<int>(c)))))
        lit[near.cell] = 1;
  std::vector<bool> kept(fine.cells(), false);
  for (int c = 0; c < fine.cells(); ++c) {
    const sim::EastNorth middle = fine.middle_km(c);
    const int under = coarse.cell_at(middle.east, middle.north);
    kept[c] = under >= 0 && lit[under] != 0;
  }
  fine.keep(kept);
}

void Mapping::put_photos(std::vector<MapObservation>& pictures, MapResult& result) const {
  result.chi2 = 0.0;
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    MapObservation& picture = pictures[p];
    MappedPhoto photo;
    photo.name = scene_.fit.photos.empty() ? "" : scene_.fit.photos[p].name;
    photo.scene = scenes_[p];
    if (!modes_.empty()) photo.scene.emission.modes = modes_;
    photo.film = picture.film();
    photo.data = picture.data();
    photo.sigma = picture.sigma();
    photo.gain = picture.gain;
    photo.values = picture.values();
    MapLight residual, none(picture.cells() * 3, 0.0f);
    result.chi2_without_aurora += picture.residual(none, residual);
    picture.forward(result.map, photo.model);
    photo.chi2 = picture.residual(photo.model, residual);
    photo.sky = picture.sky();
    result.chi2 += photo.chi2;
    result.photos.push_back(std::move(photo));
  }
}

void Mapping::add_replicates(std::vector<MapObservation>& fine, MapResult& result) {
  std::vector<MapLight> truth;  // of each picture, with its sky
  for (const MappedPhoto& photo : result.photos) {
    truth.push_back(photo.model);
    for (std::size_t i = 0; i < truth.back().size(); ++i) truth.back()[i] += photo.sky[i];
  }
  if (!modes_.empty() && options_.replicates > 0 && !stopped()) {
    MapSolverOptions o;
    o.sparsity = result.sparsity;
    o.modes = o.modes_centre = modes_;
    o.stop = options_.stop;
    learnt_ = solved_modes(fine, near_, static_cast<int>(energies_.size()), result.map, o);
    if (!stopped()) result.modes_covariance = learnt_.spread * learnt_.spread.transpose();
  }
  for (int r = 0; r < options_.replicates && !stopped(); ++r) {
    try {
      add_replicate(fine, truth, static_cast<std::uint32_t>(r), result);
    } catch (const MapStopped&) {
      return;  // the map itself is there
    }
  }
}

MapResult Mapping::run() {
  std::vector<MapObservation> coarse = pictures(2);
  const double farthest = options_.farthest_km > 0.0 ? options_.farthest_km : ground_reach_km(coarse);
  sim::GroundGrid coarse_grid = map_grid(coarse, scene_.site, farthest, 2.0);
  look(coarse, coarse_grid);
  keep_seen(coarse, coarse_grid);
  near_ = MapNeighbours(coarse_grid);
  const std::vector<float> start = flat_start(coarse, coarse_grid);
  MapResult result(scene_, coarse_grid);
  result.numbers = numbers_;
  result.altitude_scale = options_.altitude_scale;
  result.spectrum = options_.spectrum;
  result.energies_kev = energies_;
  result.sparsity = options_.sparsity > 0.0 ? options_.sparsity : choose_sparsity(coarse, start, result);
  double chi2 = 0.0;
  const std::vector<float> rough = recorded("coarse map", coarse_grid.cells(), coarse, chi2, [&] {
    return solve(coarse, start, result.sparsity, kCoarseSteps, "coarse map", share_.prior, share_.coarse);
  });
  require_light(coarse, start, chi2);

  std::vector<MapObservation> fine = pictures(1);
  for (std::size_t p = 0; p < fine.size(); ++p) fine[p].gain = coarse[p].gain;
  result.grid = map_grid(fine, scene_.site, farthest, 1.0);
  keep_lit(coarse_grid, rough, result.grid);
  look(fine, result.grid);
  near_ = MapNeighbours(result.grid);
  result.map = recorded("map", result.grid.cells(), fine, result.chi2, [&] {
    return solve(fine, refined_map(rough, coarse_grid, result.grid), result.sparsity, kFineSteps, "map",
                 share_.coarse, share_.map);
  });
  if (!modes_.empty()) result.scene.emission.modes = modes_;
  result.cells = CellReader(result.grid, energies_).cells(result.map);
  for (const CellFlux& cell : CellReader(result.grid, energies_, kWideReach_km).cells(result.map))
    result.ln_energy_around.push_back(cell.ln_energy);
  result.values = all_values(fine);
  put_photos(fine, result);
  tell_what_is_seen(fine, result);
  add_replicates(fine, result);
  result.interrupted = stopped();
  return result;
}

}  // namespace

bool is_of_one_station(const MapResult& result) {
  return std::all_of(result.photos.begin(), result.photos.end(), [&](const MappedPhoto& photo) {
    const sim::Site &site = photo.scene.site, &first = result.photos.front().scene.site;
    return site.latitude_deg == first.latitude_deg && site.longitude_deg == first.longitude_deg;
  });
}

sim::ElectronSpectrum replicate_spectrum(const sim::ElectronSpectrum& of_map, int replicate) {
  using Kind = sim::ElectronSpectrum::Kind;
  if (replicate % 2 == 0) return of_map;
  std::vector<sim::ElectronSpectrum> others;
  for (const sim::ElectronSpectrum& other :
       {sim::ElectronSpectrum{Kind::gaussian, 0.25, 5.0}, sim::ElectronSpectrum{Kind::kappa, 0.25, 4.0},
        sim::ElectronSpectrum{Kind::maxwellian, 0.25, 5.0}})
    if (other.kind != of_map.kind && others.size() < 2) others.push_back(other);
  return others[static_cast<std::size_t>(replicate / 2) % others.size()];
}

std::vector<double> drawn_numbers(std::uint64_t seed, const std::vector<MapNumber>& numbers,
                                  std::uint32_t replicate) {
  constexpr std::uint32_t kNumbers = 0xffe0u;  // in place of a picture
  std::vector<double> values;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double drawn = normal(seed, replicate, kNumbers, static_cast<std::uint32_t>(i));
    values.push_back(numbers[i].value + numbers[i].error * drawn);
  }
  return values;
}

bool is_prior_at_its_end(const MapResult& result) {
  return result.sparsity == kTrials[std::size(kTrials) - 1];
}

bool is_border_in_view(const MapResult& result, sim::EastNorth foot_km) {
  for (const MappedPhoto& photo : result.photos) {
    double x = 0.0, y = 0.0;
    if (!sim::pixel_over_foot(photo.scene, result.scene.site, foot_km, kMappedBorder_km, x, y)) continue;
    const sim::FilmGeometry& film = photo.film;
    const int column = static_cast<int>((x - film.x0_px) / film.cell_width_px);
    const int row = static_cast<int>((y - film.y0_px) / film.cell_height_px);
    const std::size_t i = (static_cast<std::size_t>(row) * film.columns + column) * 3;
    if (photo.sigma[i] + photo.sigma[i + 1] + photo.sigma[i + 2] > 0.0f) return true;
  }
  return false;
}

std::vector<CellError> cell_errors(const MapResult& result) {
  std::vector<CellError> errors(result.cells.size());
  for (std::size_t c = 0; c < errors.size(); ++c) {
    double flux = 0.0, energy = 0.0, lit = 0.0;
    for (const std::vector<CellFlux>& replicate : result.replicates) {
      flux += std::pow(replicate[c].flux_mw_m2 - result.cells[c].flux_mw_m2, 2);
      if (replicate[c].flux_mw_m2 == 0.0f && replicate[c].ln_energy == 0.0f) continue;  // no light near it
      energy += std::pow(replicate[c].ln_energy - result.cells[c].ln_energy, 2);
      lit += 1.0;
    }
    const auto count = static_cast<double>(result.replicates.size());
    const double cell_flux = result.cells[c].flux_mw_m2;
    errors[c].relative_flux =
        count > 0.0 && cell_flux > 0.0 ? std::sqrt(flux / count) / cell_flux : sim::kNaN;
    errors[c].ln_energy =
        lit > 0.0 ? std::hypot(kEnergyInflation * std::sqrt(energy / lit),
                               static_cast<double>(result.cells[c].ln_energy) - result.ln_energy_around[c])
                  : sim::kNaN;
  }
  return errors;
}

MapResult map_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const MapOptions& options) {
  sim::require_earth(scene, "a map of precipitation");
  return Mapping(scene, photos, options).run();
}

}  // namespace vegard::fit
