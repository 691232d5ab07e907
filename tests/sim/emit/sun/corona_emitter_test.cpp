#include "sim/emit/sun/corona_emitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "tests/support/kind_named.h"
#include "tests/support/one_sun.h"

namespace vegard::sim::corona_emitter_test {
namespace {

using tests::light_past;
using tests::one_sun;
using tests::RaysPast;

constexpr double kPi = 3.14159265358979323846;

Scene one_corona(std::vector<double> share, std::vector<double> power) {
  Scene scene = one_sun();
  scene.sun.distance_km = 100.0;
  Corona c;
  c.share = std::move(share);
  c.power = std::move(power);
  c.rayleigh = {20.0, 3.0};
  c.reach = 8.0;
  scene.coronae = {c};
  return scene;
}

/// Of the first line.
std::vector<double> light_of(const Scene& scene, const RaysPast& rays) {
  auto light = light_past<double>(CoronaEmitter<double>(scene, scene.coronae[0], plain_number), rays);
  light.rayleigh.resize(rays.end_km.size());
  return light.rayleigh;
}

/// ∫ f(s) ds by the midpoint rule in t, s = at + t³, which draws points together at s = `at`.
double plain_sum(double from, double to, double at, const std::function<double(double)>& f) {
  constexpr int kPieces = 20000;
  const double low = std::cbrt(from - at), step = (std::cbrt(to - at) - low) / kPieces;
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const double t = low + (i + 0.5) * step;
    sum += f(at + t * t * t) * 3.0 * t * t * step;
  }
  return sum;
}

TEST(CoronaEmitter, OfOnePowerIsTheClosedFormOverALongWay) {
  // ∫ (b² + s²)^(-p/2) ds = sqrt(pi) b^(1 - p) Γ((p - 1) / 2) / Γ(p / 2); b and s in radii.
  for (const double p : {3.0, 6.0, 16.0, 40.0, 100.0}) {
    Scene scene = one_corona({1.0}, {p});
    scene.sun.distance_km = 9000.0;
    scene.coronae[0].reach = 899.0;
    scene.coronae[0].density = 1.7;
    RaysPast rays;
    const std::vector<double> passes = {1.0, 1.001, 1.3, 2.5, 20.0};
    for (const double b : passes) rays.add(b * 10.0 / 90.0, 0.0);  // one_sun() is 90 times nearer
    const std::vector<double> light = light_of(scene, rays);
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const double whole =
          std::sqrt(kPi) * std::pow(passes[i], 1.0 - p) * std::tgamma(0.5 * (p - 1.0)) / std::tgamma(0.5 * p);
      // Beyond its reach, where b counts for little, there would be 2 reach^(1 - p) / (p - 1) more.
      const double left_out = 2.0 * std::pow(899.0, 1.0 - p) / (p - 1.0);
      EXPECT_NEAR(light[i] / (20.0 * 1.7 * 10.0 * (whole - left_out)), 1.0, p > 32.0 ? 1e-5 : 1e-7)
          << "power " << p << ", " << passes[i] << " radii";
    }
  }
}

TEST(CoronaEmitter, EndsAtThePhotosphere) {
  const Scene scene = one_corona({1.0}, {4.0});
  RaysPast rays;
  rays.add(0.0, 0.0);
  // ∫ r^-4 dr from 1 to 8 radii.
  EXPECT_NEAR(light_of(scene, rays)[0], 20.0 * 10.0 * (1.0 - std::pow(8.0, -3.0)) / 3.0, 1e-6);
}

TEST(CoronaEmitter, OfTheSquareIsThatOfTwiceThePower) {
  Scene scene = one_corona({1.0}, {3.5});
  Scene twice = one_corona({1.0}, {7.0});
  scene.coronae[0].density = 0.3;
  twice.coronae[0].density = 0.09;
  scene.coronae[0].light = CoronaLight::square;
  RaysPast rays;
  for (int i = 0; i < 30; ++i) rays.add(1.0 * i, 0.4 * i);
  const std::vector<double> light = light_of(scene, rays), other = light_of(twice, rays);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(light[i], other[i], 1e-12 * other[i]);
}

TEST(CoronaEmitter, IsTheSumAlongTheRayOfAnyLightAndShape) {
  for (const char* kind : {"density", "square", "scattered"}) {
    Scene scene = one_corona({0.1, 0.4, 0.5}, {1.5, 6.0, 16.0});
    scene.coronae[0].light = tests::kind_named<CoronaLight>(kind);
    scene.coronae[0].polar = 0.4;
    scene.sun.limb_darkening = 0.6;
    const std::vector<double> passes = {0.0,   3.0,  9.0,  9.9,  9.999, 10.0, 10.001,
                                        10.01, 10.1, 11.0, 15.0, 40.0,  75.0};
    RaysPast rays;
    for (const double b : passes) rays.add(0.6 * b, 0.8 * b);
    const std::vector<double> light = light_of(scene, rays);
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const double b = passes[i], far = std::sqrt(6400.0 - b * b);
      // The observer is 100 away: a ray's direction has a part to the north.
      const double tilt = b / 100.0, level = std::sqrt(1.0 - tilt * tilt);
      const auto f = [&](double s) {
        const double r2 = b * b + s * s, r = std::sqrt(r2) / 10.0;
        const double north = 0.8 * (b * level + tilt * s);
        const double n = (0.1 * std::pow(r, -1.5) + 0.4 * std::pow(r, -6.0) + 0.5 * std::pow(r, -16.0)) *
                         (1.0 - 0.6 * north * north / r2);
        if (std::string(kind) == "density") return n;
        if (std::string(kind) == "square") return n * n;
        return n * scattered_light(std::min(1.0, 100.0 / r2), b * b / r2, 0.6, 0.0) /
               scattered_light(1.0, 1.0, 0.6, 0.0);
      };
      const double to = b < 10.0 ? -std::sqrt(100.0 - b * b) : far;
      EXPECT_NEAR(light[i] / (20.0 * plain_sum(-far, to, b < 10.0 ? to : 0.0, f)), 1.0, 1e-6)
          << kind << ", " << b;
    }
  }
}

TEST(CoronaEmitter, BeginsAndEndsWithTheRay) {
  Scene scene = one_corona({1.0}, {2.0});
  const double b = 12.0, nearest = std::sqrt(1e4 - b * b);
  // ∫ ds / (b² + s²) = atan(s / b) / b.
  const auto between = [&](double from, double to) {
    return 20.0 * 100.0 * (std::atan(to / b) - std::atan(from / b)) / b;
  };
  const double far = std::sqrt(6400.0 - b * b);
  RaysPast rays;
  for (const double end : {nearest - 50.0, nearest - 3.0, nearest, nearest + 3.0, nearest + 60.0})
    rays.add(b, 0.0, end);
  const std::vector<double> light = light_of(scene, rays);
  std::size_t i = 0;
  for (const double end : {-50.0, -3.0, 0.0, 3.0, 60.0}) EXPECT_NEAR(light[i++], between(-far, end), 1e-5);
  // An observer within it, who looks aside and away.
  scene.sun.distance_km = 20.0;
  RaysPast around;
  around.add(60.0, 0.0);  // sine 0.6: 12 units from the middle, 16 of them ahead
  around.add(60.0, 0.0);
  around.direction[1][1] = -around.direction[1][1];
  const std::vector<double> within = light_of(scene, around);
  EXPECT_NEAR(within[0], between(-16.0, far), 1e-5);
  EXPECT_NEAR(within[1], between(16.0, far), 1e-5);
}

TEST(CoronaEmitter, OfBaumbachsElectronsHasBaumbachsBrightness) {
  // C. W. Allen, "Astrophysical quantities", after S. Baumbach (1937, Astronomische Nachrichten 263, 121):
  // electrons cm^-3 and, in 1e-6 of the Sun's light at the middle of its disc, brightness, by radii.
  Scene scene = one_corona({0.036, 1.55, 2.99}, {1.5, 6.0, 16.0});
  scene.sun.distance_km = 9000.0;
  scene.sun.limb_darkening = 0.6;
  Corona& c = scene.coronae[0];
  c.density = 1e8;
  c.reach = 100.0;
  c.light = CoronaLight::scattered;
  const double half_square_cm = 0.5 * 2.8179403e-13 * 2.8179403e-13;  // of the electron's radius
  const double radius_cm = 6.957e10;
  c.rayleigh = {half_square_cm * scattered_light(1.0, 1.0, 0.6, 0.0) * radius_cm / scene.sun.radius, 0.0};
  RaysPast rays;
  const std::vector<double> passes = {1.03, 1.1, 1.2, 1.4, 1.6, 2.0, 2.5, 3.0};
  for (const double b : passes) rays.add(b * 10.0 / 90.0, 0.0);
  const std::vector<double> light = light_of(scene, rays);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const double x = passes[i];
    const double baumbach =
        1e-6 * (0.0532 * std::pow(x, -2.5) + 1.425 * std::pow(x, -7.0) + 2.565 * std::pow(x, -17.0));
    EXPECT_NEAR(light[i] / baumbach, 1.0, 0.1) << x << " radii";
  }
}

TEST(CoronaEmitter, DerivativesAreThoseOfCentralDifferences) {
  Scene scene = one_corona({0.3, 0.7}, {2.0, 9.0});
  scene.sun.latitude_deg = 7.0;
  scene.sun.position_angle_deg = 20.0;
  scene.sun.limb_darkening = 0.5;
  scene.sun.limb_darkening_square = 0.1;
  scene.coronae[0].polar = 0.5;
  RaysPast rays;
  for (int i = 0; i < 20; ++i) rays.add(1.3 * i - 7.0, 0.7 * i - 3.0);
  for (const char* kind : {"density", "square", "scattered"}) {
    scene.coronae[0].light = tests::kind_named<CoronaLight>(kind);
    const auto make = [&](const Scene& of, const auto& number) {
      using T = decltype(number(of.sun.radius));
      return std::make_unique<CoronaEmitter<T>>(of, of.coronae[0], number);
    };
    const auto moved = tests::check_sun_derivatives(scene, rays, 0.0, {"sun", "corona"}, 1e-5, 1e-6, make);
    // Azimuth, elevation, distance, position angle, latitude; density, polar, two shares, powers and lines;
    // and the law of darkening if the light is the Sun's.
    EXPECT_EQ(moved.size(), std::string(kind) == "scattered" ? 15u : 13u) << kind;
  }
}

}  // namespace
}  // namespace vegard::sim::corona_emitter_test
