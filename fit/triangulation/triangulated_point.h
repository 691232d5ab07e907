// The place of what several cameras see, by their lines of sight alone, with its error.
//
// The place is the one whose directions from the cameras differ least from the lines of sight, each
// difference divided by its error: least squares in the planes across the lines (R. Hartley and A. Zisserman,
// "Multiple view geometry", 2004, section 12.5, for directions in place of pixels), by Gauss and Newton's
// iteration from the place nearest to all lines. The errors of a direction are those of the pixel, of the
// camera's orientation, and of its clock: light that drifts has moved by drift times the clock's error in a
// horizontal direction that nobody knows.
//
// A point of a curve has no counterpart on the same curve in another picture, only a line that it lies on: of
// such a sight the direction across the curve counts alone.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "fit/triangulation/view_point.h"

namespace vegard::fit {

struct Sight {
  std::size_t camera = 0;
  PixelPoint pixel;
  double pixel_error_px = 1.0;  ///< standard error of each coordinate
  /// The direction of the curve through the pixel, of any length; none: the pixel is a point. The error of
  /// the pixel is then across the curve.
  std::optional<Eigen::Vector2d> curve;
  /// Whether any point of the curve may be meant; else this very one is.
  bool is_anywhere_on_curve = false;
};

enum class NoPlace {
  none,  ///< there is a place
  outside_lens,
  parallel,  ///< within their errors
  behind,    ///< the lines meet behind a camera
  underground
};

/// "the lines of sight are parallel within their errors"
const char* words_of(NoPlace reason);

/// How the height changes with what is wrong in common to all sights of a camera.
struct HeightPull {
  Eigen::Vector3d km_per_rad = Eigen::Vector3d::Zero();  ///< if the camera is turned, about the Earth's axes
  Eigen::Vector3d km_per_km = Eigen::Vector3d::Zero();   ///< if the light has moved before its picture
};

struct TriangulatedPoint {
  NoPlace reason = NoPlace::none;
  GeodeticPlace place;  ///< all numbers are NaN without a place
  Eigen::Vector3d place_km;
  double height_error_km, east_error_km, north_error_km;  ///< standard errors
  Eigen::Matrix3d covariance_km2;                         ///< of east, north and up
  double pixel_height_error_km;                           ///< the part of the pixels
  double miss_km;  ///< the largest distance between two of the lines where they are nearest
  double chi2;     ///< of the miss
  int freedom = 0;
  double probability;                       ///< that chance makes chi2 as large; NaN without freedom
  double parallax_deg, parallax_error_deg;  ///< the largest angle between two of the lines, 90° at most
  std::vector<double> distance_km;          ///< from each sight's camera
  std::vector<HeightPull> pulls;            ///< of each camera

  TriangulatedPoint();
  bool is_given() const { return reason == NoPlace::none; }
};

/// `drift_km_s`: standard deviation of each horizontal component of the light's velocity. Needs two sights,
/// of two cameras. Never throws for what has no place: it has a reason.
TriangulatedPoint triangulated(const std::vector<ViewPoint>& cameras, const std::vector<Sight>& sights,
                               double drift_km_s);

/// By how much heights differ along a border, beside their errors (ESTIMATED: lower borders vary by some
/// kilometres along an arc, Störmer 1955, "The polar aurora").
inline constexpr double kHeightsAlongBorder_km = 5.0;

/// A mean of heights and its standard error: that of the pixels and the scatter become less with the number
/// of points, of which four neighbours count as one; those of orientations and clocks do not. Points off the
/// weighted median by more than three standard deviations, heights along the border included, are left out.
struct MeanHeight {
  int points = 0;                                    ///< that are used
  double km, error_km, common_error_km, scatter_km;  ///< NaN without points
};
MeanHeight mean_height(const std::vector<ViewPoint>& cameras,
                       const std::vector<const TriangulatedPoint*>& points, double drift_km_s);

}  // namespace vegard::fit
