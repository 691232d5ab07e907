// Finds the pointing of a camera from points on the horizon.
//
// On a sphere of 6371 km the horizon of an observer at the height H is the cone of directions that lie the
// dip d = acos(R / (R + H)) below the horizontal; of a layer at the height L above the sphere, seen at the
// limb, d = acos((R + L) / (R + H)). With u the direction of the zenith in the camera's axes (right, down,
// forward),
//   u = (cos e sin r, -cos e cos r, sin e)
// for the elevation e and the roll r (sim/view/camera/camera.h), a pixel's ray q (of length 1) is on the
// horizon if q . u = -sin d. The horizon does not depend on the azimuth. The fit minimises the sum of the
// squared distances of the points from that curve in pixels, to first order: q . u + sin d, divided by its
// slope in the picture.
//
// Two points determine elevation and roll, up to two solutions, of which the one with the sky on the wanted
// side is returned. From three or more points a curved horizon also gives the dip, or the focal length.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

struct PixelPoint {
  double x_px = 0.0, y_px = 0.0;  ///< the centre of the first pixel is at (0.5, 0.5)
};

/// What skylines are above (or, seen from a hill, below) the horizon: hills and trees rise by one to three
/// degrees. The figure is a guess and no measurement.
inline constexpr double kSkylineRelief_deg = 2.0;

struct HorizonProblem {
  int width_px = 0, height_px = 0;
  std::vector<PixelPoint> points;
  std::optional<double>
      hfov_deg;  ///< field of view of a pinhole with its axis in the middle; none: to be found
  double dip_deg = 0.0;
  bool free_dip = false;        ///< true if the dip is fitted as well, starting at dip_deg
  double point_error_px = 1.0;  ///< standard deviation of a point across the horizon
  /// Standard deviation of the elevation of what forms the line: 0 for the sea's horizon, kSkylineRelief_deg
  /// for a skyline of hills and trees, of which nothing is known.
  double relief_deg = 0.0;
  std::optional<PixelPoint> sky;  ///< a point above the horizon; none: the picture's top is above it
};

struct ErrorBar {
  double value = 0.0;
  double sigma = 0.0;  ///< 0 for a given number
};

/// The error bars contain the points' errors and the relief. The mean of the relief moves the elevation, and
/// its difference between the ends of the line turns the roll, as if the two ends were independent.
struct HorizonCalibration {
  ErrorBar elevation_deg, roll_deg, hfov_deg, dip_deg;
  /// The error of a point from which the error bars follow: the stated one, or the scatter of the points
  /// about the curve (per degree of freedom) if that is larger.
  double used_error_px = 1.0;
  double rms_px = 0.0;
  std::vector<double> residual_px;  ///< distance of each point from the horizon, positive into the sky
};

/// Returns the dip acos((R + layer) / (R + observer)) in degrees; 0 unless the observer is above the layer.
double horizon_dip_deg(double observer_km, double layer_km = 0.0);

/// Returns the height of the layer whose limb an observer sees at this dip.
double layer_of_dip_km(double dip_deg, double observer_km);

/// Throws sim::Error(usage), with "--points" or "--sky" as its key, for points that do not determine the
/// pointing: fewer than two that differ, points outside of the picture, fewer points than numbers to be
/// found, a horizon that bends the other way, a field of view or dip that stays undetermined (an error bar
/// above a third of the value), or points through which no horizon goes.
HorizonCalibration calibrate_horizon(const HorizonProblem& problem);

}  // namespace vegard::fit
