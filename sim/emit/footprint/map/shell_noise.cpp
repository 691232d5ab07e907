#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/noise.h"
#include "sim/base/number/smooth_step.h"
#include "sim/base/parallel.h"
#include "sim/emit/footprint/map/make_footprint.h"
#include "sim/emit/footprint/map/ridges.h"

namespace vegard::sim {
namespace shell_noise {

constexpr double kPushedInSpace = 0.4;  // how far places are pushed aside, in the largest waves
constexpr int kSpherePlaces = 8192;     // on the whole sphere, from which the dark level is taken

/// The height of ridges in space, as a box has them in its plane (noise_footprint.cpp). In a lifetime one
/// pattern passes into the next.
class RidgesInSpace {
 public:
  RidgesInSpace(const Footprint& f, std::uint64_t seed, int index, double radius_km, double instant_s)
      : seed_(seed),
        index_(static_cast<std::uint64_t>(index) << 8),
        octaves_(f.noise_octaves),
        scale_(radius_km / f.noise_scale_km) {
    const double lives = f.noise_lifetime_s > 0.0 ? instant_s / f.noise_lifetime_s : 0.0;
    const double share = lives - std::floor(lives), size = std::hypot(1.0 - share, share);
    pattern_ = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(lives)));
    // Two independent patterns whose squares sum to 1: the noise is as strong at all times.
    of_this_ = (1.0 - share) / size;
    of_next_ = share / size;
  }

  double at(const double direction[3]) const {
    double p[3], pushed[3];
    for (int a = 0; a < 3; ++a) p[a] = direction[a] * scale_;
    for (int a = 0; a < 3; ++a) pushed[a] = p[a] + kPushedInSpace * noise(1 + a, p, 1.0);
    return ridges(octaves_, [&](int k, double scale) { return noise(4 + k, pushed, scale); });
  }

 private:
  double noise(int part, const double p[3], double scale) const {
    const auto of = [&](std::uint64_t pattern) {
      return gradient_noise(seed_, Stream::footprint, pattern << 32 | index_ | static_cast<unsigned>(part),
                            p[0] * scale, p[1] * scale, p[2] * scale);
    };
    double sum = of_this_ * of(pattern_);
    if (of_next_ > 0.0) sum += of_next_ * of(pattern_ + 1);
    return sum;
  }

  std::uint64_t seed_, index_;
  int octaves_;
  double scale_;
  std::uint64_t pattern_ = 0;
  double of_this_ = 1.0, of_next_ = 0.0;
};

}  // namespace shell_noise

CubeFootprint<double> noise_cube(const Footprint& f, double sphere_km, CubeFootprint<double> cube,
                                 std::uint64_t seed, int index, double instant_s, int threads) {
  using namespace shell_noise;
  const int n = cube.face_cells;
  const RidgesInSpace ridges(f, seed, index, sphere_km + kFootAltitudeKm, instant_s);
  // Places evenly on a spiral from pole to pole.
  std::vector<double> heights(kSpherePlaces);
  parallel_for(kSpherePlaces, threads, [&](std::size_t i, int) {
    constexpr double kGoldenAngle = 2.3999632297286533;
    const double z = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / kSpherePlaces,
                 level = std::sqrt(1.0 - z * z), turn = kGoldenAngle * static_cast<double>(i);
    const double direction[3] = {level * std::cos(turn), level * std::sin(turn), z};
    heights[i] = ridges.at(direction);
  });
  std::sort(heights.begin(), heights.end());
  const auto rank = static_cast<std::size_t>((1.0 - f.noise_coverage) * (kSpherePlaces - 1));
  const double dark = heights[rank], brightest = heights.back();
  for (int face = 0; face < 6; ++face)
    parallel_for(n, threads, [&](std::size_t row, int) {
      for (int column = 0; column < n; ++column) {
        double& flux = cube.face[face].flux_mw_m2[(row + 1) * (n + 2) + column + 1];
        if (flux == 0.0) continue;
        double direction[3];
        direction_on_face(face, face_coordinate(column, n), face_coordinate(static_cast<int>(row), n),
                          direction);
        flux = brightest > dark && f.noise_coverage > 0.0
                   ? flux * smooth_step((ridges.at(direction) - dark) / (brightest - dark))
                   : 0.0;
      }
    });
  fill_borders(cube);
  return cube;
}

}  // namespace vegard::sim
