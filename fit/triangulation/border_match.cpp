#include "fit/triangulation/border_match.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kFewestPoints = 6;
constexpr double kLeastBorderWeight = 0.02;

/// The traces with enough measured points: the claimed ones, or all if none is.
std::vector<std::size_t> traces_to_match(const Border& border) {
  std::vector<std::size_t> claimed, others;
  for (std::size_t t = 0; t < border.traces.size(); ++t) {
    if (border.traces[t].measured < static_cast<int>(kFewestPoints)) continue;
    (border.traces[t].is_claimed() ? claimed : others).push_back(t);
  }
  return claimed.empty() ? others : claimed;
}

bool is_any_claimed(const Border& border, const std::vector<std::size_t>& traces) {
  return std::any_of(traces.begin(), traces.end(),
                     [&](std::size_t t) { return border.traces[t].is_claimed(); });
}

constexpr double kLevelError = 0.1, kCutLevelError = 0.5;  ///< of the peak's light
constexpr double kMostCutPeaks = 0.25;
constexpr double kUsualLevelError_km = 3.0;  ///< ESTIMATED

/// The mean height of the branch that is nearest to a height; NaN without any.
double mean_near(const MatchedCurves& matched, double height_km) {
  double nearest = sim::kNaN;
  for (const CurveBranch& branch : matched.branches)
    if (!(std::abs(branch.mean.km - height_km) >= std::abs(nearest - height_km))) nearest = branch.mean.km;
  return nearest;
}

}  // namespace

bool is_peak_cut(const BorderTrace& trace) { return trace.cut_peaks > kMostCutPeaks; }

double level_error(const BorderTrace& trace) { return is_peak_cut(trace) ? kCutLevelError : kLevelError; }

PictureCurve curve_of_trace(const BorderTrace& trace, const ViewPoint& view, std::size_t camera,
                            double level) {
  PictureCurve curve;
  curve.camera = camera;
  const sim::CameraView<double> lens = sim::camera_view(view.camera().camera);
  for (const BorderPoint& point : trace.points) {
    if (!point.measured()) continue;
    const auto at = [&](double up_deg, PixelPoint& pixel) {
      double enu[3];
      sim::enu_of_direction({point.azimuth_deg, up_deg}, enu);
      return sim::pixel_of_enu(lens, enu, pixel.x_px, pixel.y_px);
    };
    // From a quarter of the light to three quarters it is fall_deg.
    const double elevation_deg =
        point.elevation_deg + (std::isfinite(point.fall_deg) ? level / 0.5 * point.fall_deg : 0.0);
    PixelPoint pixel, above;
    constexpr double kStep_deg = 0.1;
    if (!at(elevation_deg, pixel) || !at(elevation_deg + kStep_deg, above)) continue;
    const double px_per_deg = std::hypot(above.x_px - pixel.x_px, above.y_px - pixel.y_px) / kStep_deg;
    curve.points.push_back(pixel);
    curve.error_px.push_back(std::max(0.05, point.elevation_error_deg * px_per_deg));
  }
  return curve;
}

BorderMatches border_matches(const std::vector<ViewPoint>& cameras, std::size_t first,
                             const Border& first_border, std::size_t second, const Border& second_border,
                             const HeightRange& range, double drift_km_s) {
  BorderMatches found;
  const std::vector<std::size_t> here = traces_to_match(first_border), there = traces_to_match(second_border);
  found.traces = here.size();
  found.is_claimed = is_any_claimed(first_border, here) && is_any_claimed(second_border, there);
  for (const std::size_t a : here) {
    const PictureCurve first_curve = curve_of_trace(first_border.traces[a], cameras[first], first);
    if (first_curve.points.size() < kFewestPoints) continue;
    std::vector<BorderMatch> of_trace;
    double least = HUGE_VAL, no_match = HUGE_VAL;
    for (const std::size_t b : there) {
      const PictureCurve second_curve = curve_of_trace(second_border.traces[b], cameras[second], second);
      const PictureCurve first_higher =
          curve_of_trace(first_border.traces[a], cameras[first], first, level_error(first_border.traces[a]));
      const PictureCurve second_higher = curve_of_trace(second_border.traces[b], cameras[second], second,
                                                        level_error(second_border.traces[b]));
      if (second_curve.points.size() < kFewestPoints) continue;
      const MatchedCurves matched = matched_curves(cameras, first_curve, second_curve, range, drift_km_s);
      no_match = matched.no_match_badness;
      found.along_epipolar += matched.along_epipolar;
      found.outside_range += matched.outside_range;
      for (std::size_t k = 0; k < matched.branches.size(); ++k) {
        if (matched.branches[k].mean.points < 3) continue;
        BorderMatch match{a, b, 0.0, matched.branches[k], 0.0, {}};
        for (const CurveMatch& point : matched.matches)
          if (point.branch == k) match.points.push_back(point);
        const double height_km = match.branch.mean.km;
        const auto moved_km = [&](bool is_first_higher, bool is_second_higher) {
          const MatchedCurves other =
              matched_curves(cameras, is_first_higher ? first_higher : first_curve,
                             is_second_higher ? second_higher : second_curve, range, drift_km_s);
          return std::abs(mean_near(other, height_km) - height_km);
        };
        // A level at which nothing matches (NaN) says nothing.
        std::vector<double> known_km;
        for (const double one : {moved_km(true, false), moved_km(false, true)})
          if (std::isfinite(one)) known_km.push_back(one);
        for (const double one : known_km) match.level_error_km = std::hypot(match.level_error_km, one);
        if (known_km.empty()) match.level_error_km = kUsualLevelError_km;
        if (is_peak_cut(first_border.traces[a]) || is_peak_cut(second_border.traces[b]))
          match.level_error_km = std::fmax(match.level_error_km, moved_km(true, true));
        match.branch.mean.error_km = std::hypot(match.branch.mean.error_km, match.level_error_km);
        least = std::min(least, match.branch.badness);
        of_trace.push_back(std::move(match));
      }
    }
    least = std::min(least, no_match);
    double sum = std::exp(-0.5 * (no_match - least));
    for (const BorderMatch& match : of_trace) sum += std::exp(-0.5 * (match.branch.badness - least));
    for (BorderMatch& match : of_trace) {
      match.weight = std::exp(-0.5 * (match.branch.badness - least)) / sum;
      if (match.weight >= kLeastBorderWeight) found.matches.push_back(std::move(match));
    }
  }
  std::vector<std::size_t> most(first_border.traces.size(), 0);
  for (const BorderMatch& match : found.matches)
    most[match.first_trace] = std::max(most[match.first_trace], match.points.size());
  std::stable_sort(
      found.matches.begin(), found.matches.end(), [&](const BorderMatch& a, const BorderMatch& b) {
        if (a.first_trace != b.first_trace)
          return most[a.first_trace] != most[b.first_trace] ? most[a.first_trace] > most[b.first_trace]
                                                            : a.first_trace < b.first_trace;
        return a.weight > b.weight;
      });
  return found;
}

}  // namespace vegard::fit
