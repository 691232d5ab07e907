#include "fit/map/sequence/map_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "fit/map/map_fit.h"
#include "fit/map/map_grid.h"
#include "fit/map/map_problem.h"
#include "fit/map/map_reading.h"
#include "fit/map/sequence/coarse_pass.h"
#include "fit/map/sequence/drift_fit.h"
#include "fit/map/sequence/sparse_map.h"
#include "fit/map/solution_draw.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/scene/table/value_check.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kFinerCells = 0.25;  // of a fine cell's area to a coarse one's: a bond is of each cell
constexpr std::size_t kLag = 8;       // frames after one that are heard
constexpr int kPerturbedSteps = 40;
constexpr double kOfPicture = 0.5;  // of the start that is the coarse map's, the rest being the prediction's
constexpr double kLargestKept = 0.97;

/// A perturbed sequence.
struct PerturbedSequence {
  SolutionDraw draw;
  sim::ElectronSpectrum spectrum;
  std::vector<double> values;  ///< of the numbers beside the map
  std::vector<float> rates, prior_factors;
  double sparsity = 0.0;
};

/// A frame after the pass forward. Maps: the best, then those of the perturbed sequences.
struct ForwardFrame {
  std::size_t number = 0;
  double seconds = 0.0;  ///< since the frame before; 0: nothing was carried over from it
  double kept = 0.0;     ///< the share of what the next frame knows better that is moved back to this
  std::vector<SparseMap> maps;
  std::vector<SparseMap> predicted;
  DriftField drift;
  MapResult reading;
};

/// The whole sequence.
class Sequence {
 public:
  Sequence(const sim::Scene& scene, const MapFrames& frames, const MapOptions& options,
           const std::function<void(MapOfFrame)>& done)
      : scene_(scene), frames_(frames), options_(options), done_(done) {}

  MapSequenceFacts run();

 private:
  void check() const;
  /// Reads a frame, which has the camera's size.
  Photo read(std::size_t number) const;
  /// Maps the first frame that has light, by itself.
  MapResult first_map();
  void prepare(const MapResult& first);
  void perturb(const MapResult& first);
  /// The bond of the coarse film over a step of time.
  double bond_over(double seconds) const { return facts_.bond.bond * facts_.bond.step_s / seconds; }
  /// The share that is moved back over a step.
  double kept_over(double seconds) const {
    const double kept = 1.0 - facts_.bond.gain;
    return std::min(kLargestKept, kept / (kept + facts_.bond.gain * seconds / facts_.bond.step_s));
  }

  /// Solves for a frame's maps, all but the coarse ones from those of the frame before.
  StepOutput solved_frame(std::size_t number, const Photo& photo, const CoarseState& before,
                          const std::vector<SparseMap>& maps_before) const;
  void go_on(std::size_t number, const Photo& photo);
  /// Gives away the first frame in memory, with what those after it know.
  void give_first();
  MapSolution solve(const SequenceLevel& level, std::vector<MapObservation>& picture,
                    std::vector<float> start, MapSolverOptions o) const;
  void tell(const std::string& stage, double chi2_per_value, double share) const {
    if (options_.progress) options_.progress(stage, chi2_per_value, share);
  }

  const sim::Scene& scene_;
  const MapFrames& frames_;
  MapOptions options_;
  const std::function<void(MapOfFrame)>& done_;
  std::vector<Photo> first_photo_;  ///< one
  std::optional<MapProblem> problem_;
  std::optional<SequenceLevel> coarse_, fine_;
  std::optional<CoarsePass> coarse_pass_;
  std::optional<MapReading> reading_;
  std::vector<PerturbedSequence> perturbed_;
  MapSequenceFacts facts_;
  std::optional<MapResult> common_;  ///< what all frames' results have
  std::size_t begin_ = 0;            ///< the first frame with a map
  CoarseState state_;
  std::array<double, 3> gain_{1.0, 1.0, 1.0};
  std::vector<std::uint8_t> in_view_;  ///< cells of the fine grid at the frame before
  std::deque<ForwardFrame> window_;
};

void Sequence::check() const {
  if (!scene_.fit.photos.empty())
    throw unfit_for_map(scene_, "fit.photo", "a sequence of maps is of one camera")
        .expected("a scene without [[fit.photo]]");
  const std::vector<MapNumber> numbers = map_numbers(scene_);
  if (!numbers.empty())
    throw unfit_for_map(scene_, "fit.free", "a sequence of maps takes " + numbers.front().label + " as known")
        .expected("no number of the camera, the air, the field or the blur in fit.free")
        .hint("map single frames to have its error");
  for (std::size_t i = 1; i < frames_.time_s.size(); ++i)
    if (!(frames_.time_s[i] > frames_.time_s[i - 1]))
      throw sim::Error(sim::ErrorKind::usage, frames_.names[i] + " is not later than " + frames_.names[i - 1])
          .key("--sequence")
          .expected("frames in the order of time, each with a time of its own");
}

Photo Sequence::read(std::size_t number) const {
  Photo photo = frames_.read(number);
  const sim::Camera& camera = scene_.camera;
  if (photo.linear.width != camera.width || photo.linear.height != camera.height)
    throw sim::unreadable(photo.file_name, "has " + sim::size_text(photo.linear.width, photo.linear.height) +
                                               " pixels, the camera " +
                                               sim::size_text(camera.width, camera.height))
        .expected("frames of one camera");
  return photo;
}

MapResult Sequence::first_map() {
  MapOptions o = options_;
  constexpr double kOfAll = 0.25;
  if (options_.progress)
    o.progress = [&](const std::string& stage, double chi2, double share) {
      options_.progress("first frame: " + stage, chi2, kOfAll * share);
    };
  for (begin_ = 0;; ++begin_) {
    first_photo_ = {frames_.read(begin_)};
    o.step_prefix = "first frame " + std::to_string(begin_) + ": ";
    try {
      MapResult first = map_photos(scene_, first_photo_, o);
      if (first.interrupted) throw MapStopped();
      return first;
    } catch (const sim::Error& error) {
      if (error.kind() != sim::ErrorKind::unreadable_input || begin_ + 1 >= frames_.names.size()) throw;
      facts_.without_map.push_back({begin_, "no light is above the noise and the sky"});
    }
  }
}

void Sequence::perturb(const MapResult& first) {
  for (std::size_t r = 0; r < first.replicates.size(); ++r) {
    PerturbedSequence p;
    p.draw = {scene_.seed, static_cast<std::uint32_t>(r)};
    p.spectrum = first.replicate_spectra[r];
    p.values = first.replicate_values[r];
    problem_->look_by_light(fine_->base, problem_->scenes_with(p.values), p.spectrum);
    p.rates = fine_->base.front().light().rate();
    p.prior_factors = p.draw.prior_factors(fine_->grid.cells());
    p.sparsity = p.draw.sparsity(first.sparsity);
    perturbed_.push_back(std::move(p));
  }
  fine_->base.front().set_modes(problem_->modes);
}

void Sequence::prepare(const MapResult& first) {
  problem_.emplace(scene_, first_photo_, options_);
  problem_->modes = first.scene.emission.modes;
  if (problem_->modes_before.empty()) problem_->modes.clear();
  const double farthest =
      options_.farthest_km > 0.0 ? options_.farthest_km : ground_reach_km(problem_->pictures(2));
  coarse_.emplace(*problem_, 2, farthest);
  fine_.emplace(*problem_, 1, farthest);
  reading_.emplace(fine_->grid, problem_->energies_kev);
  gain_ = first.photos.front().gain;
  perturb(first);
  common_.emplace(first.scene, fine_->grid);
  common_->numbers = first.numbers;
  common_->altitude_scale = first.altitude_scale;
  common_->spectrum = first.spectrum;
  common_->energies_kev = first.energies_kev;
  common_->modes_covariance = first.modes_covariance;
  common_->sparsity = first.sparsity;
  common_->trials = first.trials;
  common_->spectra = first.spectra;
  for (const PerturbedSequence& p : perturbed_) {
    common_->replicate_spectra.push_back(p.spectrum);
    common_->replicate_values.push_back(p.values);
  }
  common_->map = regridded(first.map, first.grid, fine_->grid);
  coarse_pass_.emplace(*problem_, *coarse_, coarsened(common_->map, fine_->grid, coarse_->grid),
                       first.sparsity);
}

MapSolution Sequence::solve(const SequenceLevel& level, std::vector<MapObservation>& picture,
                            std::vector<float> start, MapSolverOptions o) const {
  o.stop = options_.stop;
  return solve_map(picture, level.near, static_cast<int>(problem_->energies_kev.size()), std::move(start), o);
}

StepOutput Sequence::solved_frame(std::size_t number, const Photo& photo, const CoarseState& before,
                                  const std::vector<SparseMap>& maps_before) const {
  const double time_s = frames_.time_s[number], seconds = time_s - before.time_s;
  const bool carried = before.begun && seconds <= kLongestStep_s && !maps_before.empty();
  const double bond = carried ? bond_over(seconds) : 0.0;
  const CoarseState coarse = coarse_pass_->step(before, photo, time_s, bond, gain_, nullptr);
  StepOutput out;
  std::vector<MapObservation> picture = fine_->observed(*problem_, photo);
  MapObservation& one = picture.front();
  one.gain = gain_;
  const CellPoints::Sources sources =
      carried ? fine_->points->after(coarse.drift, seconds, options_.threads) : CellPoints::Sources();
  std::vector<std::uint8_t> unpredicted;
  if (carried) unpredicted = sources.from_unknown(in_view_);
  const auto predicted = [&](std::size_t of) {
    return carried ? sources.moved(maps_before[of].whole(fine_->numbers()), options_.threads)
                   : std::vector<float>();
  };
  // Where there is light, or was to be.
  std::vector<float> best = predicted(0);
  std::vector<bool> near_light =
      cells_near_light(coarse_->grid, coarse.map, problem_->energies_kev, fine_->grid);
  std::vector<std::uint8_t> kept(near_light.begin(), near_light.end());
  for (std::size_t i = 0; i < best.size(); ++i)
    if (best[i] > 0.0f) kept[i / kGroundEnergies] = 1;
  const std::vector<float> rough = regridded(coarse.map, coarse_->grid, fine_->grid);
  const auto start_from = [&](const std::vector<float>& prediction) {
    std::vector<float> start = rough;
    const auto little = static_cast<float>(1e-3 * brightest(rough));
    for (std::size_t i = 0; i < start.size(); ++i) {
      if (!prediction.empty())
        start[i] = static_cast<float>(kOfPicture * start[i] + (1.0 - kOfPicture) * prediction[i]);
      start[i] = kept[i / kGroundEnergies] != 0 ? start[i] + little : 0.0f;
    }
    return start;
  };
  const auto solved = [&](std::vector<MapObservation>& of, const std::vector<float>& start,
                          const std::vector<float>& prediction, int steps, double sparsity,
                          std::vector<float> factors) {
    MapSolverOptions o;
    o.sparsity = sparsity;
    o.cell_factor = std::move(factors);
    o.steps = steps;
    o.gains_from = std::min(o.gains_from, steps / 2);
    if (!prediction.empty()) {
      o.predicted = prediction;
      o.time_bond = kFinerCells * bond;
      o.unpredicted = unpredicted;
    }
    of.front().keep(kept);
    return solve(*fine_, of, start, o).map;
  };
  const std::vector<float> begin =
      carried || before.begun ? start_from(best) : start_from(std::vector<float>(common_->map));
  const std::vector<float> map =
      solved(picture, begin, best, carried ? kFrameSteps : 2 * kBeginSteps, common_->sparsity, {});
  SparseMap(map).store(out, "map 0");
  out.numbers["gain"] = {one.gain[0], one.gain[1], one.gain[2]};
  const std::vector<CellFlux> cells = reading_->cells(map);
  MapLight truth, residual;
  one.forward(map, truth);
  one.residual(truth, residual);
  const MapLight sky = one.sky();
  for (std::size_t i = 0; i < truth.size(); ++i) truth[i] += sky[i];
  std::vector<SparseMap> perturbed(perturbed_.size());
  sim::parallel_for(perturbed_.size(), options_.threads, [&](std::size_t r, int) {
    if (problem_->stopped()) return;
    const PerturbedSequence& p = perturbed_[r];
    std::vector<MapObservation> alone = picture;
    alone.front().work_alone();
    alone.front().set_rates(p.rates);
    alone.front().set_data(p.draw.data(one, truth, 0, number, 1));
    const std::vector<float> prediction = predicted(r + 1);
    // Drawn about the best map each time: drawn about its own, light that no picture holds would grow.
    std::vector<float> start = p.draw.start(map, cells, problem_->energies_kev);
    if (carried)
      for (std::size_t i = 0; i < start.size(); ++i)
        start[i] = static_cast<float>(kOfPicture * start[i] + (1.0 - kOfPicture) * prediction[i]);
    for (std::size_t i = 0; i < start.size(); ++i)
      if (kept[i / kGroundEnergies] == 0) start[i] = 0.0f;
    perturbed[r] = SparseMap(solved(alone, start, prediction, carried ? kPerturbedSteps : kBeginSteps,
                                    p.sparsity, p.prior_factors));
  });
  for (std::size_t r = 0; r < perturbed.size(); ++r) perturbed[r].store(out, "map " + std::to_string(r + 1));
  SparseMap(coarse.map).store(out, "coarse map");
  if (coarse.drift.moves()) {
    const auto of = [](const Eigen::MatrixXd& m) {
      return std::vector<double>(m.data(), m.data() + m.size());
    };
    out.numbers["velocity"] = of(coarse.drift.velocity_km_s);
    out.numbers["growth"] = of(coarse.drift.growth_per_s);
    out.numbers["covariance"] = of(coarse.drift.covariance);
  }
  out.whole = !problem_->stopped();
  return out;
}

void Sequence::go_on(std::size_t number, const Photo& photo) {
  const std::vector<SparseMap> none;
  const std::vector<SparseMap>& before = window_.empty() ? none : window_.back().maps;
  const double seconds = frames_.time_s[number] - state_.time_s;
  const StepOutput out = problem_->step("frame " + std::to_string(number),
                                        [&] { return solved_frame(number, photo, state_, before); });
  if (problem_->stopped()) throw MapStopped();
  ForwardFrame frame{number, 0.0, 0.0, {}, {}, {}, *common_};
  for (std::size_t r = 0; r <= perturbed_.size(); ++r)
    frame.maps.push_back(SparseMap::stored(out, "map " + std::to_string(r), fine_->numbers()));
  CoarseState after;
  after.begun = true;
  after.time_s = frames_.time_s[number];
  after.in_view = cells_in_view(coarse_->observed(*problem_, photo).front(), scene_.site, coarse_->grid);
  after.map = SparseMap::stored(out, "coarse map", coarse_->numbers()).whole(coarse_->numbers());
  if (out.numbers.count("velocity") > 0) {
    after.drift = drift_before(DriftNet::over(coarse_->grid));
    const auto fill = [&](const std::string& name, auto& matrix) {
      const std::vector<double>& stored = out.numbers_at(name, static_cast<std::size_t>(matrix.size()));
      std::copy(stored.begin(), stored.end(), matrix.data());
    };
    fill("velocity", after.drift.velocity_km_s);
    fill("growth", after.drift.growth_per_s);
    fill("covariance", after.drift.covariance);
    frame.seconds = seconds;
    frame.drift = after.drift;
    const CellPoints::Sources sources = fine_->points->after(after.drift, seconds, options_.threads);
    for (const SparseMap& map : before)
      frame.predicted.emplace_back(sources.moved(map.whole(fine_->numbers()), options_.threads));
    if (!window_.empty()) window_.back().kept = kept_over(seconds);
  }
  const std::vector<double>& gain = out.numbers_at("gain", 3);
  std::copy(gain.begin(), gain.end(), gain_.begin());
  std::vector<MapObservation> picture = fine_->observed(*problem_, photo);
  picture.front().gain = gain_;
  frame.reading.map = frame.maps.front().whole(fine_->numbers());
  reading_->read(*problem_, picture, frame.reading);
  in_view_ = frame.reading.border_in_view;
  frame.reading.map.clear();
  window_.push_back(std::move(frame));
  state_ = std::move(after);
  if (window_.size() > kLag) give_first();
}

void Sequence::give_first() {
  const std::size_t numbers = fine_->numbers();
  std::vector<std::vector<float>> maps;
  for (const SparseMap& map : window_.back().maps) maps.push_back(map.whole(numbers));
  DriftField drift = window_.back().drift;
  for (std::size_t i = window_.size() - 1; i-- > 0;) {
    const ForwardFrame &frame = window_[i], &next = window_[i + 1];
    if (next.seconds == 0.0) {  // nothing was carried over
      for (std::size_t r = 0; r < maps.size(); ++r) maps[r] = frame.maps[r].whole(numbers);
      drift = frame.drift;
      continue;
    }
    const CellPoints::Sources back = fine_->points->after(next.drift, -next.seconds, options_.threads);
    for (std::size_t r = 0; r < maps.size(); ++r) {
      std::vector<float> better = std::move(maps[r]);
      const std::vector<float> predicted = next.predicted[r].whole(numbers);
      for (std::size_t n = 0; n < numbers; ++n) better[n] -= predicted[n];
      better = back.moved(better, options_.threads);
      maps[r] = frame.maps[r].whole(numbers);
      for (std::size_t n = 0; n < numbers; ++n)
        maps[r][n] = std::max(0.0f, maps[r][n] + static_cast<float>(frame.kept) * better[n]);
    }
    drift = frame.drift.moves() ? smoothed_drift(frame.drift, drift, next.seconds) : DriftField();
  }
  ForwardFrame first = std::move(window_.front());
  window_.pop_front();
  MapOfFrame given{first.number, std::move(first.reading), std::move(drift)};
  given.map.map = std::move(maps.front());
  reading_->read_cells(given.map);
  for (std::size_t r = 1; r < maps.size(); ++r) given.map.replicates.push_back(reading_->cells(maps[r]));
  done_(std::move(given));
}

MapSequenceFacts Sequence::run() {
  check();
  const MapResult first = first_map();
  prepare(first);
  facts_.bond = choose_time_bond(
      *problem_, *coarse_pass_, frames_.time_s, begin_, [&](std::size_t i) { return read(i); }, gain_,
      [&] { tell("choosing the bond in time", 0.0, 0.27); });
  problem_->require_going();
  const std::size_t count = frames_.names.size();
  for (std::size_t i = begin_; i < count; ++i) {
    tell("frame " + std::to_string(i + 1) + " of " + std::to_string(count), 0.0,
         0.3 + 0.7 * static_cast<double>(i - begin_) / static_cast<double>(count - begin_));
    const Photo photo = i == begin_ ? first_photo_.front() : read(i);
    if (fine_->observed(*problem_, photo).front().values() == 0) {
      facts_.without_map.push_back({i, "no pixel can be used"});
      continue;
    }
    go_on(i, photo);
  }
  while (!window_.empty()) give_first();
  return std::move(facts_);
}

}  // namespace

MapSequenceFacts map_sequence(const sim::Scene& scene, const MapFrames& frames, const MapOptions& options,
                              const std::function<void(MapOfFrame)>& done) {
  return Sequence(scene, frames, options, done).run();
}

}  // namespace vegard::fit
