#include "sim/render/volumes/point_deposit.h"

#include <cmath>

namespace vegard::sim {

void BrickCounter::count(const BrickCoordinate& at) {
  if (any_ && at == last_at_) return;
  any_ = true;
  last_at_ = at;
  constexpr std::size_t kMax = 16384;
  // splitmix64 (Steele, Lea and Flood 2014, doi:10.1145/2714064.2660195), once for each number.
  std::uint64_t mixed = 0;
  for (const std::int32_t c : {at.x, at.y, at.z}) {
    mixed += static_cast<std::uint32_t>(c) + 0x9E3779B97F4A7C15u;
    mixed = (mixed ^ mixed >> 30) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ mixed >> 27) * 0x94D049BB133111EBu;
    mixed ^= mixed >> 31;
  }
  const auto is_below = [&](std::uint64_t number) {
    return halvings_ == 0 || number >> (64 - halvings_) == 0;
  };
  if (!is_below(mixed) || !kept_.insert(mixed).second) return;
  while (kept_.size() > kMax) {
    ++halvings_;
    for (auto one = kept_.begin(); one != kept_.end();)
      one = is_below(*one) ? std::next(one) : kept_.erase(one);
  }
}

void BrickCounter::add(const EmissionPoints& points) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    const float* at = points.position_in_enu_km.data() + p * 3;
    int low[3], high[3];  // bricks of the voxels on both sides, as PointDeposit has them
    bool inside = true, one_brick = true;
    for (int a = 0; a < 3; ++a) {
      inside = inside && (!box_ || (at[a] >= box_->low[a] && at[a] <= box_->high[a]));
      const double u = at[a] / edge_km_ - 0.5, below = std::floor(u);
      const int voxel = static_cast<int>(below);
      low[a] = voxel >> 3;
      high[a] = u > below ? (voxel + 1) >> 3 : low[a];
      one_brick = one_brick && low[a] == high[a];
    }
    if (!inside) continue;
    if (one_brick) {
      count({low[0], low[1], low[2]});
      continue;
    }
    for (int part = 0; part < 8; ++part)
      count({part & 1 ? high[0] : low[0], part & 2 ? high[1] : low[1], part & 4 ? high[2] : low[2]});
  }
}

PointDeposit::PointDeposit(const std::vector<int>& lines, double edge_km, const std::optional<Box3>& box,
                           std::uint64_t max_bytes)
    : lines_(lines),
      edge_km_(edge_km),
      box_(box),
      max_bytes_(max_bytes),
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
  if (full_ || (bricks_.size() + 1) * bytes_of_brick_ > max_bytes_) {
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
