// The brightness of a sheet, in rayleighs and as International Brightness Coefficient, and the electrons and
// power behind it.
//
// Sources: Baranoski et al. 2000, table 1, for the coefficient's classes 1 to 4 (1, 10, 100 and 1000 kR of
// 557.7 nm; docs/physics.md, row B21); "Photometry"; docs/optics.md, "Brightness for people".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the coefficient, 1 + log10 of kilorayleighs of 557.7 nm; minus infinity for 0.
double brightness_coefficient(double kilorayleigh);

/// Returns "IBC 2" within 0.05 of a class (12 % of brightness), "IBC 2-3" (with an en dash) between two,
/// "below IBC 1", "above IBC 4".
std::string brightness_class(double kilorayleigh);

/// The electrons behind a sheet's light, and their power.
struct SheetPower {
  double energy_flux_mw_m2 = 0.0;  ///< at the peak across a layer
  double mean_energy_kev = 0.0;    ///< of the electrons
  double electrons_cm2_s = 0.0;    ///< energy flux over mean energy
  double watts_per_km = 0.0;       ///< of one arc, along it, all its layers
  double watts = 0.0;              ///< of all arcs from end to end
  double joules = 0.0;             ///< over the exposure; 0 for an instant
};

/// Brightness of a sheet at the scene's time: the mean over the instants of the exposure (a substorm changes
/// the brightness). For a curve it is that of evened_sheet() (sheet_curve.h).
struct SheetBrightness {
  std::string name;
  double level = 1.0;  ///< factor of the substorm on the sheet's brightness
  /// Rayleighs per line of the scene seen along the field, at the peak across one layer: the column from the
  /// profile's bottom to top_km over the cosine between field and vertical at the sheet's centre. Rays and
  /// patches do not change it: they only redistribute light. Layers along the same line of sight add up.
  std::vector<double> layer_rayleigh;
  double layer_green_kilorayleigh = 0.0;  ///< of 557.7 nm, whether the scene has that line or not
  std::optional<SheetPower> power;        ///< none if the light is not that of known electrons
};

/// Computes the brightness of scene.sheets[sheet]. If a sheet's brightness is given, the energy flux is that
/// of the Maxwellian electrons of its energy that produce it. If no field line comes down at the centre, all
/// numbers are 0.
SheetBrightness sheet_brightness(const Scene& scene, int sheet);

}  // namespace vegard::sim
