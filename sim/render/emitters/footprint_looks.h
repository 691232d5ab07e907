// The instants at which a footprint's map is evaluated for the light of an exposure.
//
// A footprint that changes by itself is evaluated at each instant of an exposure and, since excited atoms
// emit with a delay, at earlier instants (sim/render/beams/light_ages.h): in each interval of age as often
// as the footprint changes in it. If only the substorm's level changes, it is evaluated once.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/render/beams/light_ages.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct FootprintLook {
  std::vector<double> instants_s{};  ///< the light is the mean over them; empty: the scene's start
  double share = 1.0;                ///< factor on the light
  LightShare of_lines{};             ///< further factor for each line's light; empty: 1
};

/// Returns the looks whose sum is the light of an exposure. A footprint in two colours emits without delay,
/// and so does everything if emission.lag is "none". The number of evaluations in an interval of age is at
/// most 64 for a footprint of a box that only drifts, 16 for a curtain, 8 if the map must be made again each
/// time, and 4 around the Earth or if a flow must be followed. The past instants of the whole exposure are
/// put into this many groups of neighbours; all instants have the same weight.
std::vector<FootprintLook> footprint_looks(const Scene& scene, const Footprint& footprint);

/// Returns the bytes that the maps of all looks take, with numbers of `number_bytes` bytes.
double map_bytes(const Scene& scene, const Footprint& footprint, std::size_t number_bytes);

/// Returns the shortest time, in seconds, in which a footprint changes notably: by drifting over its own
/// width or cells, by its noise's lifetime, by a turn of its flow through one radian, by the phases of a
/// substorm, or by the changes of its sheets. Infinite for a steady one.
double soonest_change_s(const Scene& scene, const Footprint& footprint);

/// Returns the factor of the substorm on a footprint's light; 1 if the footprint's source includes it
/// already.
double substorm_share(const Scene& scene, const Footprint& footprint, double instant_s);

}  // namespace vegard::sim
