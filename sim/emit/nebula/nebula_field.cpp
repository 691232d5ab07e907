#include "sim/emit/nebula/nebula_field.h"

#include <cmath>

#include "sim/emit/nebula/nebula_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
NebulaField::NebulaField(const Scene& scene, const Nebula& nebula)
    : cloud_(scene, nebula, [](const double& number) { return number; }),
      lines_(static_cast<int>(scene.emission.lines.size())),
      unit_cm_(nebula.unit_pc * kKmPerParsec * kCmPerKm),
      bound_(nebula.bound) {}

Box3 NebulaField::bounds() const { return {{-bound_, -bound_, -bound_}, {bound_, bound_, bound_}}; }

bool NebulaField::is_dark(const Box3& box) const {
  double middle[3], half_square = 0.0, nearest_square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * (box.low[axis] + box.high[axis]);
    const double half = 0.5 * (box.high[axis] - box.low[axis]);
    const double outside = std::max(std::abs(middle[axis]) - half, 0.0);
    half_square += half * half;
    nearest_square += outside * outside;
  }
  return nearest_square > bound_ * bound_ || cloud_.empty_about(middle) > std::sqrt(half_square);
}

void NebulaField::sample(std::size_t count, const double* const point[3], float* const emission[],
                         float* density) const {
  for (std::size_t i = 0; i < count; ++i) {
    const double here[3] = {point[0][i], point[1][i], point[2][i]};
    for (int l = 0; l < lines_; ++l) emission[l][i] = 0.0f;
    density[i] = 0.0f;
    if (here[0] * here[0] + here[1] * here[1] + here[2] * here[2] > bound_ * bound_) continue;
    CloudAt<double> at;
    if (cloud_.empty_about(here) > 0.0 || !cloud_.sample(here, at)) continue;
    const CloudDensity densities = cloud_.densities(here);
    density[i] = static_cast<float>(cloud_.has_dust() ? densities.dust : densities.gas);
    for (int l = 0; l < lines_; ++l)
      emission[l][i] = static_cast<float>(photons_per_volume(at.light[l], unit_cm_));
  }
}

}  // namespace vegard::sim
