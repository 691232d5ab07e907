// Maps of precipitation as FITS cubes: what falls down at the foot of each field line.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Cells over the tangent plane of a site, as the feet of beams are given: east and north of the point of the
/// field line at 110 km altitude. Columns run to the east, rows to the north.
struct PrecipitationMap {
  int columns = 0, rows = 0;
  double west_km = 0.0, south_km = 0.0;  ///< of the outer corner of the cell in the south-west
  double cell_km = 1.0;
  std::vector<float> energy_flux_mw_m2;  ///< [row][column]; 0 where nothing falls
  std::vector<float> energy_kev;         ///< likewise; 0 where it is not known
  std::optional<Site> site;              ///< whose tangent plane it is; none: the file does not say
};

/// Reads the first image of a FITS file: the planes energy flux in mW m^-2 and energy in keV, and others that
/// are not looked at; axes CTYPE1 EAST and CTYPE2 NORTH in km, of equal steps. NaN is no light, nor is less
/// than a millionth of the largest energy flux. SITELAT and
/// SITELONG, in degrees, say whose plane it is. Throws Error(unreadable_input) that names `place` for what is
/// no such file, for an energy flux below 0, and for energies beyond those of the emission tables.
PrecipitationMap read_precipitation_map(const std::string& place);

/// Those of a scene's footprints, by the names that the scene has; names are relative to the scene's file.
/// The errors also name the key `footprint.NAME.file`.
std::map<std::string, PrecipitationMap> read_precipitation_maps(const Scene& scene);

}  // namespace vegard::sim
