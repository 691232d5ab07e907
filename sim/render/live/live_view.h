// What a program needs to draw a scene by itself, many times a second: maps of the electrons' feet, height
// profiles, directions of fall, lens, colours, stars. The physics stays here; what is left to do is geometry
// (docs/preview.md):
//
//   light of a line at a point = flux of the map at the point's foot x rate of the profile at its altitude,
//
// added up along each ray, blurred by the lines' widths, coloured by the lines' colours.
//
// A sheet is the map of its beams' feet, with the mean over the draws of their deflections: a Gaussian of the
// tube's width where most of the light is. Sheets are drawn at one instant, without the exposure's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/render/live/live_layers.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The lens as the angle off the axis of each radius. Decentring is left out.
struct LiveCamera {
  int width = 0, height = 0;
  double azimuth_deg = 0.0, elevation_deg = 0.0, roll_deg = 0.0;
  double principal_x_px = 0.0, principal_y_px = 0.0, aspect = 1.0, side = 1.0;
  double altitude_km = 0.0;
  /// Radius in pixels of evenly spaced angles from 0 to last_angle_rad, increasing.
  std::vector<float> radius_px;
  double last_angle_rad = 0.0;
};

struct LiveStar {
  std::array<float, 3> enu, rgb_steradian;
};

struct LiveView {
  double radius_km = 0.0, foot_altitude_km = 0.0;  ///< of the body, and of its feet
  std::vector<double> lines_nm;
  std::vector<std::array<double, 3>> rgb_per_kilorayleigh;  ///< per line, linear and signed
  std::vector<double> blur_px;                              ///< per line, in pixels of the camera
  LiveCamera camera;
  std::vector<LiveLayer> layers;
  double start_s = 0.0, step_s = 0.0;  ///< of the scene's clock, of the maps' instants
  int instants = 1;

  std::array<double, 3> sky_rgb{};  ///< everywhere
  /// Linear RGB of airglow, twilight, town and moonlit air, [row][column][channel], by elevation from 90 to
  /// -90 degrees and azimuth from 0 to 360, values at the cells' middles; empty: none.
  std::vector<float> night_rgb;
  int night_columns = 0, night_rows = 0;
  std::vector<LiveStar> stars;
  double star_sigma_px = 1.0;
  /// Transmission of the air at the camera's first place, [elevation][line], elevations from -90 to 90
  /// degrees in steps of half a degree; empty: none.
  std::vector<float> transmission;
  std::vector<float> tone;            ///< encoded values of linear light (i / (size - 1))^2
  std::vector<std::string> left_out;  ///< what the scene has and the view does not show, in words
};

struct LiveOptions {
  double seconds = 0.0;  ///< of the scene's clock, from its start
  int instants = 9;      ///< maps of what changes by itself: of its start, its end and between
  int threads = 0;
};

/// Makes the view of a scene. Throws Error(scene) that names what cannot be shown: emitters other than sheets
/// and footprints, curtains without thickness, the physical blur, blurred colours, points of unit weight,
/// false colours; and as the reading of the scene's files does.
LiveView live_view(const Scene& scene, const LiveOptions& options);

}  // namespace vegard::sim
