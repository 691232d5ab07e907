// Height profiles for a march: averaged over the altitudes that a step passes through.
//
// Steps of equal length tile a ray. The rate at the middle of a step is inaccurate where the profile bends
// within the step, as at the lower border of an aurora; the mean over the step's altitudes is exact for every
// profile as long as the altitude is linear along the step. So there is a table for each of several widths in
// altitude, from 0 (the profile itself) to the step's length (for a vertical ray); a step uses the nearest.
#pragma once

#include <vector>

#include "sim/light/profile_table.h"

namespace vegard::sim {

class StepProfile {
 public:
  /// The tables range from the first altitude with light up to top_km. `widest_km` is the longest step.
  StepProfile(const ProfileTable& table, double top_km, double widest_km);

  double bottom_km() const { return bottom_km_; }  ///< below which all lines are dark
  int lines() const { return lines_; }
  int stride() const { return stride_; }
  int rows() const { return rows_; }  ///< one per HeightProfile::kStepKm, from bottom_km() up
  int widths() const { return widths_; }
  double width_step_km() const { return width_step_km_; }  ///< difference in width from one table to the next
  int energies() const { return energies_; }
  double ln_first() const { return ln_first_; }
  double ln_step() const { return ln_step_; }

  /// Returns the rates [row][stride], photons cm^-3 s^-1 per mW m^-2, linear from row to row.
  const float* rate(int energy, int width) const { return rate_.data() + offset(energy, width); }
  /// Offset from a number of one energy to that of the next energy.
  int energy_stride() const { return widths_ * rows_ * stride_; }
  /// Returns the rates' derivatives with respect to ln(energy).
  const float* slope(int energy, int width) const { return slope_.data() + offset(energy, width); }

 private:
  std::size_t offset(int energy, int width) const {
    return (static_cast<std::size_t>(energy) * widths_ + width) * rows_ * stride_;
  }

  double bottom_km_ = 0.0, width_step_km_ = 1.0, ln_first_ = 0.0, ln_step_ = 0.0;
  int lines_ = 0, stride_ = 4, rows_ = 0, widths_ = 1, energies_ = 0;
  std::vector<float> rate_, slope_;
};

}  // namespace vegard::sim
