// When a footprint's picture is looked at, for the light of an exposure.
//
// A footprint that moves by itself is looked at in each instant of an exposure; and, since excited atoms
// shine after a while, as it was before (sim/render/beams/age_intervals.h): of each interval of age at as
// many times as it changes in it. Where no more than the substorm's level changes it is looked at once.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/render/beams/age_intervals.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct FootprintLook {
  std::vector<double> instants_s{};  ///< whose mean counts; none: the scene's start
  double share = 1.0;                ///< of its light
  LightShare of_lines{};             ///< what of each line's light counts besides; empty: all
};

/// All that add up to the light of an exposure. A footprint of colours shines at once, and so does everything
/// where emission.lag is "none". In an interval of age a footprint of a box that only drifts is looked at 64
/// times at most, a curtain 16 times, one whose map must be made again each time 8 times, one around the
/// Earth, or whose flow must be followed, 4 times: the past of all of an exposure's instants in so many
/// groups of neighbours. Each instant counts alike.
std::vector<FootprintLook> footprint_looks(const Scene& scene, const Footprint& footprint);

/// What the maps of all looks take in memory, in bytes, with numbers of this size.
double map_bytes(const Scene& scene, const Footprint& footprint, std::size_t number_bytes);

/// How soon a footprint becomes something else, in seconds: by drifting over its own width or cells, by its
/// noise's lifetime, its flow's turn by a radian, the phases of a substorm, or what its sheets do. Infinite
/// for one that stays.
double soonest_change_s(const Scene& scene, const Footprint& footprint);

/// What the substorm leaves of a footprint's light, where its source does not go by it already.
double substorm_share(const Scene& scene, const Footprint& footprint, double instant_s);

}  // namespace vegard::sim
