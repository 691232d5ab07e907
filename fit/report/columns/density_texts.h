// Spectra by density profiles, as text, JSON, CSV, netCDF and as a plot.
#pragma once

#include <string>
#include <vector>

#include "fit/radar/density_inversion.h"
#include "fit/report/plot/plot.h"
#include "sim/base/file/netcdf_dataset.h"

namespace vegard::fit {

/// What the inversion was made of and with.
struct DensityFacts {
  std::string tables, air, recombination;  ///< in words
  std::string balance;                     ///< "in a steady state" or "in time"
  std::string errors;                      ///< what the intervals contain
  EnergyRange energies;                    ///< of Q and mean energy
};

struct InvertedDensities {
  const DensityPhysics& physics;
  const DensityTable& table;
  const std::vector<DensitySpectrum>& spectra;
};

/// The numbers of one profile, or of several their medians and ranges; verdicts.
std::string density_text(const InvertedDensities& inverted, const DensityFacts& facts);

/// Fixed order of keys; null for what is unknown.
std::string density_json(const InvertedDensities& inverted, const DensityFacts& facts);

/// A row a profile: time_s if there are times, energy flux and mean energy with their intervals, chi2,
/// chance.
std::string density_csv(const InvertedDensities& inverted, const DensityFacts& facts);

/// The same and the spectra by energy and time.
sim::NetcdfDataset density_dataset(const InvertedDensities& inverted, const DensityFacts& facts);

/// The spectrum and the densities of the first profile.
Plot density_plot(const InvertedDensities& inverted, const DensityFacts& facts);

/// True if most of the profiles are not explained by any electrons.
bool most_contradict(const std::vector<DensitySpectrum>& spectra);

}  // namespace vegard::fit
