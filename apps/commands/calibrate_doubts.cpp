#include "apps/commands/calibrate_doubts.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fit/photo/mask/circle.h"
#include "fit/photo/pointing/calibration_doubts.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/star_check.h"
#include "sim/base/number/constants.h"

namespace vegard::apps {
namespace {

constexpr double kBrightStars = 2.5;  // magnitude: seen in any picture in which stars are
constexpr double kClearOfGround_deg = 10.0;
constexpr double kZenithCamera_deg = 80.0;

/// Why the camera should look to the zenith; empty if nothing says so.
std::string why_level(const fit::Calibration& calibration, const std::optional<sim::Scene>& camera_file,
                      const std::optional<fit::Photo>& photo) {
  if (camera_file && camera_file->lines.count("camera.elevation_deg") > 0 &&
      camera_file->camera.elevation_deg >= kZenithCamera_deg)
    return "--camera looks to the zenith";
  if (!photo || calibration.camera.model == sim::LensModel::pinhole) return {};
  const std::optional<fit::CircleFound> found = fit::find_circle(*photo);
  if (!found) return {};
  // A hemisphere's image and more: f times 70 degrees at least, whatever the lens, where a crop's corners
  // have less.
  const double radians = found->circle.radius_px / calibration.camera.numbers[fit::focal_px_number];
  if (radians < 70.0 * sim::kRadiansPerDegree) return {};
  return "the picture is the circle of an all-sky lens, and such cameras are mostly level";
}

}  // namespace

void add_doubts(fit::Calibration& calibration, const CalibrateOptions& options,
                const std::optional<sim::Scene>& camera_file, const fit::SkyOfPicture& sky,
                const std::optional<fit::Photo>& photo, const std::vector<char>& usable) {
  if (calibration.evidence != fit::CalibrationEvidence::stars) return;
  const auto add = [&](const std::string& words) {
    if (!words.empty()) calibration.warnings.push_back(words);
  };
  if (!options.stars.empty() && calibration.frame.known &&
      fit::only_in_first_quarter(calibration.stars, calibration.frame))
    add("all stars of the table are in the picture's upper left quarter: is it this picture's, at this "
        "size?");
  if (photo && sky.julian_date && sky.observer) {
    fit::StarFinderSettings finder;
    finder.least_signal = options.least_signal;
    const double faintest = std::min(kBrightStars, options.faintest);
    const double lowest = std::max(kClearOfGround_deg, options.least_elevation_deg);
    add(fit::words_of(fit::unseen_stars(calibration,
                                        fit::catalogue_sky(*sky.observer, *sky.julian_date, faintest, lowest),
                                        faintest, fit::find_stars(photo->linear, finder, usable), usable)));
  }
  if (sky.observer) {
    const std::string why = why_level(calibration, camera_file, photo);
    if (!why.empty()) add(fit::level_doubt(calibration, {why, sky.observer->latitude_deg}));
  }
  add(fit::time_and_site_doubt(calibration));
}

}  // namespace vegard::apps
