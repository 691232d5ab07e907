#include "sim/emit/footprint/curtain_rays.h"

#include "sim/base/number/gaussian_process.h"
#include "sim/base/number/random.h"

namespace vegard::sim {
namespace curtain_rays {

constexpr double kStepsPerWidth = 8.0;
constexpr double kMostSteps = 4194304.0;
/// Of a closed curve, in widths of a ray: over which its end passes into its beginning.
constexpr double kPassage = 4.0;

}  // namespace curtain_rays

CurtainRays::CurtainRays(const Footprint& f, std::uint64_t seed, double instant_s, double length_km,
                         bool closed)
    : length_km_(length_km), closed_(closed), contrast_(f.ray_contrast) {
  using namespace curtain_rays;
  if (!has_rays(f) || !(length_km > 0.0)) return;
  step_km_ = std::max(f.ray_width_km / kStepsPerWidth, length_km / kMostSteps);
  longest_passage_km_ = kPassage * f.ray_width_km;
  // Of a closed curve also what lies before its beginning, as far as it passes into the end.
  if (closed)
    first_ = -static_cast<int>(std::ceil(std::min(longest_passage_km_, 0.5 * length_km) / step_km_)) - 2;
  GaussianProcess process(seed, Stream::ray_light, name_number(f.name), f.ray_width_km, instant_s,
                          f.ray_lifetime_s);
  process.remember(step_km_ * first_, length_km + step_km_);
  const double c = f.ray_contrast;
  const auto count = static_cast<std::size_t>(std::ceil(length_km / step_km_) + 2.0 - first_);
  ln_factor_.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    ln_factor_.push_back(c * process.at(step_km_ * (static_cast<double>(i) + first_)) - 0.5 * c * c);
}

}  // namespace vegard::sim
