// Sums of light along lines of sight for sixteen energies at once; used by sim/render/ground/ground_light.h.
#pragma once

#include <cstddef>

#include "sim/render/ground/sight_lines.h"

namespace vegard::sim {

/// Number of electron energies of a cell, side by side in a vector; if fewer are in use, the rest are 0.
inline constexpr int kGroundEnergies = 16;

/// Rates by altitude bin, line and energy: [(bin * lines + line) * kGroundEnergies + energy].
struct GroundRates {
  int lines = 0;
  const float* rate = nullptr;
};

/// light[ray * lines + line] of rays first to last: the sum over stretches and energies of
/// length x rate x flux[cell * kGroundEnergies + energy].
void sum_light(const SightLines& lines, const GroundRates& rates, const float* flux, std::size_t first,
               std::size_t last, float* light);

/// The adjoint: adds length x rate x light to flux[cell * kGroundEnergies + energy].
void spread_light(const SightLines& lines, const GroundRates& rates, const float* light, std::size_t first,
                  std::size_t last, float* flux);

}  // namespace vegard::sim
