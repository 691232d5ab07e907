#include "fit/map/sequence/drift_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/map/map_grid.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/render/ground/ground_rates.h"
#include "sim/render/ground/sight_lines.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

// Of the prior: what all light has in common, and what places have of their own.
constexpr double kCommon_km_s = 0.6, kOwn_km_s = 0.3, kShared_km = 300.0, kForgotten_s = 1200.0;
constexpr double kGrowth_per_s = 0.02;
constexpr double kFastest_km_s = 1.5, kTriedStep_km = 6.0;
constexpr double kMostBeyond_km = 40.0, kFromBeyond = 0.08;  // of a cell's light, from places out of view
constexpr int kMostTried = 21;                               // along each direction
constexpr int kNewtonSteps = 4;                              // of Gauss and Newton
constexpr double kLit = 1e-3;         // of all light: a node with less about it has no say
constexpr double kLongest_km = 12.0;  // a step's: the light is linear in no longer ones

/// The correlation of two nodes.
Eigen::MatrixXd correlation(const DriftNet& net) {
  const auto nodes = static_cast<Eigen::Index>(net.nodes());
  Eigen::MatrixXd shared(nodes, nodes);
  for (Eigen::Index i = 0; i < nodes; ++i)
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const sim::EastNorth a = net.place_km(static_cast<std::size_t>(i)),
                           b = net.place_km(static_cast<std::size_t>(j));
      shared(i, j) = std::exp(-std::hypot(a.east - b.east, a.north - b.north) / kShared_km);
    }
  return shared;
}

Eigen::MatrixXd prior_covariance(const DriftNet& net) {
  Eigen::MatrixXd shared = kOwn_km_s * kOwn_km_s * correlation(net);
  shared.array() += kCommon_km_s * kCommon_km_s;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2 * shared.rows(), 2 * shared.cols());
  for (Eigen::Index i = 0; i < shared.rows(); ++i)
    for (Eigen::Index j = 0; j < shared.cols(); ++j)
      for (Eigen::Index k = 0; k < 2; ++k) covariance(2 * i + k, 2 * j + k) = shared(i, j);
  return covariance;
}

/// How much is left of what is known after some seconds.
double remembered(double seconds) { return std::exp(-seconds / kForgotten_s); }

/// The flux by cell, and by node as far as the cells' places share in it.
std::vector<double> light_of_nodes(const DriftNet& net, const sim::GroundGrid& grid,
                                   const std::vector<float>& map) {
  std::vector<double> light(net.nodes(), 0.0);
  for (int c = 0; c < grid.cells(); ++c) {
    double flux = 0.0;
    for (int k = 0; k < kGroundEnergies; ++k) flux += map[static_cast<std::size_t>(c) * kGroundEnergies + k];
    if (flux == 0.0) continue;
    const DriftNet::Share share = net.share_at(grid.middle_km(c));
    for (int i = 0; i < 4; ++i) light[share.node[i]] += flux * grid.area_km2(c) * share.weight[i];
  }
  return light;
}

/// The map, smoothed over a cell. What a solution has from cell to cell, and the cells' own edges, fit the
/// picture where they stand and nowhere else: moved by less than a cell it would always be worse than at
/// rest.
std::vector<float> smoothed_map(std::vector<float> map, const MapNeighbours& near) {
  constexpr int kTimes = 3;  // each time by half a cell
  for (int time = 0; time < kTimes; ++time) {
    std::vector<float> smooth(map.size(), 0.0f);
    for (std::size_t c = 0; c < near.of_cell.size(); ++c)
      for (const MapNeighbours::Near& m : near.of_cell[c])
        for (int k = 0; k < kGroundEnergies; ++k)
          smooth[c * kGroundEnergies + k] +=
              m.weight * map[static_cast<std::size_t>(m.cell) * kGroundEnergies + k];
    map = std::move(smooth);
  }
  return map;
}

/// The film's cells in whose light places that are not in view may have a part, as far as light may have
/// come since.
std::vector<std::uint8_t> light_from_beyond(const MapObservation& picture, const CellPoints& points,
                                            const std::vector<std::uint8_t>& in_view,
                                            const std::vector<float>& before, const DriftField& expected,
                                            double seconds, int threads) {
  double speed_km_s = 0.0;
  for (Eigen::Index i = 0; i < expected.velocity_km_s.size(); ++i)
    speed_km_s = std::max(speed_km_s,
                          std::abs(expected.velocity_km_s(i)) + 2.0 * std::sqrt(expected.covariance(i, i)));
  DriftField around = expected;
  around.growth_per_s.setZero();
  const double way_km_s = std::min({speed_km_s, kFastest_km_s, kMostBeyond_km / seconds});
  // Everywhere the same light of the map's mean electrons.
  float spectrum[kGroundEnergies] = {};
  for (std::size_t i = 0; i < before.size(); ++i) spectrum[i % kGroundEnergies] += before[i];
  std::vector<float> every(before.size()), beyond(before.size(), 0.0f);
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = spectrum[i % kGroundEnergies];
  constexpr int kWays = 8;
  for (int way = 0; way < kWays; ++way) {
    const double angle = 2.0 * sim::kPi * way / kWays;
    for (Eigen::Index n = 0; n < around.growth_per_s.size(); ++n)
      around.velocity_km_s.segment<2>(2 * n) << way_km_s * std::sin(angle), way_km_s * std::cos(angle);
    const std::vector<std::uint8_t> unknown = points.after(around, seconds, threads).from_unknown(in_view);
    for (std::size_t c = 0; c < unknown.size(); ++c)
      if (unknown[c] != 0)
        for (int k = 0; k < kGroundEnergies; ++k) beyond[c * kGroundEnergies + k] = spectrum[k];
  }
  MapLight all, of_beyond;
  picture.forward(every, all);
  picture.forward(beyond, of_beyond);
  std::vector<std::uint8_t> cells(picture.cells(), 0);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (of_beyond[i] > kFromBeyond * all[i]) cells[i / 3] = 1;
  return cells;
}

/// Leaves a part of a picture out for its own lifetime.
class PartLeftOut {
 public:
  PartLeftOut(MapObservation& picture, const std::vector<std::uint8_t>& cells) : picture_(picture) {
    picture_.leave_out(cells);
  }
  ~PartLeftOut() { picture_.leave_out({}); }
  PartLeftOut(const PartLeftOut&) = delete;
  PartLeftOut& operator=(const PartLeftOut&) = delete;

 private:
  MapObservation& picture_;
};

/// One frame's fit.
class DriftFit {
 public:
  DriftFit(MapObservation& picture, const CellPoints& points, const sim::GroundGrid& grid,
           std::vector<float> before, const DriftField& expected, double seconds, int threads)
      : picture_(picture),
        points_(points),
        grid_(grid),
        before_(std::move(before)),
        expected_(expected),
        seconds_(seconds),
        threads_(threads),
        nodes_(static_cast<Eigen::Index>(expected.net.nodes())),
        best_(expected) {
    best_.growth_per_s = Eigen::VectorXd::Zero(nodes_);
  }

  DriftField run(bool is_first) {
    if (is_first) try_whole();
    const Eigen::MatrixXd known = prior_precision();
    for (int step = 0; step < kNewtonSteps; ++step)
      if (!take_step(known)) break;
    return best_;
  }

 private:
  double chi2_of(const DriftField& drift) {
    MapLight light, residual;
    picture_.forward(points_.after(drift, seconds_, threads_).moved(before_, threads_), light);
    return picture_.residual(light, residual);
  }

  /// Tries velocities of the light as a whole.
  void try_whole() {
    const double farthest = kFastest_km_s * seconds_;
    const int tried = std::min(kMostTried, 2 * static_cast<int>(std::ceil(farthest / kTriedStep_km)) + 1);
    DriftField drift = best_, least = best_;
    double least_chi2 = chi2_of(drift);
    for (int i = 0; i < tried; ++i)
      for (int j = 0; j < tried; ++j) {
        const double east = kFastest_km_s * (2.0 * i / (tried - 1) - 1.0),
                     north = kFastest_km_s * (2.0 * j / (tried - 1) - 1.0);
        for (Eigen::Index n = 0; n < nodes_; ++n) drift.velocity_km_s.segment<2>(2 * n) << east, north;
        const double chi2 = chi2_of(drift) + shared_by(least_chi2) * (east * east + north * north) /
                                                 (kCommon_km_s * kCommon_km_s);
        if (chi2 < least_chi2) {
          least_chi2 = chi2;
          least = drift;
        }
      }
    best_ = least;
  }

  /// How many values count as one.
  double shared_by(double chi2) const {
    return kMapSharedBy * std::max(1.0, chi2 / std::max<double>(1.0, static_cast<double>(picture_.values())));
  }

  Eigen::MatrixXd prior_precision() const {
    Eigen::MatrixXd known = Eigen::MatrixXd::Zero(3 * nodes_, 3 * nodes_);
    known.topLeftCorner(2 * nodes_, 2 * nodes_) = sim::inverse_of(expected_.covariance);
    known.bottomRightCorner(nodes_, nodes_) =
        sim::inverse_of(Eigen::MatrixXd(kGrowth_per_s * kGrowth_per_s * correlation(expected_.net)));
    return known;
  }

  /// The numbers of the nodes with light: indices among velocities, then growths.
  std::vector<Eigen::Index> numbers_seen(const std::vector<float>& moved) const {
    const std::vector<double> light = light_of_nodes(expected_.net, grid_, moved);
    double all = 0.0;
    for (const double l : light) all += l;
    std::vector<Eigen::Index> numbers;
    for (Eigen::Index n = 0; n < nodes_; ++n)
      if (light[static_cast<std::size_t>(n)] > kLit * all)
        for (const Eigen::Index i : {2 * n, 2 * n + 1, 2 * nodes_ + n}) numbers.push_back(i);
    return numbers;
  }

  /// Derivatives of the moved map by the velocity and growth of each place, before nodes share in them.
  struct Slopes {
    std::vector<float> east, north, growth;
  };
  Slopes slopes(const std::vector<float>& moved) const {
    const auto towards = [&](double east, double north) {
      return points_.after(best_, seconds_, {east, north}, threads_).moved(before_, threads_);
    };
    const auto between = [&](std::vector<float> up, const std::vector<float>& down) {
      for (std::size_t i = 0; i < up.size(); ++i)
        up[i] = static_cast<float>(-seconds_ * (static_cast<double>(up[i]) - down[i]) /
                                   (2.0 * points_.half_step_km(static_cast<int>(i / kGroundEnergies))));
      return up;
    };
    Slopes slopes;
    slopes.east = between(towards(1.0, 0.0), towards(-1.0, 0.0));
    slopes.north = between(towards(0.0, 1.0), towards(0.0, -1.0));
    slopes.growth = moved;
    for (float& x : slopes.growth) x *= static_cast<float>(seconds_);
    return slopes;
  }

  /// The light of what a node's number changes.
  MapLight light_of(Eigen::Index number, const Slopes& slopes) const {
    const bool grows = number >= 2 * nodes_;
    const auto node = static_cast<std::size_t>(grows ? number - 2 * nodes_ : number / 2);
    const std::vector<float>& slope = grows ? slopes.growth : number % 2 == 0 ? slopes.east : slopes.north;
    std::vector<float> change(slope.size(), 0.0f);
    for (int c = 0; c < grid_.cells(); ++c) {
      const DriftNet::Share share = expected_.net.share_at(grid_.middle_km(c));
      double weight = 0.0;
      for (int i = 0; i < 4; ++i)
        if (share.node[i] == node) weight += share.weight[i];
      if (weight == 0.0) continue;
      for (int k = 0; k < kGroundEnergies; ++k) {
        const std::size_t i = static_cast<std::size_t>(c) * kGroundEnergies + k;
        change[i] = static_cast<float>(weight * slope[i]);
      }
    }
    MapLight light;
    picture_.forward(change, light);
    return light;
  }

  /// Takes a step, and the covariance with it. False once steps are too short to matter.
  bool take_step(const Eigen::MatrixXd& known) {
    const std::vector<float> moved = points_.after(best_, seconds_, threads_).moved(before_, threads_);
    const std::vector<Eigen::Index> numbers = numbers_seen(moved);
    MapLight light, residual;
    picture_.forward(moved, light);
    const double by = shared_by(picture_.residual(light, residual));
    const Slopes slope = slopes(moved);
    Eigen::VectorXd apart(3 * nodes_);
    apart << best_.velocity_km_s - expected_.velocity_km_s, best_.growth_per_s;
    Eigen::MatrixXd precision = known;
    Eigen::VectorXd towards = -known * apart;
    std::vector<MapLight> lights;
    for (const Eigen::Index number : numbers) {
      lights.push_back(light_of(number, slope));
      MapLight weighted;
      picture_.take_sky_away(lights.back(), weighted);
      for (std::size_t j = 0; j < lights.size(); ++j) {
        const double product = dot(lights[j], weighted) / by;
        precision(numbers[j], number) += product;
        if (numbers[j] != number) precision(number, numbers[j]) += product;
      }
      towards(number) -= dot(lights.back(), residual) / by;
    }
    const Eigen::MatrixXd covariance = sim::inverse_of(precision);
    Eigen::VectorXd step = covariance * towards;
    const double longest = step.head(2 * nodes_).cwiseAbs().maxCoeff() * seconds_;
    if (longest > kLongest_km) step *= kLongest_km / longest;
    best_.velocity_km_s += step.head(2 * nodes_);
    best_.growth_per_s += step.tail(nodes_);
    best_.covariance = covariance.topLeftCorner(2 * nodes_, 2 * nodes_);
    constexpr double kShort_km = 0.05;
    return longest > kShort_km;
  }

  MapObservation& picture_;
  const CellPoints& points_;
  const sim::GroundGrid& grid_;
  const std::vector<float> before_;
  const DriftField& expected_;
  const double seconds_;
  const int threads_;
  const Eigen::Index nodes_;
  DriftField best_;
};

}  // namespace

DriftField drift_before(const DriftNet& net) {
  DriftField drift;
  drift.net = net;
  drift.velocity_km_s = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(net.nodes()));
  drift.growth_per_s = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(net.nodes()));
  drift.covariance = prior_covariance(net);
  return drift;
}

DriftField drift_later(const DriftField& drift, double seconds) {
  DriftField later = drift;
  const double left = remembered(seconds);
  later.velocity_km_s *= left;
  later.growth_per_s.setZero();
  later.covariance = left * left * drift.covariance + (1.0 - left * left) * prior_covariance(drift.net);
  return later;
}

std::vector<std::uint8_t> cells_in_view(const MapObservation& picture, const sim::Site& home,
                                        const sim::GroundGrid& grid) {
  std::vector<std::uint8_t> in_view(static_cast<std::size_t>(grid.cells()), 0);
  const sim::FilmGeometry& film = picture.film();
  for (int c = 0; c < grid.cells(); ++c) {
    double x = 0.0, y = 0.0;
    if (!sim::pixel_over_foot(picture.scene(), home, grid.middle_km(c), kMappedBorder_km, x, y)) continue;
    const int column = static_cast<int>((x - film.x0_px) / film.cell_width_px),
              row = static_cast<int>((y - film.y0_px) / film.cell_height_px);
    if (column < 0 || row < 0 || column >= film.columns || row >= film.rows) continue;
    const std::size_t i = (static_cast<std::size_t>(row) * film.columns + column) * 3;
    in_view[static_cast<std::size_t>(c)] =
        picture.sigma()[i] + picture.sigma()[i + 1] + picture.sigma()[i + 2] > 0.0f ? 1 : 0;
  }
  return in_view;
}

DriftField fitted_drift(MapObservation& picture, const CellPoints& points, const sim::GroundGrid& grid,
                        const MapNeighbours& near, const std::vector<std::uint8_t>& in_view,
                        const std::vector<float>& before, const DriftField& expected, double seconds,
                        bool is_first, int threads) {
  const PartLeftOut left_out(picture,
                             light_from_beyond(picture, points, in_view, before, expected, seconds, threads));
  return DriftFit(picture, points, grid, smoothed_map(before, near), expected, seconds, threads)
      .run(is_first);
}

DriftField smoothed_drift(const DriftField& drift, const DriftField& after, double seconds) {
  const DriftField later = drift_later(drift, seconds);
  const Eigen::MatrixXd gain = remembered(seconds) * drift.covariance * sim::inverse_of(later.covariance);
  DriftField smoothed = drift;
  smoothed.velocity_km_s += gain * (after.velocity_km_s - later.velocity_km_s);
  smoothed.covariance += gain * (after.covariance - later.covariance) * gain.transpose();
  return smoothed;
}

}  // namespace vegard::fit
