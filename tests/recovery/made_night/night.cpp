#include "tests/recovery/made_night/night.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/number/constants.h"
#include "sim/base/number/noise.h"
#include "sim/base/number/random.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/star_place.h"

namespace vegard::made_night {
namespace {

constexpr double kSecondsPerDay = 86400.0, kUnixEpoch = 2440587.5;
/// From -8 to -8 degrees of the Sun in the middle of October at 65 degrees north; the Moon rises in between.
constexpr double kDuration_s = 42000.0;
constexpr double kKmPerDegree = 111.19;
constexpr double kLatitude_deg[2] = {65.0, 65.2}, kLongitude_deg[2] = {20.0, 22.0};
constexpr double kAzimuth_deg[2] = {0.0, 25.0}, kHfov_deg[2] = {70.0, 80.0};

/// What a random number is of.
enum Draw : std::uint32_t { aurora_spell = 1, cloud_spell, lamp_spell, damage_of_frame, gap_of_camera };

double uniform(std::uint64_t seed, Draw what, std::uint32_t number, int word = 0) {
  const sim::Words words = sim::random_words(seed, sim::Stream::bootstrap, what, number, 20141013u);
  return sim::fine_uniform(words[2 * static_cast<std::size_t>(word)],
                           words[2 * static_cast<std::size_t>(word) + 1]);
}

/// Slow and smooth in time, -1 to 1 or so.
double slow(std::uint64_t seed, std::uint32_t which, double seconds, double scale_s) {
  return 1.6 * sim::octave_noise(seed, sim::Stream::patch, which, 2, seconds / scale_s, 0.37, 0.61);
}

}  // namespace

Night::Night(std::uint64_t seed, int frames) : seed_(seed) {
  // The evening of 12, 13 or 14 October 2014.
  begin_s_ = *sim::utc_seconds("2014-10-12T16:36:00Z") + kSecondsPerDay * static_cast<double>(seed % 3);
  const auto spells = [&](Draw what, double shortest_s, double longest_s) {
    std::vector<Spell> made;
    double until_s = 0.0;
    for (std::uint32_t i = 0; until_s < kDuration_s; ++i) {
      until_s += shortest_s + (longest_s - shortest_s) * uniform(seed, what, i, 0);
      made.push_back({until_s, uniform(seed, what, i, 1)});
    }
    return made;
  };
  aurora_ = spells(aurora_spell, 900.0, 2700.0);
  clouds_ = spells(cloud_spell, 1200.0, 4800.0);
  lamps_ = spells(lamp_spell, 600.0, 2400.0);
  const int each = std::max(1, frames / 2);
  for (int camera = 0; camera < 2; ++camera) {
    // Each camera is off for a quarter of an hour, so that there are fewer, and closer, frames.
    const double gap_at_s = kDuration_s * (0.15 + 0.7 * uniform(seed, gap_of_camera, camera));
    constexpr double kGap_s = 900.0;
    const double step_s = (kDuration_s - kGap_s) / each;
    for (int i = 0; i < each; ++i) {
      NightFrame frame;
      frame.camera = camera;
      frame.number = i;
      const double after_s = std::floor(i * step_s);
      frame.utc_s = begin_s_ + after_s + (after_s > gap_at_s ? kGap_s : 0.0) + camera;
      std::string digits;
      for (const char c : sim::utc_text(frame.utc_s))
        if (c >= '0' && c <= '9') digits += c;
      frame.name =
          fmt::format("{}/{}_{}.jpg", camera == 0 ? "a" : "b", digits.substr(0, 8), digits.substr(8, 6));
      // One in fifty is broken, in one of four ways.
      const double drawn = uniform(seed, damage_of_frame, static_cast<std::uint32_t>(2 * i + camera));
      constexpr double kBroken = 0.02;
      if (drawn < kBroken)
        frame.damage = static_cast<Damage>(1 + std::min(3, static_cast<int>(drawn / kBroken * 4.0)));
      frames_.push_back(frame);
    }
  }
}

SkyState Night::sky(double utc_s) const {
  const double t = utc_s - begin_s_;
  const auto spell = [&](const std::vector<Spell>& of, double& into_s, double& left_s) {
    double from_s = 0.0;
    for (const Spell& one : of) {
      if (t < one.until_s) {
        into_s = t - from_s;
        left_s = one.until_s - t;
        return one.value;
      }
      from_s = one.until_s;
    }
    into_s = left_s = 1e9;
    return 0.0;
  };
  SkyState sky;
  double into_s = 0.0, left_s = 0.0;
  const double which = spell(aurora_, into_s, left_s);
  sky.aurora = which < 0.25 ? Aurora::none : which < 0.4 ? Aurora::diffuse : Aurora::arc;
  // Aurora comes and goes within two minutes.
  constexpr double kRise_s = 120.0;
  const double shown = std::clamp(std::min(into_s, left_s) / kRise_s, 0.0, 1.0);
  sky.flux_mw_m2 = shown * 4.0 * std::exp(0.7 * slow(seed_, 1, t, 500.0));
  sky.energy_kev = 3.2 * std::exp(0.5 * slow(seed_, 2, t, 3000.0));
  sky.north_km = 215.0 + 65.0 * slow(seed_, 3, t, 4000.0);
  sky.east_km = 20.0;
  sky.bearing_deg = 92.0 + 9.0 * slow(seed_, 4, t, 5000.0);
  sky.thickness_km = 4.5 + 2.0 * slow(seed_, 5, t, 4000.0);
  sky.wavelength_km = 85.0 + 20.0 * slow(seed_, 6, t, 8000.0);
  sky.phase_rad = 2.5 * slow(seed_, 7, t, 1500.0) + 2.0;
  const double weather = spell(clouds_, into_s, left_s);
  constexpr double kDrift_s = 300.0;
  sky.cloud_cover = (weather < 0.6    ? 0.0
                     : weather < 0.85 ? 0.55
                                      : 1.0) *
                    std::clamp(std::min(into_s, left_s) / kDrift_s, 0.0, 1.0);
  sky.lamp = spell(lamps_, into_s, left_s) > 0.85;
  return sky;
}

std::string Night::scene_text(int camera) {
  return fmt::format(
      "# Camera {0} of a made night: it knows where it is, and nothing of the aurora but that it is one "
      "sheet.\n"
      "seed = 1\n[site]\nlatitude_deg = {1}\nlongitude_deg = {2}\n[field]\ninclination_deg = "
      "77.5\ndeclination_deg = 8.0\n[camera]\nwidth = 240\nheight = 160\nhfov_deg = {3}\nazimuth_deg = "
      "{4}\nelevation_deg = 29.0\n[emission]\ntables = \"glow\"\n[[sheet]]\nname = \"main\"\nlength_km = "
      "1600.0\nbearing_deg = "
      "92.0\nthickness_km = 4.5\nwavelength_km = 85.0\nphase_rad = 2.0\nphase_shift_rad = 0.5\nlayers = "
      "3\nwidth_km = 1.5\nbeams = 2500\nenergy_kev = 3.0\nenergy_flux_mw_m2 = 4.0\n[sensor]\n"
      "gain_per_kilorayleigh = 0.045\n[fit]\nbands = 16\nband_sky = true\nfree = [\n"
      "  {{ name = \"distance\", start = 215.0, min = 100.0, max = 450.0, scale = \"logarithmic\" }},\n"
      "  {{ path = \"sheet.main.bearing_deg\", min = 62.0, max = 122.0 }},\n"
      "  {{ path = \"sheet.main.energy_kev\", min = 0.5, max = 15.0 }},\n"
      "  {{ path = \"sheet.main.thickness_km\", min = 0.5, max = 12.0 }},\n"
      "  {{ path = \"sheet.main.wavelength_km\", min = 40.0, max = 200.0 }},\n"
      "  \"sheet.main.phase_rad\",\n]\ntied = [\n"
      "  {{ path = \"sheet.main.center_km.east\", equals = \"distance * sin_deg({4})\" }},\n"
      "  {{ path = \"sheet.main.center_km.north\", equals = \"distance * cos_deg({4})\" }},\n]\n",
      camera == 0 ? "a" : "b", kLatitude_deg[camera], kLongitude_deg[camera], kHfov_deg[camera],
      kAzimuth_deg[camera]);
}

sim::Scene Night::truth(const NightFrame& frame) const {
  const int camera = frame.camera;
  sim::Scene scene = sim::parse_scene(scene_text(camera), "night.toml");
  const SkyState now = sky(frame.utc_s);
  scene.seed = seed_ * 100003 + static_cast<std::uint64_t>(frame.number) * 2 + static_cast<unsigned>(camera);
  sim::Sheet& sheet = scene.sheets[0];
  // From camera a's level to this one's: along the ground, and turned by the meridians' convergence.
  const double east_km = (kLongitude_deg[camera] - kLongitude_deg[0]) * kKmPerDegree *
                         std::cos(kLatitude_deg[0] * sim::kRadiansPerDegree),
               north_km = (kLatitude_deg[camera] - kLatitude_deg[0]) * kKmPerDegree;
  const double turned_deg =
      (kLongitude_deg[camera] - kLongitude_deg[0]) * std::sin(kLatitude_deg[0] * sim::kRadiansPerDegree);
  sheet.center_km = {now.east_km - east_km, now.north_km - north_km};
  sheet.bearing_deg = now.bearing_deg + turned_deg;
  sheet.thickness_km = now.thickness_km;
  sheet.wavelength_km = now.wavelength_km;
  sheet.phase_rad = now.phase_rad;
  sheet.energy_kev = now.energy_kev;
  sheet.energy_flux_mw_m2 = std::max(now.flux_mw_m2, 1e-3);
  // Uneven along its length, as all arcs are.
  sheet.ray_contrast = 0.08;
  sheet.ray_width_km = 7.0;
  if (now.aurora == Aurora::diffuse) {
    sheet.width_km = 60.0;
    sheet.energy_flux_mw_m2 *= 0.02;
    sheet.ray_contrast = 0.0;
    sheet.beams = 12000;
  } else if (now.aurora == Aurora::none) {
    scene.sheets.clear();
  }
  scene.fit = {};
  scene.airglow.green_rayleigh = 180.0;
  scene.airglow.red_rayleigh = 90.0;
  scene.airglow.sodium_rayleigh = 40.0;
  scene.light_pollution.luminance_mcd_m2 = 0.4;
  scene.light_pollution.azimuth_deg = 160.0;
  scene.stars.shown = true;
  scene.stars.faintest_magnitude = 5.5;
  scene.stars.width_deg = 0.15;
  scene.time.start_s = frame.utc_s - begin_s_;
  const double date = kUnixEpoch + frame.utc_s / kSecondsPerDay;
  sim::Observer observer;
  observer.latitude_deg = scene.site.latitude_deg;
  observer.longitude_deg = scene.site.longitude_deg;
  observer.refracting_air = false;
  const auto sun = sim::direction_of_star({sim::place_of_sun(date), 0.0, 0.0}, observer, date);
  const double elevation_deg = std::asin(sun[2]) / sim::kRadiansPerDegree;
  constexpr double kDarkest_deg = -15.0, kBrightest_deg = -5.0;
  if (elevation_deg > kDarkest_deg) {
    scene.twilight.shown = true;
    scene.twilight.sun_elevation_deg = std::min(elevation_deg, kBrightest_deg);
    scene.twilight.sun_azimuth_deg = std::atan2(sun[0], sun[1]) / sim::kRadiansPerDegree;
  }
  return scene;
}

double Night::distance_km(const sim::Scene& truth) {
  const sim::Sheet& sheet = truth.sheets.at(0);
  const double b = sheet.bearing_deg * sim::kRadiansPerDegree,
               a = truth.camera.azimuth_deg * sim::kRadiansPerDegree;
  // centre + s (sin b, cos b) = d (sin a, cos a)
  const double determinant = std::sin(a) * std::cos(b) - std::cos(a) * std::sin(b);
  return (sheet.center_km.east * std::cos(b) - sheet.center_km.north * std::sin(b)) / determinant;
}

}  // namespace vegard::made_night
