// How the light of a map moves and grows from one frame to the next, and a map that has moved.
//
// The field has a velocity and a growth rate at nodes of a square net on the ground (feet at 110 km), and is
// bilinear between them. A moved map keeps the flux along the drift,
//
//     x(r, t + dt) = x(r - v(r) dt, t) exp(g(r) dt),
//
// as light does that electrons make along field lines which move with the plasma; its flux is not squeezed
// where the drift converges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sim/render/ground/ground_grid.h"

namespace vegard::fit {

struct Drift {
  double east_km_s = 0.0, north_km_s = 0.0, growth_per_s = 0.0;
};

/// The net of nodes.
struct DriftNet {
  double west_km = 0.0, south_km = 0.0, step_km = 1.0;
  int columns = 0, rows = 0;

  /// A net over all cells of a grid.
  static DriftNet over(const sim::GroundGrid& grid);

  std::size_t nodes() const { return static_cast<std::size_t>(columns) * rows; }
  sim::EastNorth place_km(std::size_t node) const {
    return {west_km + step_km * static_cast<double>(node % columns),
            south_km + step_km * static_cast<double>(node / columns)};
  }

  /// The four nodes about a place and their weights, which sum to 1; beyond the net those of its edge.
  struct Share {
    std::size_t node[4];
    double weight[4];
  };
  Share share_at(sim::EastNorth place_km) const;
};

/// Velocities have the order east, north of each node.
struct DriftField {
  DriftNet net;
  Eigen::VectorXd velocity_km_s;  ///< 2 x nodes; empty: nothing moves
  Eigen::MatrixXd covariance;     ///< of the velocities
  Eigen::VectorXd growth_per_s;   ///< by node

  bool moves() const { return velocity_km_s.size() > 0; }
  Drift at(sim::EastNorth place_km) const;
  /// The covariance of (east, north) there; NaN without velocities.
  Eigen::Matrix2d covariance_at(sim::EastNorth place_km) const;
};

/// Where each cell's flux was before: points inside of a cell, drawn once, so that a move by less than a cell
/// moves the right share of its flux.
class CellPoints {
 public:
  explicit CellPoints(const sim::GroundGrid& grid);

  /// Where what is in a cell comes from.
  struct Sources {
    std::vector<int> cell;      ///< [cell * kPoints + point]; -1: from beyond the grid
    std::vector<float> factor;  ///< by cell, with the points' weight

    /// Cells (1) of which a part comes from a place that is not `known` (by cell, 0: not), or from beyond.
    std::vector<std::uint8_t> from_unknown(const std::vector<std::uint8_t>& known) const;
    /// The map that was `before`, moved.
    std::vector<float> moved(const std::vector<float>& before, int threads) const;
  };
  /// After a drift of `seconds`; a negative time goes back.
  Sources after(const DriftField& drift, double seconds, int threads) const;
  /// The same from places that are `shift` half steps to the east and north of these: for derivatives.
  Sources after(const DriftField& drift, double seconds, sim::EastNorth shift, int threads) const;
  /// Half of a cell's smaller side, the step of derivatives, km.
  double half_step_km(int cell) const { return half_step_km_[static_cast<std::size_t>(cell)]; }

  static constexpr int kPointsAlong = 4, kPoints = kPointsAlong * kPointsAlong;

 private:
  const sim::GroundGrid& grid_;
  std::vector<sim::EastNorth> point_km_;  ///< [cell * kPoints + point]
  std::vector<double> half_step_km_;
};

}  // namespace vegard::fit
