// The light of strands against integrals that are known, against the density's definition marched step by
// step, and its derivatives against differences.
#include "sim/emit/sun/strand/strand_emitter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/sun_rays.h"

namespace vegard::sim::strand_emitter_test {
namespace {

using tests::level_sun;
using tests::light_of_film;
using tests::straight;
using tests::strand_of;
using tests::sun_ray;
using tests::SunRay;

constexpr double kPi = 3.14159265358979323846;
constexpr RadialFalloff kAll[] = {RadialFalloff::smooth, RadialFalloff::linear, RadialFalloff::gaussian};

double plain(const double& number) { return number; }

StrandEmitter<double> emitter_of(const Strands<double>& strands, double distance,
                                 std::vector<double> light = {1.0}) {
  const Sun sun = level_sun(distance);
  return {strands, sun, SunFrame<double>(sun, plain), std::move(light)};
}

/// Of a chord through a tube of radius 1 that passes the axis at the distance b, per length of the radius.
double chord(RadialFalloff falloff, double b) {
  const double h = std::sqrt(1.0 - b * b);
  if (falloff == RadialFalloff::smooth) return 16.0 / 15.0 * std::pow(h, 5.0);
  if (falloff == RadialFalloff::linear)
    return b > 0.0 ? h - b * b * std::log((1.0 + h) / b) : 1.0;  // ∫ 1 - sqrt(b² + s²)
  return std::exp(-4.5 * b * b) * std::sqrt(kPi / 4.5) * std::erf(std::sqrt(4.5) * h);
}

/// What a ray may be off by, of a strand's brightest chord (the header's quadratures).
double tolerance(RadialFalloff falloff) {
  return falloff == RadialFalloff::smooth ? 1e-9 : falloff == RadialFalloff::linear ? 4e-3 : 3e-4;
}

/// The integral of a falloff over a cross-section of radius 1.
double section(RadialFalloff falloff) {
  return falloff == RadialFalloff::gaussian ? kPi / 4.5 * (1.0 - std::exp(-4.5)) : kPi / 3.0;
}

TEST(StrandEmitter, AStraightStrandAtRightAnglesIsItsChord) {
  constexpr double kDistance = 1000.0;
  for (const RadialFalloff falloff : kAll) {
    Strands<double> strands{falloff, {straight({0, -50, 0}, {0, 50, 0}, 3.0, 2.0)}};
    const StrandEmitter<double> emitter = emitter_of(strands, kDistance, {7.0});
    for (const double up : {0.0, 0.3, 1.1, 2.0, 2.9}) {
      const double b = kDistance * up / std::hypot(kDistance, up) / 3.0;
      EXPECT_NEAR(sun_ray(emitter, kDistance, 0.0, up).rayleigh, 7.0 * 2.0 * 3.0 * chord(falloff, b),
                  7.0 * 2.0 * 3.0 * tolerance(falloff))
          << up;
    }
    EXPECT_EQ(sun_ray(emitter, kDistance, 0.0, 3.1).rayleigh, 0.0);
    EXPECT_EQ(sun_ray(emitter, kDistance, 51.0, 0.0).rayleigh, 0.0) << "it ends flat";
    EXPECT_GT(sun_ray(emitter, kDistance, 49.0, 0.0).rayleigh, 1.0);
  }
}

TEST(StrandEmitter, AtASlantTheChordIsLongerByTheSine) {
  constexpr double kDistance = 1000.0;
  for (const RadialFalloff falloff : kAll)
    for (const double angle_deg : {80.0, 45.0, 15.0}) {
      const double angle = angle_deg * kPi / 180.0;
      const Vec3<double> axis = {std::cos(angle), std::sin(angle), 0.0};
      Strands<double> strands{falloff, {straight(times3(axis, -50.0), times3(axis, 50.0), 3.0)}};
      const StrandEmitter<double> emitter = emitter_of(strands, kDistance);
      for (const double up : {0.0, 1.0, 2.5}) {
        const Vec3<double> from = {kDistance, 0.0, 0.0}, d = unit3(Vec3<double>{-kDistance, 0.0, up});
        const Vec3<double> normal = cross3(d, axis);
        const double sine = length3(normal), b = std::abs(dot3(from, normal)) / sine / 3.0;
        EXPECT_NEAR(sun_ray(emitter, kDistance, 0.0, up).rayleigh, 3.0 * chord(falloff, b) / sine,
                    3.0 / sine * tolerance(falloff))
            << angle_deg << " " << up;
      }
    }
}

TEST(StrandEmitter, AlongItsAxisAStrandIsItsLength) {
  // From joint to joint the pieces of the way add up, with a density that changes along it.
  Strands<double> strands{
      RadialFalloff::smooth,
      {strand_of<double>({{-3, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {3, 0, 0}}, 1.0, 1.0, {0.0, 2.0, 1.0, 4.0})}};
  const SunRay ray = sun_ray(emitter_of(strands, 100.0), 100.0, 0.0, 0.0);
  EXPECT_NEAR(ray.rayleigh, 2.0 * (0.5 * (0.0 + 2.0) + 0.5 * (2.0 + 1.0) + 0.5 * (1.0 + 4.0)), 1e-12);
  EXPECT_NEAR(ray.entry_km, 97.0, 1e-9);
}

/// A leaning loop, which narrows and grows brighter.
template <class T>
Strand<T> loop() {
  return strand_of<T>(
      {{T(1), T(-20), T(-10)}, {T(4), T(-22), T(24)}, {T(-9), T(14), T(30)}, {T(0), T(18), T(-12)}}, T(2.0),
      T(1.2), {T(1.0), T(1.5), T(3.0), T(2.5), T(2.0)});
}

Vec3<double> on_curve(const Strand<double>& s, double u) {
  const double v = 1.0 - u;
  Vec3<double> p;
  for (int i = 0; i < 3; ++i)
    p[i] = v * v * v * s.points[0][i] + 3 * v * v * u * s.points[1][i] + 3 * v * u * u * s.points[2][i] +
           u * u * u * s.points[3][i];
  return p;
}

double along_at(const Strand<double>& s, double t) {
  const double at = t * (s.along.size() - 1);
  const int k = std::min(static_cast<int>(at), static_cast<int>(s.along.size()) - 2);
  return s.along[k] + (at - k) * (s.along[k + 1] - s.along[k]);
}

/// The integral of density over space, of the curve at 20000 steps.
double volume_integral(const Strand<double>& s, RadialFalloff falloff) {
  double sum = 0.0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps, r = s.radius_first + (s.radius_last - s.radius_first) * t;
    sum += along_at(s, t) * r * r *
           length3(minus3(on_curve(s, (i + 1.0) / kSteps), on_curve(s, static_cast<double>(i) / kSteps)));
  }
  return sum * section(falloff);
}

TEST(StrandEmitter, AFilmHoldsTheWholeDensity) {
  // Seen from so far off that rays are parallel to 1e-5. Cells are a tenth of the radius; a Gaussian's edge,
  // where it falls from 1 % to nothing, is that much less well summed.
  constexpr double kDistance = 1e6;
  for (const RadialFalloff falloff : kAll) {
    const Strands<double> line{falloff, {straight({10, -11, -6}, {-9, 12, 7}, 1.7, 1.3)}},
        bent{falloff, {loop<double>()}};
    const double of_line = 1.3 * 1.7 * 1.7 * std::sqrt(19.0 * 19 + 23 * 23 + 13 * 13) * section(falloff);
    EXPECT_NEAR(light_of_film(emitter_of(line, kDistance), kDistance, 15.0, 180) / of_line, 1.0, 1e-3);
    // Chords are shorter than their arcs by 1e-4 or so.
    EXPECT_NEAR(light_of_film(emitter_of(bent, kDistance), kDistance, 25.0, 300) /
                    volume_integral(loop<double>(), falloff),
                1.0, 2e-3);
  }
}

TEST(StrandEmitter, ThinStrandsKeepTheirLightOnAnyFilm) {
  // Far narrower than a pixel of any of these films: unless they were widened, nearly all rays would miss.
  constexpr double kDistance = 1e6;
  for (const RadialFalloff falloff : kAll) {
    Strands<double> strands{falloff, {}};
    double whole = 0.0;
    for (int k = 0; k < 7; ++k) {
      Strand<double> s = loop<double>();
      for (auto& point : s.points) point[1] = 0.8 * point[1] + 0.63 * k;
      s.radius_first = s.radius_last = 0.01;
      strands.all.push_back(s);
      whole += volume_integral(s, falloff);
    }
    const StrandEmitter<double> emitter = emitter_of(strands, kDistance);
    // 2 % is what the header says of a Gaussian along the film's rows at worst.
    for (const int cells : {20, 33, 64, 150})
      EXPECT_NEAR(light_of_film(emitter, kDistance, 30.0, cells) / whole, 1.0, 0.02) << cells;
  }
}

TEST(StrandEmitter, AThinStrandIsLitAllAlong) {
  // Along a row of a film it is not to be seen in steps: what a row's columns hold differs by the share of a
  // wave of a pixel's length alone.
  constexpr double kDistance = 1e6, kCell = 0.5;
  const Strands<double> strands{RadialFalloff::smooth, {straight({0, -30, -3.1}, {0, 30, 4.3}, 1e-3)}};
  const StrandEmitter<double> emitter = emitter_of(strands, kDistance);
  double least = 1e300, most = 0.0;
  for (int i = -50; i < 50; ++i) {
    double column = 0.0;
    for (int j = -40; j < 40; ++j)
      column += sun_ray(emitter, kDistance, (i + 0.5) * kCell, (j + 0.5) * kCell, kCell / kDistance).rayleigh;
    least = std::min(least, column);
    most = std::max(most, column);
  }
  EXPECT_LT(most / least, 1.03);
}

/// The density as sim/emit/sun/strand/strand.h has it, marched.
double marched(const Strand<double>& s, RadialFalloff falloff, double distance, double right, double up) {
  constexpr int kSteps = 600, kPlaces = 200;
  std::vector<Vec3<double>> places;
  for (int k = 0; k <= kPlaces; ++k) places.push_back(on_curve(s, static_cast<double>(k) / kPlaces));
  const Vec3<double> from = {distance, 0, 0}, d = unit3(Vec3<double>{-distance, right, up});
  double sum = 0.0;
  const double reach = 30.0, step = 2.0 * reach / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3<double> p = along3(from, distance - reach + (i + 0.5) * step, d);
    double best = 1e300, t = 0.0;
    for (int k = 0; k < kPlaces; ++k) {
      const Vec3<double> way = minus3(places[k + 1], places[k]), to = minus3(p, places[k]);
      const double w = std::min(std::max(dot3(to, way) / dot3(way, way), 0.0), 1.0);
      const Vec3<double> off = along3(to, -w, way);
      if (dot3(off, off) < best) {
        best = dot3(off, off);
        t = (k + w) / kPlaces;
      }
    }
    if (t <= 0.0 || t >= 1.0) continue;  // beyond an end
    const double q = std::sqrt(best) / (s.radius_first + (s.radius_last - s.radius_first) * t);
    if (q >= 1.0) continue;
    const double shape = falloff == RadialFalloff::smooth   ? (1 - q * q) * (1 - q * q)
                         : falloff == RadialFalloff::linear ? 1 - q
                                                            : std::exp(-4.5 * q * q);
    sum += along_at(s, t) * shape * step;
  }
  return sum;
}

TEST(StrandEmitter, AgreesWithItsDensityMarched) {
  // Chords may lie a twentieth of the radius beside their curve, on average two thirds of that, where light
  // falls by up to 1.5 (smooth) or 1.8 (Gaussian) over a radius: 6 % of the brightest ray at most.
  constexpr double kDistance = 400.0;
  for (const RadialFalloff falloff : kAll) {
    const StrandEmitter<double> emitter = emitter_of({falloff, {loop<double>()}}, kDistance);
    double brightest = 0.0, worst = 0.0, difference = 0.0, sum = 0.0;
    for (int i = 0; i < 60; ++i) {
      const double turn = 0.61803398875 * i, t = (i + 0.5) / 60.0;
      const Vec3<double> near = on_curve(loop<double>(), t);
      const double right = near[1] + 1.6 * (turn - std::floor(turn) - 0.5),
                   up = near[2] + 0.8 * std::cos(7.0 * i);
      const double here = sun_ray(emitter, kDistance, right, up).rayleigh,
                   there = marched(loop<double>(), falloff, kDistance, right, up);
      brightest = std::max(brightest, there);
      worst = std::max(worst, std::abs(here - there));
      difference += here - there;
      sum += there;
    }
    EXPECT_GT(brightest, 3.0);
    EXPECT_LT(worst / brightest, 0.06);
    EXPECT_LT(std::abs(difference / sum), 0.01);
  }
}

TEST(StrandEmitter, EndsWhereTheRayDoes) {
  const Strands<double> strands{RadialFalloff::smooth, {straight({0, -5, 0}, {0, 5, 0}, 1.0)}};
  const StrandEmitter<double> emitter = emitter_of(strands, 100.0);
  const SunRay whole = sun_ray(emitter, 100.0, 0.0, 0.0),
               half = sun_ray(emitter, 100.0, 0.0, 0.0, 0.0, 100.0),
               none = sun_ray(emitter, 100.0, 0.0, 0.0, 0.0, 99.0);
  EXPECT_NEAR(half.rayleigh, 0.5 * whole.rayleigh, 1e-12);
  EXPECT_NEAR(whole.depth_km, 100.0, 1e-9);
  EXPECT_NEAR(whole.entry_km, 99.0, 1e-9);
  EXPECT_LT(half.depth_km, 100.0);
  EXPECT_EQ(none.rayleigh, 0.0);
  EXPECT_TRUE(std::isinf(none.depth_km));
}

TEST(StrandEmitter, FindsEverySegment) {
  // A ray through all of them together meets what rays through each alone meet.
  constexpr double kDistance = 300.0;
  Strands<double> all{RadialFalloff::smooth, {}};
  std::vector<StrandEmitter<double>> single;
  for (int k = 0; k < 40; ++k) {
    Strand<double> s = loop<double>();
    for (auto& point : s.points) {
      point[0] += 7.0 * std::sin(1.3 * k);
      point[1] += 0.4 * (k - 20);
    }
    s.radius_first = s.radius_last = k % 3 == 0 ? 0.05 : 1.0;
    all.all.push_back(s);
    single.push_back(emitter_of({RadialFalloff::smooth, {s}}, kDistance));
  }
  const StrandEmitter<double> together = emitter_of(all, kDistance);
  int lit = 0;
  for (int i = 0; i < 300; ++i) {
    const double right = 0.15 * (i - 150), up = 8.0 + 15.0 * std::sin(0.7 * i),
                 cell = i % 2 == 0 ? 0.0 : 1e-3;
    double sum = 0.0;
    for (const auto& one : single) sum += sun_ray(one, kDistance, right, up, cell).rayleigh;
    const double here = sun_ray(together, kDistance, right, up, cell).rayleigh;
    EXPECT_NEAR(here, sum, 1e-9 * (1.0 + sum));
    lit += here > 0.0;
  }
  EXPECT_GT(lit, 100);
}

/// The loop, with fifteen numbers added to its own.
template <class T>
Strands<T> moved(RadialFalloff falloff, const std::function<T(int)>& number) {
  Strand<T> s = loop<T>();
  for (int p = 0; p < 4; ++p)
    for (int axis = 0; axis < 3; ++axis) s.points[p][axis] = s.points[p][axis] + number(3 * p + axis);
  s.radius_first = s.radius_first + number(12);
  s.along[2] = s.along[2] + number(13);
  s.radius_last = s.radius_last + number(14);
  return {falloff, {s}};
}

TEST(StrandEmitter, DerivativesAreThoseOfItsLight) {
  constexpr double kDistance = 250.0;
  const Sun sun = level_sun(kDistance);
  for (const RadialFalloff falloff : kAll)
    for (const double cell_rad : {0.0, 0.02}) {  // the latter widens its narrow end
      const NumberAs<FreeDual> constant = [](const double& x) { return FreeDual(x); };
      const StrandEmitter<FreeDual> dual(moved<FreeDual>(falloff,
                                                         [](int i) {
                                                           FreeDual x(0.0);
                                                           x.d.t[i] = 1.0;
                                                           return x;
                                                         }),
                                         sun, SunFrame<FreeDual>(sun, constant), {FreeDual(1.0)});
      int compared = 0;
      for (int k = 0; k < 12; ++k) {
        const Vec3<double> near = on_curve(loop<double>(), (k + 0.4) / 12.0);
        const double right = near[1] + 0.31 * std::sin(2.0 * k), up = near[2] + 0.4 * std::cos(3.0 * k);
        const double length = std::sqrt(right * right + up * up + kDistance * kDistance);
        const FreeDual d[3] = {FreeDual(right / length), FreeDual(kDistance / length), FreeDual(up / length)};
        FreeDual light(0.0), kept(1.0);
        double end = std::numeric_limits<double>::infinity(), entry, depth;
        dual.march({1, {&d[0], &d[1], &d[2]}, &end, cell_rad}, {1, &light, &kept, &entry, &depth});
        ASSERT_GT(light.v, 0.0);
        for (int i = 0; i < 15; ++i) {
          constexpr double kStep = 1e-5;
          const auto with = [&](double value) {
            const auto strands = moved<double>(falloff, [&](int j) { return j == i ? value : 0.0; });
            return sun_ray(emitter_of(strands, kDistance), kDistance, right, up, cell_rad).rayleigh;
          };
          EXPECT_NEAR(light.d.t[i], (with(kStep) - with(-kStep)) / (2.0 * kStep), 1e-5 * (1.0 + light.v))
              << "number " << i << " ray " << k;
          compared += std::abs(light.d.t[i]) > 1e-3;
        }
      }
      EXPECT_GT(compared, 60);
    }
}

}  // namespace
}  // namespace vegard::sim::strand_emitter_test
