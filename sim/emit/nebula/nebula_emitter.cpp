#include "sim/emit/nebula/nebula_emitter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "sim/base/number/escaping_share.h"
#include "sim/base/number/smooth_step.h"
#include "sim/base/number/vec3.h"
#include "sim/emit/nebula/nebula_frame.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
namespace {

constexpr double kNebulaNothingComesThrough = 1e-10;

constexpr int kIterations = 50;
constexpr double kInsideGain = 1.0 / 200.0, kStepGain = 1.0 / 90.0;  // of opacity, at every step
constexpr double kGrey = 0.3, kEmission = 0.2, kDensityScale = 0.2;
constexpr double kStepOfDistance = 0.1, kLiteralMinStep = 0.01;
constexpr double kLiteralScattering = 0.2, kScattered = 0.4;

}  // namespace

template <class T>
NebulaEmitter<T>::NebulaEmitter(const Scene& scene, const Nebula& nebula, const NumberAs<T>& number,
                                bool skip)
    : frame_(nebula, number), cloud_(scene, nebula, number), step_(nebula.step), skip_(skip) {}

template <class T>
void NebulaEmitter<T>::march(const RayBundle<T>& rays, const BundleLight<T>& out) const {
  for (std::size_t i = 0; i < rays.count; ++i) {
    const T enu[3] = {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]};
    march_ray(enu, rays.end_km[i], i, rays.count, out);
  }
}

template <class T>
void NebulaEmitter<T>::march_ray(const T enu[3], double end_km, std::size_t index, std::size_t rays,
                                 const BundleLight<T>& out) const {
  const NebulaRay<T> ray = frame_.ray(enu);
  if (!ray.meets) return;
  // From the nearest place: the observer is at ray.observer, and the way begins there or at the bound.
  T first = T(0.0) - ray.half_chord, last = ray.half_chord;
  const double observer = value_of(ray.observer);
  if (value_of(first) < observer) first = ray.observer;
  const double end = observer + end_km / frame_.unit_km();
  if (value_of(last) > end) last = T(end);
  if (!(value_of(first) < value_of(last))) return;
  out.entry_km[index] = (value_of(first) - observer) * frame_.unit_km();

  double bright = 0.0, weighted = 0.0, max_kept = 1.0;
  T light[kMaxLines], kept[kMaxLines];
  for (int l = 0; l < out.lines; ++l) {
    light[l] = T(0.0);
    kept[l] = T(1.0);
  }
  const double begin = std::floor(value_of(first) / step_), finish = std::ceil(value_of(last) / step_);
  for (double piece = begin; piece < finish; piece += 1.0) {
    const double low = piece * step_, high = low + step_;
    if (skip_) {
      const double middle = low + 0.5 * step_;
      double here[3];
      for (int axis = 0; axis < 3; ++axis)
        here[axis] = value_of(ray.nearest[axis]) + middle * value_of(ray.direction[axis]);
      // The middle of a piece cut short is half a step nearer at most.
      const double empty = cloud_.empty_about(here) - 0.5 * step_;
      if (empty > 0.0) {
        piece += std::floor(std::min(empty / step_, finish - piece));
        continue;
      }
    }
    const T from = low < value_of(first) ? first : T(low), to = high > value_of(last) ? last : T(high);
    const T length = to - from, middle = (from + to) * 0.5;
    T point[3];
    for (int axis = 0; axis < 3; ++axis) point[axis] = ray.nearest[axis] + ray.direction[axis] * middle;
    CloudAt<T> at;
    if (!cloud_.sample(point, at)) continue;
    double seen_here = 0.0;
    max_kept = 0.0;
    for (int l = 0; l < out.lines; ++l) {
      T seen = kept[l] * at.light[l] * length;
      if (cloud_.has_dust()) {
        const T tau = at.loss[l] * length;
        seen = seen * escaping_share(tau);
        kept[l] = kept[l] * exponential(T(0.0) - tau);
      }
      light[l] = light[l] + seen;
      seen_here += value_of(seen);
      max_kept = std::max(max_kept, value_of(kept[l]));
    }
    bright += seen_here;
    weighted += seen_here * value_of(middle);
    if (std::is_same_v<T, double> && max_kept < kNebulaNothingComesThrough) break;
  }
  for (int l = 0; l < out.lines; ++l) {
    const std::size_t to = static_cast<std::size_t>(l) * rays + index;
    out.rayleigh[to] = light[l];
    out.kept[to] = kept[l];
  }
  if (bright > 0.0) out.depth_km[index] = (weighted / bright - observer) * frame_.unit_km();
}

template class NebulaEmitter<double>;
template class NebulaEmitter<FreeDual>;

NebulaField::NebulaField(const Scene& scene, const Nebula& nebula)
    : cloud_(scene, nebula, plain_number),
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
