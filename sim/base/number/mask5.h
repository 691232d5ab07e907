// Convolution masks of 5 x 5 x 5 numbers for grids.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace vegard::sim {

/// The result of the convolution for a single voxel of 1: the weight at (i, j, k) voxels from it, each -2 to
/// 2.
struct Mask5 {
  static constexpr int kReach = 2, kSide = 5, kWeights = kSide * kSide * kSide;
  static constexpr double kMaxWeight =
      1e6;  ///< in files; the largest numbers of grids times this are finite floats
  std::array<double, kWeights> weights{};

  static constexpr int at(int i, int j, int k) {
    return ((i + kReach) * kSide + j + kReach) * kSide + k + kReach;
  }
  double sum() const;
};

/// Returns the outer product of three factors (1, 4, 6, 4, 1) / 16. Its sum is 1.
Mask5 blur_mask();

/// Returns twice the identity minus blur_mask(). Its sum is 1.
Mask5 sharpen_mask();

/// Reads 125 numbers, separated by blanks, commas or line breaks, with k varying fastest and i slowest (for
/// instance 25 lines of 5). Text after a # is skipped. Throws Error(unreadable_input) with file and line for
/// a number that is not finite or beyond kMaxWeight, and for too many or too few numbers.
Mask5 read_mask5(std::string_view text, const std::string& name);

}  // namespace vegard::sim
