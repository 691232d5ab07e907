// Maps of precipitation on regular grids of longitude and latitude, as models of the ionosphere read them.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/map/map_planes.h"

namespace vegard::fit {

/// Whose longitudes and latitudes.
enum class EarthFrame {
  geographic,  ///< of the sphere
  /// Of the centred dipole that GEMINI has by default: its pole at colatitude 11 degrees and
  /// longitude 289 degrees; the geographic pole stands at the magnetic longitude 180 degrees.
  gemini_dipole
};

struct LongitudeLatitude {
  double longitude_deg = 0.0;  ///< geographic: above -180, to 180; of the dipole: 0 to 360
  double latitude_deg = 0.0;
};

/// Of the point of a sphere with these geographic coordinates, and the other way round.
LongitudeLatitude in_frame(EarthFrame frame, LongitudeLatitude geographic);
LongitudeLatitude geographic_of(EarthFrame frame, LongitudeLatitude place);

struct GeographicGrid {
  EarthFrame frame = EarthFrame::geographic;
  std::vector<double> longitude_deg, latitude_deg;  ///< increasing, of the cells' middles; longitudes may go
                                                    ///< beyond the frame's range so that they increase
  std::size_t cells() const { return longitude_deg.size() * latitude_deg.size(); }
};

/// Over all maps. `step_deg` of latitude; of longitude as many degrees more as makes cells about square.
/// Throws sim::Error(usage) with key "--step-deg" for a grid of more than 4194304 cells or fewer than two
/// each way. Maps over a pole get each longitude once, and no latitude beyond it.
GeographicGrid grid_over(const std::vector<MapPlanes>& maps, EarthFrame frame, double step_deg);

/// [latitude * longitudes + longitude]. NaN where less than half of a cell has values; the energy where there
/// is no flux.
struct GeographicMap {
  std::vector<double> energy_flux_mw_m2;                     ///< mean over the cell
  std::vector<double> energy_kev;                            ///< E0: of its logarithm the mean by flux
  std::vector<double> relative_flux_error, ln_energy_error;  ///< means by flux: errors are taken as alike
};
GeographicMap on_grid(const MapPlanes& map, const GeographicGrid& grid);

}  // namespace vegard::fit
