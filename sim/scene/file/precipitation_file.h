// Maps of precipitation as FITS cubes: energy flux and energy of electrons at the feet of field lines.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/site.h"

namespace vegard::sim {

struct Scene;

/// A grid of cells in the tangent plane of a site. A cell has the east and north of feet of field lines, at
/// 110 km altitude. Columns run to the east, rows to the north.
struct PrecipitationMap {
  int columns = 0, rows = 0;
  double west_km = 0.0, south_km = 0.0;  ///< of the outer corner of the cell in the south-west
  double cell_km = 1.0;
  std::vector<float> energy_flux_mw_m2;  ///< [row][column]; 0: no precipitation
  std::vector<float> energy_kev;         ///< [row][column]; 0: unknown
  std::optional<Site> site;              ///< site of the tangent plane, if the file has it
};

/// Reads the first image of a FITS file: its first planes are the energy flux in mW m^-2 and the energy in
/// keV, further planes are ignored; the axes are CTYPE1 EAST and CTYPE2 NORTH in km, with equal steps. NaN,
/// and less than a millionth of the largest energy flux, become 0. SITELAT and SITELONG, in degrees, are the
/// site. Throws Error(unreadable_input) that names `place` for any other file, for an energy flux below 0,
/// and for energies outside of the emission tables.
PrecipitationMap read_precipitation_map(const std::string& place);

/// Reads the maps of a scene's footprints and returns them by their names in the scene, which are relative to
/// the scene's file. The errors also name the key `footprint.NAME.file`.
std::map<std::string, PrecipitationMap> read_precipitation_maps(const Scene& scene);

}  // namespace vegard::sim
