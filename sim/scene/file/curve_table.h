// Reads the curve of a sheet from a table of curtains.
#pragma once

#include <string>
#include <string_view>

#include "sim/scene/structs/sheet.h"

namespace vegard::sim {

/// Sets the course, points, brightness, energies and widths of a sheet from one curtain of a CSV table. The
/// rows of the table are points, in order along their curtain, with the columns curtain (a number from 1),
/// east_km, north_km (of the feet at 110 km altitude), energy_flux_mw_m2, energy_kev and width_km; other
/// columns are ignored. point_brightness is the energy flux over the curtain's largest, which becomes the
/// sheet's energy_flux_mw_m2 unless `keeps_flux`. Throws Error(unreadable_input) that names `file` if a
/// column or the curtain is missing, if an energy flux is below 0, or if none is above 0.
void take_curtain(std::string_view text, const std::string& file, int curtain, bool keeps_flux, Sheet& sheet);

}  // namespace vegard::sim
