// Tables of the brightness of lines along a vertical column against the energy of the electrons, their flux
// and the air's atomic oxygen: what one component of a spectrum gives, per unit energy flux.
//
// The columns are integrals of the simulator's own height profiles (sim/light/spectrum_profile.h), at nodes
// so close together that ln(rayleighs) is a cubic through the four nearest, once continuously differentiable
// (Catmull and Rom 1974).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {

inline constexpr std::size_t kMaxColumnLines = 8;

/// Values at even distances, of which there is one or at least four.
class EvenNodes {
 public:
  EvenNodes() = default;
  /// At least four nodes, at most `widest_step` apart.
  EvenNodes(double least, double most, double widest_step);
  explicit EvenNodes(double only) : at_{only} {}

  const std::vector<double>& at() const { return at_; }
  std::size_t size() const { return at_.size(); }

  /// Weights of the nodes from `first` on in an interpolated value, and in its slope.
  struct Weights {
    std::size_t first = 0, count = 4;
    std::array<double, 4> value{1.0, 0.0, 0.0, 0.0}, slope{};
  };
  /// Those of the cubic between two nodes whose slopes at both are those of the parabolas through their
  /// neighbours; at the ends the parabola goes on.
  Weights cubic(double at) const;
  /// Those of the quadratic B-spline (de Boor 1978): no weight is negative, so that the mean of covariances
  /// is a covariance; it smooths over a node's distance. Three nodes at most, with the end nodes repeated.
  Weights spline(double at) const;

 private:
  double step_ = 1.0;
  std::vector<double> at_;
};

/// ln(rayleighs) per mW m^-2 of a line, and its derivatives by ln(energy), ln(flux), ln(oxygen).
struct ComponentLight {
  double ln_rayleigh = 0.0, by_energy = 0.0, by_flux = 0.0, by_oxygen = 0.0;
};

class ColumnTable {
 public:
  /// Energies are those of `energies`, in ln(keV); `fluxes` those of ln(mW m^-2) at which the flux law of
  /// Maxwellian electrons is taken. `oxygens` are ln(factor). Lines of the aurora, kMaxColumnLines at most.
  ColumnTable(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
              const sim::ElectronSpectrum& spectrum, EvenNodes energies, EvenNodes fluxes, EvenNodes oxygens,
              bool has_modes, int threads);

  const EvenNodes& energies() const { return energies_; }
  const EvenNodes& oxygens() const { return oxygens_; }

  /// All lines at a point inside the nodes; `light` has as many places as there are lines.
  void at(double ln_energy, double ln_flux, double ln_oxygen, ComponentLight* light) const;

  int modes() const { return modes_; }
  /// What the modes of the tables' uncertainty change of ln(rayleighs) at a node of the energies, [line,
  /// mode], for the tables' own oxygen.
  Eigen::MatrixXd modes_at_node(std::size_t energy) const;
  /// Changes the columns by these coefficients of the modes, and each line's by the logarithm of a factor.
  void multiply(const Eigen::VectorXd& modes, const Eigen::VectorXd& ln_factors);

 private:
  void tabulate_columns(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                        const sim::ElectronSpectrum& spectrum, int threads);
  void tabulate_modes(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                      const sim::ElectronSpectrum& spectrum, int threads);
  void tabulate_flux_law(const sim::EmissionTables& tables, const std::vector<double>& lines_nm);

  std::size_t lines_;
  EvenNodes energies_, fluxes_, oxygens_;
  std::vector<double> ln_column_;  ///< [(oxygen * energies + energy) * lines + line], at 1 mW m^-2
  std::vector<double> ln_factor_;  ///< of the flux law, [(energy * fluxes + flux) * lines + line]; or empty
  int modes_ = 0;
  std::vector<double> mode_;  ///< [(energy * lines + line) * modes + mode]
};

}  // namespace vegard::fit
