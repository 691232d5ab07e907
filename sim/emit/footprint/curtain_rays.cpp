#include "sim/emit/footprint/curtain_rays.h"

#include "sim/base/number/gaussian_process.h"
#include "sim/base/number/random.h"
#include "sim/base/number/smooth_step.h"

namespace vegard::sim {
namespace curtain_rays {

constexpr double kStepsPerWidth = 8.0;
constexpr double kMostSteps = 4194304.0;
/// Of a closed curve, in widths of a ray: over which its end passes into its beginning.
constexpr double kPassage = 4.0;

}  // namespace curtain_rays

CurtainRays::CurtainRays(const Footprint& f, std::uint64_t seed, double instant_s, double length_km,
                         bool closed) {
  using namespace curtain_rays;
  if (!has_rays(f) || !(length_km > 0.0)) return;
  step_km_ = std::max(f.ray_width_km / kStepsPerWidth, length_km / kMostSteps);
  const double passage_km = closed ? std::min(kPassage * f.ray_width_km, 0.5 * length_km) : 0.0;
  GaussianProcess process(seed, Stream::ray_light, name_number(f.name), f.ray_width_km, instant_s,
                          f.ray_lifetime_s);
  process.remember(-passage_km, length_km + step_km_);
  const double c = f.ray_contrast;
  const auto count = static_cast<std::size_t>(std::ceil(length_km / step_km_)) + 2;
  ln_factor_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double along_km = step_km_ * static_cast<double>(i);
    double g = process.at(along_km);
    if (const double past = along_km - (length_km - passage_km); passage_km > 0.0 && past > 0.0) {
      // Both have unit variance, and so has their sum.
      const double share = smooth_step(past / passage_km);
      g = (g * (1.0 - share) + process.at(along_km - length_km) * share) / std::hypot(1.0 - share, share);
    }
    ln_factor_.push_back(c * g - 0.5 * c * c);
  }
}

}  // namespace vegard::sim
