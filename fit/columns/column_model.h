// Brightness of emission lines along a vertical column, as a function of the electrons: what a column-ratio
// inversion compares with photometers and filtered cameras.
//
// The electrons have a spectrum of characteristic energy E0 and, where asked for, a soft Maxwellian component
// of a fixed energy beside it. Of the energy flux Q, the part s/(1 + s) is that of the soft component:
//
//     R(line) = Q (r(line; E0) + s r(line; E_soft)) / (1 + s),
//
// r being the brightness per energy flux (fit/columns/column_table.h). It is fast enough for a million
// pixels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fit/columns/column_table.h"
#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {

/// The unknowns of an inversion, in this order everywhere.
inline constexpr std::size_t kLnEnergy = 0, kLnFlux = 1, kLnOxygen = 2, kLnSoft = 3, kColumnUnknowns = 4;

/// ln(E0 in keV), ln(energy flux in mW m^-2), ln(factor of atomic oxygen), ln(energy flux of the soft
/// component over that of the others).
using ColumnPoint = std::array<double, kColumnUnknowns>;
using ColumnFreedom = std::array<bool, kColumnUnknowns>;

/// What many measurements in common tell about the light of the lines: a normal distribution of the
/// coefficients of the modes of the tables' uncertainty (sim/light/tables/light_modes.h) and, behind them, of
/// a factor of each line, whose logarithm is its coefficient times `factor_error`.
struct CommonLight {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd factor_error;  ///< by line
};

/// E0 of a soft component unless it is given: that of electrons of the plasma sheet's boundary, whose light
/// is red. ESTIMATED: 0.1 to 0.5 keV are common.
inline constexpr double kUsualSoftKev = 0.3;

struct ColumnModelOptions {
  sim::ElectronSpectrum spectrum;
  std::optional<double> soft_kev;  ///< E0 of the soft component; none: there is none
  bool has_modes = true;           ///< with the modes of the tables' uncertainty; false: the tables are exact
};

/// ln of a line's brightness in rayleighs, and its derivatives by the unknowns.
struct ColumnLight {
  double ln_rayleigh = 0.0;
  ColumnPoint slope{};
  double soft_share = 0.0;  ///< of the line's light, that of the soft component
  ColumnPoint soft_share_slope{};
};
using ColumnLights = std::array<ColumnLight, kMaxColumnLines>;

/// A symmetric matrix by pairs of lines: [line * kMaxColumnLines + other].
using LineMatrix = std::array<double, kMaxColumnLines * kMaxColumnLines>;

/// The covariance of the lines' ln(rayleighs) by the modes, and its derivatives by the unknowns.
struct LineCovariance {
  LineMatrix value;
  std::array<LineMatrix, kColumnUnknowns> slope;
  ColumnFreedom depends_on{};  ///< where false, there is no slope
};

using ColumnMatrix =
    Eigen::Matrix<double, static_cast<int>(kColumnUnknowns), static_cast<int>(kColumnUnknowns)>;

/// Brightnesses of the model's lines, in rayleighs. Standard deviations are above 0.
struct ColumnData {
  std::array<double, kMaxColumnLines> rayleigh{}, sigma{};
};

/// The factor on the tables' brightness of a line that the data ask for, and the error of its logarithm: that
/// of the tables before the data, and that which the data leave.
struct LineCorrection {
  double factor = 1.0, ln_sigma_of_tables = 0.0, ln_sigma = 0.0;
};

class ColumnModel {
 public:
  static constexpr double kMinFlux = 1e-3, kMaxFlux = 1e3;            ///< mW m^-2
  static constexpr double kMinSoftRatio = 1e-3, kMaxSoftRatio = 1e1;  ///< of the energy fluxes

  /// `lines_nm`: lines of the aurora, eight at most. `tables` need not outlive the constructor, which takes
  /// some tenths of a second on up to `threads` threads (0: all).
  ColumnModel(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
              const ColumnModelOptions& options, int threads = 0);

  /// The same for light of which this is known; `base` must have modes, and no such knowledge.
  ColumnModel(const ColumnModel& base, const CommonLight& common);

  std::size_t lines() const { return lines_nm_.size(); }
  const std::vector<double>& lines_nm() const { return lines_nm_; }

  /// Brightness at a point inside the limits: of all lines, and of one.
  void at(const ColumnPoint& point, ColumnLights& lights) const;
  ColumnLight at(std::size_t line, const ColumnPoint& point) const;

  /// The number of modes that are not exact, and the lines' covariance by them at a point of these `lights`,
  /// for the tables' own oxygen.
  int modes() const { return modes_; }
  void ln_covariance(const ColumnPoint& point, const ColumnLights& lights, LineCovariance& covariance) const;

  /// What each mode changes of the lines' ln(rayleighs): [line, mode].
  Eigen::MatrixXd modes_at(const ColumnPoint& point) const;

  /// The range of each unknown: that of the tables, for the flux kMinFlux to kMaxFlux, for the soft component
  /// kMinSoftRatio to kMaxSoftRatio. If both ends are equal, the light does not depend on it (knows() is
  /// false).
  double least(std::size_t unknown) const { return least_[unknown]; }
  double most(std::size_t unknown) const { return most_[unknown]; }
  bool knows(std::size_t unknown) const { return most_[unknown] > least_[unknown]; }

  /// Values so close together that no minimum of chi2 can hide between two of them.
  const std::vector<double>& ln_energies() const { return main_.energies().at(); }
  const std::vector<double>& ln_oxygens() const { return main_.oxygens().at(); }
  const std::vector<double>& ln_softs() const { return softs_.at(); }

  /// Whether one of the lines is a fixed multiple of the other for all electrons, since both come from the
  /// same upper state.
  bool is_multiple(std::size_t line, std::size_t other) const;

 private:
  /// The index of the covariance of two rows of (component, line) at a node.
  std::size_t gram_size() const { return components() * lines(); }
  std::size_t components() const { return soft_ ? 2u : 1u; }
  void tabulate_covariance(const CommonLight* common);

  std::vector<double> lines_nm_;
  ColumnTable main_;
  std::optional<ColumnTable> soft_;
  EvenNodes softs_;
  ColumnPoint least_{}, most_{};
  int modes_ = 0;
  std::vector<double> gram_;  ///< [(energy * rows + row) * rows + other row], rows by component and line
};

}  // namespace vegard::fit
