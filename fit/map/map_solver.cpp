#include "fit/map/map_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kAlong_km = 6.0;   // smoothing length of Q' and p'
constexpr double kEpsilon = 1e-3;   // of the brightest neighbourhood: less light counts as none
constexpr double kChanging = 0.03;  // of the brightest neighbourhood: less light may come and go
constexpr double kDark = 1e-5;  // of the brightest neighbourhood: less light, with less around, is put out
constexpr int kDarkFrom = 40;   // the step from which cells may count as dark
constexpr double kFewer = 0.8;  // of their cells: lines of sight are made anew once no more are left
constexpr double kMaxModeStep = 1.0;  // standard deviations
constexpr int kHalvings = 3;          // of a step of the modes that does not lead down
constexpr double kLevel = 5e-4;       // relative fall from revision to revision that is no longer waited for

/// Gains that are not known, by least squares with the skies solved for: those of R and B beside G where the
/// white balance is unknown, and of every photograph but the first, whose scale is the map's.
void solve_gains(std::vector<MapObservation>& pictures, std::vector<MapLight>& light) {
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    MapObservation& picture = pictures[p];
    const bool balanced = picture.scene().fit.white_balance_known;
    if (p == 0 && balanced) continue;
    MapLight weighted;
    picture.take_sky_away(light[p], weighted);
    std::array<double, 3> by{}, square{};
    for (std::size_t i = 0; i < weighted.size(); ++i) {
      by[i % 3] += static_cast<double>(weighted[i]) * picture.data()[i];
      square[i % 3] += static_cast<double>(weighted[i]) * light[p][i];
    }
    if (balanced) {
      by.fill(by[0] + by[1] + by[2]);
      square.fill(square[0] + square[1] + square[2]);
    }
    for (int c = 0; c < 3; ++c) {
      if (p == 0 && c == picture.reference_channel()) continue;
      if (!(square[c] > 0.0) || !(by[c] > 0.0)) continue;
      const double change = std::clamp(by[c] / square[c], 0.2, 5.0);
      picture.gain[c] *= change;
      for (std::size_t i = c; i < light[p].size(); i += 3) light[p][i] *= static_cast<float>(change);
    }
  }
}

/// A cell's flux after a change that is taken to first order: never negative.
float moved(float flux, float change) {
  return change >= 0.0f ? flux + change : flux > 0.0f ? flux * flux / (flux - change) : 0.0f;
}

/// The state of a solution and the steps of its loop, in the order of their calls.
class MapSolver {
 public:
  MapSolver(std::vector<MapObservation>& pictures, const MapNeighbours& near, int energies,
            std::vector<float> start, const MapSolverOptions& options)
      : pictures_(pictures),
        options_(options),
        energies_(energies),
        cells_(near.of_cell.size()),
        n_(cells_ * kGroundEnergies),
        near_(near.of_cell),
        modes_(options.modes),
        x_(std::move(start)),
        light_(pictures.size()),
        residual_(pictures.size()),
        along_(pictures.size()) {
    see_light();
  }
  ~MapSolver() {
    for (MapObservation& picture : pictures_) picture.keep_all();
  }
  MapSolver(const MapSolver&) = delete;
  MapSolver& operator=(const MapSolver&) = delete;

  MapSolution run() {
    for (int it = 0; it < options_.steps; ++it) {
      const bool revised = it % options_.held == 0;
      if (revised) {
        if (it >= options_.gains_from) solve_gains(pictures_, light_);
        reweight();
        if (it >= kDarkFrom) leave_out_dark_cells();
        find_scale();
      }
      evaluate();
      steps_ = it;
      if (revised && it > 2 * options_.held) {
        const bool converged = has_converged();
        if (modes_left_ > 0 && (converged || it - modes_at_ >= options_.steps / (options_.modes_steps + 1)))
          solve_modes();
        else if (converged)
          break;
      }
      if (options_.progress) options_.progress(it, chi2_);
      if (options_.stop != nullptr && *options_.stop) break;
      add_penalties();
      find_length(revised, it % 3 == 0 ? StepLength::longer : StepLength::shorter);
      const double slope = project_step();
      if (!(slope < 0.0)) {
        if (revised) break;
        gradient_before_.clear();
        length_ = 1.0;
        continue;
      }
      take_step(exact_share(slope));
    }
    return {std::move(x_), std::move(modes_), chi2_, steps_};
  }

  MapModes learnt() {
    reweight();
    find_scale();
    evaluate();
    const double prior = modes_prior();
    MapModes modes;
    modes.response = response(prior);
    const auto count = static_cast<Eigen::Index>(modes_.size());
    const std::optional<Eigen::MatrixXd> root = sim::cholesky_root(
        sim::inverse_of(modes.response.information / prior + Eigen::MatrixXd::Identity(count, count)));
    modes.spread = root ? *root : Eigen::MatrixXd(Eigen::MatrixXd::Identity(count, count));
    return modes;
  }

 private:
  enum class StepLength { longer, shorter };

  /// The flux of each cell, and that of its neighbourhood. Returns the brightest neighbourhood's.
  double smooth_flux() {
    for (std::size_t c = 0; c < cells_; ++c) {
      double sum = 0.0;
      for (int k = 0; k < energies_; ++k) sum += x_[c * kGroundEnergies + k];
      flux_[c] = static_cast<float>(sum);
    }
    double most = 0.0;
    for (std::size_t c = 0; c < cells_; ++c) {
      double sum = 0.0;
      for (const MapNeighbours::Near& m : near_[c]) sum += m.weight * flux_[m.cell];
      smooth_[c] = static_cast<float>(sum);
      most = std::max(most, sum);
    }
    return most;
  }

  /// The flux of each neighbourhood in the prediction; empty without one.
  std::vector<float> smooth_prediction() const {
    std::vector<float> smooth;
    if (options_.time_bond <= 0.0 || options_.predicted.empty()) return smooth;
    std::vector<float> flux(cells_);
    for (std::size_t c = 0; c < cells_; ++c)
      for (int k = 0; k < energies_; ++k) flux[c] += options_.predicted[c * kGroundEnergies + k];
    for (std::size_t c = 0; c < cells_; ++c) {
      double sum = 0.0;
      for (const MapNeighbours::Near& m : near_[c]) sum += m.weight * flux[m.cell];
      smooth.push_back(static_cast<float>(sum));
    }
    return smooth;
  }

  bool is_predicted(std::size_t c) const {
    return !smooth_predicted_.empty() && (options_.unpredicted.empty() || options_.unpredicted[c] == 0);
  }

  /// Holds a cell near its prediction beside what holds it already: two parabolas make one.
  void hold_to_prediction(std::size_t c, double most) {
    const double bright = std::max(smooth_[c], smooth_predicted_[c]);
    const auto bond = static_cast<float>(options_.time_bond / std::pow(bright + kChanging * most, 2));
    for (int k = 0; k < energies_; ++k) {
      const std::size_t i = c * kGroundEnergies + k;
      target_[i] = (bond_[i] * target_[i] + bond * options_.predicted[i]) / (bond_[i] + bond);
      bond_[i] += bond;
    }
  }

  /// The weights of the sparsity, of the neighbours' mean spectrum and of the prediction, from the map as it
  /// is.
  void reweight() {
    const double most = smooth_flux(), epsilon = kEpsilon * most;
    for (std::size_t c = 0; c < cells_; ++c) {
      const double bright = is_predicted(c) ? 0.5 * (smooth_[c] + smooth_predicted_[c]) : smooth_[c];
      linear_[c] = static_cast<float>(options_.sparsity / (bright + epsilon));
      if (!options_.cell_factor.empty()) linear_[c] *= options_.cell_factor[c];
      if (options_.energy_bond <= 0.0) continue;
      double spectrum[kGroundEnergies] = {};
      for (const MapNeighbours::Near& m : near_[c])
        for (int k = 0; k < energies_; ++k) spectrum[k] += m.weight * x_[m.cell * kGroundEnergies + k];
      for (int k = 0; k < energies_; ++k) {
        target_[c * kGroundEnergies + k] = static_cast<float>(flux_[c] * spectrum[k] / (smooth_[c] + 1e-30));
        bond_[c * kGroundEnergies + k] =
            static_cast<float>(options_.energy_bond / std::pow(smooth_[c] + epsilon, 2));
      }
      if (is_predicted(c)) hold_to_prediction(c, most);
    }
  }

  static std::vector<std::uint32_t> all_of(std::size_t cells) {
    std::vector<std::uint32_t> all(cells);
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  void see_light() {
    for (std::size_t p = 0; p < pictures_.size(); ++p) pictures_[p].forward(x_, light_[p]);
  }

  /// Puts out cells about which there is next to no light, and takes them out of the lines of sight: most of
  /// the ground, and of the work. A cell without light stays so, as steps are in proportion to it.
  void leave_out_dark_cells() {
    float most = 0.0f;
    for (const float q : smooth_) most = std::max(most, q);
    const auto dark = static_cast<float>(kDark * most);
    std::vector<std::uint8_t> kept(cells_);
    std::size_t count = 0;
    for (const std::uint32_t c : lit_) {
      kept[c] = smooth_[c] > dark || flux_[c] > dark ? 1 : 0;
      count += kept[c];
    }
    if (static_cast<double>(count) > kFewer * static_cast<double>(lit_.size())) return;
    std::size_t lit = 0;
    for (const std::uint32_t c : lit_)
      if (kept[c] != 0)
        lit_[lit++] = c;
      else
        for (std::size_t i = c * std::size_t{kGroundEnergies}; i < (c + 1) * std::size_t{kGroundEnergies};
             ++i)
          x_[i] = step_[i] = 0.0f;
    lit_.resize(lit);
    for (MapObservation& picture : pictures_) picture.keep(kept);
    see_light();
  }

  /// The function itself, whose weights have just been computed. Shares of the brightest neighbourhood do not
  /// ask how bright it is.
  double objective(double prior) const {
    double sum = 0.5 * chi2_, most = 0.0;
    for (std::size_t k = 0; k < modes_.size(); ++k)
      sum += 0.5 * prior * std::pow(modes_[k] - options_.modes_centre[k], 2);
    for (const float q : smooth_) most = std::max(most, static_cast<double>(q));
    for (std::size_t c = 0; c < cells_; ++c)
      sum += options_.sparsity * (options_.cell_factor.empty() ? 1.0 : options_.cell_factor[c]) *
             std::log1p(smooth_[c] / (kEpsilon * most));
    for (std::size_t i = 0; i < n_; ++i) {
      const double apart = static_cast<double>(x_[i]) - target_[i];
      sum += 0.5 * bond_[i] * apart * apart;
    }
    return sum;
  }

  /// The precision of the modes' prior beside chi2, in which all values count.
  double modes_prior() const {
    double values = 0.0;
    for (const MapObservation& picture : pictures_) values += static_cast<double>(picture.values());
    // What is not explained is no noise that would average out.
    return kMapSharedBy * std::max(1.0, chi2_ / std::max(1.0, values));
  }

  ModeResponse response(double prior) {
    evaluate();
    add_penalties();
    // Sparsity is of shares of the light: that it wants less of all is no reason for other light.
    double wanted = 0.0, all = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      wanted += static_cast<double>(linear_[i / kGroundEnergies]) * x_[i];
      all += x_[i];
    }
    for (float& g : gradient_) g -= static_cast<float>(wanted / std::max(1e-30, all));
    return mode_response({pictures_, x_, light_, scale_, residual_, gradient_, options_.stop},
                         static_cast<int>(modes_.size()), prior);
  }

  /// A step of Gauss and Newton of the modes, with the map's answer, to less of the function.
  void solve_modes() {
    reweight();  // cells may have been put out since
    const double prior = modes_prior();
    const ModeResponse r = response(prior);
    if (options_.stop != nullptr && *options_.stop) return;
    const double before = objective(prior);
    const auto count = static_cast<Eigen::Index>(modes_.size());
    Eigen::VectorXd towards = -r.gradient;
    for (Eigen::Index k = 0; k < count; ++k)
      towards(k) +=
          prior * (options_.modes_centre[static_cast<std::size_t>(k)] - modes_[static_cast<std::size_t>(k)]);
    const Eigen::VectorXd step =
        sim::solve_symmetric(r.information + prior * Eigen::MatrixXd::Identity(count, count), towards);
    const double longest = step.cwiseAbs().maxCoeff();
    const std::vector<double> modes = modes_;
    const std::vector<float> map = x_, change = r.answer(step);
    double share = longest > kMaxModeStep ? kMaxModeStep / longest : 1.0;
    for (int i = 0; i <= kHalvings + 1; ++i, share = i <= kHalvings ? 0.5 * share : 0.0) {
      for (std::size_t k = 0; k < modes_.size(); ++k)
        modes_[k] = modes[k] + share * step(static_cast<Eigen::Index>(k));
      for (std::size_t n = 0; n < change.size(); ++n)
        x_[n] = moved(map[n], static_cast<float>(share) * change[n]);
      for (MapObservation& picture : pictures_) picture.set_modes(modes_);
      see_light();
      evaluate();
      reweight();
      if (objective(prior) <= before) break;
    }
    find_scale();
    objective_before_ = std::numeric_limits<double>::infinity();
    modes_at_ = steps_;
    --modes_left_;
  }

  /// The multiplicative method's scale, x over the positive part of the gradient.
  void find_scale() {
    std::vector<float> positive(n_, 0.0f);
    MapLight weighted;
    for (std::size_t p = 0; p < pictures_.size(); ++p) {
      const MapLight& w = pictures_[p].weight();
      weighted.assign(w.size(), 0.0f);
      for (std::size_t i = 0; i < w.size(); ++i) weighted[i] = w[i] * std::abs(light_[p][i]);
      pictures_[p].add_adjoint(weighted, positive);
    }
    double mean = 0.0;
    for (const float v : positive) mean += std::max(0.0f, v) / n_;
    for (std::size_t i = 0; i < n_; ++i)
      scale_[i] = 1.0f / (std::max(positive[i], static_cast<float>(1e-3 * mean)) +
                          linear_[i / kGroundEnergies] + bond_[i] * x_[i]);
  }

  /// chi2 and the gradient of its half.
  void evaluate() {
    chi2_ = 0.0;
    std::fill(gradient_.begin(), gradient_.end(), 0.0f);
    for (std::size_t p = 0; p < pictures_.size(); ++p) {
      chi2_ += pictures_[p].residual(light_[p], residual_[p]);
      pictures_[p].add_adjoint(residual_[p], gradient_);
    }
  }

  /// Whether chi2 / 2 with the logarithms that the weights stand for, which all steps together bring down,
  /// has hardly fallen since it was last asked for.
  bool has_converged() {
    double objective = 0.5 * chi2_, most = 0.0;
    for (const float q : smooth_) most = std::max(most, static_cast<double>(q));
    for (const float q : smooth_) objective += options_.sparsity * std::log1p(q / (kEpsilon * most));
    if (objective_before_ - objective < kLevel * objective) return true;
    objective_before_ = objective;
    return false;
  }

  /// Calls body(i, c) for each number i of the cells c that have not been put out.
  template <class Body>
  void each_lit(const Body& body) const {
    for (const std::uint32_t c : lit_)
      for (std::size_t k = 0; k < kGroundEnergies; ++k) body(c * std::size_t{kGroundEnergies} + k, c);
  }

  void add_penalties() {
    each_lit(
        [&](std::size_t i, std::size_t c) { gradient_[i] += linear_[c] + bond_[i] * (x_[i] - target_[i]); });
  }

  /// Barzilai's and Borwein's lengths in the scaled metric; 1 after a revision.
  void find_length(bool revised, StepLength wanted) {
    if (revised || gradient_before_.empty()) {
      length_ = 1.0;
      return;
    }
    double sds = 0.0, sy = 0.0, yy = 0.0;
    each_lit([&](std::size_t i, std::size_t) {
      const float sx = x_[i] - x_before_[i], y = gradient_[i] - gradient_before_[i];
      const float d = std::max(1e-30f, x_[i] * scale_[i]);
      sds += static_cast<double>(sx) * sx / d;
      sy += static_cast<double>(sx) * y;
      yy += static_cast<double>(y) * y * d;
    });
    if (sy > 0.0) length_ = std::clamp(wanted == StepLength::longer ? sds / sy : sy / yy, 1e-2, 1e3);
  }

  /// The step along the scaled gradient to where x >= 0. Returns the slope along it.
  double project_step() {
    double slope = 0.0;
    const auto length = static_cast<float>(length_);
    each_lit([&](std::size_t i, std::size_t) {
      const float to = std::max(0.0f, x_[i] - length * x_[i] * scale_[i] * gradient_[i]);
      step_[i] = to - x_[i];
      slope += static_cast<double>(step_[i]) * gradient_[i];
    });
    return slope;
  }

  /// The share of the step at which the quadratic problem is least, at most 1.
  double exact_share(double slope) {
    double curvature = 0.0;
    MapLight weighted;
    for (std::size_t p = 0; p < pictures_.size(); ++p) {
      pictures_[p].forward(step_, along_[p]);
      pictures_[p].take_sky_away(along_[p], weighted);
      curvature += dot(along_[p], weighted);
    }
    each_lit([&](std::size_t i, std::size_t) {
      curvature += static_cast<double>(bond_[i] * step_[i]) * step_[i];
    });
    return curvature > 0.0 ? std::min(1.0, -slope / curvature) : 1.0;
  }

  void take_step(double share) {
    gradient_before_ = gradient_;
    x_before_ = x_;
    const auto t = static_cast<float>(share);
    each_lit([&](std::size_t i, std::size_t) { x_[i] = std::max(0.0f, x_[i] + t * step_[i]); });
    for (std::size_t p = 0; p < pictures_.size(); ++p)
      for (std::size_t i = 0; i < light_[p].size(); ++i) light_[p][i] += t * along_[p][i];
  }

  std::vector<MapObservation>& pictures_;
  const MapSolverOptions& options_;
  const int energies_;
  const std::size_t cells_, n_;
  const std::vector<std::vector<MapNeighbours::Near>>& near_;
  std::vector<double> modes_;
  int modes_left_ = modes_.empty() ? 0 : options_.modes_steps;  // steps of the modes that are to come
  int modes_at_ = 0;                                            // the step of the last one
  std::vector<float> x_, x_before_, step_ = std::vector<float>(n_), scale_ = std::vector<float>(n_, 0.0f);
  std::vector<float> gradient_ = std::vector<float>(n_), gradient_before_;
  std::vector<float> flux_ = std::vector<float>(cells_), smooth_ = std::vector<float>(cells_);
  std::vector<float> smooth_predicted_ = smooth_prediction();
  std::vector<float> linear_ = std::vector<float>(cells_, 0.0f);  // weights of the sparsity
  std::vector<float> bond_ = std::vector<float>(n_, 0.0f), target_ = std::vector<float>(n_, 0.0f);
  std::vector<MapLight> light_, residual_, along_;  // by picture; along_: the light of step_
  double chi2_ = 0.0, length_ = 1.0, objective_before_ = std::numeric_limits<double>::infinity();
  int steps_ = 0;
  std::vector<std::uint32_t> lit_ = all_of(cells_);  ///< cells that have not been put out
};

}  // namespace

MapNeighbours::MapNeighbours(const sim::GroundGrid& grid) : of_cell(static_cast<std::size_t>(grid.cells())) {
  for (int cell = 0; cell < grid.cells(); ++cell) {
    const double reach = std::max(kAlong_km, 1.01 * std::max(grid.depth_km(cell), grid.breadth_km(cell)));
    double sum = 0.0;
    for (const auto& near : grid.near(cell, 1.5 * reach)) {
      const double d = std::hypot(near.east_km, near.north_km) / reach;
      const double w = std::exp(-0.5 * d * d * 4.0) * grid.area_km2(near.cell);
      of_cell[cell].push_back({near.cell, static_cast<float>(w)});
      sum += w;
    }
    for (Near& near : of_cell[cell]) near.weight = static_cast<float>(near.weight / sum);
  }
}

MapSolution solve_map(std::vector<MapObservation>& pictures, const MapNeighbours& near, int energies,
                      std::vector<float> start, const MapSolverOptions& options) {
  return MapSolver(pictures, near, energies, std::move(start), options).run();
}

MapModes solved_modes(std::vector<MapObservation>& pictures, const MapNeighbours& near, int energies,
                      const std::vector<float>& map, const MapSolverOptions& options) {
  return MapSolver(pictures, near, energies, map, options).learnt();
}

std::vector<float> moved_map(const std::vector<float>& map, const std::vector<float>& change) {
  std::vector<float> to = map;
  for (std::size_t i = 0; i < change.size(); ++i) to[i] = moved(map[i], change[i]);
  return to;
}

}  // namespace vegard::fit
