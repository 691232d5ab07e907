#include "sim/emit/aurora/sheet_brightness.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/foot_field.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet_curve.h"
#include "sim/light/electron.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

constexpr double kJoulesPerKev = 1.602176634e-16;

/// The cosine between field and vertical at the foot of the sheet's centre; 0 where no beam falls.
double vertical_at_centre(const Scene& scene, const Sheet& sheet) {
  constexpr double kFarthestKm = 4000.0;  // as in sim/render/beams/beams.cpp
  const double east = sheet.center_km.east, north = sheet.center_km.north;
  if (!(std::hypot(east, north) < kFarthestKm)) return 0.0;
  const Field& field = scene.field;
  const FootField own(scene);
  const FallFrame<double> fall = own.varies() ? own.at(east, north)
                                              : fall_frame(field.inclination_deg * kRadiansPerDegree,
                                                           field.declination_deg * kRadiansPerDegree);
  const Beam<double> beam = start_beam(east, north, fall, 1e-3 * scene.site.altitude_m, sheet.top_km,
                                       HeightProfile::kBottomKm, scene.body.radius_km);
  return beam.vertical > 0.0 && beam.length_km > 0.0 ? beam.vertical : 0.0;
}

double mean_level(const Scene& scene) {
  const std::vector<double> instants = instants_s(scene.time);
  double sum = 0.0;
  for (double instant : instants) sum += substorm_level(scene.substorm, instant);
  return sum / static_cast<double>(instants.size());
}

/// Vertical column of 557.7 nm of the sheet's profile.
double green_column(const Scene& scene, int sheet) {
  return column_below(sheet_profile({kGreenNm}, scene, sheet), 0, scene.sheets[sheet].top_km).rayleigh;
}

/// What the sheet's light needs, before the substorm. Where the brightness is given, its profile is that of a
/// flux of 1 (sim/light/sheet_profile.h), and so is the light per flux here.
double energy_flux_of(const Scene& scene, int index, double vertical) {
  const Sheet& sheet = scene.sheets[index];
  if (!has_given_brightness(sheet)) return sheet.energy_flux_mw_m2;
  Scene by_flux = scene;
  by_flux.sheets[index].brightness_kilorayleigh = 0.0;
  by_flux.sheets[index].energy_flux_mw_m2 = 1.0;
  return vertical * 1000.0 * sheet.brightness_kilorayleigh / green_column(by_flux, index);
}

SheetPower power_of(const Scene& scene, const Sheet& sheet, double flux_mw_m2, double mean_energy_kev) {
  constexpr double kWattsPerMw = 1e-3, kSquareMetresPerKm2 = 1e6, kSquareCentimetresPerM2 = 1e4;
  SheetPower power;
  power.energy_flux_mw_m2 = flux_mw_m2;
  power.mean_energy_kev = mean_energy_kev;
  power.electrons_cm2_s =
      flux_mw_m2 * kWattsPerMw / (mean_energy_kev * kJoulesPerKev) / kSquareCentimetresPerM2;
  power.watts_per_km =
      flux_mw_m2 * kWattsPerMw * sheet.width_km * kSqrtTwoPi * kSquareMetresPerKm2 * sheet.layers;
  power.watts = power.watts_per_km * sheet.length_km * sheet.arcs;
  power.joules = power.watts * scene.time.exposure_s;
  return power;
}

}  // namespace

double brightness_coefficient(double kilorayleigh) { return 1.0 + std::log10(kilorayleigh); }

std::string brightness_class(double kilorayleigh) {
  constexpr double kNear = 0.05;
  const double coefficient = brightness_coefficient(kilorayleigh);
  if (coefficient < 1.0 - kNear) return "below IBC 1";
  if (coefficient > 4.0 + kNear) return "above IBC 4";
  const double nearest = std::round(coefficient);
  if (std::abs(coefficient - nearest) <= kNear) return "IBC " + std::to_string(static_cast<int>(nearest));
  const int below = static_cast<int>(std::floor(coefficient));
  return "IBC " + std::to_string(below) + "\u2013" + std::to_string(below + 1);
}

SheetBrightness sheet_brightness(const Scene& scene, int index) {
  if (is_curve(scene.sheets[index])) {
    Scene even = scene;
    even.sheets[index] = evened_sheet(scene.sheets[index]);
    return sheet_brightness(even, index);
  }
  const Sheet& sheet = scene.sheets[index];
  SheetBrightness result;
  result.name = sheet.name;
  result.level = mean_level(scene);
  result.layer_rayleigh.assign(scene.emission.lines.size(), 0.0);
  const double vertical = vertical_at_centre(scene, sheet);
  if (vertical == 0.0) return result;

  // A sheet of given brightness has a profile that is that bright along the field
  // (sim/light/sheet_profile.h).
  const double per_column =
      result.level * (has_given_brightness(sheet) ? 1.0 : sheet.energy_flux_mw_m2 / vertical);
  const HeightProfile profile = sheet_profile(scene.emission.lines, scene, index);
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    result.layer_rayleigh[l] = per_column * column_below(profile, static_cast<int>(l), sheet.top_km).rayleigh;
  result.layer_green_kilorayleigh = 1e-3 * per_column * green_column(scene, index);
  if (const std::optional<double> mean_energy = mean_energy_kev(sheet))
    result.power =
        power_of(scene, sheet, result.level * energy_flux_of(scene, index, vertical), *mean_energy);
  return result;
}

}  // namespace vegard::sim
