#include "tests/recovery/made_night/random_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/base/utc_time.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sensor/tone_curve.h"
#include "tests/recovery/made_night/weather.h"

namespace vegard::made_night {
namespace {

/// Numbers one after the other, of one sky.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint32_t number) : seed_(seed), number_(number) {}
  double operator()() {
    const sim::Words words = sim::random_words(seed_, sim::Stream::bootstrap, number_, count_++, 20260101u);
    return sim::fine_uniform(words[0], words[1]);
  }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  double log_between(double low, double high) { return low * std::pow(high / low, (*this)()); }
  bool chance(double share) { return (*this)() < share; }

 private:
  std::uint64_t seed_;
  std::uint32_t number_, count_ = 0;
};

enum class Form { none, diffuse, one_arc, several, rayed, overhead };

std::string sheet_text(const char* name, double east_km, double north_km, double bearing_deg,
                       double energy_kev, double flux, double ray_contrast, double width_km, int beams,
                       Dice& dice) {
  return fmt::format(
      "[[sheet]]\nname = \"{}\"\ncenter_km = [{:.2f}, {:.2f}]\nbearing_deg = {:.2f}\nlength_km = "
      "{:.0f}\nthickness_km = {:.2f}\nwavelength_km = {:.1f}\nphase_rad = {:.2f}\nlayers = 3\nwidth_km = "
      "{:.2f}\nbeams = {}\nenergy_kev = {:.2f}\nenergy_flux_mw_m2 = {:.4f}\nray_contrast = "
      "{:.2f}\nray_width_km = {:.2f}\n",
      name, east_km, north_km, bearing_deg, dice.log_between(400.0, 1800.0), dice.between(1.0, 9.0),
      dice.between(40.0, 160.0), dice.between(0.0, 6.28), width_km, beams, energy_kev, flux, ray_contrast,
      dice.between(2.0, 7.0));
}

/// The light of a scene, or its mean over an hour and a half.
sim::Image shown_over_time(sim::Scene scene, const sim::Rendering& now, const sim::RenderOptions& options,
                           bool trails) {
  sim::Image mean = sim::shown_light(scene, now);
  if (!trails) return mean;
  // In steps of 100 s, in which a star moves less than half a degree.
  constexpr int kSteps = 54;
  const double start = sim::utc_seconds(scene.site.time_utc).value();
  for (int step = 1; step < kSteps; ++step) {
    scene.site.time_utc = sim::utc_text(start + 100.0 * step);
    const sim::Image one = sim::shown_light(scene, sim::render(scene, options));
    for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] += one.data[i];
  }
  for (float& value : mean.data) value /= kSteps;
  return mean;
}

}  // namespace

RandomSky random_sky(std::uint64_t seed, std::uint32_t number, bool trails) {
  Dice dice(seed, number);
  RandomSky result;
  RandomSkyTruth& truth = result.truth;
  truth.fisheye = dice.chance(0.5);
  truth.mono = dice.chance(0.2);
  truth.black = dice.chance(0.03);
  Form form = dice.chance(0.5) ? static_cast<Form>(1 + std::min(4, static_cast<int>(dice() * 5.0)))
                               : (dice(), Form::none);
  if (form == Form::overhead && !truth.fisheye) form = Form::rayed;

  const double cloud_draw = dice();
  const double cover = form == Form::none ? (cloud_draw < 0.5 ? 0.0 : dice.between(0.4, 1.0))
                                          : (cloud_draw < 0.75 ? 0.0 : dice.between(0.3, 0.6));
  const bool has_twilight = dice.chance(form == Form::none ? 0.25 : 0.1);
  const bool has_moon = dice.chance(0.25), has_lamp = dice.chance(0.15);
  const double gain = dice.log_between(0.012, 0.09);
  const double azimuth_deg = dice.between(0.0, 360.0);
  const double elevation_deg = truth.fisheye ? 90.0 : dice.between(18.0, 40.0);
  const int width = truth.fisheye ? 240 : 260, height = truth.fisheye ? 240 : 180;

  std::string text = fmt::format(
      "seed = {}\n[site]\nlatitude_deg = 67.0\nlongitude_deg = 20.0\ntime_utc = "
      "\"2014-{:02d}-{:02d}T{:02d}:30:00Z\"\n"
      "[field]\ninclination_deg = 77.0\ndeclination_deg = 6.0\n[camera]\nwidth = {}\nheight = "
      "{}\n{}azimuth_deg = "
      "{:.1f}\nelevation_deg = {:.1f}\n[emission]\ntables = \"glow\"\n[sensor]\ngain_per_kilorayleigh = "
      "{:.4f}\n"
      "[airglow]\ngreen_rayleigh = {:.0f}\nred_rayleigh = {:.0f}\nsodium_rayleigh = 40.0\n[light_pollution]\n"
      "luminance_mcd_m2 = {:.3f}\nazimuth_deg = {:.0f}\n[stars]\nshown = true\nsource = "
      "\"catalogue\"\nmilky_way "
      "= {}\nfaintest_magnitude = {:.2f}\nwidth_deg = {:.3f}\n",
      1000 * seed + number, 1 + static_cast<int>(dice() * 12.0), 1 + static_cast<int>(dice() * 28.0),
      static_cast<int>(dice() * 24.0), width, height,
      truth.fisheye ? fmt::format("model = \"equidistant\"\nfocal_px = {:.2f}\n", dice.between(70.0, 80.0))
                    : fmt::format("hfov_deg = {:.1f}\n", dice.between(45.0, 100.0)),
      azimuth_deg, elevation_deg, gain, dice.between(80.0, 350.0), dice.between(30.0, 200.0),
      dice.log_between(0.05, 2.0), dice.between(0.0, 360.0), dice.chance(0.6) ? "true" : "false",
      dice.between(4.5, 6.5), truth.fisheye ? dice.between(0.2, 0.35) : dice.between(0.12, 0.25));
  if (has_twilight)
    text += fmt::format("[twilight]\nshown = true\nsun_elevation_deg = {:.2f}\nsun_azimuth_deg = {:.1f}\n",
                        dice.between(-13.0, -6.0), azimuth_deg + dice.between(-120.0, 120.0));
  const auto flux = [&] { return dice.log_between(1.5, 15.0); };
  const auto energy = [&] { return dice.log_between(1.5, 7.0); };
  // An arc before a lens; for a fisheye anywhere to the north or the south.
  const auto distance = [&] {
    return truth.fisheye ? dice.between(60.0, 320.0) : dice.between(140.0, 330.0);
  };
  const double side_deg = truth.fisheye ? (dice.chance(0.5) ? 6.0 : 186.0) : azimuth_deg;
  const auto add = [&](const char* name, double away_km, double contrast) {
    const double a = side_deg * sim::kRadiansPerDegree;
    text += sheet_text(name, away_km * std::sin(a), away_km * std::cos(a),
                       side_deg + 90.0 + dice.between(-15.0, 15.0), energy(), flux(), contrast,
                       dice.between(1.0, 3.0), 2500, dice);
  };
  switch (form) {
    case Form::none:
      break;
    case Form::diffuse: {
      const double a = side_deg * sim::kRadiansPerDegree, d = dice.between(100.0, 250.0);
      text += sheet_text("main", d * std::sin(a), d * std::cos(a), side_deg + 90.0, energy(), 0.03 * flux(),
                         0.0, dice.between(40.0, 80.0), 12000, dice);
      break;
    }
    case Form::one_arc:
      add("main", distance(), dice.between(0.0, 0.15));
      break;
    case Form::several: {
      const double first = distance();
      add("main", first, dice.between(0.0, 0.2));
      add("second", first + dice.between(50.0, 110.0), dice.between(0.0, 0.2));
      if (dice.chance(0.4))
        add("third", std::max(30.0, first - dice.between(45.0, 90.0)), dice.between(0.0, 0.2));
      break;
    }
    case Form::rayed:
      add("main", distance(), dice.between(0.6, 1.2));
      if (dice.chance(0.3)) add("second", distance(), dice.between(0.6, 1.2));
      break;
    case Form::overhead:
      // About the foot of the field line through the observer, south of it.
      for (int i = 0; i < 3; ++i)
        text += sheet_text(i == 0   ? "main"
                           : i == 1 ? "second"
                                    : "third",
                           dice.between(-15.0, 15.0), -25.0 + 18.0 * (i - 1) + dice.between(-5.0, 5.0),
                           96.0 + dice.between(-15.0, 15.0), dice.log_between(0.8, 3.0), flux(),
                           dice.between(0.5, 1.0), dice.between(1.0, 2.5), 2500, dice);
      break;
  }
  const sim::Scene scene = sim::parse_scene(text, "random_sky.toml");
  sim::RenderOptions options;
  options.threads = 1;
  const sim::Rendering rendering = sim::render(scene, options);
  const sim::Image shown = shown_over_time(scene, rendering, options, trails);
  result.scene = scene;
  result.light = sim::Image(width, height, {"aurora", "left", "sky"});
  const sim::CameraView<double> view = sim::camera_view(scene.camera);

  // The Moon and the lamp stand somewhere in the picture.
  const auto somewhere = [&](double low, double high, double enu[3]) {
    const double a = (truth.fisheye ? dice.between(0.0, 360.0) : azimuth_deg + dice.between(-20.0, 20.0)) *
                     sim::kRadiansPerDegree,
                 h = dice.between(low, high) * sim::kRadiansPerDegree;
    enu[0] = std::sin(a) * std::cos(h);
    enu[1] = std::cos(a) * std::cos(h);
    enu[2] = std::sin(h);
  };
  double moon[3], lamp[3];
  somewhere(truth.fisheye ? 8.0 : 14.0, truth.fisheye ? 60.0 : 35.0, moon);
  somewhere(3.0, 12.0, lamp);
  const CloudForm clouds{dice.log_between(4.0, 40.0), dice.log_between(0.3, 1.5)};
  const double gamma = dice.between(0.8, 1.25), vignetting = dice.between(0.0, 0.6);
  const double offset = dice.chance(0.3) ? dice.between(0.0, 0.03) : 0.0;
  const double trees_deg = truth.fisheye && dice.chance(0.6) ? dice.between(4.0, 20.0) : 0.0;
  const double trees_phase = dice.between(0.0, 6.28);
  const double lit = has_moon ? dice.between(0.1, 1.0) : 0.0;
  const double cloud_at_moon = lit > 0.0 ? cloud_share(seed * 4099 + number, cover, moon, 0.0, clouds) : 0.0;
  const double exposure = gain / 0.045;
  const double town = dice.log_between(0.3, 2.0);
  const std::array<double, 3> balance = {dice.between(0.75, 1.3), 1.0, dice.between(0.75, 1.3)};
  const SensorNoise noise{dice.log_between(2000.0, 20000.0), dice.log_between(0.0005, 0.004)};
  const double moon_core_deg = dice.log_between(0.4, 3.0), moon_strength = dice.log_between(1.0, 6.0);
  const bool has_trail = dice.chance(0.06), has_ground = !truth.fisheye && dice.chance(0.5);
  const double ground_deg = dice.between(1.0, 5.0), trail_light = dice.log_between(0.1, 1.0);
  const std::array<double, 4> trail = {dice(), dice(), dice.between(0.0, 360.0), dice.log_between(0.1, 0.7)};
  const int quality = 80 + static_cast<int>(dice() * 19.0);

  double twilight_level = 0.0;
  if (has_twilight) {
    sim::Scene without = scene;
    without.twilight.shown = false;
    without.sheets.clear();
    const sim::Image other = sim::shown_light(without, sim::render(without, options));
    without.twilight.shown = true;
    const sim::Image both = sim::shown_light(without, sim::render(without, options));
    std::vector<double> levels;
    for (int y = 0; y < height; y += 4)
      for (int x = 0; x < width; x += 4) levels.push_back(both.at(x, y, 1) - other.at(x, y, 1));
    twilight_level = middle(levels);
  }
  // A camera that exposes by itself shows no sky as white.
  std::vector<double> greens;
  for (int y = 0; y < height; y += 3)
    for (int x = 0; x < width; x += 3) {
      double enu[3];
      if (sim::enu_of_pixel(view, x + 0.5, y + 0.5, enu) && enu[2] > 0.1) greens.push_back(shown.at(x, y, 1));
    }
  constexpr double kBrightest = 0.35;
  const double shutter = std::min(1.0, kBrightest * dice.between(0.3, 1.0) / std::max(middle(greens), 1e-6));
  cv::Mat picture(height, width, CV_8UC3, cv::Scalar(0, 0, 0));
  std::vector<double> aurora, background;
  double hidden = 0.0, seen_aurora = 0.0, all_aurora = 0.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double enu[3] = {0.0, 0.0, -1.0};
      const bool is_sky = sim::enu_of_pixel(view, x + 0.5, y + 0.5, enu) && enu[2] > 0.0;
      std::array<double, 3> light{};
      if (is_sky || !truth.fisheye) {
        const double cloud = cloud_share(seed * 4099 + number, cover, enu, 0.0, clouds);
        const double at_moon = enu[0] * moon[0] + enu[1] * moon[1] + enu[2] * moon[2];
        const double at_lamp = enu[0] * lamp[0] + enu[1] * lamp[1] + enu[2] * lamp[2];
        for (int c = 0; c < 3; ++c) {
          constexpr double kTown[3] = {0.038, 0.027, 0.016};
          const double moonlit = 0.045 * exposure * lit * std::max(0.0, moon[2]) *
                                 (c == 2   ? 1.4
                                  : c == 0 ? 0.85
                                           : 1.0);
          const double cloud_light = exposure * town * kTown[c] + 3.0 * moonlit + 0.6 * twilight_level;
          double value = (shown.at(x, y, c) + moonlit) * (1.0 - cloud) + cloud_light * cloud;
          if (lit > 0.0)
            value += exposure * lit * (1.0 - cloud_at_moon) * moon_strength * glare(at_moon, moon_core_deg);
          if (has_lamp) value += exposure * glare(at_lamp, 0.6) * (c == 0 ? 1.0 : c == 1 ? 0.8 : 0.5);
          light[static_cast<std::size_t>(c)] = shutter * value;
        }
        const double green = rendering.aurora.empty() ? 0.0 : std::max(0.0f, rendering.aurora.at(x, y, 1));
        if (enu[2] > 0.0) {
          result.light.at(x, y, 0) = static_cast<float>(green);
          result.light.at(x, y, 1) = static_cast<float>(1.0 - cloud);
          result.light.at(x, y, 2) = static_cast<float>(light[1] / shutter - green * (1.0 - cloud));
        }
        if (enu[2] > 0.1) {
          hidden += cloud;
          aurora.push_back(green * (1.0 - cloud));
          all_aurora += green;
          seen_aurora += green * (1.0 - cloud);
          background.push_back(light[1] / shutter - green * (1.0 - cloud));
        }
      }
      if (has_ground && enu[2] < std::sin(sim::kRadiansPerDegree * (ground_deg + 1.5 * std::sin(0.11 * x) +
                                                                    0.7 * std::sin(0.9 * x)))) {
        for (double& value : light) value *= 0.06;
        result.light.at(x, y, 1) = 0.0f;
      }
      // Trees about a camera that looks up, here and there higher than a lamp.
      const double bearing = std::atan2(enu[0], enu[1]);
      if (trees_deg > 0.0 &&
          enu[2] < std::sin(sim::kRadiansPerDegree * trees_deg *
                            std::max(0.0, 0.4 + 0.5 * std::sin(2.0 * bearing + trees_phase) +
                                              0.1 * std::sin(37.0 * bearing)))) {
        for (double& value : light) value *= 0.08;
        result.light.at(x, y, 1) = 0.0f;
      }
      for (double& value : light) {
        const double away = (x - 0.5 * width) * (x - 0.5 * width) + (y - 0.5 * height) * (y - 0.5 * height);
        value *= 1.0 - vignetting * std::min(1.0, 4.0 * away / (1.0 * width * width));
        value = std::pow(std::max(value, 0.0), gamma) + offset;
      }
      // The straight trail of a satellite, a meteor or an aeroplane.
      if (has_trail) {
        const double t = trail[2] * sim::kRadiansPerDegree, dx = x - trail[0] * width,
                     dy = y - trail[1] * height;
        const double along = dx * std::cos(t) + dy * std::sin(t), off = dy * std::cos(t) - dx * std::sin(t);
        if (std::abs(along) < 0.5 * trail[3] * width)
          for (double& value : light) value += trail_light * std::exp(-0.7 * off * off);
      }
      if (truth.black) light = {0.002, 0.0015, 0.002};
      if (truth.mono) {
        const double grey = (light[0] + light[1] + light[2]) / 3.0;
        light = {grey, grey, grey};
      }
      for (int c = 0; c < 3; ++c) {
        const double value =
            truth.mono ? light[0] : light[static_cast<std::size_t>(c)] * balance[static_cast<std::size_t>(c)];
        const double code =
            255.0 * sim::srgb_encode(noisy(value, noise, scene.seed, x, y, truth.mono ? 0 : c));
        picture.at<cv::Vec3b>(y, x)[2 - c] =
            static_cast<unsigned char>(std::lround(std::clamp(code, 0.0, 255.0)));
      }
    }
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  result.jpeg.assign(bytes.begin(), bytes.end());
  if (truth.black) return result;

  // What can be seen, as in a made night.
  constexpr double kArc = 0.25, kAurora = 0.15, kSeen = 0.6, kCloud = 0.3, kMoon = 0.05;
  std::vector<double> sorted = aurora;
  const auto brightest =
      sorted.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), brightest, sorted.end());
  const double contrast = *brightest / middle(background);
  truth.aurora = form != Form::none && contrast > kAurora;
  truth.arc = truth.aurora && form != Form::diffuse && contrast > kArc && seen_aurora > kSeen * all_aurora;
  truth.several = truth.arc && form == Form::several;
  truth.rayed = truth.arc && form == Form::rayed;
  truth.overhead = truth.arc && form == Form::overhead;
  truth.cloud = hidden / static_cast<double>(background.size()) >= kCloud;
  truth.moon = lit * (1.0 - cloud_at_moon) >= kMoon;
  truth.twilight = twilight_level > 0.5 * middle(background);
  truth.lamp = has_lamp;
  return result;
}

}  // namespace vegard::made_night
