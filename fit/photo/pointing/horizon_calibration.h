// Finds the pointing of a camera from points on the horizon.
//
// On a sphere of 6371 km the horizon of an observer at the height H is the cone of directions that lie the
// dip d = acos(R / (R + H)) below the horizontal; of a layer at the height L above the sphere, seen at the
// limb, d = acos((R + L) / (R + H)). With u the direction of the zenith in the camera's axes (right, down,
// forward),
//   u = (cos e sin r, -cos e cos r, sin e)
// for the elevation e and the roll r (sim/view/camera/camera.h), a pixel's ray q (of length 1) is on the
// horizon where q . u = -sin d. The azimuth leaves no trace. What is minimised is the sum of the squares of
// the points' distances from that curve in pixels, to first order (q . u + sin d over its slope in the
// picture).
//
// Two points give elevation and roll: of the two cones' crossings through them, the one with the sky on the
// side that is asked for. With three or more a bent horizon gives more: the dip, or the focal length.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

struct PixelPoint {
  double x_px = 0.0, y_px = 0.0;  ///< the centre of the first pixel is at (0.5, 0.5)
};

struct HorizonProblem {
  int width_px = 0, height_px = 0;
  std::vector<PixelPoint> points;
  std::optional<double> hfov_deg;  ///< of a pinhole with its axis in the middle; left out: to be found
  double dip_deg = 0.0;
  bool free_dip = false;          ///< the dip is found too; dip_deg is its start
  double point_error_px = 1.0;    ///< standard deviation of a point across the horizon
  std::optional<PixelPoint> sky;  ///< somewhere above the horizon; left out: the picture's top is
};

struct ErrorBar {
  double value = 0.0;
  double sigma = 0.0;  ///< 0 where it was given
};

struct HorizonCalibration {
  ErrorBar elevation_deg, roll_deg, hfov_deg, dip_deg;
  /// What the error bars are made from: the stated error of a point, or the scatter of the points about the
  /// curve (with the freedom of what was found taken off) if that is larger.
  double used_error_px = 1.0;
  double rms_px = 0.0;
  std::vector<double> residual_px;  ///< distance of each point from the horizon, positive into the sky
};

/// d = acos((R + layer) / (R + observer)), degrees; 0 unless the observer is above the layer.
double horizon_dip_deg(double observer_km, double layer_km = 0.0);

/// The height of the layer whose limb an observer sees at this dip.
double layer_of_dip_km(double dip_deg, double observer_km);

/// Throws sim::Error(usage), with "--points" or "--sky" as its key, for points that determine nothing: fewer
/// than two that differ, outside of the picture, fewer than what is to be found, a horizon that bends the
/// other way, a field of view or dip that they leave open (an error bar above a third of the value), none
/// that is a horizon at all.
HorizonCalibration calibrate_horizon(const HorizonProblem& problem);

}  // namespace vegard::fit
