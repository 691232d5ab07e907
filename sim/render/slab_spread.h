// Spreads the light on a film by the motion of its excited atoms, one slab of altitude after the other
// (sim/render/beams/altitude_slabs.h). It works for every lens and every source of the light.
//
// Cell and altitude determine the distance r of the light, and with the lens the width on the film of a
// Gaussian in space: the mean of its variances along two axes is sigma^2 / r^2 times half the sum of the
// squares of d (x, y) / d direction. (For a pinhole this is sigma^2 (f/Z)^2 (1 + tan^2 theta / 2), as in
// sim/render/physical_blur.h.) An observer above the light may see it on this side of the Earth's limb and
// beyond; then the light is taken to be at the lowest point of the line of sight, unless the line meets the
// ground.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/beams/altitude_slabs.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/level_ladder.h"

namespace vegard::sim {

/// Returns the distance in km from the observer to light at an altitude, along a direction with this sine of
/// the elevation.
double range_to_altitude_km(double observer_km, double sine, double altitude_km,
                            double sphere_km = kEarthRadiusKm);

/// The directions of a film's cells and their scale.
struct FilmSight {
  FilmGeometry film;
  std::vector<float> sine;  ///< [cell] sine of the elevation
  std::vector<float>
      px2;  ///< [cell] variance in px^2 on the film per square radian of variance in direction; 0: not seen
  std::vector<float> enu[3];  ///< [cell] the direction, if requested

  /// The direction of a cell, where directions were requested.
  std::array<float, 3> direction(std::size_t cell) const {
    return {enu[0][cell], enu[1][cell], enu[2][cell]};
  }
};
FilmSight film_sight(const Scene& scene, const FilmGeometry& film, bool with_directions, int threads);

/// Range of the standard deviation, in pixels, of a slab's light on a film.
struct SpreadRange {
  double min_px = 0.0, max_px = 0.0;
};
SpreadRange spread_range(const Scene& scene, const FilmSight& sight, double altitude_km, double variance_km2);

/// Where the light of a slab goes from each cell of a film: the two neighbouring levels of the ladder of
/// blurs that share it, and its new place if a wind moves it.
struct SlabPlaces {
  std::vector<std::uint8_t> lower;  ///< [cell] the lower of the two levels
  std::vector<float> upper_share;   ///< [cell] share of the upper level
  std::vector<float> x_px, y_px;    ///< [cell]; empty: the cells' middles
  std::vector<float> gain;          ///< [cell] factor for light that the wind brings nearer; empty: 1
  int least = 0, most = 0;          ///< lowest and highest level that gets any light
};

/// Light of one slab on a film.
struct SlabLight {
  const FilmGeometry* film = nullptr;
  const SlabPlaces* places = nullptr;
  const float* planes = nullptr;  ///< [row][column][stride]
  std::size_t stride = 1;
};

class SlabSpread {
 public:
  /// `film`: the film that receives the spread light.
  SlabSpread(const FilmGeometry& film, double widest_px);

  /// `is_calm`: without the wind.
  SlabPlaces places(const Scene& scene, const FilmSight& sight, const AltitudeSlab& slab, bool is_calm,
                    int threads) const;

  /// Adds the spread light, `width` numbers per cell, to the film's planes [row][column][width]. The result
  /// does not depend on the number of threads.
  void add(const std::vector<SlabLight>& light, int width, float* planes, int threads) const;

 private:
  FilmGeometry film_;
  double widest_px_;
  std::vector<FilmLevel> levels_;
  std::vector<float> variance_px2_;
};

}  // namespace vegard::sim
