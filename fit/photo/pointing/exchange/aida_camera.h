// Reads and writes cameras of AIDA_tools (B. Gustavsson, Swedish Institute of Space Physics) in files `.acc`:
// lines of fifteen numbers: the station, azimuth and zenith distance of the axis in degrees, two Julian dates
// between which the camera is valid, the number of the lens's model, eight numbers of the camera, and 0
// (saveas_acc.m, acc2optpar.m).
//
// The eight are f1, f2, alpha, beta, gamma, dx, dy, a. A direction e (east, north, up) has in the camera's
// frame the coordinates R^T e with R = Ry(alpha) Rx(beta) Rz(gamma) as in camera_rot, angles in degrees. At
// the angle theta from the axis its place in the picture is
//
//   u = (f1 X / rho g(theta) + 1/2 + dx) columns,  v = (f2 Y / rho g(theta) + 1/2 + dy) rows,
//
// with X, Y of its coordinates, their length rho, and g by the model: 1 tan theta; 2 sin(a theta);
// 3 a theta + (1 - a) tan theta; 4 theta^a; 5 tan(a theta); 12 with f1 / a and f2 / a: tan(a theta) of a
// above 0, sin(a theta) below 0, theta for 0 (camera_model.m). u and v count from 1 at the centre of the
// first column and row.
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
  double azimuth_deg = 0.0, zenith_deg = 0.0;  ///< the nominal pointing; not used
  double from_jd = 0.0, until_jd = 0.0;
  int model = 3;
  std::array<double, 8> numbers{};  ///< f1, f2, alpha, beta, gamma, dx, dy, a
  int line = 0;                     ///< line in the file, from 1
};

/// Reads the cameras of a file, at least one. Throws sim::Error(unreadable_input), with the line, for an
/// invalid line and for models that are tables (-1, -2, -3) or belong to a single camera (6, 7, 8, 9, 11).
std::vector<AidaCamera> read_aida_cameras(std::string_view text, const std::string& file);

/// Returns the directions of the pixels of a picture of this size; none beyond the model's image.
sim::DirectionMap directions_of_aida(const AidaCamera& camera, int width_px, int height_px);

/// Computes the place of a direction in such a picture, the first pixel's centre at (0.5, 0.5); false beyond
/// 90 degrees from the axis.
bool aida_place(const AidaCamera& camera, int width_px, int height_px, const std::array<double, 3>& enu,
                double& x_px, double& y_px);

struct AidaFit {
  AidaCamera camera;
  int points = 0;  ///< number of the points of a grid to which it was fitted
  double rms_px = 0.0, largest_px = 0.0;
  double share = 0.0;  ///< share of the grid's points within reach
};

/// Fits a camera of AIDA to a camera, by least squares over places of the picture at most 85 degrees off the
/// axis; of the models 1 to 5 the one with the smallest residuals is taken. `julian_date`: the camera is
/// valid from four months before it to six months after it, as AIDA writes it; none: from 0 to 9999999.
/// Throws sim::Error(scene) if too little of the picture is within reach.
AidaFit aida_of_camera(const sim::Camera& camera, std::optional<double> julian_date);

/// Returns the camera's line for a file.
std::string encode_aida(const AidaCamera& camera);

}  // namespace vegard::fit
