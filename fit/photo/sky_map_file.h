// Skymaps: one file with the azimuth and the elevation of every pixel, as imager teams publish them beside
// their pictures. THEMIS, REGO and TREx have them in IDL's saves (skymap.full_azimuth, skymap.full_elevation)
// and CDF (thg_asf_gill_azim, thg_asf_gill_elev), others in HDF5, MATLAB files, FITS and EXR.
#pragma once

#include <optional>
#include <string>

#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

struct SkyMapPlace {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;
};

struct SkyMapFile {
  /// Rows as stored, the first at the top (of FITS as it has them), unless they were to be flipped.
  sim::DirectionMap map;
  /// Of the arrays that it was read from: "skymap/full_azimuth, skymap/full_elevation"; empty of FITS and
  /// EXR.
  std::string arrays;
  std::optional<SkyMapPlace> place;  ///< if the file gives the site's
};

/// What is to be turned round of what is stored, to be as the pictures.
struct SkyMapFlip {
  bool rows = false, columns = false;
};

/// Turns a map's rows or columns round, or both.
void flip_map(const SkyMapFlip& flip, sim::DirectionMap& map);

/// In a file of arrays (sim/base/array) the azimuths are the largest array of two dimensions (besides those
/// of length 1) that is called azimuth, azim or az, alone or behind an underscore (azimuth_deg as well); the
/// elevations likewise, elevation, elev or el. A FITS file has the azimuths in its first plane and the
/// elevations in the second, an EXR in its channels azimuth_deg and elevation_deg. Throws
/// sim::Error(unreadable_input) for what holds none, or several of one size.
SkyMapFile read_sky_map(const std::string& file, const SkyMapFlip& flip = {});

/// Whether a file of arrays has such maps: nothing is read of them. False as well for one that is damaged.
bool has_sky_map(const std::string& file);

}  // namespace vegard::fit
