#include "sim/render/volumes/point_deposit.h"

#include <cmath>

namespace vegard::sim {

PointDeposit::PointDeposit(const std::vector<int>& lines, double edge_km, const std::optional<Box3>& box,
                           std::uint64_t most_bytes)
    : lines_(lines),
      edge_km_(edge_km),
      box_(box),
      most_bytes_(most_bytes),
      bytes_of_brick_(bytes_of_brick(lines.size())) {}

std::uint64_t PointDeposit::bytes_of_brick(std::size_t lines) {
  constexpr std::uint64_t kRest = 120;  // a place in the tree
  return lines * SparseGrid::kVoxels * sizeof(double) + kRest;
}

/// Null if there is no room for it.
std::vector<double>* PointDeposit::brick(const BrickCoordinate& at) {
  if (last_ != nullptr && at == last_at_) return last_;
  const auto found = bricks_.find(at);
  if (found != bricks_.end()) {
    last_at_ = at;
    return last_ = &found->second;
  }
  if (full_ || (bricks_.size() + 1) * bytes_of_brick_ > most_bytes_) {
    full_ = true;
    left_out_.insert(at);
    return nullptr;
  }
  last_at_ = at;
  return last_ = &bricks_.emplace(at, std::vector<double>(lines_.size() * SparseGrid::kVoxels, 0.0))
                      .first->second;
}

void PointDeposit::add(const EmissionPoints& points) {
  const std::size_t lines = lines_.size();
  for (std::size_t p = 0; p < points.size(); ++p) {
    const float* at = points.position_in_enu_km.data() + p * 3;
    if (box_) {
      bool inside = true;
      for (int a = 0; a < 3; ++a) inside = inside && at[a] >= box_->low[a] && at[a] <= box_->high[a];
      if (!inside) continue;
    }
    int voxel[3];
    double share[3][2];
    for (int a = 0; a < 3; ++a) {
      const double u = at[a] / edge_km_ - 0.5, low = std::floor(u);
      voxel[a] = static_cast<int>(low);
      share[a][1] = u - low;
      share[a][0] = 1.0 - share[a][1];
    }
    const float* light = points.photons_per_s.data() + p * points.lines;
    for (int part = 0; part < 8; ++part) {
      const int d[3] = {part >> 2, part >> 1 & 1, part & 1};
      const double weight = share[0][d[0]] * share[1][d[1]] * share[2][d[2]];
      if (weight == 0.0) continue;
      const int i = voxel[0] + d[0], j = voxel[1] + d[1], k = voxel[2] + d[2];
      std::vector<double>* to = brick({i >> 3, j >> 3, k >> 3});
      if (to == nullptr) continue;
      double* number = to->data() + SparseGrid::within(i & 7, j & 7, k & 7);
      for (std::size_t l = 0; l < lines; ++l) number[l * SparseGrid::kVoxels] += weight * light[lines_[l]];
    }
  }
}

void PointDeposit::move_to(SparseGrid& grid) {
  const double per_cm3 = 1.0 / (edge_km_ * edge_km_ * edge_km_ * 1e15);
  last_ = nullptr;
  while (!bricks_.empty()) {
    const auto node = bricks_.extract(bricks_.begin());
    SparseGrid::Brick& to = grid.brick(node.key());
    for (std::size_t i = 0; i < node.mapped().size(); ++i)
      to[i] = static_cast<float>(to[i] + node.mapped()[i] * per_cm3);
  }
}

}  // namespace vegard::sim
