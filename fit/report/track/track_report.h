// What a satellite met, as a table, as netCDF, as a plot and in words. The columns are in
// docs/file_formats.md.
#pragma once

#include <string>
#include <vector>

#include "fit/report/plot/plot.h"
#include "fit/track/satellite_track.h"
#include "sim/base/file/netcdf_dataset.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {

/// The brightness of a line seen from straight below, by point of the track.
struct TrackLine {
  double wavelength_nm = 0.0;
  std::vector<double> rayleigh, sigma;  ///< NaN where the electrons are not known
};

/// Returns the light of Maxwellian electrons by the tables; errors are those of E0 and flux, to first order
/// and taken as independent, the tables as exact.
std::vector<TrackLine> track_lines(const std::vector<MetElectrons>& met, const sim::EmissionTables& tables,
                                   const std::vector<double>& lines_nm);

/// What it was made of, for comments and attributes.
struct TrackFacts {
  std::vector<std::string> maps;
  std::string track, field;
};

std::string track_csv(const std::vector<MetElectrons>& met, const std::vector<TrackLine>& lines,
                      const TrackFacts& facts);
sim::NetcdfDataset track_dataset(const std::vector<MetElectrons>& met, const std::vector<TrackLine>& lines,
                                 const TrackFacts& facts);

/// Energy flux and E0 against the seconds since the first point that is known, with bands of one standard
/// deviation.
Plot track_plot(const std::vector<MetElectrons>& met, const TrackFacts& facts);

/// How many points, over which maps, how far in time, the ranges of flux and energy.
std::string track_text(const std::vector<MetElectrons>& met, const TrackFacts& facts);

}  // namespace vegard::fit
