#include "fit/photo/pointing/blind/star_doubts.h"

#include <algorithm>

#include "fit/photo/mask/circle.h"
#include "fit/photo/pointing/calibration_doubts.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/held_out.h"
#include "fit/photo/pointing/star_check.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kBrightStars = 2.5;  // magnitude: seen in any picture in which stars are
constexpr double kClearOfGround_deg = 10.0;

/// Returns why the camera is level if the picture is the circle of an all-sky lens; else an empty text.
std::string circle_says_level(const Calibration& calibration, const Photo* photo) {
  if (photo == nullptr || calibration.camera.model == sim::LensModel::pinhole) return {};
  const std::optional<CircleFound> found = find_circle(*photo);
  if (!found) return {};
  // A hemisphere's image and more: f times 70 degrees at least, whatever the lens, where a crop's corners
  // have less.
  const double radians = found->circle.radius_px / calibration.camera.numbers[focal_px_number];
  if (radians < 70.0 * sim::kRadiansPerDegree) return {};
  return "the picture is the circle of an all-sky lens, and such cameras are mostly level";
}

}  // namespace

void add_star_doubts(Calibration& calibration, const StarEvidence& evidence) {
  if (calibration.evidence != CalibrationEvidence::stars) return;
  const auto add = [&](const std::string& words) {
    if (!words.empty()) calibration.warnings.push_back(words);
  };
  if (evidence.is_table && calibration.frame.known &&
      only_in_first_quarter(calibration.stars, calibration.frame))
    add("all stars of the table are in the picture's upper left quarter: is it this picture's, at this "
        "size?");
  const SkyOfPicture& sky = evidence.sky;
  if (evidence.photo != nullptr && sky.julian_date && sky.observer) {
    std::vector<FoundStar> points = evidence.points;
    if (points.empty()) {
      StarFinderSettings finder;
      finder.min_signal = evidence.min_signal;
      points = find_stars(evidence.photo->linear, finder, evidence.usable);
    }
    const double faintest = std::min(kBrightStars, evidence.faintest);
    const double lowest =
        sim::horizon_elevation_deg(*sky.observer) + std::max(kClearOfGround_deg, evidence.min_elevation_deg);
    add(words_of(unseen_stars(calibration, catalogue_sky(*sky.observer, *sky.julian_date, faintest, lowest),
                              faintest, points, evidence.usable)));
    calibration.explained = explained_points(
        calibration, points,
        field_sky(calibration.camera, calibration.frame, *sky.observer, *sky.julian_date,
                  sim::horizon_elevation_deg(*sky.observer) + evidence.min_elevation_deg, 0.0));
  }
  if (sky.observer) {
    const std::string why =
        evidence.why_level.empty() ? circle_says_level(calibration, evidence.photo) : evidence.why_level;
    if (!why.empty()) add(level_doubt(calibration, {why, sky.observer->latitude_deg}));
  }
  add(time_and_site_doubt(calibration));
}

}  // namespace vegard::fit
