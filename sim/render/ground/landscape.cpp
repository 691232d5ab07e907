#include "sim/render/ground/landscape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/base/number/smooth_step.h"

namespace vegard::sim {
namespace {

// Fractal footprints draw from this stream by gradient_noise(), with other keys.
constexpr Stream kLandscape = Stream::footprint;
constexpr double kShore_m = 150.0;  // nothing but the plain is nearer
constexpr double kTallestTree_m = 13.0;
constexpr std::uint32_t kNoiseAddress = 0x1000, kTreeAddress = 0x1001;

/// One wavelength of the noise. Octaves lie in different layers of the lattice, turned against each other, so
/// that its axes are not seen.
struct Octave {
  double wavelength_m, height_m;
  double cosine, sine;  ///< of its turn
  double stretch;       ///< along the turned axis
  double layer;
};
Octave wave(double wavelength_m, double height_m, double turn_rad, double stretch, int number) {
  return {wavelength_m, height_m, std::cos(turn_rad), std::sin(turn_rad), stretch, 0.37 + 3.61 * number};
}
/// Drifts lie along the wind, more or less.
const std::array<Octave, 5> kDrifts = {wave(15.0, 0.50, 0.0, 2.2, 0), wave(6.0, 0.24, 0.3, 2.6, 1),
                                       wave(2.4, 0.11, -0.2, 3.0, 2), wave(1.0, 0.05, 0.15, 3.0, 3),
                                       wave(0.4, 0.018, -0.1, 2.0, 4)};
const std::array<Octave, 5> kHills = {wave(9000.0, 420.0, 0.0, 1.0, 5), wave(2600.0, 170.0, 2.4, 1.0, 6),
                                      wave(1200.0, 70.0, 4.8, 1.0, 7), wave(560.0, 24.0, 1.0, 1.0, 8),
                                      wave(260.0, 8.0, 3.4, 1.0, 9)};
constexpr std::size_t kFarHills = 1;  // of kHills, seen in the distance alone

struct Place {
  double x, y, z;
};
Place place_in(const Octave& octave, double east_m, double north_m) {
  const double across = 1.0 / octave.wavelength_m;
  return {(east_m * octave.cosine + north_m * octave.sine) * across / octave.stretch,
          (north_m * octave.cosine - east_m * octave.sine) * across, octave.layer};
}

/// 1 for waves that are much longer than a step, 0 for those that it would miss.
double resolved(double wavelength_m, double step_m) {
  return smooth_step(wavelength_m / (2.0 * step_m) - 1.0);
}

}  // namespace

Landscape::Landscape(std::uint64_t seed) : seed_(seed), noise_(seed, kLandscape, kNoiseAddress) {}

/// Returns the height of the trees: spires at random places of a grid whose cells grow with the step.
double Landscape::tree_m(double east_m, double north_m, double step_m, double& light) const {
  constexpr double kCell_m = 2.6, kSlimness = 7.0;  // height over radius
  const double coarser = std::exp2(std::ceil(std::log2(std::max(1.0, step_m / 2.4))));
  const double cell_m = kCell_m * coarser;
  const double x = east_m / cell_m, y = north_m / cell_m;
  const double x0 = std::floor(x), y0 = std::floor(y);
  double highest = 0.0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const auto column = static_cast<std::int32_t>(x0) + i, row = static_cast<std::int32_t>(y0) + j;
      const Words words =
          random_words(seed_, kLandscape, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row),
                       kTreeAddress + (static_cast<std::uint32_t>(coarser) << 16));
      const double dx = column + uniform(words[0]) - x, dy = row + uniform(words[1]) - y;
      const double top_m = 4.0 + (kTallestTree_m - 4.0) * uniform(words[2]) * uniform(words[3]);
      const double out = std::sqrt(dx * dx + dy * dy) * cell_m / std::max(top_m / kSlimness, 0.4 * cell_m);
      if (out >= 1.0) continue;
      const double here = top_m * (1.0 - out) * (1.0 - 0.3 * out);
      if (here > highest) {
        highest = here;
        light = (0.5 + 0.6 * here / top_m) * (0.8 + 0.3 * uniform(words[3] ^ words[0]));
      }
    }
  return highest;
}

/// Returns the height; of a surface that is `seen`, also everything else. What is lower than `hidden_m` needs
/// no trees.
Landscape::Surface Landscape::surface(double east_m, double north_m, double distance_m, double step_m,
                                      double hidden_m, bool seen) const {
  Surface at{0.0, 0.0, 0.0, 1.0, 1.0};
  const auto add = [&](const Octave& octave, double share) {
    share *= resolved(octave.wavelength_m, step_m);
    if (share <= 0.0) return;
    const Place place = place_in(octave, east_m, north_m);
    share *= octave.height_m;
    if (!seen) {
      at.height_m += share * noise_.value(place.x, place.y, place.z);
      return;
    }
    const NoiseAt noise = noise_.with_slope(place.x, place.y, place.z);
    at.height_m += share * noise.value;
    const double along = share / octave.wavelength_m / octave.stretch * noise.slope[0];
    const double across = share / octave.wavelength_m * noise.slope[1];
    at.slope_east += along * octave.cosine - across * octave.sine;
    at.slope_north += along * octave.sine + across * octave.cosine;
  };
  // Land rises with the distance, out of a plain of snow around the observer.
  if (distance_m > kShore_m) {
    const double near = smooth_step((distance_m - kShore_m) / 900.0);
    const double far = smooth_step((distance_m - 2500.0) / 9000.0);
    for (std::size_t n = 0; n < kHills.size(); ++n) add(kHills[n], n < kFarHills ? far : near);
    at.height_m += 26.0 * smooth_step(std::log(distance_m / 200.0) / std::log(20.0)) - 9.0;
  }
  if (distance_m > kShore_m && at.height_m > 0.0) {
    // Trees stand from a step above the shore up to where hills are bare, with clearings.
    const double clearing = noise_.value(east_m / 170.0, north_m / 170.0, 41.3) +
                            0.5 * noise_.value(east_m / 45.0, north_m / 45.0, 44.7);
    const double bare_m = 170.0 * (1.0 + 0.5 * clearing);
    const double wood = clearing < -0.45 ? 0.0
                                         : smooth_step(at.height_m / 1.5) *
                                               (1.0 - smooth_step((at.height_m - bare_m) / 50.0));
    if (wood > 0.02 && at.height_m + kTallestTree_m > hidden_m) {
      double light = 1.0;
      const double tree = wood * tree_m(east_m, north_m, step_m, light);
      at.snow = tree > 0.3 ? 0.0 : 1.0 - 0.8 * wood;  // between trees their shade
      at.height_m += tree;
      if (tree > 0.3) at.light = light;
    }
    return at;
  }
  at.height_m = at.slope_east = at.slope_north = 0.0;
  for (const Octave& octave : kDrifts) add(octave, 1.0);
  if (!seen) return at;
  // Crust that the wind has bared between drifts of fresh snow.
  const auto crust = [&](double along_m, double across_m, double layer) {
    const double share = resolved(across_m, step_m);
    return share > 0.0 ? share * noise_.value(east_m / along_m, north_m / across_m, layer) : 0.0;
  };
  at.light = std::clamp(0.8 + 0.3 * crust(160.0, 60.0, 50.9) + 0.3 * crust(38.0, 11.0, 47.1) +
                            0.25 * crust(7.0, 2.6, 53.3) + 0.18 * crust(1.9, 0.8, 56.7),
                        0.6, 1.0);
  return at;
}

void Landscape::look(double azimuth_rad, double lowest_sine, double step_rad,
                     std::vector<LandscapePoint>& seen) const {
  constexpr double kFinest = 0.006, kOfPlain = 0.012;  // of the distance
  constexpr double kTallest_m = 600.0, kNear_m = 40.0;
  const double east = std::sin(azimuth_rad), north = std::cos(azimuth_rad);
  const double eye_m = kEye_m + surface(0.0, 0.0, 0.0, 0.01, -1e9, false).height_m;
  double highest = -1.0;
  seen.clear();
  // Nothing that stands higher than a drift is near enough to be seen below this.
  const double down = std::clamp(-lowest_sine, 0.05, 1.0);
  double distance_m = std::max(0.0, 0.8 * kEye_m * std::sqrt(1.0 - down * down) / down - 1.0);
  while (distance_m < kFarthest_m && distance_m * highest < kTallest_m) {
    const double of_angle = (distance_m * distance_m + kEye_m * kEye_m) / kEye_m * step_rad;
    const double step_m = std::min(of_angle, std::max(distance_m < kShore_m ? kOfPlain : kFinest, step_rad) *
                                                 std::max(distance_m, kEye_m));
    const double below_m = eye_m + distance_m * distance_m / (2e3 * kEarthRadiusKm);
    const double hidden_m =
        below_m + distance_m * highest / std::sqrt(std::max(1e-12, 1.0 - highest * highest));
    const double to_east = distance_m * east, to_north = distance_m * north;
    // Nearly all is seen that is near; farther off, most is hidden, and the height alone costs less.
    const bool near = distance_m < kNear_m;
    Surface at = surface(to_east, to_north, distance_m, step_m, hidden_m, near);
    if (at.height_m > hidden_m) {
      if (!near) at = surface(to_east, to_north, distance_m, step_m, hidden_m, true);
      const double up_m = at.height_m - below_m;
      highest = up_m / std::sqrt(up_m * up_m + distance_m * distance_m + 1e-12);
      seen.push_back({static_cast<float>(highest), static_cast<float>(distance_m),
                      static_cast<float>(at.slope_east), static_cast<float>(at.slope_north),
                      static_cast<float>(at.snow), static_cast<float>(at.light)});
    }
    distance_m += step_m;
  }
}

}  // namespace vegard::sim
