#include "fit/photo/pointing/calibration_doubts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kLevelWithin_deg = 2.5;
constexpr double kSiderealPerHour_deg = 15.041;  // 360.9856 degrees a day

/// "1 h 5 min", "12 min".
std::string duration_text(double hours) {
  const int minutes = static_cast<int>(std::lround(60.0 * std::abs(hours)));
  return minutes < 60 ? fmt::format("{} min", minutes)
                      : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace

UnseenStars unseen_stars(const Calibration& calibration, const std::vector<StarSighting>& sky,
                         double faintest, const std::vector<FoundStar>& points,
                         const std::vector<char>& usable) {
  UnseenStars unseen;
  unseen.faintest = faintest;
  unseen.radius_px = std::max(3.0, 5.0 * calibration.rms_px);
  const Frame& frame = calibration.frame;
  for (StarSighting star : sky) {
    if (star.magnitude > faintest) continue;
    if (!place_of_star(calibration.camera, star.enu, star.x_px, star.y_px)) continue;
    if (star.x_px < 0.0 || star.y_px < 0.0 || star.x_px >= frame.width_px || star.y_px >= frame.height_px)
      continue;
    const std::size_t pixel = static_cast<std::size_t>(star.y_px) * static_cast<std::size_t>(frame.width_px) +
                              static_cast<std::size_t>(star.x_px);
    if (!usable.empty() && usable[pixel] == 0) continue;
    ++unseen.in_view;
    const auto near = [&](const auto& other) {
      return std::hypot(other.x_px - star.x_px, other.y_px - star.y_px) <= unseen.radius_px;
    };
    if (std::any_of(points.begin(), points.end(), near) ||
        std::any_of(calibration.stars.begin(), calibration.stars.end(), near))
      continue;
    unseen.stars.push_back(star);
  }
  return unseen;
}

std::string words_of(const UnseenStars& unseen) {
  constexpr std::size_t kNamed = 6;
  if (unseen.stars.empty()) return {};
  std::string text = fmt::format(
      "{} of the {} stars to magnitude {:.1f} in view {} no point of light within {:.1f} px of the place:",
      unseen.stars.size(), unseen.in_view, unseen.faintest, unseen.stars.size() == 1 ? "has" : "have",
      unseen.radius_px);
  for (std::size_t i = 0; i < std::min(kNamed, unseen.stars.size()); ++i) {
    const StarSighting& star = unseen.stars[i];
    text += fmt::format("{} {} (magnitude {:.1f}) at ({:.0f}, {:.0f})", i > 0 ? "," : "",
                        star.name.empty() ? "a star" : star.name, star.magnitude, star.x_px, star.y_px);
  }
  if (unseen.stars.size() > kNamed) text += fmt::format(", and {} more", unseen.stars.size() - kNamed);
  return text + ": behind clouds or trees, lost in bright light, or not these stars";
}

std::string level_doubt(const Calibration& calibration, const LevelEvidence& level) {
  const Eigen::Vector3d axis = calibration.camera.camera_from_enu.row(2).transpose();
  const double off_deg = std::acos(std::clamp(axis[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
  if (!(off_deg > kLevelWithin_deg)) return {};
  const double latitude = level.latitude_deg * sim::kRadiansPerDegree;
  const double along_pole = axis[1] * std::cos(latitude) + axis[2] * std::sin(latitude);
  const double on_meridian = -axis[1] * std::sin(latitude) + axis[2] * std::cos(latitude);
  const double east_deg = std::atan2(axis[0], on_meridian) / sim::kRadiansPerDegree;
  const double rest_deg =
      std::abs(std::asin(std::clamp(along_pole, -1.0, 1.0)) / sim::kRadiansPerDegree - level.latitude_deg);
  std::string text =
      fmt::format("{}, but by the stars its axis is {:.1f} deg from the zenith", level.why, off_deg);
  if (rest_deg < off_deg / 3.0)
    text += fmt::format(
        "; a time {} {}, or a site {:.1f} deg farther {}, would leave {:.1f} deg: check the clock, its zone "
        "and the site",
        duration_text(east_deg / kSiderealPerHour_deg), east_deg > 0.0 ? "later" : "earlier",
        std::abs(east_deg), east_deg > 0.0 ? "east" : "west", rest_deg);
  else
    text += "; no error of the time explains that: check the site, or whether the camera was tilted";
  return text;
}

std::string time_and_site_doubt(const Calibration& calibration) {
  if (calibration.evidence != CalibrationEvidence::stars) return {};
  const std::vector<LensNumber>& free = calibration.candidates[calibration.chosen].free;
  for (const LensNumber turn : {turn_about_right, turn_about_down, turn_about_forward})
    if (std::find(free.begin(), free.end(), turn) == free.end()) return {};
  return "stars alone cannot reveal a wrong time or site: an hour turns the camera by 15 deg about the "
         "celestial pole "
         "and fits as well; a horizon, a levelled camera or another picture of it would reveal it";
}

}  // namespace vegard::fit
