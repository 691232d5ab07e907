// chi2 of line brightnesses as a function of the unknowns of a column-ratio inversion, and all of its minima.
//
// A ratio of two lines need not be monotonic in the energy, so brightnesses may have two solutions. The whole
// range of energies is scanned first, with the energy flux solved for at each energy (brightness is nearly
// proportional to it). From every local minimum of that scan, damped Gauss-Newton steps (Levenberg 1944,
// Marquardt 1963) lead to a minimum of chi2 inside the limits of the tables.
//
// The modes of the tables' uncertainty are solved for at every point, chi2 being the least over their
// coefficients a of
//
//     sum over lines of ((R exp(M a) - y)/sigma)^2 + |a|^2,
//
// so that with Gaussian errors it is that of the errors and the modes together, of covariance
// sigma^2 + (R M)(R M)^T.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "fit/columns/column_model.h"

namespace vegard::fit {

/// A local minimum of chi2.
struct ColumnValley {
  ColumnPoint at{};
  double chi2 = 0.0;
  /// Half of chi2's second derivatives by the unknowns, in the Gauss-Newton approximation; the inverse is
  /// their covariance.
  ColumnMatrix information = ColumnMatrix::Zero();
  ColumnFreedom at_edge{};  ///< chi2 would decrease further beyond the tables
  /// Largest chi2 of the scan between this minimum and the best one, above the higher of the two; 0 for the
  /// best.
  double barrier = 0.0;
};

class ColumnChi2 {
 public:
  /// Unknowns that are not free keep their values in `fixed`. `model` must outlive this object. Of the
  /// model's energies, every energy_stride-th is scanned.
  ColumnChi2(const ColumnModel& model, const ColumnFreedom& free, const ColumnPoint& fixed,
             std::size_t energy_stride = 1);

  const ColumnModel& model() const { return *model_; }
  const ColumnFreedom& free() const { return free_; }
  const ColumnPoint& fixed() const { return fixed_; }

  double at(const ColumnData& data, const ColumnPoint& point) const;

  /// Returns what the modes of the tables' uncertainty make of each line's brightness at a minimum.
  std::vector<LineCorrection> corrections(const ColumnData& data, const ColumnValley& valley) const;

  /// Descends from `start` by changing the unknowns of `free`.
  ColumnValley descend(const ColumnData& data, ColumnPoint start, const ColumnFreedom& free) const;

  /// Returns all minima, the lowest first; at least one. Those that must lie far above the lowest may be
  /// missing. May be called by several threads at once.
  std::vector<ColumnValley> valleys(const ColumnData& data) const;

 private:
  struct ScanPlace {
    ColumnPoint at{};
    std::size_t energy = 0;                 ///< index among the scanned energies
    std::vector<double> rayleigh_per_flux;  ///< [flux * lines + line]
    LineMatrix ln_covariance{};             ///< of the lines by the modes; none without modes
  };
  /// chi2 at a place with the best energy flux; kLines is the number of lines.
  template <std::size_t kLines>
  double best_flux(const ColumnData& data, const ScanPlace& place, double& ln_flux) const;

  /// A bound from below for chi2 about a minimum of the scan. Of a parabola, the lowest point is below the
  /// lowest of even samples by at most a quarter of the rise to the higher of its neighbours; half is taken.
  /// 0 where other unknowns than the flux have few places in the scan.
  double lowest_near(const std::vector<double>& least, std::size_t minimum) const;

  const ColumnModel* model_;
  ColumnFreedom free_;
  ColumnPoint fixed_;
  std::vector<double> ln_fluxes_;
  std::vector<double> ln_energies_;
  std::vector<ScanPlace> places_;
};

/// Returns the covariance of the unknowns that are free and not at an edge; the rows and columns of the
/// others are zero.
ColumnMatrix column_covariance(const ColumnValley& valley, const ColumnFreedom& free);

}  // namespace vegard::fit
