// Light that a film has caught, slab of altitude by slab (sim/render/beams/altitude_slabs.h), spread as far
// as its atoms come before they shine: for every lens, and whatever the light comes from.
//
// A cell and an altitude say how far away light is, and with the lens how wide a Gaussian in space is seen:
// the mean of its two axes' variances, sigma^2 / r^2 times half the sum of the squares of d (x, y) / d
// direction. (Of a pinhole that is sigma^2 (f/Z)^2 (1 + tan^2 theta / 2), as sim/render/physical_blur.h has
// it.) For an observer above the light, who may see it on this side of the Earth's limb and beyond, it is
// taken to be at the point where the line of sight is lowest, unless it meets the ground.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/beams/altitude_slabs.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/film/film_ladder.h"

namespace vegard::sim {

/// Kilometres from the observer to the light at an altitude, along a direction of this sine of elevation.
double range_to_altitude_km(double observer_km, double sine, double altitude_km,
                            double sphere_km = kEarthRadiusKm);

/// How a film looks into the sky.
struct FilmSight {
  FilmGeometry film;
  std::vector<float> sine;  ///< [cell] of the elevation
  std::vector<float> px2;   ///< [cell] variance of the image of a direction's, per square radian; 0: not seen
  std::vector<float> enu[3];  ///< [cell] the direction, if asked for
};
FilmSight film_sight(const Scene& scene, const FilmGeometry& film, bool with_directions, int threads);

/// Which standard deviations, in pixels, light of a slab has on a film.
struct SpreadRange {
  double min_px = 0.0, max_px = 0.0;
};
SpreadRange spread_range(const Scene& scene, const FilmSight& sight, double altitude_km, double variance_km2);

/// Where the light of a slab on the cells of a film goes: to which two levels of a ladder, and if a wind
/// carries it to which place.
struct SlabPlaces {
  std::vector<std::uint8_t> lower;  ///< [cell] of the two levels
  std::vector<float> upper_share;   ///< [cell] of the other one
  std::vector<float> x_px, y_px;    ///< [cell]; empty: the cells' middles
  std::vector<float> gain;          ///< [cell] of light that has come nearer, likewise
  int least = 0, most = 0;          ///< levels that get any
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
  /// `film`: where the spread light is wanted.
  SlabSpread(const FilmGeometry& film, double widest_px);

  /// `is_calm`: without the wind.
  SlabPlaces places(const Scene& scene, const FilmSight& sight, const AltitudeSlab& slab, bool is_calm,
                    int threads) const;

  /// Adds all of it, `width` numbers of each cell, to the film's planes [row][column][width]. The same for
  /// every number of threads.
  void add(const std::vector<SlabLight>& light, int width, float* planes, int threads) const;

 private:
  FilmGeometry film_;
  double widest_px_;
  std::vector<FilmLevel> levels_;
  std::vector<float> variance_px2_;
};

}  // namespace vegard::sim
