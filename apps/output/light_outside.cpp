#include "apps/output/light_outside.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/earth.h"
#include "sim/light/sheet_profile.h"

namespace vegard::apps {
namespace {

std::string direction_words(const std::string& what, double azimuth_deg, double elevation_deg) {
  return fmt::format("the middle of {} stands at azimuth {:.0f}\u00b0, elevation {:.0f}\u00b0", what,
                     azimuth_deg, elevation_deg);
}

/// Of a point of the tangent plane, at the foot's altitude, as the observer sees it.
std::string place_of(const std::string& what, const sim::EastNorth& center_km, double observer_altitude_km) {
  const double east = center_km.east, north = center_km.north;
  const double across = std::hypot(east, north);
  const double from_centre = sim::kEarthRadiusKm + sim::kFootAltitudeKm;
  const double up = std::sqrt(std::max(0.0, from_centre * from_centre - across * across)) -
                    sim::kEarthRadiusKm - observer_altitude_km;
  double azimuth_deg = std::atan2(east, north) / sim::kRadiansPerDegree;
  if (azimuth_deg < 0.0) azimuth_deg += 360.0;
  return direction_words(what, azimuth_deg, std::atan2(up, across) / sim::kRadiansPerDegree);
}

bool could_shine(const sim::Scene& scene) {
  const bool sheets = std::any_of(scene.sheets.begin(), scene.sheets.end(), [](const sim::Sheet& sheet) {
    return sim::has_given_brightness(sheet) || sheet.energy_flux_mw_m2 > 0.0;
  });
  const bool footprints =
      std::any_of(scene.footprints.begin(), scene.footprints.end(),
                  [](const sim::Footprint& footprint) { return footprint.energy_flux_mw_m2 > 0.0; });
  return sheets || footprints || !scene.volumes.empty() || scene.sun.shown ||
         std::any_of(scene.nebulae.begin(), scene.nebulae.end(), [](const sim::Nebula& nebula) {
           return nebula.method != "literal" && nebula.brightness > 0.0;
         });
}

}  // namespace

std::string warning_if_out_of_view(const sim::Scene& scene, const sim::Image& rayleigh) {
  const bool shines =
      std::any_of(rayleigh.data.begin(), rayleigh.data.end(), [](float value) { return value > 0.0f; });
  if (!could_shine(scene) || shines) return {};
  std::string text = fmt::format(
      "warning: no light reaches the picture, it holds the sky alone: the camera looks to azimuth "
      "{:g}\u00b0, "
      "elevation {:g}\u00b0, ",
      scene.camera.azimuth_deg, scene.camera.elevation_deg);
  text += scene.camera.model == "pinhole"
              ? fmt::format("with {:g}\u00b0 across", scene.camera.hfov_deg)
              : fmt::format("its lens {}, {:g} px to a radian", scene.camera.model, scene.camera.focal_px);
  const double observer_km = scene.site.altitude_m * 1e-3;
  for (const sim::Sheet& sheet : scene.sheets)
    text += "; " + place_of("sheet '" + sheet.name + "'", sheet.center_km, observer_km);
  for (const sim::Footprint& footprint : scene.footprints)
    text += "; " + (footprint.shape == "box"
                        ? place_of("footprint '" + footprint.name + "'", footprint.center_km, observer_km)
                        : "footprint '" + footprint.name + "' stands around the Earth");
  for (const sim::Nebula& nebula : scene.nebulae)
    text += "; " + direction_words("nebula '" + nebula.name + "'", nebula.azimuth_deg, nebula.elevation_deg);
  if (scene.sun.shown)
    text += "; " + direction_words("the Sun", scene.sun.azimuth_deg, scene.sun.elevation_deg);
  for (const sim::Volume& volume : scene.volumes)
    text += "; volume '" + volume.name + "' stands where " + volume.file + " has it";
  return text;
}

}  // namespace vegard::apps
