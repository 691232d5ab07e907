#include "apps/light_outside.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/earth.h"
#include "sim/light/sheet_profile.h"

namespace vegard::apps {
namespace {

/// Of the sheet's middle, at the foot's altitude, as the observer sees it.
std::string place_of(const sim::Sheet& sheet, double observer_altitude_km) {
  const double east = sheet.center_km.east, north = sheet.center_km.north;
  const double across = std::hypot(east, north);
  const double from_centre = sim::kEarthRadiusKm + sim::kFootAltitudeKm;
  const double up = std::sqrt(std::max(0.0, from_centre * from_centre - across * across)) -
                    sim::kEarthRadiusKm - observer_altitude_km;
  double azimuth_deg = std::atan2(east, north) / sim::kRadiansPerDegree;
  if (azimuth_deg < 0.0) azimuth_deg += 360.0;
  return fmt::format("the middle of sheet '{}' stands at azimuth {:.0f}\u00b0, elevation {:.0f}\u00b0",
                     sheet.name, azimuth_deg, std::atan2(up, across) / sim::kRadiansPerDegree);
}

}  // namespace

std::string warning_if_out_of_view(const sim::Scene& scene, const sim::Image& rayleigh) {
  const bool could_shine = std::any_of(scene.sheets.begin(), scene.sheets.end(), [](const sim::Sheet& sheet) {
    return sim::has_given_brightness(sheet) || sheet.energy_flux_mw_m2 > 0.0;
  });
  const bool shines =
      std::any_of(rayleigh.data.begin(), rayleigh.data.end(), [](float value) { return value > 0.0f; });
  if (!could_shine || shines) return {};
  std::string text = fmt::format(
      "warning: no sheet is in view, the picture holds the sky alone: the camera looks to azimuth "
      "{:g}\u00b0, "
      "elevation {:g}\u00b0, ",
      scene.camera.azimuth_deg, scene.camera.elevation_deg);
  text += scene.camera.model == "pinhole"
              ? fmt::format("with {:g}\u00b0 across", scene.camera.hfov_deg)
              : fmt::format("its lens {}, {:g} px to a radian", scene.camera.model, scene.camera.focal_px);
  for (const sim::Sheet& sheet : scene.sheets) text += "; " + place_of(sheet, scene.site.altitude_m * 1e-3);
  return text;
}

}  // namespace vegard::apps
