// SparseGrid: voxels of one or more quantities (channels), stored in bricks of 8 x 8 x 8 where they are not
// 0.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace vegard::sim {

/// The position of a brick: the index of its first voxel over 8.
struct BrickCoordinate {
  std::int32_t x = 0, y = 0, z = 0;
  bool operator<(const BrickCoordinate& o) const { return std::tie(x, y, z) < std::tie(o.x, o.y, o.z); }
  bool operator==(const BrickCoordinate& o) const { return x == o.x && y == o.y && z == o.z; }
};

/// A quantity of a grid: "emission_5577", in "photons cm^-3 s^-1".
struct GridChannel {
  std::string name, unit;
};

/// The numbers of voxel (i, j, k) are those at its centre, origin + voxel (axes[0] (i + 1/2) + axes[1] (j +
/// 1/2) + axes[2] (k + 1/2)). Voxels without a brick are 0.
struct SparseGrid {
  static constexpr int kEdge = 8;
  static constexpr int kVoxels = kEdge * kEdge * kEdge;
  using Brick = std::vector<float>;  ///< [channel][i][j][k]

  double voxel = 1.0;                           ///< edge of a voxel
  std::array<double, 3> origin{0.0, 0.0, 0.0};  ///< the low corner of voxel (0, 0, 0)
  std::array<std::array<double, 3>, 3> axes{
      {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};  ///< unit vectors along i, j and k
  std::vector<GridChannel> channels;
  std::map<BrickCoordinate, Brick> bricks;

  static constexpr int within(int i, int j, int k) { return (i * kEdge + j) * kEdge + k; }

  /// Returns the brick at a position, a new one with zeros if there is none.
  Brick& brick(const BrickCoordinate& at) {
    Brick& found = bricks[at];
    if (found.empty()) found.assign(channels.size() * kVoxels, 0.0f);
    return found;
  }

  /// Returns the index of the channel, or -1.
  int channel(const std::string& name) const {
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c].name == name) return static_cast<int>(c);
    return -1;
  }

  /// Returns the number of a voxel, 0 if there is no brick.
  float value(int channel, int i, int j, int k) const {
    const auto found = bricks.find({i >> 3, j >> 3, k >> 3});
    return found == bricks.end() ? 0.0f : found->second[channel * kVoxels + within(i & 7, j & 7, k & 7)];
  }

  /// Returns the sum over all voxels of a channel.
  double sum(int channel) const {
    double all = 0.0;
    for (const auto& [at, numbers] : bricks)
      for (int v = 0; v < kVoxels; ++v) all += numbers[channel * kVoxels + v];
    return all;
  }
};

/// Returns the memory of a brick while an OpenVDB file is written, with or without a colour of three numbers.
inline std::uint64_t vdb_bytes_of_brick(std::size_t channels, bool with_colour) {
  constexpr std::uint64_t kRest = 200;  // of a leaf and its tree node, without the numbers
  return channels * (sizeof(float) * SparseGrid::kVoxels + kRest) +
         (with_colour ? 3 * sizeof(float) * SparseGrid::kVoxels + kRest : 0);
}

}  // namespace vegard::sim
