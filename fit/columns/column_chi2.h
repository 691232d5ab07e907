// chi2 of line brightnesses over the unknowns of a column-ratio inversion, and all of its valleys.
//
// A ratio of two lines need not be monotonic in the energy, so that brightnesses may have two explanations.
// The whole range of energies is scanned first, with the energy flux solved for at each (brightness is nearly
// proportional to it); every valley of that scan is then followed to its bottom by damped Gauss-Newton steps
// (Levenberg 1944, Marquardt 1963) inside the limits of the tables.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <vector>

#include "fit/columns/column_model.h"

namespace vegard::fit {

inline constexpr std::size_t kMaxColumnLines = 8;

/// Of the model's lines, in rayleighs. Standard deviations are above 0.
struct ColumnData {
  std::array<double, kMaxColumnLines> rayleigh{}, sigma{};
};

/// The bottom of a valley.
struct ColumnValley {
  ColumnPoint at{};
  double chi2 = 0.0;
  /// Half of chi2's second derivatives by the unknowns, as Gauss and Newton have them; its inverse is their
  /// covariance.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  std::array<bool, kColumnUnknowns> at_edge{};  ///< chi2 would fall further beyond the tables
  /// Of the scan between this valley and the best one, above the higher of the two; 0 for the best.
  double barrier = 0.0;
};

class ColumnChi2 {
 public:
  /// Unknowns that are not free stay as `fixed` has them. `model` outlives this. energy_stride: of the
  /// model's energies every which one is scanned.
  ColumnChi2(const ColumnModel& model, const ColumnFreedom& free, const ColumnPoint& fixed,
             std::size_t energy_stride = 1);

  const ColumnModel& model() const { return model_; }
  const ColumnFreedom& free() const { return free_; }
  const ColumnPoint& fixed() const { return fixed_; }

  double at(const ColumnData& data, const ColumnPoint& point) const;

  /// From `start` downwards, over those of `free`.
  ColumnValley descend(const ColumnData& data, ColumnPoint start, const ColumnFreedom& free) const;

  /// All valleys, the deepest first; never none. Safe to be called by several threads at once.
  std::vector<ColumnValley> valleys(const ColumnData& data) const;

 private:
  struct ScanPlace {
    ColumnPoint at{};
    std::size_t energy = 0;                 ///< which of the scanned energies
    std::vector<double> rayleigh_per_flux;  ///< [line * fluxes + flux]
  };
  double best_flux(const ColumnData& data, const ScanPlace& place, double& ln_flux) const;

  const ColumnModel& model_;
  ColumnFreedom free_;
  ColumnPoint fixed_;
  std::vector<double> ln_fluxes_;
  std::vector<double> ln_energies_;
  std::vector<ScanPlace> places_;
};

/// The covariance of the unknowns that are free and not at an edge; zero in the rows of the others.
Eigen::Matrix3d column_covariance(const ColumnValley& valley, const ColumnFreedom& free);

}  // namespace vegard::fit
