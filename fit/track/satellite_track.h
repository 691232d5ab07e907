// The places of a satellite: from a table, or from two-line elements; and what a map of precipitation has
// where the field lines through them come down.
#pragma once

#include <string>
#include <vector>

#include "fit/map/precipitation_planes.h"
#include "fit/track/field_foot.h"

namespace vegard::fit {

struct SatellitePoint {
  double time_s = 0.0;  ///< seconds since 1970 in UTC
  GeodeticPlace place;
};

/// Reads a table with columns of these names, capital or small letters alike:
///
///     time       time, time_utc, timestamp, utc, epoch (ISO 8601, UTC without a zone), ut1_unix, time_s,
///     unix
///                (seconds since 1970)
///     latitude   lat, latitude, latitude_deg, glat, gdlat
///     longitude  lon, long, longitude, longitude_deg, glon
///     altitude   alt, altitude, altitude_km, alt_km, gdalt in km; or radius in m from the Earth's centre, as
///                Swarm's files have it: the latitude is then geocentric
///
/// Throws sim::Error(unreadable_input), with the line, unless all four are there and sound in every row.
std::vector<SatellitePoint> read_track(const std::string& text, const std::string& name);

/// The instants START/STEP/STOP: two times and seconds between. Throws sim::Error(usage) about --times for
/// another form, a step of 0, or more than 100000 instants.
std::vector<double> instants_of(const std::string& words);

/// Elements of one satellite of which an orbit is computed, with the epoch nearest to each instant. Along the
/// track they go wrong by one to three kilometres a day, and more near the Earth (Vallado et al. 2006).
inline constexpr double kOldElementsDays = 5.0;

/// Returns the places at these instants. `satellite`: its number; empty where the file has one alone. Throws
/// sim::Error(unreadable_input) for elements more than kOldElementsDays away from an instant, and what
/// read_orbital_elements() and Sgp4 throw; Error(usage) about --satellite.
std::vector<SatellitePoint> track_of_elements(const std::string& text, const std::string& name,
                                              const std::string& satellite,
                                              const std::vector<double>& instants, double& oldest_days);

/// What a map has at a foot; NaN where it knows nothing.
struct MetElectrons {
  SatellitePoint point;
  GeodeticPlace foot;  ///< at the map's altitude; NaN where the field line does not come down
  double east_km = 0.0, north_km = 0.0;
  double seconds_after_map = 0.0;
  double energy_kev = 0.0, energy_flux_mw_m2 = 0.0;
  double ln_energy_sigma = 0.0, relative_flux_sigma = 0.0;
};

struct TrackRequest {
  double time_tolerance_s = 60.0;  ///< of a point to its map
};

/// Returns what the map nearest in time has along a track: bilinear in the flux between four cells, and
/// weighted with it in the logarithm of E0 and in the errors, which are taken as fully correlated. NaN where
/// one of the fluxes is unknown, or no map is within the tolerance. Latitudes on the maps' sphere are taken
/// as geodetic ones. Each map must have a time. Throws sim::Error(unreadable_input) about `name` if no point
/// is ever on a map, with how near it comes.
std::vector<MetElectrons> electrons_along(const std::vector<PrecipitationPlanes>& maps,
                                          const std::vector<SatellitePoint>& track,
                                          const TrackRequest& request, const std::string& name);

}  // namespace vegard::fit
