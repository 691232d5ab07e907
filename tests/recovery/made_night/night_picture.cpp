#include "tests/recovery/made_night/night_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/render.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sensor/tone_curve.h"
#include "sim/view/sky/moon.h"
#include "tests/recovery/made_night/weather.h"

namespace vegard::made_night {
namespace {

constexpr int kQuality = 92;
constexpr double kSecondsPerDay = 86400.0, kUnixEpoch = 2440587.5;

using Rgb = std::array<double, 3>;

}  // namespace

std::string FrameTruth::sky() const {
  if (arc) return "arc";
  if (twilight) return "twilight";
  if (cloud) return "cloud";
  if (moon) return "moon";
  if (lamp) return "lamp";
  return aurora ? "aurora" : "dark";
}

NightPicture night_picture(const Night& night, const NightFrame& frame) {
  const sim::Scene scene = night.truth(frame);
  const SkyState now = night.sky(frame.utc_s);
  const double seconds = frame.utc_s - night.begin_s();
  sim::RenderOptions options;
  options.threads = 1;
  const sim::Rendering rendering = sim::render(scene, options);
  const sim::Image shown = sim::shown_light(scene, rendering);
  const int w = scene.camera.width, h = scene.camera.height;
  const sim::CameraView<double> view = sim::camera_view(scene.camera);

  sim::Observer observer;
  observer.latitude_deg = scene.site.latitude_deg;
  observer.longitude_deg = scene.site.longitude_deg;
  const double date = kUnixEpoch + frame.utc_s / kSecondsPerDay;
  const std::array<double, 3> moon = sim::direction_of_moon(observer, date);
  const double lit = moon[2] > 0.0 ? sim::lit_share_of_moon(date) : 0.0;
  const double cloud_at_moon =
      lit > 0.0 ? cloud_share(night.seed(), now.cloud_cover, moon.data(), seconds) : 0.0;
  double moon_x = -1.0, moon_y = -1.0;
  const bool moon_is_seen = lit > 0.0 && sim::pixel_of_enu(view, moon.data(), moon_x, moon_y) &&
                            moon_x > 0.0 && moon_x < w && moon_y > 0.0 && moon_y < h;
  // A lamp on a pole, where it always stands.
  double lamp[3];
  const double lamp_x = frame.camera == 0 ? 51.5 : 190.5, lamp_y = frame.camera == 0 ? 121.5 : 117.5;
  sim::enu_of_pixel(view, lamp_x, lamp_y, lamp);

  // Twilight alone, for the truth; overcast shows it all the same.
  double twilight_level = 0.0;
  if (scene.twilight.shown) {
    sim::Scene without = scene;
    without.twilight.shown = false;
    without.sheets.clear();
    without.stars.shown = false;
    const sim::Image other = sim::shown_light(without, sim::render(without, options));
    sim::Scene with = without;
    with.twilight.shown = true;
    const sim::Image both = sim::shown_light(with, sim::render(with, options));
    std::vector<double> levels;
    for (int y = 0; y < h; y += 4)
      for (int x = 0; x < w; x += 4) levels.push_back(both.at(x, y, 1) - other.at(x, y, 1));
    twilight_level = middle(levels);
  }

  NightPicture result;
  cv::Mat picture(h, w, CV_8UC3);
  std::vector<double> aurora, background;
  double hidden = 0.0, seen_aurora = 0.0, all_aurora = 0.0;
  int sky_pixels = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      double enu[3];
      sim::enu_of_pixel(view, x + 0.5, y + 0.5, enu);
      const double cloud = cloud_share(night.seed(), now.cloud_cover, enu, seconds);
      const double at_moon = enu[0] * moon[0] + enu[1] * moon[1] + enu[2] * moon[2];
      const double at_lamp = enu[0] * lamp[0] + enu[1] * lamp[1] + enu[2] * lamp[2];
      Rgb light{}, sky{};
      for (int c = 0; c < 3; ++c) {
        const double of_aurora =
            rendering.aurora.empty() ? 0.0 : std::max(0.0f, rendering.aurora.at(x, y, c));
        const double behind = shown.at(x, y, c);
        sky[static_cast<std::size_t>(c)] = behind - of_aurora;
        // The air that the Moon lights, clouds that twilight, the Moon and the town light.
        constexpr double kMoonlit = 0.045, kTown[3] = {0.038, 0.027, 0.016};
        const double moonlit = kMoonlit * lit * std::max(0.0, moon[2]) * (c == 2 ? 1.4 : c == 0 ? 0.85 : 1.0);
        const double cloud_light = kTown[c] + 3.0 * moonlit +
                                   0.6 * twilight_level *
                                       (c == 0   ? 1.05
                                        : c == 1 ? 1.0
                                                 : 0.95);
        double value = (behind + moonlit) * (1.0 - cloud) + cloud_light * cloud;
        if (lit > 0.0) value += lit * (1.0 - cloud_at_moon) * glare(at_moon, 0.35);
        if (now.lamp) value += glare(at_lamp, 0.5) * (c == 0 ? 1.0 : c == 1 ? 0.8 : 0.5);
        light[static_cast<std::size_t>(c)] = value;
      }
      if (enu[2] > 0.1) {
        ++sky_pixels;
        hidden += cloud;
        const double green = rendering.aurora.empty() ? 0.0 : std::max(0.0f, rendering.aurora.at(x, y, 1));
        aurora.push_back(green * (1.0 - cloud));
        all_aurora += green;
        seen_aurora += green * (1.0 - cloud);
        background.push_back(light[1] - green * (1.0 - cloud));
      }
      for (int c = 0; c < 3; ++c) {
        const double code =
            255.0 * sim::srgb_encode(noisy(light[static_cast<std::size_t>(c)], {}, scene.seed, x, y, c));
        // OpenCV has blue first.
        picture.at<cv::Vec3b>(y, x)[2 - c] =
            static_cast<unsigned char>(std::lround(std::clamp(code, 0.0, 255.0)));
      }
    }
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  result.jpeg.assign(bytes.begin(), bytes.end());

  FrameTruth& truth = result.truth;
  constexpr double kArc = 0.25, kAurora = 0.15, kSeen = 0.6, kCloud = 0.3, kMoon = 0.02;
  std::vector<double> sorted = aurora;
  const auto brightest =
      sorted.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), brightest, sorted.end());
  truth.contrast = *brightest / middle(background);
  truth.cover = hidden / sky_pixels;
  truth.aurora = now.aurora != Aurora::none && truth.contrast > kAurora;
  truth.arc = now.aurora == Aurora::arc && truth.contrast > kArc && seen_aurora > kSeen * all_aurora;
  truth.cloud = truth.cover >= kCloud;
  truth.moon = moon_is_seen && lit * (1.0 - cloud_at_moon) >= kMoon;
  truth.twilight = twilight_level > 0.5 * middle(background);
  truth.lamp = now.lamp;
  return result;
}

}  // namespace vegard::made_night
