// The distance of a sheet from one camera and from two, 100 km apart on a line across it: the table of
// docs/validation.md. Rays that the model does not have, noise, and beams in other random places.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "fit/fit.h"
#include "sim/base/file/number_text.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::two_stations_test {
namespace {

constexpr int kSeeds = 6;
constexpr double kTruthKm = 180.0;

/// Of the truth's distance from the scene's site, which is the southern camera's.
struct Found {
  double sum_of_squares = 0.0, sum_of_sigmas = 0.0;
  int sigmas = 0;
  void add(const FitResult& result, double shift_km) {
    const DerivedNumber& distance = result.derived.at(0);
    sum_of_squares += std::pow(distance.value + shift_km - kTruthKm, 2);
    if (!distance.sigma) return;
    sum_of_sigmas += *distance.sigma;
    ++sigmas;
  }
  double error_km() const { return std::sqrt(sum_of_squares / kSeeds); }
  /// Of those that have one.
  double sigma_km() const { return sum_of_sigmas / sigmas; }
};

std::string words(const FitResult& result, double shift_km) {
  const DerivedNumber& distance = result.derived.at(0);
  return sim::number_with_error(distance.value + shift_km, distance.sigma) + " (" +
         verdict_name(result.verdict) + ")";
}

/// One camera by itself, in its own frame.
FitResult alone(const sim::Scene& start, int which, const Photo& photo) {
  sim::Scene scene = sim::scene_of_photo(start, start.fit.photos[which]);
  scene.fit.free = start.fit.free;
  return fit_photo(scene, photo, {});
}

// Six truths, seeds 11 to 16. Measured: docs/validation.md.
TEST(TwoStations, AreFiveTimesBetterThanOne) {
  Found south, north, both;
  for (int seed = 11; seed < 11 + kSeeds; ++seed) {
    sim::Scene truth = tests::two_stations();
    truth.seed = static_cast<std::uint64_t>(seed);
    truth.sheets[0].layers = 1;
    truth.sheets[0].beams = 8000;
    truth.sheets[0].ray_contrast = 0.4;
    const std::vector<Photo> photos = tests::photos_of(truth, 0.002, truth.seed);
    sim::Scene start = tests::with_unknown_height(truth);
    start.sheets[0].beams = 1500;
    const double apart_km =
        kTruthKm - sim::scene_of_photo(truth, truth.fit.photos[1]).sheets[0].center_km.north;
    const FitResult of_south = alone(start, 0, photos[0]), of_north = alone(start, 1, photos[1]),
                    of_both = fit_photos(start, photos, {});
    south.add(of_south, 0.0);
    north.add(of_north, apart_km);
    both.add(of_both, 0.0);
    std::printf("%d: south %s, north %s, both %s km\n", seed, words(of_south, 0.0).c_str(),
                words(of_north, apart_km).c_str(), words(of_both, 0.0).c_str());
  }
  for (const auto& [name, found] : {std::pair{"south", &south}, {"north", &north}, {"both", &both}})
    std::printf("%s: error %.3f km, sigma %.3f km (%d of %d)\n", name, found->error_km(), found->sigma_km(),
                found->sigmas, kSeeds);
  ASSERT_EQ(both.sigmas, kSeeds) << "two cameras always know";
  ASSERT_GT(south.sigmas, 0);
  EXPECT_GT(south.sigma_km(), 5.0 * both.sigma_km());
  EXPECT_GT(south.error_km(), 5.0 * both.error_km());
}

}  // namespace
}  // namespace vegard::fit::two_stations_test
