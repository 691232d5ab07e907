// The places along a curve that two cameras see, without knowing which point of one picture is which of the
// other.
//
// A line of sight and the other camera lie in a plane, which is a line in the other's picture, the epipolar
// line (R. Hartley and A. Zisserman, "Multiple view geometry", 2004, chapter 9): where the other's curve
// crosses it, it shows the same place. It may cross it several times. Crossings that follow each other along
// both curves make a branch; the more of the curve a branch explains, and the less its heights scatter beyond
// their errors, the more weight it has among all branches and the chance that the curves are two things.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/triangulation/triangulated_point.h"

namespace vegard::fit {

struct PictureCurve {
  std::string name;
  std::size_t camera = 0;
  std::vector<PixelPoint> points;  ///< two or more, in their order along the curve
  std::vector<double> error_px;    ///< of each point, across the curve
};

struct HeightRange {
  double lowest_km = 60.0, highest_km = 500.0;
};

/// A point of the first curve and where the second one crosses its epipolar line.
struct CurveMatch {
  std::size_t vertex = 0;     ///< of the first curve
  PixelPoint there;           ///< in the second camera's picture
  double along = 0.0;         ///< the second curve: number of its point, with the part of the way to the next
  double crossing_deg = 0.0;  ///< angle between the second curve and the epipolar line, on the sky
  TriangulatedPoint point;
  std::size_t branch = 0;
};

struct CurveBranch {
  double weight = 0.0;  ///< of 1, among all branches of the two curves and none of them
  double share = 0.0;   ///< of the first curve's points
  /// Minus twice the logarithm of its probability; to be compared with branches of the same first curve.
  double badness = 0.0;
  MeanHeight mean;
  double median_error_km = 0.0;  ///< of its points' heights
};

/// The least weight of a clear match.
inline constexpr double kClearMatch = 0.9;

/// Returns what speaks against a match of this weight, as parts of a sentence; empty if nothing does.
std::vector<std::string> doubts_about(const CurveBranch& branch, double weight);

struct MatchedCurves {
  std::vector<CurveMatch> matches;    ///< by vertex, then by branch; those that have a place in the range
  std::vector<CurveBranch> branches;  ///< that of the largest weight is the first
  std::size_t outside_range = 0;      ///< number of crossings whose height is not in the range
  double no_match_badness = 0.0;      ///< if the curves are not the same: no point is explained
  std::size_t along_epipolar = 0;     ///< number of crossings at too small an angle for a height
};

/// Matches two curves of different cameras.
MatchedCurves matched_curves(const std::vector<ViewPoint>& cameras, const PictureCurve& first,
                             const PictureCurve& second, const HeightRange& range, double drift_km_s);

}  // namespace vegard::fit
