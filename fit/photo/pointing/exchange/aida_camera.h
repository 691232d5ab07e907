// Cameras of AIDA_tools (B. Gustavsson, Swedish Institute of Space Physics) in files `.acc`: lines of fifteen
// numbers, station, azimuth and zenith distance of the axis in degrees, two Julian dates between which it
// holds, the number of the lens's model, eight numbers of the camera, and 0 (saveas_acc.m, acc2optpar.m).
//
// The eight are f1, f2, alpha, beta, gamma, dx, dy, a. A direction e (east, north, up) has in the camera's
// frame the coordinates R^T e, R = Ry(alpha) Rx(beta) Rz(gamma) as camera_rot has them, in degrees; at the
// angle theta from the axis it is seen at
//
//   u = (f1 X / rho g(theta) + 1/2 + dx) columns,  v = (f2 Y / rho g(theta) + 1/2 + dy) rows,
//
// X, Y of its coordinates, rho their length, and g by the model: 1 tan theta; 2 sin(a theta);
// 3 a theta + (1 - a) tan theta; 4 theta^a; 5 tan(a theta); 12 with f1 / a and f2 / a: tan(a theta) of a
// above 0, sin(a theta) below, theta of 0 (camera_model.m). u and v count from 1 at the centre of the first
// column and row.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

struct AidaCamera {
  double station = 0.0;
  double azimuth_deg = 0.0, zenith_deg = 0.0;  ///< as it was pointed; not used
  double from_jd = 0.0, until_jd = 0.0;
  int model = 3;
  std::array<double, 8> numbers{};  ///< f1, f2, alpha, beta, gamma, dx, dy, a
  int line = 0;                     ///< of the file, from 1
};

/// The cameras of a file, at least one. Throws sim::Error(unreadable_input), with the line, for what is none,
/// and for models that are tables (-1, -2, -3) or one camera's own (6, 7, 8, 9, 11).
std::vector<AidaCamera> read_aida_cameras(std::string_view text, const std::string& file);

/// Where the pixels of a picture of this size look; nowhere beyond the model's image.
sim::DirectionMap directions_of_aida(const AidaCamera& camera, int width_px, int height_px);

/// The place of a direction in such a picture, the first pixel's centre at (0.5, 0.5); false beyond 90
/// degrees from the axis.
bool aida_place(const AidaCamera& camera, int width_px, int height_px, const std::array<double, 3>& enu,
                double& x_px, double& y_px);

struct AidaFit {
  AidaCamera camera;
  int points = 0;  ///< of a grid of the picture, which it was fitted to
  double rms_px = 0.0, largest_px = 0.0;
  double share = 0.0;  ///< of the grid's points within reach
};

/// A camera as AIDA has it: by least squares over places of the picture at most 85 degrees off the axis, of
/// the models 1 to 5 that which leaves least. `julian_date`: the camera holds from four months before it to
/// six months after, as AIDA writes it; none: from 0 to 9999999. Throws sim::Error(scene) for a camera that
/// shows too little of that.
AidaFit aida_of_camera(const sim::Camera& camera, std::optional<double> julian_date);

/// The line of a file.
std::string encode_aida(const AidaCamera& camera);

}  // namespace vegard::fit
