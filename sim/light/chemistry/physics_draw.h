// Draws of the numbers of physics within their uncertainty: cross-sections, rate coefficients, yields, air.
//
// Source: data/electrons/uncertainties.csv, which has the standard deviation of the logarithm of each and
// where it comes from. Numbers are independent and log-normal about the value that the program uses.
#pragma once

#include <cstdint>
#include <map>

#include "sim/light/reactions.h"
#include "sim/light/transport/field_air.h"

namespace vegard::sim {

/// What is uncertain of the air, by its number in the table.
enum class UncertainAir {
  density = 1,  ///< all three gases
  oxygen,       ///< atomic oxygen besides
  temperature,  ///< above 100 km, and the scale heights with it
  nitric_oxide,
  electron_temperature,  ///< its excess over the air's
  seconds,               ///< since the electrons have begun to fall
};

/// Factors on the numbers; what is not in a map has 1.
struct PhysicsDraw {
  std::map<int, double> reactions;  ///< by `number` of reactions.csv
  std::map<int, double> processes;  ///< by `process` of cross_sections.csv and emissions.csv
  std::map<UncertainAir, double> of_the_air;
};

/// Returns a draw, a pure function of (seed, number of the draw).
PhysicsDraw draw_physics(std::uint64_t seed, std::uint32_t draw);

/// Returns the table with the factors on the air. Above 100 km the logarithm of each density falls off from
/// its value there the more slowly the warmer it is: hydrostatic where temperatures change by a factor alone.
AirTable changed_air(AirTable table, const std::map<UncertainAir, double>& factors);

}  // namespace vegard::sim
