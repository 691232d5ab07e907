#include "sim/emit/sun/strand/macro_loop.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/base/number/smooth_step.h"
#include "sim/base/number/vec3.h"
#include "sim/emit/sun/solar_rotation.h"
#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim {
namespace {

/// The random numbers of a strand: standard normal ones, and the one by which the middles of bunches are
/// drawn.
struct StrandChance {
  double root[2][2];  ///< [foot][along, across]
  double height, tilt, density;
  std::uint32_t lot;

  StrandChance(std::uint64_t seed, std::uint32_t strand, std::uint32_t loop) {
    const auto normal = [](std::uint32_t word) { return normal_quantile(uniform(word)); };
    const Words roots = random_words(seed, Stream::strand, strand, loop, 0);
    const Words shape = random_words(seed, Stream::strand, strand, loop, 1);
    for (int foot = 0; foot < 2; ++foot)
      for (int way = 0; way < 2; ++way) root[foot][way] = normal(roots[2 * foot + way]);
    height = normal(shape[0]);
    tilt = normal(shape[1]);
    density = normal(shape[2]);
    lot = shape[3];
  }
};

/// The loop's numbers as T, and its directions.
template <class T>
struct LoopShape {
  Vec3<T> up, along, across;
  T radius, height, width, sharpness, skew, tilt, tilt_per_distance, spread;
  T root_noise, height_noise, tilt_noise;

  LoopShape(const Sun& sun, const Loop& l, const NumberAs<T>& number)
      : radius(number(sun.radius)),
        height(number(l.height)),
        width(number(l.width)),
        sharpness(number(l.sharpness)),
        skew(number(l.skew)),
        tilt(number(l.tilt_deg) * kRadiansPerDegree),
        tilt_per_distance(number(l.tilt_per_distance_deg) * kRadiansPerDegree),
        spread(number(l.spread)),
        root_noise(number(l.root_noise)),
        height_noise(number(l.height_noise)),
        tilt_noise(number(l.tilt_noise_deg) * kRadiansPerDegree) {
    const SunPlace<T> place = sun_place(number(l.latitude_deg), number(l.longitude_deg));
    const T bearing = number(l.bearing_deg) * kRadiansPerDegree;
    const T s = sine(bearing), c = cosine(bearing);
    for (int i = 0; i < 3; ++i) {
      up[i] = place.up[i];
      along[i] = place.north[i] * c + place.west[i] * s;
      across[i] = place.west[i] * c - place.north[i] * s;
    }
  }

  /// Returns the place on the photosphere straight below or above a place of the tangent plane.
  Vec3<T> foot(T a, T x) const {
    const T square = a * a + x * x;
    const T most = radius * radius * 0.999;
    if (value_of(square) > value_of(most)) {
      const T shrink = square_root(most / square);
      a = a * shrink;
      x = x * shrink;
    }
    return along3(along3(times3(up, square_root(radius * radius - a * a - x * x)), a, along), x, across);
  }

  std::vector<Vec3<T>> points(double share, const StrandChance& chance) const {
    const T x = T(0.0) + spread * share;  // never -0
    Vec3<T> feet[2];
    for (int f = 0; f < 2; ++f)
      feet[f] = foot(width * (f == 0 ? -0.5 : 0.5) + root_noise * chance.root[f][0],
                     x + root_noise * chance.root[f][1]);
    const Vec3<T> chord = minus3(feet[1], feet[0]);
    const T length = length3(chord);
    const Vec3<T> c = times3(chord, T(1.0) / length);
    const Vec3<T> middle = times3(along3(feet[0], T(1.0), feet[1]), T(0.5));
    Vec3<T> upright = along3(up, T(0.0) - dot3(up, c), c);
    upright = unit3(upright);
    const Vec3<T> right = cross3(c, upright);
    const T angle = tilt + tilt_per_distance * x + tilt_noise * chance.tilt;
    const Vec3<T> h = along3(times3(upright, cosine(angle)), sine(angle), right);
    const Vec3<T> n = cross3(c, h);
    T share_of_height = height_noise * chance.height + 1.0;
    if (!(value_of(share_of_height) > 0.05)) share_of_height = T(0.05);
    const Vec3<T> above = along3(middle, height * share_of_height * (4.0 / 3.0), h);
    const T aside = (T(1.0) - sharpness) * length * 0.5;
    return {feet[0], along3(along3(above, T(0.0) - aside, c), skew, n),
            along3(along3(above, aside, c), T(0.0) - skew, n), feet[1]};
  }
};

template <class T>
Vec3<T> top_of(const std::vector<Vec3<T>>& p) {
  Vec3<T> top;
  for (int i = 0; i < 3; ++i) top[i] = (p[0][i] + p[3][i]) * 0.125 + (p[1][i] + p[2][i]) * 0.375;
  return top;
}

/// Numbers of the strands that bunches have in their middles, ascending.
std::vector<int> middles_of_bunches(const std::vector<StrandChance>& chance, int filaments) {
  std::vector<int> order(chance.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return chance[a].lot < chance[b].lot; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(std::max(filaments, 0))));
  std::sort(order.begin(), order.end());
  return order;
}

template <class T>
void draw_together(const std::vector<int>& middles, const T& pull, std::vector<Strand<T>>& all) {
  if (middles.empty()) return;
  std::vector<Vec3<T>> tops;
  for (const Strand<T>& strand : all) tops.push_back(top_of(strand.points));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const int strand = static_cast<int>(k);
    const int middle = *std::min_element(middles.begin(), middles.end(), [&](int a, int b) {
      return std::abs(a - strand) < std::abs(b - strand);
    });
    const Vec3<T> way = minus3(tops[middle], tops[k]);
    for (int p = 1; p <= 2; ++p) all[k].points[p] = along3(all[k].points[p], pull * (4.0 / 3.0), way);
  }
}

/// Either half goes with its foot.
template <class T>
void turn_with_feet(const SolarTurn& turn, Strand<T>& strand) {
  for (const int foot : {0, 3}) {
    const Vec3<T> at = strand.points[foot];
    const T angle = turn.angle_at_rad(at[0], at[1], at[2]);
    for (const int p : {foot, foot == 0 ? 1 : 2}) strand.points[p] = turned_west(strand.points[p], angle);
  }
}

/// 1 where most, `least` where least; z from 0 at the feet to 1 at the top.
template <class T>
T height_falloff(HeightFalloff falloff, const T& least, double z) {
  const T range = T(1.0) - least;
  switch (falloff) {
    case HeightFalloff::grow:
      return least + range * z;
    case HeightFalloff::fade:
      return T(1.0) - range * z;
    case HeightFalloff::logarithmic:
      return T(1.0) - range * (std::log1p(9.0 * z) / std::log(10.0));
    case HeightFalloff::inverse_square:
      return least + range * ((1.0 / ((1.0 + 3.0 * z) * (1.0 + 3.0 * z)) - 0.0625) / 0.9375);
    case HeightFalloff::none:
      break;
  }
  return T(1.0);
}

/// Density along a strand on which chance has no bearing.
template <class T>
std::vector<T> density_along(const Loop& loop, const NumberAs<T>& number) {
  const T base = number(loop.base_density), least = number(loop.falloff_least);
  const T more = number(loop.brightening), at = number(loop.brightening_at);
  const T width = number(loop.brightening_width);
  std::vector<T> along;
  for (int i = 0; i < kDensitiesAlong; ++i) {
    const double t = static_cast<double>(i) / (kDensitiesAlong - 1), z = 4.0 * t * (1.0 - t);
    const T off = (at - z) / width;
    const T here = height_falloff(loop.height_falloff, least, z) + more * exponential(off * off * -0.5);
    along.push_back(base * here * (loop.foot_fade > 0.0 ? smooth_step(z / loop.foot_fade) : 1.0));
  }
  return along;
}

}  // namespace

template <class T>
Strands<T> strands_of(const Sun& sun, const Loop& loop, std::uint64_t seed, const NumberAs<T>& number,
                      double instant_s) {
  const LoopShape<T> shape(sun, loop, number);
  const std::vector<T> along = density_along(loop, number);
  const T radius = number(loop.strand_radius), noise = number(loop.density_noise);
  std::vector<StrandChance> chance;
  for (int k = 0; k < loop.strands; ++k)
    chance.emplace_back(seed, static_cast<std::uint32_t>(k), name_number(loop.name));

  Strands<T> made;
  made.falloff = loop.density_falloff;
  for (int k = 0; k < loop.strands; ++k) {
    const double share = (2.0 * k + 1.0 - loop.strands) / loop.strands;
    Strand<T> strand{shape.points(share, chance[k]), radius, radius, along};
    const T gain = exponential(noise * chance[k].density - noise * noise * 0.5);
    for (T& density : strand.along) density = density * gain;
    made.all.push_back(std::move(strand));
  }
  draw_together(middles_of_bunches(chance, loop.filaments), number(loop.filament_pull), made.all);
  const SolarTurn turn(sun, instant_s);
  if (turn.turns())
    for (Strand<T>& strand : made.all) turn_with_feet(turn, strand);
  return made;
}

template Strands<double> strands_of(const Sun&, const Loop&, std::uint64_t, const NumberAs<double>&, double);
template Strands<FreeDual> strands_of(const Sun&, const Loop&, std::uint64_t, const NumberAs<FreeDual>&,
                                      double);

}  // namespace vegard::sim
