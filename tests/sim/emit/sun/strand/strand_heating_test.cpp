// Strands that flares heat at random: how one cools, when flares come, and what light that makes.
#include "sim/base/number/gauss_quadrature.h"
#include "sim/emit/sun/strand/strand_heating.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_emitter.h"
#include "sim/emit/sun/strand/strand_field.h"
#include "sim/scene/lines/emission_lines.h"
#include "tests/support/light_derivatives.h"
#include "tests/support/seeded_numbers.h"
#include "tests/support/sun_rays.h"

namespace vegard::sim::strand_heating_test {
namespace {

using tests::plain_double;

constexpr double kBoltzmann = 1.380649e-16, kConductivity = 1e-6, kRadiation = 6e-20;
constexpr double kHot_k = 1e7, kThin_cm3 = 1e9, kHalf_cm = 5e9;

CoolingStrand<double> usual() { return {kHot_k, kThin_cm3, kHalf_cm}; }

double slope(const std::function<double(double)>& of, double at) {
  const double step = 1e-4 * at;
  return (of(at + step) - of(at - step)) / (2.0 * step);
}

// Cargill (2014, ApJ 784, 49), equation A2, with alpha = -1/2: the whole time is
//   (2 - alpha) / (1 - alpha) 3 k (L^(8 - 4 alpha) / (kappa0^(4 - 2 alpha) chi^7 (n0 T0)^(3 + 2 alpha)))^(1 /
//   (11 - 2 alpha)),
// in which tau_c, that conduction needs to set in, is neglected.
TEST(CoolingStrand, TakesCargillsTime) {
  for (const double half_cm : {1e9, 5e9, 2e10}) {
    const double total =
        5.0 / 3.0 * 3.0 * kBoltzmann *
        std::pow(std::pow(half_cm, 10) /
                     (std::pow(kConductivity, 5) * std::pow(kRadiation, 7) * std::pow(kHot_k * kThin_cm3, 2)),
                 1.0 / 12.0);
    const double tau_c =
        3.0 * kBoltzmann * kThin_cm3 * half_cm * half_cm / (kConductivity * std::pow(kHot_k, 2.5));
    const CoolingStrand<double> strand(kHot_k, kThin_cm3, half_cm);
    EXPECT_NEAR(strand.lifetime_s(), total - tau_c, 1e-9 * total) << half_cm;
    EXPECT_LT(tau_c, 0.1 * total);
  }
}

TEST(CoolingStrand, CoolsByItsEquations) {
  const CoolingStrand<double> strand = usual();
  const auto temperature = [&](double t) { return strand.at(t).temperature_k; };
  EXPECT_NEAR(strand.at(0.0).temperature_k, kHot_k, 1e-9 * kHot_k);
  EXPECT_NEAR(strand.at(0.0).density_cm3, kThin_cm3, 1e-9 * kThin_cm3);
  const double turn = strand.conduction_s();
  ASSERT_GT(turn, 100.0);
  // Conduction, at constant pressure: dT/dt = -(2/7) kappa0 T^(7/2) / (3 k n L²).
  for (const double t : {0.1 * turn, 0.5 * turn, 0.95 * turn}) {
    const auto now = strand.at(t);
    EXPECT_NEAR(now.temperature_k * now.density_cm3, kHot_k * kThin_cm3, 1e-9 * kHot_k * kThin_cm3);
    const double rate = 2.0 / 7.0 * kConductivity * std::pow(now.temperature_k, 3.5) /
                        (3.0 * kBoltzmann * now.density_cm3 * kHalf_cm * kHalf_cm);
    EXPECT_NEAR(slope(temperature, t), -rate, 1e-5 * rate);
  }
  // Both take as long where the one passes into the other, and nothing jumps.
  const auto before = strand.at(turn * (1.0 - 1e-9)), after = strand.at(turn * (1.0 + 1e-9));
  EXPECT_NEAR(before.temperature_k, after.temperature_k, 1e-6 * before.temperature_k);
  EXPECT_NEAR(before.density_cm3, after.density_cm3, 1e-6 * before.density_cm3);
  EXPECT_NEAR(kBoltzmann * 3.0 * after.density_cm3 * kHalf_cm * kHalf_cm /
                  (kConductivity * std::pow(after.temperature_k, 2.5)),
              3.0 * kBoltzmann * std::pow(after.temperature_k, 1.5) / (kRadiation * after.density_cm3),
              1e-5 * strand.lifetime_s());
  // Radiation at that density: dT/dt = -chi n' T^(-1/2) / (3 k), and n as the root of T.
  for (const double t :
       {turn + 0.2 * (strand.lifetime_s() - turn), turn + 0.8 * (strand.lifetime_s() - turn)}) {
    const auto now = strand.at(t);
    const double rate = kRadiation * after.density_cm3 / std::sqrt(now.temperature_k) / (3.0 * kBoltzmann);
    EXPECT_NEAR(slope(temperature, t), -rate, 1e-5 * rate);
    EXPECT_NEAR(now.density_cm3 / after.density_cm3, std::sqrt(now.temperature_k / after.temperature_k),
                1e-8);
  }
  EXPECT_EQ(strand.at(strand.lifetime_s() * 1.001).density_cm3, 0.0);
}

/// By 4000 steps: their error is below 1e-5.
double over_life(const CoolingStrand<double>& strand, const std::function<double(double)>& response_of_k) {
  constexpr int kSteps = 4000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const auto now = strand.at((i + 0.5) / kSteps * strand.lifetime_s());
    sum += now.density_cm3 * now.density_cm3 * response_of_k(now.temperature_k);
  }
  return sum * strand.lifetime_s() / kSteps;
}

TEST(CoolingStrand, KnowsTheIntegralOfItsSquaredDensity) {
  // The last is so dense and cool that it radiates from the beginning.
  const CoolingStrand<double> all[] = {usual(), {5e6, 1e8, 1e10}, {2e6, 1e11, 1e9}};
  for (const CoolingStrand<double>& strand : all)
    EXPECT_NEAR(over_life(strand, [](double) { return 1.0; }) / strand.square_density_s(), 1.0, 1e-4);
  EXPECT_EQ(all[2].conduction_s(), 0.0);
}

double response(double line_nm, double k) { return response_at(*temperature_response(line_nm), k * 1e-6); }

TEST(CoolingStrand, ShinesInHotLinesFirst) {
  const CoolingStrand<double> strand = usual();
  double before_s = -1.0;
  for (const double line : {13.1, 9.4, 33.5, 19.5, 17.1}) {
    double best = 0.0, at_s = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double t = i / 20000.0 * strand.lifetime_s();
      const auto now = strand.at(t);
      const double light = now.density_cm3 * now.density_cm3 * response(line, now.temperature_k);
      if (light > best) {
        best = light;
        at_s = t;
      }
    }
    EXPECT_GT(at_s, before_s) << line << " nm";
    before_s = at_s;
  }
  EXPECT_GT(before_s, 0.5 * strand.lifetime_s()) << "171 Å comes late";
}

Loop heated(double interval_s) {
  Loop loop;
  loop.heating_interval_s = interval_s;
  loop.heating_temperature_mk = 8.0;
  loop.strands = 60;
  loop.height_noise = 0.1;
  return loop;
}

TEST(StrandHeating, HasFlaresOfAPoissonProcess) {
  const Loop loop = heated(100.0);
  // 40 strands of 1000 intervals with seed 3: their numbers have mean and variance 1000. Four standard
  // deviations of the mean of 40 are 20; of their variance, 1000 sqrt(2 / 39), four are 906.
  double sum = 0.0, squares = 0.0;
  std::vector<double> gaps;
  for (int k = 0; k < 40; ++k) {
    std::vector<double> times = flare_times_s(loop, 3, k, 0.0, 1e5 - 1e-6);
    sum += static_cast<double>(times.size());
    squares += static_cast<double>(times.size()) * static_cast<double>(times.size());
    std::sort(times.begin(), times.end());
    for (std::size_t i = 1; i < times.size(); ++i) gaps.push_back(times[i] - times[i - 1]);
  }
  EXPECT_NEAR(sum / 40.0, 1000.0, 20.0);
  EXPECT_NEAR((squares - sum * sum / 40.0) / 39.0, 1000.0, 906.0);
  // Gaps are exponential, of which 1 / e is longer than the mean: four standard deviations of that share
  // among 40000 are 0.0097.
  const double longer =
      static_cast<double>(std::count_if(gaps.begin(), gaps.end(), [](double g) { return g > 100.0; }));
  EXPECT_NEAR(longer / static_cast<double>(gaps.size()), std::exp(-1.0), 0.0097);
}

TEST(StrandHeating, HasTheSameFlaresHoweverItIsAsked) {
  const Loop loop = heated(100.0);
  const std::vector<double> all = flare_times_s(loop, 3, 7, -5000.0, 5000.0);
  std::vector<double> some = flare_times_s(loop, 3, 7, 120.0, 480.0);
  ASSERT_FALSE(some.empty());
  for (const double time : some) EXPECT_NE(std::find(all.begin(), all.end(), time), all.end());
  EXPECT_NE(all, flare_times_s(loop, 4, 7, -5000.0, 5000.0)) << "another seed";
  EXPECT_NE(all, flare_times_s(loop, 3, 8, -5000.0, 5000.0)) << "another strand";
  Loop other = loop;
  other.name = "other";
  EXPECT_NE(all, flare_times_s(other, 3, 7, -5000.0, 5000.0)) << "another loop";
}

Scene scene_of(const Loop& loop, const std::vector<double>& lines) {
  Scene scene;
  scene.sun.shown = true;
  scene.emission.lines = lines;
  scene.loops = {loop};
  scene.loops[0].rayleigh.assign(lines.size(), 1.0);
  return scene;
}

Strands<double> heated_strands(const Scene& scene, const std::vector<double>& instants) {
  Strands<double> strands = strands_of<double>(scene.sun, scene.loops[0], scene.seed, plain_double);
  heat_strands<double>(scene, scene.loops[0], instants, plain_double, strands);
  return strands;
}

// Campbell's theorem: over a long time the mean of a line is that over a strand's life, by its squared
// density.
TEST(StrandHeating, ShinesInTheMeanAsItsLifeDoes) {
  Loop loop = heated(3000.0);
  loop.height_noise = 0.0;
  Scene scene = scene_of(loop, {560.0, 17.1, 13.1});
  std::vector<double> instants;
  for (int i = 0; i < 4000; ++i) instants.push_back(250.0 * i);  // 333 intervals
  const Strands<double> strands = heated_strands(scene, instants);
  // Strands are alike and independent: the spread of their means says how good the mean of all is. With seed
  // 1 it comes within three standard errors, which are 1.5 % or less.
  double half_cm = 0.0;
  for (int i = 0; i < 20000; ++i) {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](double t) {
        const auto& p = strands.all[0].points;
        const double u = 1.0 - t;
        return u * u * u * p[0][axis] + 3 * u * u * t * p[1][axis] + 3 * u * t * t * p[2][axis] +
               t * t * t * p[3][axis];
      };
      const double step = at((i + 1) / 20000.0) - at(i / 20000.0);
      square += step * step;
    }
    half_cm += 0.5 * std::sqrt(square) * 1e8;
  }
  const CoolingStrand<double> life(8e6, 1e9, half_cm);
  for (std::size_t l = 0; l < 3; ++l) {
    double sum = 0.0, squares = 0.0;
    for (const Strand<double>& strand : strands.all) {
      sum += strand.line_gain[l];
      squares += strand.line_gain[l] * strand.line_gain[l];
    }
    const double count = static_cast<double>(strands.all.size()), mean = sum / count,
                 error = std::sqrt((squares / count - mean * mean) / (count - 1.0));
    const double want = l == 0 ? 1.0 : over_life(life, [&](double k) {
                                         return k > 0.0 ? response(scene.emission.lines[l], k) : 0.0;
                                       }) / life.square_density_s();
    EXPECT_NEAR(mean, want, 3.0 * error) << l;
    EXPECT_LT(error, 0.015 * want) << l;
  }
}

TEST(StrandHeating, FadesAndBrightens) {
  const Scene scene = scene_of(heated(20000.0), {560.0});
  double least = 1e300, most = 0.0;
  const Strands<double> one = heated_strands(scene, {0.0});
  int dark = 0;
  for (const Strand<double>& strand : one.all) dark += strand.line_gain[0] == 0.0;
  EXPECT_GT(dark, 10) << "seldom heated, many are cold";
  EXPECT_LT(dark, 55);
  for (int i = 0; i < 100; ++i) {
    const double gain = heated_strands(scene, {500.0 * i}).all[4].line_gain[0];
    least = std::min(least, gain);
    most = std::max(most, gain);
  }
  EXPECT_EQ(least, 0.0);
  EXPECT_GT(most, 1.0);
}

TEST(StrandHeating, IsTheMeanOfInstants) {
  const Scene scene = scene_of(heated(2000.0), {17.1, 13.1});
  const std::vector<double> instants = {100.0, 400.0, 5000.0};
  const Strands<double> mean = heated_strands(scene, instants);
  for (std::size_t k = 0; k < mean.all.size(); ++k)
    for (std::size_t l = 0; l < 2; ++l) {
      double sum = 0.0;
      for (const double instant : instants) sum += heated_strands(scene, {instant}).all[k].line_gain[l] / 3.0;
      EXPECT_NEAR(mean.all[k].line_gain[l], sum, 1e-12 * (1.0 + sum));
    }
}

// Rays and grids have the light of each strand times its factors.
TEST(StrandHeating, LightsRaysAndGridsStrandByStrand) {
  Sun sun = tests::level_sun(4000.0);
  Strands<double> both, first, second;
  Strand<double> a = tests::straight({0, -30, 0}, {0, 30, 0}, 5.0),
                 b = tests::straight({9, -20, -8}, {9, 20, 8}, 4.0);
  first.all = {a};
  second.all = {b};
  a.line_gain = {2.0, 0.0};
  b.line_gain = {0.5, 3.0};
  both.all = {a, b};
  const SunFrame<double> frame(sun, plain_double);
  const StrandEmitter<double> heated(both, sun, frame, {1.0, 10.0}), one(first, sun, frame, {1.0}),
      other(second, sun, frame, {1.0});
  int lit = 0;
  for (int k = 0; k < 40; ++k) {
    const double right = -20.0 + k, up = 3.0 * std::sin(1.0 * k);
    const double length = std::sqrt(right * right + up * up + 16e6);
    const double d[3] = {right / length, 4000.0 / length, up / length};
    const double end = std::numeric_limits<double>::infinity();
    double light[2] = {0.0, 0.0}, kept[2] = {1.0, 1.0}, entry = end, depth = end;
    heated.march({1, {&d[0], &d[1], &d[2]}, &end, 1e-5}, {2, light, kept, &entry, &depth});
    const tests::SunRay of_one = tests::sun_ray(one, 4000.0, right, up, 1e-5),
                        of_other = tests::sun_ray(other, 4000.0, right, up, 1e-5);
    EXPECT_NEAR(light[0], 2.0 * of_one.rayleigh + 0.5 * of_other.rayleigh, 1e-12);
    EXPECT_NEAR(light[1], 30.0 * of_other.rayleigh, 1e-11);
    lit += light[0] > 0.0 && light[1] > 0.0;
    if (of_one.rayleigh > 0.0 && of_other.rayleigh > 0.0) {
      const double w1 = 2.0 * of_one.rayleigh, w2 = 30.5 * of_other.rayleigh;
      EXPECT_NEAR(depth, (w1 * of_one.depth_km + w2 * of_other.depth_km) / (w1 + w2), 1e-6);
    }
  }
  EXPECT_GT(lit, 8);
  const StrandField field(both, sun, {1.0, 10.0}, 2), of_one(first, sun, {1.0}, 1),
      of_other(second, sun, {1.0}, 1);
  for (const Vec3<double>& at : {Vec3<double>{1, 2, 3}, Vec3<double>{8, 3, 2}, Vec3<double>{5, 0, 1}}) {
    const double* const point[3] = {&at[0], &at[1], &at[2]};
    float light[2], density;
    float* const to[2] = {&light[0], &light[1]};
    field.sample(1, point, to, &density);
    // 1 R to a km is 1e6 photons cm^-2 s^-1 over 1e5 cm.
    EXPECT_NEAR(light[0], 10.0 * (2.0 * of_one.density_at(at.data()) + 0.5 * of_other.density_at(at.data())),
                1e-5);
    EXPECT_NEAR(light[1], 100.0 * 3.0 * of_other.density_at(at.data()), 1e-4);
  }
}

TEST(StrandHeating, DerivativesAreThoseOfItsLight) {
  Scene scene = scene_of(heated(2000.0), {17.1});
  scene.sun = tests::level_sun(4000.0);
  scene.sun.radius = 700.0;
  scene.sun.unit_km = 1.0;
  Loop& loop = scene.loops[0];
  loop.longitude_deg = 85.0;
  loop.strands = 4;
  loop.strand_radius = 12.0;
  // A strand of 100 km would cool at once.
  loop.heating_density_cm3 = 1e7;
  loop.heating_interval_s = 30.0;
  const std::vector<double*> numbers = {&loop.height, &loop.width, &loop.base_density};
  const NumberAs<FreeDual> number = tests::seeded({numbers.begin(), numbers.end()});
  Strands<FreeDual> strands = strands_of<FreeDual>(scene.sun, loop, scene.seed, number);
  heat_strands<FreeDual>(scene, loop, {0.0}, number, strands);
  const StrandEmitter<FreeDual> dual(strands, scene.sun, SunFrame<FreeDual>(scene.sun, number),
                                     {FreeDual(1.0)});
  const auto make = [&] {
    return std::make_unique<StrandEmitter<double>>(heated_strands(scene, {0.0}), scene.sun,
                                                   SunFrame<double>(scene.sun, plain_double),
                                                   std::vector<double>{1.0});
  };
  std::vector<std::array<double, 2>> places;
  for (int k = 0; k < 14; ++k) places.push_back({700.0 + 6.0 * k, 30.0 * std::sin(2.0 * k)});
  EXPECT_GE(tests::expect_light_derivatives(dual, numbers, make, 4000.0, places, 1e-3), 5);
}

}  // namespace
}  // namespace vegard::sim::strand_heating_test
