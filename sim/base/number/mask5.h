// Masks of 5 x 5 x 5 numbers, for convolving grids.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace vegard::sim {

/// What a single voxel of 1 becomes: weight(i, j, k) at i, j, k voxels from it, each from -2 to 2.
struct Mask5 {
  static constexpr int kReach = 2, kSide = 5, kWeights = kSide * kSide * kSide;
  static constexpr double kMaxWeight = 1e6;  ///< in files; what grids hold at most stays a float with it
  std::array<double, kWeights> weights{};

  static constexpr int at(int i, int j, int k) {
    return ((i + kReach) * kSide + j + kReach) * kSide + k + kReach;
  }
  double sum() const;
};

/// The outer product of three times (1, 4, 6, 4, 1) / 16. Its sum is 1.
Mask5 blur_mask();

/// Twice what is there, less the blur. Its sum is 1.
Mask5 sharpen_mask();

/// 125 numbers with blanks, commas or ends of lines between them, k fastest and i slowest: 25 lines of 5 if
/// it is to be read by people. What follows a # is skipped. Throws Error(unreadable_input) with file and line
/// for what is no finite number or beyond kMaxWeight, and for too many or too few.
Mask5 read_mask5(std::string_view text, const std::string& name);

}  // namespace vegard::sim
