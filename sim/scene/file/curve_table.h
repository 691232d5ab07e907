// Curtains as a table of points, which sheets take their curves from.
#pragma once

#include <string>
#include <string_view>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Gives a sheet the course, points, brightness, energies and widths of one curtain of a CSV table. Its rows
/// are points, in order along their curtain, with the columns curtain (a number from 1), east_km, north_km
/// (of the feet at 110 km altitude), energy_flux_mw_m2, energy_kev and width_km; other columns may stand
/// beside them and are not looked at. The brightness is the energy flux over the curtain's largest, which
/// becomes the sheet's energy_flux_mw_m2 unless `keeps_flux`. Throws Error(unreadable_input) that names the
/// file for a table without one of the columns, without the curtain, or with an energy flux below 0 or
/// nowhere above it.
void take_curtain(std::string_view text, const std::string& file, int curtain, bool keeps_flux, Sheet& sheet);

}  // namespace vegard::sim
