// Resamples maps of precipitation to regular grids of longitude and latitude, for models of the ionosphere.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/map/precipitation_planes.h"

namespace vegard::fit {

/// The coordinate system of longitudes and latitudes.
enum class EarthFrame {
  geographic,  ///< on the sphere
  /// The centred dipole that is GEMINI's default: its pole is at colatitude 11 degrees and longitude 289
  /// degrees; the geographic pole is at the magnetic longitude 180 degrees.
  gemini_dipole
};

struct LongitudeLatitude {
  double longitude_deg = 0.0;  ///< geographic: above -180, to 180; dipole: 0 to 360
  double latitude_deg = 0.0;
};

/// Converts geographic coordinates of a point of the sphere to those of the frame.
LongitudeLatitude in_frame(EarthFrame frame, LongitudeLatitude geographic);
/// Converts coordinates of the frame to geographic ones.
LongitudeLatitude geographic_of(EarthFrame frame, LongitudeLatitude place);

struct GeographicGrid {
  EarthFrame frame = EarthFrame::geographic;
  std::vector<double> longitude_deg,
      latitude_deg;  ///< of cells' centres; increasing, even beyond 360
  std::size_t cells() const { return longitude_deg.size() * latitude_deg.size(); }
};

/// Returns a grid that covers all maps, with steps of `step_deg` in latitude, and in longitude larger ones
/// that make cells about square. Throws sim::Error(usage) with key "--step-deg" for a grid of more than
/// 4194304 cells or fewer than two along either axis. If maps cover a pole, the grid has each longitude once,
/// and no latitude beyond the pole.
GeographicGrid grid_over(const std::vector<PrecipitationPlanes>& maps, EarthFrame frame, double step_deg);

/// A map on such a grid, [latitude * longitudes + longitude]. NaN where less than half of a cell has values;
/// the energy is also NaN where there is no flux.
struct GeographicMap {
  std::vector<double> energy_flux_mw_m2;  ///< mean over the cell
  std::vector<double> energy_kev;         ///< E0: mean of its logarithm, weighted with flux
  std::vector<double> relative_flux_error,
      ln_energy_error;  ///< means weighted with flux: errors are taken as fully correlated
};
GeographicMap on_grid(const PrecipitationPlanes& map, const GeographicGrid& grid);

}  // namespace vegard::fit
