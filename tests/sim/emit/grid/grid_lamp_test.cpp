// A grid that scatters the light of a lamp once: against integrals that are known, and its derivatives.
#include "sim/emit/grid/grid_lamp.h"
#include "sim/base/number/gauss_quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "sim/emit/grid/grid_emitter.h"
#include "tests/support/seeded_numbers.h"

namespace vegard::sim::grid_lamp_test {
namespace {

using tests::plain_double;

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kDegree = kPi / 180.0;

/// A box of voxels of 1 km from `low` to below `high`, whose corner (0, 0, 0) is at the origin of the site.
SparseGrid box(const int low[3], const int high[3], const std::function<double(const double[3])>& density) {
  SparseGrid grid;
  grid.voxel = 1.0;
  grid.origin = {0.0, 0.0, 0.0};
  grid.channels.push_back({"density", ""});
  for (int i = low[0]; i < high[0]; ++i)
    for (int j = low[1]; j < high[1]; ++j)
      for (int k = low[2]; k < high[2]; ++k) {
        const double at[3] = {i + 0.5, j + 0.5, k + 0.5};
        grid.brick({i >> 3, j >> 3, k >> 3})[SparseGrid::within(i & 7, j & 7, k & 7)] =
            static_cast<float>(density(at));
      }
  return grid;
}

GridBricks dust(const SparseGrid& grid, int lines = 1) {
  return GridBricks(grid, std::vector<int>(lines, -1), 0, "a.vdb", Site(), Site());
}

/// A wide slab between heights, without edges that a ray near its middle sees.
GridBricks slab(int bottom, int top, int half) {
  const int low[3] = {-half, -half, bottom}, high[3] = {half, half, top};
  return dust(box(low, high, [](const double[3]) { return 1.0; }));
}

Volume scattering(VolumeLamp lamp) {
  Volume volume;
  volume.extinction_per_km = 0.05;
  volume.albedo = 0.7;
  volume.asymmetry = 0.3;
  volume.lamp = lamp;
  volume.lamp_azimuth_deg = 60.0;
  volume.lamp_elevation_deg = 40.0;
  volume.lamp_flux = {1000.0};
  volume.step_voxels = 0.5;
  return volume;
}

struct Ray {
  double direction[3];
  Ray(double azimuth_deg, double elevation_deg) {
    const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
    direction[0] = std::cos(e) * std::sin(a);
    direction[1] = std::cos(e) * std::cos(a);
    direction[2] = std::sin(e);
  }
};

struct Light {
  double rayleigh = 0.0, kept = 1.0, entry = kInfinity, depth = kInfinity;
};

Light light_of(const GridEmitter<double>& emitter, const Ray& ray) {
  Light out;
  const double end = kInfinity;
  emitter.march({1, {&ray.direction[0], &ray.direction[1], &ray.direction[2]}, &end},
                {1, &out.rayleigh, &out.kept, &out.entry, &out.depth});
  return out;
}

Light light_of(const GridBricks& grid, const Volume& volume, const Ray& ray, const Sun* sun = nullptr) {
  return light_of(GridEmitter<double>(grid, volume, plain_double, sun), ray);
}

double cosine_between(const Ray& a, const Ray& b) {
  return a.direction[0] * b.direction[0] + a.direction[1] * b.direction[1] + a.direction[2] * b.direction[2];
}

TEST(HenyeyGreenstein, IsWholeAndHasItsMeanCosine) {
  const GaussLegendre<64> nodes;
  for (const double g : {-0.6, 0.0, 0.3, 0.75}) {
    double whole = 0.0, mean = 0.0;
    for (int n = 0; n < 64; ++n) {
      const double cosine = 2.0 * nodes.place[n] - 1.0;
      const double share = 2.0 * kPi * 2.0 * nodes.weight[n] * henyey_greenstein(cosine, g);
      whole += share;
      mean += share * cosine;
    }
    EXPECT_NEAR(whole, 1.0, 1e-9) << g;
    EXPECT_NEAR(mean, g, 1e-9) << g;
  }
  EXPECT_GT(henyey_greenstein(1.0, 0.5), henyey_greenstein(-1.0, 0.5)) << "forwards";
}

// So thin that nothing is absorbed: flux, albedo, 4 pi times the phase function, and the optical depth.
TEST(GridLamp, IsTheOpticalDepthWhereThatIsSmall) {
  const GridBricks grid = slab(20, 36, 32);
  Volume volume = scattering(VolumeLamp::direction);
  volume.extinction_per_km = 1e-7;
  const Ray lamp(volume.lamp_azimuth_deg, volume.lamp_elevation_deg);
  const GridEmitter<double> emitter(grid, volume, plain_double);
  for (const Ray& ray : {Ray(0.0, 90.0), Ray(60.0, 70.0), Ray(240.0, 60.0)}) {
    // 16 voxels, and half a one of either edge's slope, which is as much.
    const double depth = 1e-7 * 16.0 / ray.direction[2];
    const double want = 1000.0 * 0.7 * 4.0 * kPi * henyey_greenstein(cosine_between(ray, lamp), 0.3) * depth;
    EXPECT_NEAR(light_of(emitter, ray).rayleigh, want, 1e-3 * want);
  }
}

// Chandrasekhar's plane layer of optical depth tau, lit from the cosine m0 and seen from m, both of the
// vertical, by light scattered once. Lit from above and seen from below it passes on
//   (a F 4 pi p / m) (exp(-tau / m) - exp(-tau / m0)) / (1 / m0 - 1 / m),
// and lit from below it gives back a F 4 pi p (1 - exp(-tau (1 / m + 1 / m0))) / (1 + m / m0).
TEST(GridLamp, IsTheIntegralOverASlab) {
  const GridBricks grid = slab(20, 44, 48);
  for (const double extinction : {0.01, 0.05, 0.2}) {
    Volume volume = scattering(VolumeLamp::direction);
    volume.extinction_per_km = extinction;
    volume.step_voxels = 0.125;
    const double tau = extinction * 24.0;
    for (const bool from_above : {true, false}) {
      volume.lamp_elevation_deg = from_above ? 65.0 : -65.0;
      const Ray lamp(volume.lamp_azimuth_deg, volume.lamp_elevation_deg);
      const double m0 = std::abs(lamp.direction[2]);
      const GridEmitter<double> emitter(grid, volume, plain_double);
      for (const Ray& ray : {Ray(10.0, 75.0), Ray(200.0, 55.0)}) {
        const double m = ray.direction[2];
        const double source = 1000.0 * 0.7 * 4.0 * kPi * henyey_greenstein(cosine_between(ray, lamp), 0.3);
        const double want =
            from_above ? source / m * (std::exp(-tau / m) - std::exp(-tau / m0)) / (1.0 / m0 - 1.0 / m)
                       : source * (1.0 - std::exp(-tau * (1.0 / m + 1.0 / m0))) / (1.0 + m / m0);
        const Light light = light_of(emitter, ray);
        // In the voxel of an edge the density is linear and the column of it quadratic, but taken as linear:
        // up to an eighth of a voxel too much, of the light of that voxel, which is a fifth of all of it or
        // less.
        EXPECT_NEAR(light.rayleigh, want, 0.2 * extinction / (8.0 * m0) * want) << extinction << from_above;
        EXPECT_NEAR(light.kept, std::exp(-tau / m), 0.002);
        EXPECT_GT(light.depth, 20.0);
        EXPECT_LT(light.depth, 44.0 / m);
      }
    }
  }
}

// A point within a thin cloud: its flux falls as the square of the distance.
TEST(GridLamp, IsAPointsLightByTheSquareOfItsDistance) {
  const GridBricks grid = slab(20, 36, 32);
  Volume volume = scattering(VolumeLamp::point);
  volume.extinction_per_km = 1e-7;
  volume.lamp_km = {12.0, -5.0, 60.0};
  const Ray ray(30.0, 80.0);
  double want = 0.0;
  constexpr int kSteps = 20000;
  const double first = 19.5 / ray.direction[2], last = 36.5 / ray.direction[2],
               step = (last - first) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double t = first + (i + 0.5) * step, height = t * ray.direction[2];
    const double density = std::min({1.0, height - 19.5, 36.5 - height});
    double square = 0.0, along = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double to_lamp = volume.lamp_km[a] - t * ray.direction[a];
      square += to_lamp * to_lamp;
      along += to_lamp * ray.direction[a];
    }
    want += 1000.0 * 0.7 * 4.0 * kPi * henyey_greenstein(along / std::sqrt(square), 0.3) / square * 1e-7 *
            density * step;
  }
  EXPECT_NEAR(light_of(grid, volume, ray).rayleigh, want, 1e-3 * want);
}

// The Sun as a lamp is parallel light of the flux of its disc.
TEST(GridLamp, IsTheSunsLight) {
  const GridBricks grid = slab(20, 36, 32);
  Sun sun;
  sun.shown = true;
  sun.azimuth_deg = 60.0;
  sun.elevation_deg = 40.0;
  sun.photosphere_rayleigh = {2e9};
  sun.limb_darkening = 0.6;
  Volume volume = scattering(VolumeLamp::sun);
  volume.lamp_flux.clear();
  const Ray ray(0.0, 90.0);
  // Brightness over 4 pi, times the solid angle pi (R / d)², times the disc's mean of 1 - 0.6 / 3.
  const double ratio = 695.7e3 / 149597870.7, flux = 2e9 / (4.0 * kPi) * kPi * ratio * ratio * 0.8;
  Volume far = scattering(VolumeLamp::direction);
  far.lamp_flux = {flux};
  const double want = light_of(grid, far, ray).rayleigh;
  EXPECT_NEAR(light_of(grid, volume, ray, &sun).rayleigh, want, 1e-9 * want);
  EXPECT_GT(want, 0.0);
}

// On the Sun the photosphere is the lamp, from its middle; dust in front of the disc is lit from behind.
TEST(GridLamp, IsThePhotosphereForAGridOnTheSun) {
  Sun sun;
  sun.shown = true;
  sun.azimuth_deg = 0.0;
  sun.elevation_deg = 0.0;
  sun.distance_km = 4000.0;
  sun.unit_km = 1.0;
  sun.radius = 20.0;
  sun.photosphere_rayleigh = {1e6};
  // On the Sun's y axis, to the right as seen from the north.
  const int low[3] = {-8, 96, -8}, high[3] = {8, 112, 8};
  const GridBricks grid = dust(box(low, high, [](const double[3]) { return 1.0; }));
  Volume volume = scattering(VolumeLamp::sun);
  volume.frame = VolumeFrame::sun;
  volume.extinction_per_km = 1e-7;
  const double length = std::hypot(4000.0, 104.0);
  Ray ray(0.0, 0.0);
  ray.direction[0] = 104.0 / length;
  ray.direction[1] = 4000.0 / length;
  // Seen nearly at a right angle; the flux over the 16 km is that at 104 km to a per cent.
  const double flux = 0.25e6 * 20.0 * 20.0 / (104.0 * 104.0);
  const double want = flux * 0.7 * 4.0 * kPi * henyey_greenstein(-104.0 / length, 0.3) * 1e-7 * 16.0;
  EXPECT_NEAR(light_of(grid, volume, ray, &sun).rayleigh, want, 0.01 * want);
}

TEST(GridLamp, LeavesAVolumeThatScattersNothingAsItIsToTheLastBit) {
  const int low[3] = {-16, -16, 20}, high[3] = {16, 16, 40};
  SparseGrid grid =
      box(low, high, [](const double at[3]) { return 1.0 + std::sin(at[0]) * std::cos(at[2]); });
  const GridBricks bricks(grid, {0}, 0, "a.vdb", Site(), Site());
  Volume plain;
  plain.extinction_per_km = 0.05;
  Volume lamp = scattering(VolumeLamp::direction);
  lamp.step_voxels = plain.step_voxels;
  lamp.albedo = 0.0;
  Volume dark = lamp;
  dark.albedo = 0.7;
  dark.lamp = VolumeLamp::none;
  for (const Ray& ray : {Ray(3.0, 80.0), Ray(100.0, 70.0)}) {
    const Light want = light_of(bricks, plain, ray);
    EXPECT_GT(want.rayleigh, 0.0);
    for (const Volume* volume : {&lamp, &dark}) {
      const Light light = light_of(bricks, *volume, ray);
      EXPECT_EQ(light.rayleigh, want.rayleigh);
      EXPECT_EQ(light.kept, want.kept);
      EXPECT_EQ(light.depth, want.depth);
    }
    // What it scatters is added to what it gives itself.
    Volume both = lamp;
    both.albedo = 0.7;
    Volume lit = both;
    lit.gain = 0.0;
    EXPECT_NEAR(light_of(bricks, both, ray).rayleigh, want.rayleigh + light_of(bricks, lit, ray).rayleigh,
                1e-9 * want.rayleigh);
  }
}

TEST(GridLamp, HasColumnsThatDoNotDependOnThreads) {
  const int low[3] = {-16, -16, 20}, high[3] = {16, 16, 40};
  const GridBricks grid =
      dust(box(low, high, [](const double at[3]) { return 1.0 + std::sin(at[0] * at[2]); }));
  const LampPlace lamp = lamp_place(grid, scattering(VolumeLamp::direction), nullptr);
  const LampColumns one(grid, lamp, 1.0, 1), four(grid, lamp, 1.0, 4);
  for (std::size_t b = 0; b < grid.bricks(); ++b)
    for (int v = 0; v < GridBricks::kVoxels; ++v)
      ASSERT_EQ(one.of_brick(static_cast<std::int32_t>(b))[v],
                four.of_brick(static_cast<std::int32_t>(b))[v]);
}

TEST(GridLamp, HasDerivativesOfItsLight) {
  const int low[3] = {-16, -16, 20}, high[3] = {16, 16, 36};
  const GridBricks grid = dust(box(low, high, [](const double at[3]) {
    return 1.0 + 0.5 * std::sin(0.2 * at[0]) * std::cos(0.15 * at[2]);
  }));
  for (const VolumeLamp lamp : {VolumeLamp::direction, VolumeLamp::point}) {
    Volume volume = scattering(lamp);
    volume.lamp_km = {10.0, 4.0, 70.0};
    std::vector<double*> numbers = {&volume.extinction_per_km, &volume.albedo, &volume.asymmetry};
    if (lamp == VolumeLamp::direction)  // a point stands still as the grid is moved
      for (double& one : volume.shift_km) numbers.push_back(&one);
    const NumberAs<FreeDual> number = tests::seeded({numbers.begin(), numbers.end()});
    const GridEmitter<FreeDual> dual(grid, volume, number);
    const double step = 1e-5, end = kInfinity;
    const Ray rays[] = {Ray(5.0, 77.0), Ray(130.0, 68.0), Ray(250.0, 82.0)};
    std::vector<FreeDual> lights;
    for (const Ray& ray : rays) {
      const FreeDual d[3] = {ray.direction[0], ray.direction[1], ray.direction[2]};
      FreeDual light(0.0), kept(1.0);
      double entry = end, depth = end;
      dual.march({1, {&d[0], &d[1], &d[2]}, &end}, {1, &light, &kept, &entry, &depth});
      lights.push_back(light);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double was = *numbers[i];
      *numbers[i] = was + step;
      const GridEmitter<double> more(grid, volume, plain_double);
      *numbers[i] = was - step;
      const GridEmitter<double> less(grid, volume, plain_double);
      *numbers[i] = was;
      for (std::size_t r = 0; r < 3; ++r) {
        const double difference =
            (light_of(more, rays[r]).rayleigh - light_of(less, rays[r]).rayleigh) / (2.0 * step);
        EXPECT_GT(lights[r].v, 0.0);
        EXPECT_NEAR(lights[r].d.t[i], difference, 1e-3 * (0.01 * lights[r].v + std::abs(difference)))
            << "number " << i << " ray " << r;
      }
    }
    // By a camera that turns: the ray's own direction.
    const Ray ray(40.0, 75.0);
    const double across[3] = {std::cos(40.0 * kDegree), -std::sin(40.0 * kDegree), 0.0};
    FreeDual d[3] = {ray.direction[0], ray.direction[1], ray.direction[2]};
    for (int a = 0; a < 3; ++a) d[a].d.t[0] = across[a];
    FreeDual light(0.0), kept(1.0);
    double entry = end, depth = end;
    const GridEmitter<FreeDual> plain(grid, volume, [](const double& x) { return FreeDual(x); });
    const GridEmitter<double> values(grid, volume, plain_double);
    plain.march({1, {&d[0], &d[1], &d[2]}, &end}, {1, &light, &kept, &entry, &depth});
    const auto turned = [&](double by) {
      Ray other = ray;
      double length = 0.0;
      for (int a = 0; a < 3; ++a) {
        other.direction[a] += by * across[a];
        length += other.direction[a] * other.direction[a];
      }
      for (double& one : other.direction) one /= std::sqrt(length);
      return light_of(values, other).rayleigh;
    };
    const double difference = (turned(1e-5) - turned(-1e-5)) / 2e-5;
    EXPECT_NEAR(light.d.t[0], difference, 1e-3 * (0.01 * light.v + std::abs(difference)));
  }
}

}  // namespace
}  // namespace vegard::sim::grid_lamp_test
