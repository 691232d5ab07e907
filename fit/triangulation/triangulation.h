// All points and curves of several pictures triangulated: what `vegard triangulate` gives.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/triangulation/matched_curves.h"
#include "fit/triangulation/sight_table.h"

namespace vegard::fit {

struct TriangulationSettings {
  EarthShape earth = EarthShape::wgs84;
  bool is_refracted = true;
  double drift_km_s = 0.0;  ///< standard deviation of each horizontal component of the light's velocity
  HeightRange heights;      ///< of curves
};

/// A camera by its file: [camera] and [site], with the error of directions that the file tells unless one is
/// given. Throws Error(unreadable_input, scene), Error(usage) about `--pointing-error` if nobody tells it.
PlacedCamera placed_camera(const std::string& file, std::optional<double> pointing_error_deg,
                           double clock_error_s, bool is_refracted);

/// A point, or a point of a curve by two of the cameras.
struct TriangulatedRow {
  std::string name;
  bool is_curve = false;
  std::vector<std::size_t> cameras;  ///< by which it was found
  std::vector<PixelPoint> pixels;    ///< of each of them
  double branch_weight = 1.0;        ///< of the match, among all of the curve
  std::size_t branch = 0;            ///< 0 is the most probable one
  std::string doubt;                 ///< what speaks against the match; empty: nothing
  TriangulatedPoint point;
};

/// What two cameras say of a curve.
struct CurveSummary {
  std::string name;
  std::size_t first_camera = 0, second_camera = 0;
  MatchedCurves matched;
};

struct Triangulation {
  std::vector<ViewPoint> cameras;
  TriangulationSettings settings;
  std::vector<TriangulatedRow> rows;  ///< by feature, in the order of the table
  std::vector<CurveSummary> curves;

  /// Number of rows without a place, of points whose lines miss each other beyond chance (below 0.001), and
  /// of curves without a match, or with a best one that something speaks against: doubts_about().
  std::size_t refused() const, contradicted() const, ambiguous() const;
  bool is_good() const { return refused() + contradicted() + ambiguous() == 0; }
};

/// The same features give the same answer.
Triangulation triangulation(const std::vector<PlacedCamera>& cameras,
                            const std::vector<SightedFeature>& features,
                            const TriangulationSettings& settings);

/// Whether chance makes the lines of sight miss each other as far.
bool is_contradicted(const TriangulatedPoint& point);

}  // namespace vegard::fit
