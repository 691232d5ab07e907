// Reads skymaps: files with the azimuth and the elevation of every pixel, which imager teams publish with
// their pictures. THEMIS, REGO and TREx use IDL save files (skymap.full_azimuth, skymap.full_elevation) and
// CDF (thg_asf_gill_azim, thg_asf_gill_elev), others use HDF5, MATLAB files, FITS and EXR.
#pragma once

#include <optional>
#include <string>

#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

struct SkyMapPlace {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;
};

struct SkyMapFile {
  /// The first stored row is at the top (also for FITS), unless the caller asked to flip the rows.
  sim::DirectionMap map;
  /// Names of the arrays that were read: "skymap/full_azimuth, skymap/full_elevation"; empty for FITS and
  /// EXR.
  std::string arrays;
  std::optional<SkyMapPlace> place;  ///< the site, if the file gives it
};

/// Which axes of the stored map to reverse so that it matches the pictures.
struct SkyMapFlip {
  bool rows = false, columns = false;
};

/// Reverses the order of a map's rows, of its columns, or of both.
void flip_map(const SkyMapFlip& flip, sim::DirectionMap& map);

/// Reads a skymap. In a file of arrays (sim/base/array) the azimuths are the largest array of two dimensions
/// (not counting those of length 1) with the name azimuth, azim or az, alone or after an underscore
/// (azimuth_deg as well); the elevations likewise: elevation, elev or el. A FITS file has the azimuths in its
/// first plane and the elevations in the second, an EXR has them in the channels azimuth_deg and
/// elevation_deg. Throws sim::Error(unreadable_input) if the file has no such map, or several of the same
/// size.
SkyMapFile read_sky_map(const std::string& file, const SkyMapFlip& flip = {});

/// True if a file of arrays has such maps; their contents are not read. False for a damaged file.
bool has_sky_map(const std::string& file);

}  // namespace vegard::fit
