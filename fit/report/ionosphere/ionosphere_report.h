// Ionospheres as netCDF, as a plot and in words. The variables are in docs/file_formats.md.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/report/ionosphere/electron_source.h"
#include "fit/report/plot/plot.h"
#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// What the numbers were computed with.
struct IonosphereFacts {
  std::string electrons;  ///< "the map night/map"
  std::string tables, air, reactions;
  std::string instant;  ///< "180 s after the onset", "in a steady state"
  std::string errors;   ///< what the standard deviations contain
  std::string field;    ///< "54300 nT at 110 km, IGRF-14, 65 N 148 W, 2014.0"
};

/// Ionospheres of a source, as many as it has rows or cells.
struct IonosphereAnswer {
  std::vector<sim::IonosphereEstimate> estimates;
};

/// Computes them on `threads` threads; the same numbers for any of them.
IonosphereAnswer ionospheres(const sim::IonosphereTable& table, const ElectronSource& source, int threads);

/// Electrons of a cell or a row.
sim::ElectronEstimate electrons_of(const ElectronSource& source, std::size_t index);
std::size_t ionosphere_count(const ElectronSource& source);

/// Returns the table's range: that of all electrons of the source that are known, within the limits of the
/// model. Throws sim::Error(unreadable_input) if none is, or one row's energy is beyond the limits.
sim::IonosphereTable::Range electron_range(const ElectronSource& source, const sim::IonosphereModel& model);

/// Conductances, peaks and their standard deviations by row or cell; profiles by altitude besides for rows,
/// and for a map where `has_profiles`.
sim::NetcdfDataset ionosphere_dataset(const sim::IonosphereTable& table, const ElectronSource& source,
                                      const IonosphereAnswer& answer, const IonosphereFacts& facts,
                                      bool has_profiles, int threads);

/// A row an altitude for the electrons of one row: altitude_km, each number and its NAME_sigma; the units are
/// in a comment.
std::string ionosphere_csv(const sim::IonosphereTable& table, const sim::ElectronEstimate& electrons,
                           const IonosphereFacts& facts);

/// Two panels for the electrons of one row: densities and conductivities, with bands of one standard
/// deviation.
Plot ionosphere_plot(const sim::IonosphereTable& table, const sim::ElectronEstimate& electrons,
                     const std::string& note);

/// A line a number for one row; for more of them, or a map, their medians and ranges.
std::string ionosphere_text(const IonosphereAnswer& answer, const IonosphereFacts& facts);

}  // namespace vegard::fit
