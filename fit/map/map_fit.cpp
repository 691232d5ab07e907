#include "fit/map/map_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/map/map_error_bars.h"
#include "fit/map/map_grid.h"
#include "fit/map/map_problem.h"
#include "fit/map/map_reading.h"
#include "fit/map/spectra_left_open.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/scene/table/value_check.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr int kWorseTrials = 2;
constexpr double kUsualSparsity = 4.0;

/// Solves the coarse and then the fine problem.
class Mapping {
 public:
  Mapping(const sim::Scene& scene, const std::vector<Photo>& photos, const MapOptions& options)
      : problem_(scene, photos, options) {}

  MapResult run();

 private:
  /// Throws if light explains next to nothing of the pictures.
  void require_light(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                     double chi2) const;
  std::vector<float> flat_start(std::vector<MapObservation>& pictures, const sim::GroundGrid& grid) const;
  void keep_seen(std::vector<MapObservation>& pictures, sim::GroundGrid& grid);
  /// Solves with one prior after the other, each time without some cells, and writes how well it predicts
  /// them.
  StepOutput try_priors(std::vector<MapObservation>& pictures, const std::vector<float>& start) const;
  double choose_sparsity(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                         MapResult& result);
  std::vector<float> recorded(const std::string& name, int cells, std::vector<MapObservation>& pictures,
                              double& chi2, const std::function<MapSolution()>& work);

  MapProblem problem_;
};

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
    throw unfit_for_map(problem_.scene, "fit.photo", "no part of the sky is seen from two of the stations")
        .expected("stations whose pictures show a common volume between 80 and 640 km altitude")
        .hint("check the sites and the cameras' directions, or map each photograph by itself");
  grid.keep(kept);
  for (MapObservation& picture : pictures) picture.keep_in_grid(kept);
}

std::vector<float> Mapping::flat_start(std::vector<MapObservation>& pictures,
                                       const sim::GroundGrid& grid) const {
  std::vector<float> map(static_cast<std::size_t>(grid.cells()) * kGroundEnergies,
                         1.0f / static_cast<float>(problem_.energies_kev.size()));
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
    out.whole = !problem_.stopped();
    return out;
  };
  const StepOutput out = problem_.step(name, step);
  const std::size_t size =
      out.count_of(out.number_at("size"), "size", static_cast<std::size_t>(cells) * kGroundEnergies);
  if (size != static_cast<std::size_t>(cells) * kGroundEnergies) throw out.error_at("size");
  std::vector<float> map(size, 0.0f);
  const std::vector<double>& place = out.numbers_at("place");
  const std::vector<double>& value = out.numbers_at("value", place.size());
  for (std::size_t i = 0; i < place.size(); ++i)
    map[out.count_of(place[i], "place", size - 1)] = static_cast<float>(value[i]);
  chi2 = out.number_at("chi2");
  problem_.modes = out.numbers_at("modes", problem_.modes_before.size());
  for (MapObservation& picture : pictures) picture.set_modes(problem_.modes);
  const std::vector<double>& gain = out.numbers_at("gain", 3 * pictures.size());
  for (std::size_t p = 0; p < pictures.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) pictures[p].gain[c] = gain[3 * p + c];
  return map;
}

StepOutput Mapping::try_priors(std::vector<MapObservation>& pictures, const std::vector<float>& start) const {
  std::vector<std::vector<std::uint8_t>> left_out;
  for (std::size_t p = 0; p < pictures.size(); ++p)
    left_out.push_back(left_out_blocks(pictures[p], problem_.scene.seed, static_cast<std::uint32_t>(p)));
  StepOutput trials;
  const int count = static_cast<int>(std::size(kPriorTrials));
  double least = std::numeric_limits<double>::infinity();
  int worse = 0;
  // All are tried with the same modes, which the usual one teaches.
  std::vector<double> modes;
  if (!problem_.modes.empty())
    modes = problem_
                .solve(pictures, start, kUsualSparsity, kCoarseSteps, "choosing the prior", 0.0,
                       problem_.share.prior / kUsualTrials)
                .modes;
  for (int t = 0; t < count && worse < kWorseTrials && !problem_.stopped(); ++t) {
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      pictures[p].leave_out(left_out[p]);
      pictures[p].set_modes(modes);
    }
    MapSolverOptions o;
    o.steps = kCoarseSteps;
    o.sparsity = kPriorTrials[t];
    const MapSolution s = problem_.solve(
        pictures, start, "choosing the prior", problem_.share.prior * std::min(1.0, (t + 1) / kUsualTrials),
        problem_.share.prior * std::min(1.0, (t + 2) / kUsualTrials), std::move(o));
    const PredictionLoss loss = prediction_loss(pictures, s.map, left_out);
    trials.numbers["sparsity"].push_back(kPriorTrials[t]);
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
  trials.whole = !problem_.stopped();
  return trials;
}

double Mapping::choose_sparsity(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                                MapResult& result) {
  const auto try_all = [&] { return try_priors(pictures, start); };
  const StepOutput trials = problem_.step("prior", try_all);
  if (trials.numbers.count("sparsity") == 0) return kUsualSparsity;  // stopped before the first
  const std::vector<double>& sparsity = trials.numbers_at("sparsity");
  const std::vector<double>& left = trials.numbers_at("left_out", sparsity.size());
  const std::vector<double>& error = trials.numbers_at("error", sparsity.size());
  if (sparsity.empty()) throw trials.error_at("sparsity");
  problem_.modes = trials.numbers_at("modes", problem_.modes_before.size());
  for (MapObservation& picture : pictures) picture.set_modes(problem_.modes);
  for (std::size_t t = 0; t < left.size(); ++t) result.trials.push_back({sparsity[t], left[t], error[t]});
  return strongest_good_prior(result.trials);
}

void Mapping::require_light(std::vector<MapObservation>& pictures, const std::vector<float>& start,
                            double chi2) const {
  double dark = 0.0;
  for (MapObservation& picture : pictures) {
    MapLight none(picture.cells() * 3, 0.0f), residual;
    dark += picture.residual(none, residual);
  }
  constexpr double kMinGain = 0.05;  // of chi2 per value, that light explains
  if (problem_.stopped() ||
      (start[0] != 0.0f && !(dark - chi2 < kMinGain * static_cast<double>(all_values(pictures)))))
    return;
  throw sim::unreadable(problem_.photos.front().file_name, "no light is above the noise and the sky")
      .expected("a photograph with aurora")
      .hint("check the mask and fit.roi_px; a smooth sky explains all of the picture");
}

MapResult Mapping::run() {
  std::vector<MapObservation> coarse = problem_.pictures(2);
  const double farthest =
      problem_.options.farthest_km > 0.0 ? problem_.options.farthest_km : ground_reach_km(coarse);
  sim::GroundGrid coarse_grid = map_grid(coarse, problem_.scene.site, farthest, 2.0);
  problem_.look(coarse, coarse_grid);
  keep_seen(coarse, coarse_grid);
  problem_.near = MapNeighbours(coarse_grid);
  const std::vector<float> start = flat_start(coarse, coarse_grid);
  MapResult result(problem_.scene, coarse_grid);
  result.numbers = problem_.numbers;
  result.altitude_scale = problem_.options.altitude_scale;
  result.spectrum = problem_.options.spectrum;
  result.energies_kev = problem_.energies_kev;
  result.sparsity =
      problem_.options.sparsity > 0.0 ? problem_.options.sparsity : choose_sparsity(coarse, start, result);
  double chi2 = 0.0;
  const std::vector<float> rough = recorded("coarse map", coarse_grid.cells(), coarse, chi2, [&] {
    return problem_.solve(coarse, start, result.sparsity, kCoarseSteps, "coarse map", problem_.share.prior,
                          problem_.share.coarse);
  });
  require_light(coarse, start, chi2);
  if (problem_.options.replicates > 1 && is_of_one_station(problem_.scenes))
    try_other_spectra(problem_, coarse, start, chi2, result);

  std::vector<MapObservation> fine = problem_.pictures(1);
  for (std::size_t p = 0; p < fine.size(); ++p) fine[p].gain = coarse[p].gain;
  result.grid = map_grid(fine, problem_.scene.site, farthest, 1.0);
  result.grid.keep(cells_near_light(coarse_grid, rough, problem_.energies_kev, result.grid));
  problem_.look(fine, result.grid);
  problem_.near = MapNeighbours(result.grid);
  result.map = recorded("map", result.grid.cells(), fine, result.chi2, [&] {
    return problem_.solve(fine, refined_map(rough, coarse_grid, result.grid), result.sparsity, kFineSteps,
                          "map", problem_.share.coarse, problem_.share.map);
  });
  MapReading(result.grid, problem_.energies_kev).read(problem_, fine, result);
  add_replicates(problem_, fine, result);
  result.interrupted = problem_.stopped();
  return result;
}

}  // namespace

MapResult map_photos(const sim::Scene& scene, const std::vector<Photo>& photos, const MapOptions& options) {
  sim::require_earth(scene, "a map of precipitation");
  return Mapping(scene, photos, options).run();
}

}  // namespace vegard::fit
