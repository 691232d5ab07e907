#include "sim/emit/sun/chromosphere_density.h"

#include <cstdint>

#include "sim/base/number/random.h"

namespace vegard::sim {
namespace {

constexpr double kFiner = 1.99;  // an octave's lattice than the one before

}  // namespace

template <class T>
ChromosphereDensity<T>::ChromosphereDensity(const Scene& scene, int index, const Image* biasmap,
                                            const NumberAs<T>& number, std::optional<double> instant_s)
    : lattice_(scene.seed, Stream::chromosphere,
               name_number(scene.chromospheres[static_cast<std::size_t>(index)].name)),
      turn_(scene.sun, instant_s.value_or(scene.time.start_s)) {
  const Chromosphere& c = scene.chromospheres[static_cast<std::size_t>(index)];
  octaves_ = c.octaves;
  cutoff_ = c.cutoff;
  roughness_ = number(c.roughness);
  per_scale_ = T(1.0) / number(c.scale);
  for (std::size_t axis = 0; axis < 3; ++axis) shift_[axis] = number(c.shift[axis]);
  coverage_ = number(c.coverage);
  sharpness_ = number(c.sharpness);
  amplitude_ = number(c.amplitude);
  peak_ = number(c.peak);
  if (biasmap != nullptr && !biasmap->empty()) biasmap_.emplace(*biasmap);
}

template <class T>
T ChromosphereDensity<T>::turbulence(const T place[3], double least) const {
  double to_come = 0.0, height = 1.0;
  for (int i = 0; i < octaves_; ++i, height *= value_of(roughness_))
    to_come += NoiseLattice::kLargest * height;
  T sum(0.0), weight(1.0);
  T point[3];
  for (int axis = 0; axis < 3; ++axis) point[axis] = place[axis] * per_scale_ + shift_[axis];
  for (int i = 0; i < octaves_; ++i) {
    if (value_of(sum) + to_come < least) return sum;
    const T n = noise_of(lattice_, point);
    sum = value_of(n) < 0.0 ? sum - weight * n : sum + weight * n;
    to_come -= NoiseLattice::kLargest * value_of(weight);
    if (i + 1 == octaves_) break;
    weight = weight * roughness_;
    for (T& p : point) p = p * kFiner;
  }
  return sum;
}

template <class T>
T ChromosphereDensity<T>::at(const T place[3]) const {
  if (!turn_.turns()) return at_first(place);
  const Vec3<T> here = {place[0], place[1], place[2]};
  return at_first(turned_west(here, T(0.0) - turn_.angle_at_rad(here[0], here[1], here[2])).data());
}

/// Returns the density at a place of the pattern as it stood at time 0.
template <class T>
T ChromosphereDensity<T>::at_first(const T place[3]) const {
  T density(0.0);
  if (cutoff_) {
    if (value_of(amplitude_) > 0.0 && value_of(sharpness_) > 0.0)
      density = cloud_cutoff(turbulence(place, value_of(coverage_)), coverage_, sharpness_, amplitude_);
  } else {
    density = turbulence(place, 0.0);
  }
  if (biasmap_) density = density + peak_ * biasmap_->at(place);
  return value_of(density) > 0.0 ? density : T(0.0);
}

template class ChromosphereDensity<double>;
template class ChromosphereDensity<FreeDual>;

}  // namespace vegard::sim
