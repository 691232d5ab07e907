// The height of the lower border by two pictures' traces of it (fit/border/border.h).
//
// Each trace of one picture is matched with each of the other as a curve (matched_curves.h). The matches of
// one trace compete: where several explain it about as well, each has its weight.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/border/border.h"
#include "fit/triangulation/matched_curves.h"

namespace vegard::fit {

/// A trace of the first picture and one of the second that may be the same border.
struct BorderMatch {
  std::size_t first_trace = 0, second_trace = 0;
  double weight = 0.0;  ///< of 1, among the matches of the first trace and none of them
  CurveBranch branch;   ///< the error of its mean holds level_error_km
  /// What it does to the mean height if the border of one picture or the other is at a level that is higher
  /// by level_error(), six tenths of the peak in place of a half: the two see the light's thickness in
  /// different ways. Where a peak is cut, at least what both together do. 3 km if neither gives a height
  /// (ESTIMATED: what it is where they do).
  double level_error_km = 0.0;
  std::vector<CurveMatch> points;
};

struct BorderMatches {
  std::vector<BorderMatch> matches;  ///< by first trace: the most points first; then by weight
  bool is_claimed = true;            ///< the traces of both pictures are claimed to be aurora
  std::size_t traces = 0;            ///< number of the first picture's traces that were tried
  std::size_t along_epipolar = 0, outside_range = 0;  ///< of crossings, as in MatchedCurves
};

/// Returns by how much of the peak's light the level of a border may be off, a tenth; a half where more than
/// a quarter of the peaks are clipped or hidden: the light may be twice as bright (ESTIMATED).
double level_error(const BorderTrace& trace);
/// Whether it is the larger one.
bool is_peak_cut(const BorderTrace& trace);

/// Returns the measured points of a trace as a curve of the camera's picture, at the level of a half of the
/// peak's light and `level` more.
PictureCurve curve_of_trace(const BorderTrace& trace, const ViewPoint& view, std::size_t camera,
                            double level = 0.0);

/// Matches the traces that are claimed to be aurora; if a picture claims none, its others.
BorderMatches border_matches(const std::vector<ViewPoint>& cameras, std::size_t first,
                             const Border& first_border, std::size_t second, const Border& second_border,
                             const HeightRange& range, double drift_km_s);

}  // namespace vegard::fit
