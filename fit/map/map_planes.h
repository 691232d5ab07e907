// precipitation.fits of a map, read with all of its planes: for other formats and other programs.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// On linear axes in the site's tangent plane, of feet at `height_km`: columns to the east, rows to the
/// north, [row * columns + column]. NaN where no picture constrains it.
struct MapPlanes {
  int columns = 0, rows = 0;
  double west_km = 0.0, south_km = 0.0;  ///< of the middle of the first cell
  double step_km = 2.0;
  double height_km = 110.0;
  sim::Site site;
  std::optional<double> time_s;  ///< seconds since 1970 in UTC, of the (first) photograph
  bool flux_is_absolute = true;  ///< else right up to a factor
  std::vector<double> energy_flux_mw_m2;
  std::vector<double> energy_kev;           ///< E0 of Maxwellian electrons; NaN where there is no flux
  std::vector<double> relative_flux_error;  ///< standard error, a share of the flux
  std::vector<double> ln_energy_error;      ///< standard error of ln(E0)
  std::vector<double> sensitivity;          ///< signal to noise ratio of 1 mW m-2 in a cell by itself

  std::size_t cells() const { return static_cast<std::size_t>(columns) * rows; }
};

/// DIRECTORY/precipitation.fits. Throws sim::Error(unreadable_input) for what is no such file.
MapPlanes read_map_planes(const std::string& directory);

}  // namespace vegard::fit
