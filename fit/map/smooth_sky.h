// The sky of a picture that a map must explain, beside the aurora's light: for each channel a sum of smooth
// functions of direction, found by weighted least squares with a weak prior.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/parallel.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

class SmoothSky {
 public:
  static constexpr std::size_t kTerms = 10;
  /// Of each term in each channel.
  using Coefficients = std::array<std::array<double, kTerms>, 3>;

  SmoothSky() = default;
  SmoothSky(const sim::Scene& scene, const sim::FilmGeometry& film);

  /// Takes the weights of values, [cell * 3 + channel], and the data, whose dark part the prior is made from.
  void weigh(const std::vector<float>& weight, const std::vector<float>& data);

  /// Returns the sky by least squares: `weighted(i)` is the weight of value i times the light there that the
  /// sky must explain, 0 where it has no weight. The result does not depend on the number of threads.
  template <class Value>
  Coefficients solve(int threads, const Value& weighted) const {
    std::array<Coefficients, kShares> right{};
    sim::parallel_for(kShares, useful_threads(threads), [&](std::size_t share, int) {
      const std::size_t last = weighted_.size() * (share + 1) / kShares;
      for (std::size_t from = weighted_.size() * share / kShares; from < last; from += kRun)
        add_run(from, std::min(last, from + kRun), weighted, right[share]);
    });
    Coefficients sum{}, sky{};
    for (const Coefficients& part : right)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t j = 0; j < kTerms; ++j) sum[c][j] += part[c][j];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < kTerms; ++i)
        for (std::size_t j = 0; j < kTerms; ++j) sky[c][i] += inverse_[c][i * kTerms + j] * sum[c][j];
    return sky;
  }

  /// Calls use(share, i, light) for each value i of the cells with weights, with the sky's light there; equal
  /// shares, kShares of them, side by side.
  template <class Use>
  void each_weighted(int threads, const Coefficients& sky, const Use& use) const {
    sim::parallel_for(kShares, useful_threads(threads), [&](std::size_t share, int) {
      for (std::size_t n = weighted_.size() * share / kShares; n < weighted_.size() * (share + 1) / kShares;
           ++n)
        each_of(weighted_[n], sky, [&](std::size_t i, float light) { use(share, i, light); });
    });
  }

  /// The sky's light of all cells, [cell * 3 + channel].
  std::vector<float> light(const Coefficients& sky) const;

  static constexpr std::size_t kShares = 8;

 private:
  static constexpr std::size_t kLanes = 8;  ///< cells of a block, side by side
  /// To wake threads takes longer than what there is to do with fewer blocks.
  static constexpr std::size_t kFewBlocks = 1024;
  int useful_threads(int threads) const { return weighted_.size() < kFewBlocks ? 1 : threads; }

  static constexpr std::size_t kRun = 32;  ///< blocks whose sums are of single precision
  using Lanes = std::array<float, kLanes>;

  /// The terms of a block's cells.
  struct Block {
    std::array<Lanes, kTerms> term{};
  };

  template <class Value>
  void add_run(std::size_t from, std::size_t to, const Value& weighted, Coefficients& right) const {
    std::array<std::array<Lanes, kTerms>, 3> sum{};
    for (std::size_t n = from; n < to; ++n) {
      const std::size_t first = std::size_t{weighted_[n]} * kLanes, count = std::min(kLanes, cells_ - first);
      std::array<Lanes, 3> value{};
      for (std::size_t lane = 0; lane < count; ++lane)
        for (std::size_t c = 0; c < 3; ++c)
          value[c][lane] = static_cast<float>(weighted((first + lane) * 3 + c));
      const Block& block = block_[weighted_[n]];
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t j = 0; j < kTerms; ++j)
          for (std::size_t lane = 0; lane < kLanes; ++lane)
            sum[c][j][lane] += value[c][lane] * block.term[j][lane];
    }
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < kTerms; ++j)
        for (const float part : sum[c][j]) right[c][j] += part;
  }

  template <class Use>
  void each_of(std::size_t block, const Coefficients& sky, const Use& use) const {
    std::array<Lanes, 3> light{};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < kTerms; ++j) {
        const auto factor = static_cast<float>(sky[c][j]);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          light[c][lane] += factor * block_[block].term[j][lane];
      }
    const std::size_t first = block * kLanes, count = std::min(kLanes, cells_ - first);
    for (std::size_t lane = 0; lane < count; ++lane)
      for (std::size_t c = 0; c < 3; ++c) use((first + lane) * 3 + c, light[c][lane]);
  }

  std::size_t cells_ = 0;
  std::vector<Block> block_;
  std::vector<std::uint32_t> weighted_;         ///< blocks in which some value has a weight
  std::array<std::vector<double>, 3> inverse_;  ///< (B' W B + prior)^-1 of a channel
};

}  // namespace vegard::fit
