#include "apps/output/light_outside.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/lens.h"

namespace vegard::apps {
namespace {

std::string direction_words(const std::string& what, double azimuth_deg, double elevation_deg) {
  return fmt::format("the middle of {} is at azimuth {:.0f}\u00b0, elevation {:.0f}\u00b0", what, azimuth_deg,
                     elevation_deg);
}

/// Of a point of the tangent plane, at the foot's altitude, as the observer sees it.
std::string place_of(const std::string& what, const sim::EastNorth& center_km, const sim::Scene& scene) {
  const double east = center_km.east, north = center_km.north;
  const double across = std::hypot(east, north);
  const double from_centre = scene.body.radius_km + sim::kFootAltitudeKm;
  const double up = std::sqrt(std::max(0.0, from_centre * from_centre - across * across)) -
                    scene.body.radius_km - scene.site.altitude_m * 1e-3;
  double azimuth_deg = std::atan2(east, north) / sim::kRadiansPerDegree;
  if (azimuth_deg < 0.0) azimuth_deg += 360.0;
  return direction_words(what, azimuth_deg, std::atan2(up, across) / sim::kRadiansPerDegree);
}

bool may_emit(const sim::Scene& scene) {
  const bool sheets = std::any_of(scene.sheets.begin(), scene.sheets.end(), [](const sim::Sheet& sheet) {
    return sim::has_given_brightness(sheet) || sheet.energy_flux_mw_m2 > 0.0;
  });
  const std::vector<sim::EmitterKind>& kinds = sim::emitter_kinds();
  return sheets || std::any_of(kinds.begin(), kinds.end(),
                               [&](const sim::EmitterKind& kind) { return sim::may_emit(kind, scene); });
}

std::string words_of(const sim::LightLocation& where, const sim::Scene& scene) {
  switch (where.known) {
    case sim::LightLocation::Known::place:
      return place_of(where.what, where.center_km, scene);
    case sim::LightLocation::Known::direction:
      return direction_words(where.what, where.azimuth_deg, where.elevation_deg);
    default:
      return where.what + " " + where.words;
  }
}

}  // namespace

std::string warning_if_out_of_view(const sim::Scene& scene, const sim::Image& rayleigh) {
  const bool shines =
      std::any_of(rayleigh.data.begin(), rayleigh.data.end(), [](float value) { return value > 0.0f; });
  if (!may_emit(scene) || shines) return {};
  std::string text = fmt::format(
      "warning: no light reaches the picture, it holds the sky alone: the camera looks to azimuth "
      "{:g}\u00b0, elevation {:g}\u00b0, ",
      scene.camera.azimuth_deg, scene.camera.elevation_deg);
  text += scene.camera.model == sim::LensModel::pinhole
              ? fmt::format("with {:g}\u00b0 across", scene.camera.hfov_deg)
          : sim::is_panorama(scene.camera.model)
              ? fmt::format("its picture {}, all around", sim::word_of(scene.camera.model))
              : fmt::format("its lens {}, {:g} px to a radian", sim::word_of(scene.camera.model),
                            scene.camera.focal_px);
  for (const sim::Sheet& sheet : scene.sheets)
    text += "; " + place_of("sheet '" + sheet.name + "'", sim::evened_sheet(sheet).center_km, scene);
  std::vector<sim::LightLocation> all;
  for (const sim::EmitterKind& kind : sim::emitter_kinds()) {
    if (kind.light_locations == nullptr) continue;
    for (sim::LightLocation& where : kind.light_locations(scene)) all.push_back(std::move(where));
  }
  // Who has to look into a file for it learns so last.
  std::stable_partition(all.begin(), all.end(), [](const sim::LightLocation& where) {
    return where.known != sim::LightLocation::Known::file;
  });
  for (const sim::LightLocation& where : all) text += "; " + words_of(where, scene);
  return text;
}

}  // namespace vegard::apps
