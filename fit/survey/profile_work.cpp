#include "fit/survey/survey_frame.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/compare/observation.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kStandsOut = 5.0;  // standard errors

/// A strip of a profile in one channel.
struct Strip {
  const Profile& profile;
  int band = 0, channel = 0;

  double mean(int row) const { return profile.mean[profile.index(band, row, channel)]; }
  double error(int row) const { return profile.standard_error[profile.index(band, row, channel)]; }
  bool is_known(int row) const { return std::isfinite(mean(row)) && std::isfinite(error(row)); }
};

struct Extremes {
  int brightest = -1, darkest = -1;  ///< rows; -1: nothing is known
};

Extremes extremes_of(const Strip& strip) {
  Extremes found;
  for (int row = 0; row < strip.profile.rows; ++row) {
    if (!strip.is_known(row)) continue;
    if (found.brightest < 0 || strip.mean(row) > strip.mean(found.brightest)) found.brightest = row;
    if (found.darkest < 0 || strip.mean(row) < strip.mean(found.darkest)) found.darkest = row;
  }
  return found;
}

/// Returns the place of the vertex of the parabola through the brightest row and those beside it.
double vertex(const Strip& strip, int row) {
  if (row == 0 || row + 1 == strip.profile.rows || !strip.is_known(row - 1) || !strip.is_known(row + 1))
    return row;
  const double above = strip.mean(row - 1), here = strip.mean(row), below = strip.mean(row + 1);
  const double bend = above - 2.0 * here + below;
  return bend < 0.0 ? row + 0.5 * (above - below) / bend : row;
}

/// Returns the row where the light has fallen to a level, from a row on downwards (step 1) or upwards (-1);
/// none if it meets unknown rows first.
std::optional<double> row_of_level(const Strip& strip, int from, int step, double level) {
  for (int row = from; row + step >= 0 && row + step < strip.profile.rows; row += step) {
    if (!strip.is_known(row + step)) return std::nullopt;
    const double here = strip.mean(row), next = strip.mean(row + step);
    if (next <= level) return row + step * (here - level) / (here - next);
  }
  return std::nullopt;
}

void add_ratio(const Profile& profile, int band, const Extremes& at, int channel, const char* name,
               WorkAnswer& answer) {
  constexpr int kGreen = 1;
  const auto light = [&](int colour, double& value, double& error) {
    const Strip strip{profile, band, colour};
    if (!strip.is_known(at.brightest) || !strip.is_known(at.darkest)) return false;
    value = strip.mean(at.brightest) - strip.mean(at.darkest);
    error = std::hypot(strip.error(at.brightest), strip.error(at.darkest));
    return true;
  };
  double upper = 0.0, upper_error = 0.0, green = 0.0, green_error = 0.0;
  if (!light(channel, upper, upper_error) || !light(kGreen, green, green_error)) return;
  if (!(green > kStandsOut * green_error)) return;
  const double ratio = upper / green;
  answer.quantities.push_back(
      {band + 1, name, "", ratio, std::hypot(upper_error, ratio * green_error) / green, {}, {}});
}

void add_strip(const Strip& strip, const sim::Scene& scene, WorkAnswer& answer) {
  const Extremes at = extremes_of(strip);
  if (at.brightest < 0) return;
  const double bright = strip.mean(at.brightest), dark = strip.mean(at.darkest);
  const double bright_error = strip.error(at.brightest), dark_error = strip.error(at.darkest);
  if (!(bright - dark > kStandsOut * std::hypot(bright_error, dark_error))) return;
  const Profile& profile = strip.profile;
  const double middle_px =
      profile.region.x + (strip.band + 0.5) * profile.region.width / static_cast<double>(profile.bands);
  const auto look = [&](double row) {
    return sim::direction_of_pixel(scene.camera, middle_px, profile.region.y + row + 0.5);
  };
  const auto put = [&](const char* name, const char* unit, std::optional<double> value,
                       std::optional<double> sigma, std::optional<std::string> reason) {
    answer.quantities.push_back({strip.band + 1, name, unit, value, sigma, {}, std::move(reason)});
  };
  const double peak = vertex(strip, at.brightest);
  put("azimuth of the brightest place", "deg", look(peak).azimuth_deg, {}, {});
  put("elevation of the brightest place", "deg", look(peak).elevation_deg, {}, {});
  put("brightness", "white", bright, bright_error, {});
  put("darkest brightness", "white", dark, dark_error, {});
  const double level = 0.5 * (bright + dark);
  for (const auto& [name, step] : {std::pair{"half-width below", 1}, {"half-width above", -1}}) {
    const std::optional<double> row = row_of_level(strip, at.brightest, step, level);
    if (row)
      put(name, "deg", std::abs(look(*row).elevation_deg - look(peak).elevation_deg), {}, {});
    else
      put(name, "deg", {}, {}, "the light leaves the picture or what is sky before it has fallen to half");
  }
  add_ratio(profile, strip.band, at, 0, "red over green", answer);
  add_ratio(profile, strip.band, at, 2, "blue over green", answer);
}

}  // namespace

WorkAnswer profile_answer(const Photo& photo, const sim::Scene& scene, int channel) {
  const sim::Scene seen = scene_of_pixels(scene, photo);
  const Region region = checked_region(seen.fit.roi_px, photo.linear.width, photo.linear.height);
  const Profile profile =
      smoothed(extract_profile(photo, region, std::min(kSurveyStrips, region.width)), kProfileSmoothing_px);
  WorkAnswer answer;
  answer.work = SurveyWork::profile;
  for (int band = 0; band < profile.bands; ++band) add_strip({profile, band, channel}, seen, answer);
  answer.verdict = answer.quantities.empty() ? "none" : "good";
  return answer;
}

}  // namespace vegard::fit
