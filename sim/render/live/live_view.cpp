#include "sim/render/live/live_view.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/motion.h"
#include "sim/light/sample.h"
#include "sim/render/beams/light_ages.h"
#include "sim/render/film.h"
#include "sim/render/live/live_layers.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/structs/line_of.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sensor/tone_curve.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/sky_of_scene.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kMostStars = 6000;
constexpr int kLensAngles = 1024, kToneValues = 1024;
constexpr int kNightColumns = 180, kNightRows = 180;  // the horizon is where it changes most
constexpr double kElevationStep_deg = 0.5;

Error refusal(const Scene& scene, const std::string& what, const std::string& key, const std::string& right,
              const std::string& hint = "vegard render shows it") {
  return with_place(
      Error(ErrorKind::scene, "the live view cannot show " + what).key(key).expected(right).hint(hint),
      scene);
}

void check(const Scene& scene) {
  for (const EmitterKind& kind : emitter_kinds())
    if (kind.table != "footprint" && is_drawn(kind, scene))
      throw refusal(scene, "what [" + kind.table + "] has", kind.table, "sheets and footprints");
  for (const Footprint& f : scene.footprints)
    if (f.model == FootprintModel::curtain)
      throw refusal(scene, "curtains without thickness", "footprint." + f.name + ".model", "\"volume\"");
  if (scene.blur.model == BlurModel::physical)
    throw refusal(scene, "the physical blur", "blur.model", "\"angle\"");
  if (scene.blur.order == BlurOrder::rgb) throw refusal(scene, "blurred colours", "blur.order", "\"lines\"");
  if (scene.film.weight == PointWeight::unit)
    throw refusal(scene, "points of unit weight", "film.weight", "\"rayleigh\"");
  if (scene.sensor.colour_table != "none")
    throw refusal(scene, "false colours", "sensor.colour_table", "\"none\"");
  if (scene.march.ghosts == GhostRule::literal)
    throw refusal(scene, "light from behind the camera", "march.ghosts", "\"span\"");
  if (scene.sheets.empty() && scene.footprints.empty())
    throw refusal(scene, "a scene without light", "sheet", "a sheet or a footprint");
}

std::vector<std::string> left_out(const Scene& scene) {
  std::vector<std::string> out;
  const auto note = [&](bool applies, const char* what) {
    if (applies) out.emplace_back(what);
  };
  for (const Sheet& sheet : scene.sheets)
    if (soonest_change_s(sheet, scene.substorm) < 1e12 && scene.emission.lag == EmissionLag::lifetime) {
      out.emplace_back("the lag of light behind moving sheets");
      break;
    }
  note(scene.time.exposure_s > 0.0 && !scene.sheets.empty(), "the exposure's blur of moving sheets");
  note(!scene.sheets.empty(), "the grain of single beams");
  const Sky& sky = scene.sky;
  const auto any = [](const std::array<double, 3>& rgb) { return rgb != std::array<double, 3>{}; };
  note(any(sky.gradient) || any(sky.curvature), "the gradient of [sky] across the picture");
  note(scene.ground.shown, "the lit ground");
  note(scene.moon.shown, "the Moon's disc");
  note(scene.stars.milky_way, "the Milky Way");
  note(scene.stars.shown && scene.stars.faintest_magnitude > 6.5, "stars beyond the brightest 6000");
  note(!scene.composite.background.empty() || !scene.composite.foreground.empty(), "[composite]'s pictures");
  note(!scene.march.depth.empty(), "objects of march.depth");
  note(scene.march.smooth_px > 0.0 || scene.march.glow > 0.0, "the glow and smoothing of [march]");
  note(scene.sensor.vignetting_cos_power != 0.0 || any(scene.sensor.vignetting), "the lens's vignetting");
  note(scene.sensor.tone == ToneKind::filmic, "the roll-off of sensor.tone = \"filmic\"");
  note(scene.camera.p1 != 0.0 || scene.camera.p2 != 0.0, "the lens's decentring");
  note(is_panorama(scene.camera.model), "the whole panorama: it looks through a lens of 90 degrees");
  note(scene.air.model != AirModel::none, "changes of the air's extinction in flight");
  return out;
}

LiveCamera camera_of(const Scene& scene) {
  Camera camera = scene.camera;
  if (is_panorama(camera.model)) {
    const double azimuth = camera.azimuth_deg, elevation = camera.elevation_deg;
    camera = {};
    camera.hfov_deg = 90.0;
    camera.azimuth_deg = azimuth;
    camera.elevation_deg = std::max(elevation, 20.0);
  }
  const Lens<double> lens = camera_view(camera).lens;
  LiveCamera live;
  live.width = camera.width, live.height = camera.height;
  live.azimuth_deg = camera.azimuth_deg, live.elevation_deg = camera.elevation_deg;
  live.roll_deg = camera.roll_deg;
  live.principal_x_px = lens.principal_x_px, live.principal_y_px = lens.principal_y_px;
  live.aspect = lens.aspect, live.side = lens.side;
  live.altitude_km = scene.site.altitude_m * 1e-3;
  constexpr double kWidestPinhole = 80.0 * kRadiansPerDegree;
  live.last_angle_rad = std::acos(std::clamp(lens.min_cosine, -1.0, 1.0));
  if (lens.model == LensModel::pinhole) live.last_angle_rad = std::min(live.last_angle_rad, kWidestPinhole);
  for (int i = 0; i < kLensAngles; ++i)
    live.radius_px.push_back(static_cast<float>(
        lens.focal_px * radius_of_angle(lens, live.last_angle_rad * i / (kLensAngles - 1))));
  return live;
}

void take_sky(const Scene& scene, LiveView& view) {
  view.sky_rgb = scene.sky.level;
  if (has_night_sky(scene)) {
    const NightSky<double> sky(scene);
    view.night_columns = kNightColumns, view.night_rows = kNightRows;
    for (int row = 0; row < kNightRows; ++row)
      for (int column = 0; column < kNightColumns; ++column) {
        const double elevation = (90.0 - (row + 0.5) * 180.0 / kNightRows) * kRadiansPerDegree,
                     azimuth = (column + 0.5) * 360.0 / kNightColumns * kRadiansPerDegree;
        const std::array<double, 3> rgb =
            sky.light({std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
                       std::sin(elevation)});
        for (const double light : rgb) view.night_rgb.push_back(static_cast<float>(std::max(0.0, light)));
      }
  }
  if (scene.stars.shown || scene.stars.planets)
    for (const PointOfLight& point : star_points(scene, scene.time.start_s, kMostStars)) {
      LiveStar& star = view.stars.emplace_back();
      for (int i = 0; i < 3; ++i) {
        star.enu[i] = static_cast<float>(point.enu[i]);
        star.rgb_steradian[i] = static_cast<float>(point.rgb_steradian[i]);
      }
    }
  view.star_sigma_px = std::max(0.5, scene.stars.width_deg * pixels_per_degree(scene.camera));
  if (scene.air.model == AirModel::none) return;
  for (double elevation = -90.0; elevation <= 90.0; elevation += kElevationStep_deg)
    for (const double line_nm : scene.emission.lines)
      view.transmission.push_back(static_cast<float>(air_transmission(scene, line_nm, elevation)));
}

}  // namespace

LiveView live_view(const Scene& scene, const LiveOptions& options) {
  check(scene);
  LiveView view;
  view.left_out = left_out(scene);
  view.radius_km = scene.body.radius_km, view.foot_altitude_km = kFootAltitudeKm;
  view.lines_nm = scene.emission.lines;
  for (const Vector3& rgb : line_colours(scene))
    view.rgb_per_kilorayleigh.push_back({rgb[0], rgb[1], rgb[2]});
  view.camera = camera_of(scene);
  const double px_share = static_cast<double>(view.camera.width) / scene.camera.width;
  for (int line = 0; line < static_cast<int>(scene.emission.lines.size()); ++line)
    view.blur_px.push_back(blur_sigma_px(scene, line) * px_share);
  view.start_s = scene.time.start_s;
  view.instants = options.seconds > 0.0 ? std::max(2, options.instants) : 1;
  view.step_s = view.instants > 1 ? options.seconds / (view.instants - 1) : 0.0;
  std::vector<double> instants;
  for (int i = 0; i < view.instants; ++i) instants.push_back(view.start_s + i * view.step_s);
  view.layers = live_layers(scene, instants, options.threads);
  take_sky(scene, view);
  // A table by channel is no filmic tone, which keeps the hue: it is left out, and said.
  Scene by_channel = scene;
  if (scene.sensor.tone == ToneKind::filmic) by_channel.sensor.tone = ToneKind::srgb;
  const ToneCurve tone(by_channel);
  for (int i = 0; i < kToneValues; ++i) {
    const double root = static_cast<double>(i) / (kToneValues - 1);
    view.tone.push_back(static_cast<float>(tone.encode(root * root)));
  }
  return view;
}

}  // namespace vegard::sim
