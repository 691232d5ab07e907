#include "fit/measurement/together/pair_height.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fit/border/border_distance.h"
#include "fit/triangulation/shared_view.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace pair_height {

constexpr double kGoodError_km = 5.0;
constexpr double kFarthest = 3.0;        ///< in standard deviations of the difference
constexpr double kCovered = 0.68;        ///< share of the points that error bars should cover
constexpr double kLongestGap_deg = 3.0;  ///< between predicted points

std::vector<std::string> doubts_of(const PairHeight& height, const PairOfPictures& pair) {
  std::vector<std::string> doubts;
  const BorderMatch* border = best_border(pair);
  if (!height.is_by_profiles) {
    doubts = doubts_about(border->branch, border->weight);
  } else if (border && border->weight >= kClearMatch) {
    const MeanHeight& mean = border->branch.mean;
    if (std::abs(height.km - mean.km) > kFarthest * std::hypot(height.error_km, mean.error_km))
      doubts.push_back(fmt::format("the borders alone give another height, {} km",
                                   sim::number_with_error(mean.km, mean.error_km)));
  }
  if (height.is_by_profiles && std::isfinite(pair.profiles.contradicting_km))
    doubts.push_back(fmt::format(
        "the light along the field lines through the other picture's border gives another height, {} km",
        sim::number_with_error(pair.profiles.contradicting_km, pair.profiles.contradicting_error_km)));
  if (pair.is_peak_cut)
    doubts.push_back("the brightest light is clipped or hidden in a picture: the border may be higher");
  if (!pair.borders.is_claimed) doubts.push_back("the traces are not claimed to be aurora");
  if (!std::isfinite(pair.apart_s)) doubts.push_back("a time is not known: both are taken for the same");
  if (const ShellHeight* pattern = clear_pattern(pair))
    if (pattern->km + 2.0 * pattern->error_km < height.km - 2.0 * height.error_km)
      doubts.push_back("the light's pattern is lower than its border");
  return doubts;
}

void doubt_width(PairHeight& height) {
  height.is_wide = !(height.error_km <= kGoodError_km);
  if (height.is_wide) height.doubts.push_back(fmt::format("the error is above {:.0f} km", kGoodError_km));
}

/// Where the second camera sees the border of the first one, if that is at this height.
std::vector<SeenBorder> seen_border(const PairOfPictures& pair, const PictureCurve& border,
                                    double height_km) {
  const ViewPoint &from = pair.cameras[0], &to = pair.cameras[1];
  const sim::CameraView<double> view = sim::camera_view(to.camera().camera);
  std::vector<SeenBorder> seen;
  for (const PixelPoint& point : border.points) {
    const auto direction = from.direction(point);
    const auto place = direction ? place_at_height(from, *direction, height_km) : std::nullopt;
    const auto pixel = place && !to.is_hidden(*place) ? to.pixel(*place) : std::nullopt;
    double enu[3];
    if (!pixel || !sim::enu_of_pixel(view, pixel->x_px, pixel->y_px, enu)) continue;
    seen.push_back({std::fmod(std::atan2(enu[0], enu[1]) / sim::kRadiansPerDegree + 360.0, 360.0),
                    std::asin(std::clamp(enu[2], -1.0, 1.0)) / sim::kRadiansPerDegree, 0.0});
  }
  return seen;
}

/// The elevations at which a curve passes an azimuth.
std::vector<double> elevations_at(const std::vector<SeenBorder>& curve, double azimuth_deg) {
  std::vector<double> found;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const double a = std::remainder(curve[i].azimuth_deg - azimuth_deg, 360.0);
    const double b = std::remainder(curve[i + 1].azimuth_deg - azimuth_deg, 360.0);
    if ((a < 0.0) == (b < 0.0) || std::abs(b - a) > kLongestGap_deg) continue;
    found.push_back(curve[i].elevation_deg +
                    a / (a - b) * (curve[i + 1].elevation_deg - curve[i].elevation_deg));
  }
  return found;
}

/// Which quantity has to change so that the first picture's answer fits the second.
std::string what_has_to_change(const PairOfPictures& pair) {
  const double low = kBorderAltitudesKm.front(), high = kBorderAltitudesKm.back();
  const std::optional<PairHeight> height = height_of(pair);
  if (height && (height->km < low || height->km > high))
    return fmt::format("the height has to change, to {} km",
                       sim::number_with_error(height->km, height->error_km));
  if (!height && pair.profiles.is_given())
    return "the brightness has to change: the light along the field lines is not alike";
  return pair.apart_s > 0.0 ? "the place has to change, or the light has moved in the meantime"
                            : "the place has to change: no height of the whole border explains both";
}

}  // namespace pair_height

std::optional<PairHeight> height_of(const PairOfPictures& pair) {
  PairHeight height;
  const BorderMatch* border = best_border(pair);
  if (has_clear_profiles(pair)) {
    height = {pair.clocks.border_km, pair.clocks.border_error_km, true, 0, {}, false};
  } else if (border && std::isfinite(border->branch.mean.km)) {
    height = {border->branch.mean.km, border->branch.mean.error_km, false, 0, {}, false};
  } else {
    return std::nullopt;
  }
  if (border) height.points = border->branch.mean.points;
  height.doubts = pair_height::doubts_of(height, pair);
  pair_height::doubt_width(height);
  return height;
}

std::optional<PairHeight> peak_of(const PairOfPictures& pair) {
  const MeanProfiles& found = pair.profiles.profiles;
  // Of clipped light the brightest is not known.
  if (!has_clear_profiles(pair) || pair.is_peak_cut || !std::isfinite(found.peak_above_km))
    return std::nullopt;
  PairHeight peak;
  peak.km = pair.clocks.border_km + found.peak_above_km;
  peak.error_km = std::hypot(pair.clocks.border_error_km, found.peak_above_error_km);
  peak.is_by_profiles = true;
  peak.doubts = height_of(pair)->doubts;
  return peak;
}

bool has_sound_profiles(const PairOfPictures& pair) {
  if (!pair.refusal.empty() || !has_clear_profiles(pair)) return false;
  const std::optional<PairHeight> height = height_of(pair);
  return height->doubts.size() == (height->is_wide ? 1u : 0u);
}

std::optional<PairHeight> common_border(const std::vector<PairOfPictures>& pairs,
                                        const ClockSolution& clocks) {
  std::vector<PairHeight> sound;
  for (const PairOfPictures& pair : pairs)
    if (has_sound_profiles(pair)) sound.push_back(*height_of(pair));
  if (sound.size() < 2 || contradict(sound)) return std::nullopt;
  PairHeight border;
  border.km = clocks.border_km;
  border.error_km = clocks.border_error_km;
  border.is_by_profiles = true;
  pair_height::doubt_width(border);
  return border;
}

bool contradict(const std::vector<PairHeight>& heights) {
  for (const PairHeight& a : heights)
    for (const PairHeight& b : heights)
      if (std::abs(a.km - b.km) > pair_height::kFarthest * std::hypot(a.error_km, b.error_km)) return true;
  return false;
}

BorderDistance distance_by(const PairOfPictures& pair, const PairHeight& height, const Measurement& alone,
                           std::size_t which) {
  BorderDistance none{sim::kNaN, sim::kNaN};
  if (!alone.main_border || !alone.border_scene ||
      compared_trace(pair, alone, which) != alone.main_border->trace)
    return none;
  const auto at = [&](double height_km) {
    const MainBorder& border = *alone.main_border;
    const double error_deg =
        std::max(border.elevation_error_deg, pair.cameras[which].camera().pointing_error_deg);
    return border_place(alone.border_scene->site, border.azimuth_deg, border.elevation_deg, error_deg,
                        height_km);
  };
  const BorderPlace place = at(height.km);
  const double by_height = 0.5 * (at(height.km + height.error_km).distance_km -
                                  at(std::max(1.0, height.km - height.error_km)).distance_km);
  return {place.distance_km, std::hypot(place.distance_error_km, by_height)};
}

CrossCheck cross_check(const PairOfPictures& pair, const Measurement& first, const Measurement& second) {
  using namespace pair_height;
  CrossCheck check;
  const auto here = compared_trace(pair, first, 0), there = compared_trace(pair, second, 1);
  if (!here || !there || !first.border || !second.border) return check;
  const PictureCurve border = curve_of_trace(first.border->traces[*here], pair.cameras[0], 0);
  check.lowest = seen_border(pair, border, kBorderAltitudesKm.front());
  check.highest = seen_border(pair, border, kBorderAltitudesKm.back());
  const double pointing_deg =
      std::hypot(pair.cameras[0].camera().pointing_error_deg, pair.cameras[1].camera().pointing_error_deg);
  for (const BorderPoint& point : second.border->traces[*there].points) {
    if (!point.measured()) continue;
    const double error_deg = std::hypot(point.elevation_error_deg, pointing_deg);
    check.shown.push_back({point.azimuth_deg, point.elevation_deg, error_deg});
    std::vector<double> all = elevations_at(check.lowest, point.azimuth_deg);
    const std::vector<double> more = elevations_at(check.highest, point.azimuth_deg);
    if (all.empty() || more.empty()) continue;
    all.insert(all.end(), more.begin(), more.end());
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    ++check.compared;
    check.covered += point.elevation_deg >= *least - error_deg && point.elevation_deg <= *most + error_deg;
  }
  if (check.compared == 0) return check;
  const double share = static_cast<double>(check.covered) / check.compared;
  check.sentence = fmt::format(
      "What the first picture alone says, with a border {:.0f} to {:.0f} km high, covers {:.0f} % of "
      "the second one's border",
      kBorderAltitudesKm.front(), kBorderAltitudesKm.back(), 100.0 * share);
  check.sentence += share >= kCovered ? "." : "; " + what_has_to_change(pair) + ".";
  return check;
}

}  // namespace vegard::fit
