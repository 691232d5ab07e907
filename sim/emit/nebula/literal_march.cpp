#include "sim/emit/nebula/literal_march.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/smooth_step.h"
#include "sim/base/number/vec3.h"

namespace vegard::sim {
namespace {

constexpr int kIterations = 50;
constexpr double kInsideGain = 1.0 / 200.0, kStepGain = 1.0 / 90.0;  // of opacity, at every step
constexpr double kGrey = 0.3, kEmission = 0.2, kDensityScale = 0.2;
constexpr double kStepOfDistance = 0.1, kLiteralMinStep = 0.01;
constexpr double kLiteralScattering = 0.2, kScattered = 0.4;

}  // namespace

LiteralCloud literal_cloud(const NodeMap<double>& map, const Nebula& nebula) {
  constexpr std::array<double, 3> kWhite{1.0, 1.0, 1.0};
  const bool white = nebula.literal_colour == LiteralColour::white;
  return {map,
          map.node(nebula.gas),
          nebula.bound,
          nebula.edge,
          white ? kWhite : nebula.colour_a,
          white ? kWhite : nebula.colour_b};
}

std::array<double, 4> literal_march(const LiteralCloud& cloud, const std::array<double, 3>& origin,
                                    const std::array<double, 3>& direction, double depth) {
  const double b = dot3(direction, origin), c = dot3(origin, origin) - cloud.bound * cloud.bound;
  const double delta = b * b - c;
  if (delta < 0.0 || std::sqrt(delta) - b <= 0.0) return {0.0, 0.0, 0.0, 0.0};
  const double far = std::sqrt(delta) - b, near = -b - std::sqrt(delta);
  const double observer = std::sqrt(dot3(origin, origin));

  double t = std::max(near, 0.0), opacity = 0.0, local = 0.0;
  std::array<double, 4> sum{};
  for (int i = 0; i < kIterations && t <= depth && t <= far; ++i) {
    double place[3];
    for (int axis = 0; axis < 3; ++axis) place[axis] = origin[axis] + t * direction[axis];
    const double distance = cloud.map.distance(cloud.node, place);
    const double from_middle = std::sqrt(place[0] * place[0] + place[1] * place[1] + place[2] * place[2]);
    if (distance < cloud.edge) {
      local = cloud.edge - distance;
      opacity = std::min(opacity + (1.0 - opacity) * local + kInsideGain, 1.0);
      // The emission: what there is shines on itself.
      for (int channel = 0; channel < 3; ++channel) sum[channel] += sum[3] * sum[channel] * kEmission;
      const double alpha = opacity * kDensityScale, room = 1.0 - sum[3];
      const double far_out = std::min(from_middle, 1.0);
      for (int channel = 0; channel < 3; ++channel) {
        const double light =
            cloud.colour_a[channel] + (cloud.colour_b[channel] - cloud.colour_a[channel]) * far_out;
        sum[channel] += kGrey * light * alpha * room;
      }
      sum[3] += alpha * room;
    }
    opacity = std::min(opacity + kStepGain, 1.0);
    t += std::max(distance * kStepOfDistance * std::max(std::min(from_middle, observer), 1.0),
                  kLiteralMinStep);
  }
  // The last density alone, as the source has it.
  const double scattered = kScattered / std::exp(local * kLiteralScattering);
  std::array<double, 4> result{};
  for (int channel = 0; channel < 3; ++channel) result[channel] = smooth_step(sum[channel] * scattered);
  result[3] = opacity;
  return result;
}

}  // namespace vegard::sim
