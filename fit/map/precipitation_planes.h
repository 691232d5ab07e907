// Reads all planes of a map's precipitation.fits, for export to other formats and programs.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/site.h"

namespace vegard::fit {

/// The planes on linear axes in the site's tangent plane, for feet at `height_km`: columns to the east, rows
/// to the north, [row * columns + column]. NaN where no picture constrains a value.
struct PrecipitationPlanes {
  int columns = 0, rows = 0;
  double west_km = 0.0, south_km = 0.0;  ///< of the middle of the first cell
  double step_km = 2.0;
  double height_km = 110.0;
  sim::Site site;
  std::optional<double> time_s;  ///< seconds since 1970 in UTC, of the (first) photograph
  bool flux_is_absolute = true;  ///< else known only up to a factor
  std::vector<double> energy_flux_mw_m2;
  std::string spectrum = "maxwellian";      ///< of the electrons, as in --spectrum
  std::vector<double> energy_kev;           ///< E0 of the electrons; NaN where there is no flux
  std::vector<double> relative_flux_error;  ///< standard error as a fraction of the flux
  std::vector<double> ln_energy_error;      ///< standard error of ln(E0)
  std::vector<double> sensitivity;          ///< signal-to-noise ratio of 1 mW m-2 in this cell alone

  std::size_t cells() const { return static_cast<std::size_t>(columns) * rows; }
};

/// Reads DIRECTORY/precipitation.fits. Throws sim::Error(unreadable_input) if it is not such a file.
PrecipitationPlanes read_precipitation_planes(const std::string& directory);

}  // namespace vegard::fit
