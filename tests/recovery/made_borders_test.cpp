// Lower borders claimed on made skies of which it is known where aurora is: 25 without any (clear, with the
// Milky Way, cloud, twilight, the Moon, lamps, trails of stars) and 25 with some. They stand beside the real
// pictures of tests/reality/borders.py, and are counted apart (docs/border.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "fit/border/border.h"
#include "fit/photo/photo.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"
#include "tests/recovery/made_night/random_sky.h"

namespace vegard::fit::made_borders_test {
namespace {

using made_night::RandomSky;
using made_night::RandomSkyTruth;

constexpr std::uint64_t kSeed = 44;  // the number: nothing was chosen by what it draws
constexpr int kWanted = 25, kWithTrails = 3;
constexpr double kNear_deg = 3.0;  // as tests/reality/borders.py has it
// The aim is one claim in 25 frames without aurora, and one in ten false or missed where there is some. Two
// were claimed without, in one sky of moonlit cloud, none of 33 was false, and 29 of 73 were missed
// (docs/border.md): these limits notice worse.
constexpr int kMostWithout = 2;
constexpr double kMostFalse = 0.1, kMostMissed = 0.45;

struct Place {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
};
using Line = std::vector<Place>;

double apart_deg(const Place& a, const Place& b) {
  double u[3], v[3];
  sim::enu_of_direction({a.azimuth_deg, a.elevation_deg}, u);
  sim::enu_of_direction({b.azimuth_deg, b.elevation_deg}, v);
  return std::acos(std::clamp(u[0] * v[0] + u[1] * v[1] + u[2] * v[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
}

double length_deg(const Line& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += apart_deg(line[i - 1], line[i]);
  return sum;
}

bool is_near(const Place& place, const std::vector<Line>& lines) {
  for (const Line& line : lines)
    for (const Place& other : line)
      if (apart_deg(place, other) <= kNear_deg) return true;
  return false;
}

double share_near(const Line& line, const std::vector<Line>& lines) {
  double near = 0.0;
  for (const Place& place : line) near += is_near(place, lines) ? 1.0 : 0.0;
  return near / static_cast<double>(line.size());
}

/// Where the aurora's own light, without noise, sky and cloud, has fallen to half of a peak above it, at each
/// azimuth from 2 to 70 degrees of elevation: those that are seen against the sky by `contrast`, joined to
/// lines.
std::vector<Line> true_borders(const RandomSky& sky, double contrast) {
  constexpr double kStep_deg = 0.1;
  constexpr int kRows = 800;
  const sim::CameraView<double> view = sim::camera_view(sky.scene.camera);
  const auto light = [&](double azimuth, int row, int channel) {
    double enu[3], x = 0.0, y = 0.0;
    sim::enu_of_direction({azimuth, kStep_deg * row}, enu);
    if (!sim::pixel_of_enu(view, enu, x, y) || !(x >= 0.0 && y >= 0.0) || x >= sky.light.width ||
        y >= sky.light.height)
      return 0.0;
    return static_cast<double>(sky.light.at(static_cast<int>(x), static_cast<int>(y), channel));
  };
  std::vector<Line> lines;
  for (int azimuth = 0; azimuth < 360; ++azimuth) {
    std::vector<double> aurora;
    for (int row = 0; row < kRows; ++row) aurora.push_back(light(azimuth, row, 0));
    for (int peak = 1; peak + 1 < kRows; ++peak) {
      // The upper end of a flat top, as pixels make it.
      if (!(aurora[peak] > aurora[peak + 1])) continue;
      int foot = peak;
      while (foot > 0 && aurora[foot - 1] <= aurora[foot]) --foot;
      // A dip between the folds of one arc is no border.
      if (aurora[foot] > 0.5 * aurora[peak]) continue;
      const double half = 0.5 * (aurora[peak] + aurora[foot]);
      int border = peak;
      while (border > foot && aurora[border] > half) --border;
      const Place place{static_cast<double>(azimuth), kStep_deg * border};
      const double left = light(azimuth, peak, 1), background = light(azimuth, peak, 2);
      if (place.elevation_deg < 2.0 || place.elevation_deg > 70.0 || light(azimuth, border, 1) < 0.6 ||
          left * (aurora[peak] - aurora[foot]) < contrast * background)
        continue;
      const auto goes_on = std::find_if(lines.begin(), lines.end(), [&](const Line& line) {
        return azimuth - line.back().azimuth_deg < 2.5 && azimuth > line.back().azimuth_deg &&
               std::abs(line.back().elevation_deg - place.elevation_deg) < 2.0;
      });
      if (goes_on != lines.end())
        goes_on->push_back(place);
      else
        lines.push_back({place});
    }
  }
  return lines;
}

std::vector<Line> claims_on(const RandomSky& sky) {
  Photo photo = read_photo_bytes(sky.jpeg, "made.jpg", Decoding{});
  // What a mask of the lens's circle leaves out.
  for (int y = 0; y < photo.linear.height; ++y)
    for (int x = 0; x < photo.linear.width; ++x) {
      const sim::Direction d = sim::direction_of_pixel(sky.scene.camera, x + 0.5, y + 0.5);
      if (!(d.elevation_deg > 0.0))
        for (int c = 0; c < 3; ++c) photo.usable[photo.linear.index(x, y, c)] = 0;
    }
  const Border border = trace_border(photo, sky.scene);
  std::vector<Line> claims;
  for (const BorderTrace& trace : border.traces) {
    if (!trace.is_claimed()) continue;
    Line line;
    for (const BorderPoint& p : trace.points)
      if (p.measured()) line.push_back({p.azimuth_deg, p.elevation_deg});
    claims.push_back(std::move(line));
  }
  return claims;
}

std::string kinds_of(const RandomSkyTruth& truth, bool trails) {
  std::string words;
  const auto add = [&](bool is_so, const char* word) {
    if (is_so) words += (words.empty() ? "" : " ") + std::string(word);
  };
  add(truth.black, "black");
  add(truth.cloud, "cloud");
  add(truth.twilight, "twilight");
  add(truth.moon, "moon");
  add(truth.lamp, "lamp");
  add(trails, "trails");
  add(truth.mono, "grey");
  return words.empty() ? "clear" : words;
}

/// To look at, where the environment names a folder for them.
void keep(const RandomSky& sky, const std::string& name) {
  if (const char* folder = std::getenv("VEGARD_MADE_BORDERS"))
    std::ofstream(std::string(folder) + "/" + name + ".jpg", std::ios::binary) << sky.jpeg;
}

TEST(MadeBorders, NoneIsClaimedWithoutAurora) {
  int frames = 0, claimed = 0;
  std::map<std::string, int> kinds;
  for (std::uint32_t number = 0; frames < kWanted; ++number) {
    const bool trails = frames >= kWanted - kWithTrails;
    const RandomSky sky = made_night::random_sky(kSeed, number, trails);
    if (!sky.scene.sheets.empty()) continue;
    ++frames;
    const std::size_t claims = claims_on(sky).size();
    claimed += static_cast<int>(claims);
    const std::string kind = kinds_of(sky.truth, trails);
    ++kinds[kind];
    keep(sky, "none_" + std::to_string(number));
    if (claims > 0) std::printf("sky %u, %s: %zu claimed\n", number, kind.c_str(), claims);
  }
  for (const auto& [kind, count] : kinds) std::printf("%d %s\n", count, kind.c_str());
  std::printf("%d claimed in %d frames without aurora\n", claimed, frames);
  EXPECT_LE(claimed, kMostWithout);
}

TEST(MadeBorders, AreClaimedWhereAuroraIs) {
  int frames = 0, claimed = 0, wrong = 0, marked = 0, missed = 0;
  for (std::uint32_t number = 0; frames < kWanted; ++number) {
    const RandomSky sky = made_night::random_sky(kSeed, number);
    // A corona is seen from below: it has no lower border.
    if (!sky.truth.aurora || sky.truth.overhead) continue;
    ++frames;
    // What an eye may call a border, and what it must.
    const std::vector<Line> faint = true_borders(sky, 0.03), bright = true_borders(sky, 0.25);
    const std::vector<Line> claims = claims_on(sky);
    int wrong_here = 0, marked_here = 0, missed_here = 0;
    for (const Line& claim : claims) wrong_here += share_near(claim, faint) < 0.5 ? 1 : 0;
    for (const Line& line : bright) {
      if (length_deg(line) < 10.0) continue;
      ++marked_here;
      missed_here += share_near(line, claims) < 0.5 ? 1 : 0;
    }
    claimed += static_cast<int>(claims.size());
    wrong += wrong_here, marked += marked_here, missed += missed_here;
    keep(sky, "aurora_" + std::to_string(number));
    std::printf("sky %u, %s%s: %zu claimed, %d false; %d marked, %d missed\n", number,
                sky.truth.rayed     ? "rayed "
                : sky.truth.several ? "several "
                : sky.truth.arc     ? "arc "
                                    : "",
                kinds_of(sky.truth, false).c_str(), claims.size(), wrong_here, marked_here, missed_here);
  }
  std::printf("%d of %d claimed are false, %d of %d marked are missed\n", wrong, claimed, missed, marked);
  EXPECT_LE(wrong, kMostFalse * claimed);
  EXPECT_LE(missed, kMostMissed * marked);
}

}  // namespace
}  // namespace vegard::fit::made_borders_test
