// Octaves of noise for density nodes: their sum, and their ridges.
//
// Each octave is twice as fine as the one before and `gain` times as high; it is turned and shifted, so that
// neither its lattice nor its period coincides with the previous one's. If only the comparison of a sum with
// a bound matters, the functions stop early, since the largest contribution of the remaining octaves is
// known.
#pragma once

#include <cmath>
#include <limits>

#include "sim/base/number/noise.h"
#include "sim/emit/nebula/node_shapes.h"

namespace vegard::sim {

template <class T>
struct NoiseNumbers {
  T frequency, gain;
  int octaves = 1;
};

/// Returns the sum of the octaves' heights: 1 + gain + gain² ...
template <class T>
double octave_total(const NoiseNumbers<T>& noise) {
  double total = 0.0, height = 1.0;
  for (int k = 0; k < noise.octaves; ++k, height *= value_of(noise.gain)) total += height;
  return total;
}

/// Changes a point to that of the next octave: scaled by 2, turned, and shifted.
template <class T>
void to_next_octave(T point[3]) {
  // A turn by the angles of the 3-4-5 triangle about two axes: rational, and of no lattice.
  const T x = point[0] * 0.6 - point[1] * 0.8, y = point[0] * 0.8 + point[1] * 0.6;
  const T z = y * 0.8 + point[2] * 0.6;
  point[1] = (y * 0.6 - point[2] * 0.8) * 2.0 + 31.7;
  point[0] = x * 2.0 + 17.3;
  point[2] = z * 2.0 + 5.9;
}

/// Returns the sum of octaves, each within ±NoiseLattice::kLargest times its height. If `times` times the sum
/// is certain to reach `most`, the function may return `most` / `times` instead.
template <class T>
T octaves_of(const NoiseLattice& lattice, const NoiseNumbers<T>& noise, const T at[3], double shift = 0.0,
             double times = 1.0, double most = std::numeric_limits<double>::infinity()) {
  T point[3] = {at[0] * noise.frequency + shift, at[1] * noise.frequency - shift,
                at[2] * noise.frequency + 2.0 * shift};
  T sum(0.0), height(1.0);
  double to_come = NoiseLattice::kLargest * octave_total(noise);
  for (int k = 0; k < noise.octaves; ++k) {
    if (times * value_of(sum) - std::abs(times) * to_come >= most) return T(most / times);
    sum = sum + height * noise_of(lattice, point);
    to_come -= NoiseLattice::kLargest * value_of(height);
    height = height * noise.gain;
    if (k + 1 < noise.octaves) to_next_octave(point);
  }
  return sum;
}

/// Returns ridges, from 0 to 1 on their crests. An octave's ridge is (1 - |n| / 0.6)², 0 where |n| is larger:
/// narrow around the surfaces on which the noise n is 0. An octave is weighted by the ridge of the previous
/// octave (after F. K. Musgrave's ridged multifractal, in Ebert et al., "Texturing and Modeling", 2003). If
/// the sum is certain to stay below `least`, the function may return any number below `least`.
template <class T>
T ridges_of(const NoiseLattice& lattice, const NoiseNumbers<T>& noise, const T at[3], double least = 0.0) {
  constexpr double kReach = 0.6, kRounding = 0.02;  // of the crest, so that it has a slope everywhere
  T point[3] = {at[0] * noise.frequency, at[1] * noise.frequency, at[2] * noise.frequency};
  T sum(0.0), total(0.0), height(1.0), weight(1.0);
  double to_come = octave_total(noise);
  const double whole = to_come;
  for (int k = 0; k < noise.octaves; ++k) {
    // No later octave weighs more than this one.
    if (value_of(sum) + value_of(weight) * to_come < least * whole) return T(least - 1.0);
    const T n = noise_of(lattice, point);
    const T off =
        larger(T(1.0) - (square_root(n * n + kRounding * kRounding) - kRounding) * (1.0 / kReach), T(0.0));
    weight = weight * off * off;
    sum = sum + height * weight;
    total = total + height;
    to_come -= value_of(height);
    height = height * noise.gain;
    if (k + 1 < noise.octaves) to_next_octave(point);
  }
  return sum / total;
}

}  // namespace vegard::sim
