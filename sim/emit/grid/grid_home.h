// The transformation of a scene's rays to the voxels of a grid, and the light that the grid's numbers mean.
//
// A grid is either in a frame on the ground (GridBricks::place() transforms it to voxels) or on the Sun; then
// its place is given in the heliographic frame of sim/emit/sun/sun_frame.h, whose unit is sun.unit_km. The
// Sun's own parameters may be free, so the transformation is computed in T.
//
// Rounding: on the Sun the observer is some 1.5e5 units away from the grid's corner, the origin of voxels. A
// place on a ray, from + t along, is the difference of two such numbers, each with a relative error of 1e-16,
// so it has an error of some 1e-10 units.
#pragma once

#include <vector>

#include "sim/emit/grid/grid_bricks.h"
#include "sim/emit/sun/solar_rotation.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/volume.h"

namespace vegard::sim {

template <class T>
struct GridHome {
  T turn[3][3];          ///< from the observer's east, north, up in km to voxels
  T from[3];             ///< origin of the rays, in voxels
  double voxel_km;       ///< edge of a voxel
  std::vector<T> light;  ///< [line] rayleighs per km for the value 1, times the volume's gain
};

/// Computes the shift of a volume, in its unit and along the axes of GridPlace. The scene gives it along
/// east, north, up of the observer or of the volume's home, or along the axes of the Sun's frame.
template <class T, class Number>
void shift_of_volume(const GridBricks& grid, const Volume& volume, double unit_km, const Number& number,
                     T shift[3]) {
  for (int c = 0; c < 3; ++c) {
    shift[c] = T(0.0);
    for (int k = 0; k < 3; ++k)
      shift[c] = shift[c] + number(volume.shift_km[k]) * (1.0 / unit_km) * grid.place().from_home[c][k];
  }
}

/// Returns the rotation of a grid of frame "sun" about the Sun's axis at an instant of the scene's clock, in
/// radians to the west. The grid turns rigidly, with the rate of solar_rotation.h at the latitude of the
/// middle of its box, or at the equator if the middle lies within the photosphere.
inline double grid_turn_rad(const GridBricks& grid, const Volume& volume, const Sun* sun, double instant_s) {
  if (volume.frame != VolumeFrame::sun || sun == nullptr || grid.empty()) return 0.0;
  const SolarTurn turn(*sun, instant_s);
  if (!turn.turns()) return 0.0;
  // Turn and one scale: the inverse is the transpose over the square of the scale.
  constexpr double kCoarseCell = GridBricks::kEdge * GridBricks::kCoarse;
  const GridPlace& place = grid.place();
  double shift[3], middle[3], square = 0.0;
  shift_of_volume(grid, volume, sun->unit_km, plain_number, shift);
  for (int c = 0; c < 3; ++c) {
    middle[c] = shift[c];
    for (int a = 0; a < 3; ++a)
      middle[c] += (0.5 * (grid.low(a) + grid.high(a)) * kCoarseCell - place.shift[a]) * place.turn[a][c] *
                   grid.voxel_km() * grid.voxel_km();
    square += middle[c] * middle[c];
  }
  const bool within = square < sun->radius * sun->radius;
  return turn.angle_rad(within ? 0.0 : middle[2] * middle[2] / square);
}

/// Returns the transformation to voxels and the light of a volume. `sun` is the scene's Sun for a volume of
/// frame "sun"; otherwise it may be null. density_rayleigh is per kilometre, or per unit of the Sun's frame;
/// without it a grid's number is in photons cm^-3 s^-1. `turned_rad` is that of grid_turn_rad().
template <class T>
GridHome<T> grid_home(const GridBricks& grid, const Volume& volume, const Sun* sun, const NumberAs<T>& number,
                      double turned_rad = 0.0) {
  GridHome<T> home;
  const GridPlace& place = grid.place();
  const bool on_sun = volume.frame == VolumeFrame::sun && sun != nullptr;
  const double unit_km = on_sun ? sun->unit_km : 1.0;
  home.voxel_km = grid.voxel_km() * unit_km;
  T shift[3];
  shift_of_volume(grid, volume, unit_km, number, shift);
  for (int a = 0; a < 3; ++a) {
    home.from[a] = T(place.shift[a]);
    for (int c = 0; c < 3; ++c) {
      home.from[a] = home.from[a] - shift[c] * place.turn[a][c];
      home.turn[a][c] = T(place.turn[a][c]);
    }
  }
  if (on_sun) {
    const SunFrame<T> frame(*sun, number);
    Vec3<T> observer, axis[3];  // [of east, north, up][of the frame]
    frame.observer(observer.data());
    for (int e = 0; e < 3; ++e) {
      const T east_north_up[3] = {T(e == 0 ? 1.0 : 0.0), T(e == 1 ? 1.0 : 0.0), T(e == 2 ? 1.0 : 0.0)};
      T in_sky[3];
      frame.sky().turn(east_north_up, in_sky);
      frame.from_sky(in_sky, axis[e].data());
    }
    if (turned_rad != 0.0) {  // as the grid sees them
      observer = turned_west(observer, T(-turned_rad));
      for (Vec3<T>& one : axis) one = turned_west(one, T(-turned_rad));
    }
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c) {
        home.from[a] = home.from[a] + observer[c] * place.turn[a][c];
        home.turn[a][c] = T(0.0);
        for (int k = 0; k < 3; ++k)
          home.turn[a][c] = home.turn[a][c] + axis[c][k] * (place.turn[a][k] / unit_km);
      }
  }
  const T gain = number(volume.gain);
  for (int l = 0; l < grid.lines(); ++l)
    home.light.push_back(volume.density_rayleigh.empty()
                             ? gain * kRayleighsPerKm
                             : gain * number(volume.density_rayleigh[l]) * (1.0 / unit_km));
  return home;
}

}  // namespace vegard::sim
