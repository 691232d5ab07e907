// A picture by integration along lines of sight: no beams, no deflections, no splats. Beside the height
// profiles it shares the camera, the blur and the colours with the simulator, and of the sheets their folds
// and rays (Footprint).
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::scorecard {

/// Blurred rayleighs per line, as sim::Rendering::rayleigh has them, in a uniform field. Every pixel is the
/// mean of two lines of sight, one above the other. threads: 0 for all cores; the picture does not depend on
/// it.
sim::Image line_of_sight_rayleighs(const sim::Scene& scene, int threads);

class Footprint {
 public:
  static constexpr double kCellKm = 0.2;

  /// Of scene.sheets[sheet]. One arc that does not move, without curls, patches or an uneven border.
  Footprint(const sim::Scene& scene, int sheet);

  /// Outside of this distance from the line from start to end there is no light.
  double half_width_km() const { return half_width_km_; }
  double half_length_km() const { return half_length_km_; }

  /// mW m^-2 at a place: `along_km` from the centre towards the end, `aside_km` to the side of the sine's
  /// positive values.
  double flux_mw_m2(double along_km, double aside_km) const {
    const double x = (along_km + half_length_km_) / kCellKm, y = (aside_km + half_width_km_) / kCellKm;
    if (!(x >= 0.0 && y >= 0.0)) return 0.0;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    if (i + 1 >= columns_ || j + 1 >= rows_) return 0.0;
    const double fx = x - i, fy = y - j;
    const float* const near = &flux_[static_cast<std::size_t>(i) * rows_ + j];
    const float* const next = near + rows_;
    return (1.0 - fx) * ((1.0 - fy) * near[0] + fy * near[1]) + fx * ((1.0 - fy) * next[0] + fy * next[1]);
  }

 private:
  double half_length_km_, half_width_km_;
  int columns_, rows_;
  std::vector<float> flux_;  ///< [along][aside], at the cells' corners
};

}  // namespace vegard::scorecard
