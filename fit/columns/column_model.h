// Brightness of emission lines along a vertical column, as a function of the electrons: what a column-ratio
// inversion compares with photometers and filtered cameras.
//
// The columns are integrals of the simulator's own height profiles (sim/light/height_profile.h). They are
// tabulated once over energy (and energy flux and oxygen where these matter), so that they are fast enough
// for a million pixels. In between, ln(rayleighs) is interpolated by a cubic through the four nearest nodes,
// once continuously differentiable.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {

/// The unknowns of an inversion, in this order everywhere.
inline constexpr std::size_t kLnEnergy = 0, kLnFlux = 1, kLnOxygen = 2, kColumnUnknowns = 3;

/// ln(E0 in keV), ln(energy flux in mW m^-2), ln(factor of atomic oxygen).
using ColumnPoint = std::array<double, kColumnUnknowns>;
using ColumnFreedom = std::array<bool, kColumnUnknowns>;

enum class ColumnSpectrum { maxwellian, gaussian, mono };

struct ColumnModelOptions {
  ColumnSpectrum spectrum = ColumnSpectrum::maxwellian;
  double spread = 0.25;   ///< of a Gaussian: its standard deviation over its energy
  bool has_modes = true;  ///< with the modes of the tables' uncertainty; false: the tables are exact
};

/// ln of a line's brightness in rayleighs, and its derivatives by the three unknowns.
struct ColumnLight {
  double ln_rayleigh = 0.0;
  ColumnPoint slope{};
};

/// The derivatives of a line's ln(rayleighs) by the coefficients of the modes of the tables' uncertainty
/// (sim/light/tables/light_modes.h), and their derivatives by ln(energy).
struct ColumnModes {
  std::array<double, sim::kMaxLightModes> value{}, slope{};
};

class ColumnModel {
 public:
  static constexpr double kMinFlux = 1e-3, kMaxFlux = 1e3;  ///< mW m^-2

  /// `lines_nm`: lines of the aurora, eight at most. `tables` need not outlive the constructor, which takes
  /// some tenths of a second on up to `threads` threads (0: all).
  ColumnModel(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
              const ColumnModelOptions& options, int threads = 0);

  std::size_t lines() const { return lines_nm_.size(); }
  const std::vector<double>& lines_nm() const { return lines_nm_; }

  /// Brightness at a point inside the limits.
  ColumnLight at(std::size_t line, const ColumnPoint& point) const;

  /// The number of modes, and what they change at a point inside the limits, for the tables' own oxygen.
  int modes() const { return modes_; }
  ColumnModes modes_at(std::size_t line, const ColumnPoint& point) const;

  /// The range of each unknown: that of the tables, for the flux kMinFlux to kMaxFlux. If both ends are
  /// equal, the tables do not depend on it (knows() is false).
  double least(std::size_t unknown) const { return least_[unknown]; }
  double most(std::size_t unknown) const { return most_[unknown]; }
  bool knows(std::size_t unknown) const { return most_[unknown] > least_[unknown]; }

  /// Energies so close together that no minimum of chi2 can hide between two of them.
  const std::vector<double>& ln_energies() const { return energy_nodes_; }
  const std::vector<double>& ln_oxygens() const { return oxygen_nodes_; }

  /// Whether one of the lines is a fixed multiple of the other for all electrons, since both come from the
  /// same upper state.
  bool is_multiple(std::size_t line, std::size_t other) const;

 private:
  double node(std::size_t line, std::size_t energy, std::size_t oxygen) const {
    return ln_column_[(line * oxygen_nodes_.size() + oxygen) * energy_nodes_.size() + energy];
  }
  void tabulate_columns(const sim::EmissionTables& tables, const ColumnModelOptions& options, int threads);
  void tabulate_modes(const sim::EmissionTables& tables, const ColumnModelOptions& options, int threads);
  void tabulate_flux_law(const sim::EmissionTables& tables);

  std::vector<double> lines_nm_, energy_nodes_, oxygen_nodes_, flux_nodes_;
  ColumnPoint least_{}, most_{};
  std::vector<double> ln_column_;  ///< [(line * oxygens + oxygen) * energies + energy], at 1 mW m^-2
  int modes_ = 0;
  std::vector<double> mode_;  ///< [(line * energies + energy) * modes + mode]
  std::vector<double>
      ln_factor_;  ///< of the flux law, [(line * energies + energy) * fluxes + flux]; or empty
};

}  // namespace vegard::fit
