// How fast the light of strands is collected along rays:
//
//   strand_ray_bench [--strands N] [--width N] [--height N] [--threads N] [--repeat N] [--falloff WORD]
//     A macro-loop of so many strands on a film, by the emitter as it is (median of the repetitions, and the
//     time to make it), beside a brute-force search in the same run: every segment asked by every ray, on
//     rays spread over the film, scaled to all of them. Also how far the two lights differ.
//   strand_ray_bench tiny
//     A check that it still runs, and that the two agree.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "apps/options/command.h"
#include "sim/base/parallel.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_emitter.h"
#include "tests/support/kind_named.h"

namespace vegard::bench {
namespace {

using namespace sim;

struct Options {
  int strands = 2000, width = 821, height = 691, threads = 0, repeat = 5, brute_rays = 200;
  std::string falloff = "smooth";
};

double plain(const double& number) { return number; }

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A loop beyond the limb, seen from the Earth, fills the picture.
class Bench {
 public:
  explicit Bench(const Options& options) : options_(options) {
    sun_.shown = true;
    sun_.elevation_deg = 0.0;
    Loop loop;
    loop.longitude_deg = 88.0;
    loop.bearing_deg = 15.0;
    loop.strands = options.strands;
    loop.spread = 20.0;
    loop.strand_radius = 0.4;
    loop.root_noise = 4.0;
    loop.height_noise = 0.15;
    loop.tilt_noise_deg = 6.0;
    loop.density_falloff = tests::kind_named<sim::RadialFalloff>(options.falloff);
    strands_ = strands_of<double>(sun_, loop, 1, plain);
    cell_rad_ = 160.0 * sun_.unit_km / sun_.distance_km / options.width;
  }

  StrandEmitter<double> emitter() const { return {strands_, sun_, SunFrame<double>(sun_, plain), {1.0}}; }

  /// The ray of a pixel.
  void aim(int column, int row, double direction[3]) const {
    const double right = (column + 0.5 - 0.5 * options_.width) * cell_rad_ +
                         735.0 * sun_.unit_km / sun_.distance_km,
                 up = (0.5 * options_.height - row - 0.5) * cell_rad_;
    const double length = std::sqrt(1.0 + right * right + up * up);
    direction[0] = right / length;
    direction[1] = 1.0 / length;
    direction[2] = up / length;
  }

  std::vector<double> film(const Emitter<double>& emitter) const {
    const std::size_t columns = static_cast<std::size_t>(options_.width);
    std::vector<double> light(columns * options_.height);
    parallel_for(static_cast<std::size_t>(options_.height), options_.threads, [&](std::size_t row, int) {
      std::vector<double> direction[3], end(columns, std::numeric_limits<double>::infinity()),
          kept(columns, 1.0), entry(end), depth(end);
      for (auto& axis : direction) axis.resize(columns);
      for (std::size_t c = 0; c < columns; ++c) {
        double d[3];
        aim(static_cast<int>(c), static_cast<int>(row), d);
        for (int axis = 0; axis < 3; ++axis) direction[axis][c] = d[axis];
      }
      emitter.march(
          {columns, {direction[0].data(), direction[1].data(), direction[2].data()}, end.data(), cell_rad_},
          {1, &light[row * columns], kept.data(), entry.data(), depth.data()});
    });
    return light;
  }

  /// Every segment for one ray.
  double brute(const std::vector<std::vector<PlacedJoint<double>>>& chains, int column, int row) const {
    const SunFrame<double> frame(sun_, plain);
    double d[3];
    aim(column, row, d);
    const SkyRay<double> ray = frame.ray(d);
    const Vec3<double> nearest = {ray.nearest[0], ray.nearest[1], ray.nearest[2]},
                       direction = {ray.direction[0], ray.direction[1], ray.direction[2]};
    double half = 0.0, last = std::numeric_limits<double>::infinity();
    if (meets_sphere(ray, sun_.radius, half)) last = -half;
    double sum = 0.0;
    for (const auto& chain : chains)
      for (std::size_t j = 0; j + 1 < chain.size(); ++j) {
        SegmentLight<double> light;
        if (segment_light(chain[j], chain[j + 1], strands_.falloff,
                          cell_rad_ * (strands_.falloff == RadialFalloff::gaussian ? 1.5 : 1.0), nearest,
                          direction, ray.observer, last, light))
          sum += light.column;
      }
    return sum;
  }

  std::vector<std::vector<PlacedJoint<double>>> chains() const {
    Vec3<double> observer;
    SunFrame<double>(sun_, plain).observer(observer.data());
    std::vector<std::vector<PlacedJoint<double>>> all;
    for (const Strand<double>& strand : strands_.all) {
      std::vector<StrandJoint<double>> joints;
      add_joints(strand, joints);
      all.emplace_back();
      for (const auto& joint : joints) all.back().push_back({joint, length3(minus3(joint.place, observer))});
    }
    return all;
  }

 private:
  Options options_;
  Sun sun_;
  Strands<double> strands_;
  double cell_rad_;
};

/// Returns the largest difference of the two lights, of the brightest.
double run(const Options& options) {
  const Bench bench(options);
  auto start = std::chrono::steady_clock::now();
  const StrandEmitter<double> emitter = bench.emitter();
  const double making_s = seconds_since(start);
  std::vector<double> times, light;
  for (int n = 0; n < options.repeat; ++n) {
    start = std::chrono::steady_clock::now();
    light = bench.film(emitter);
    times.push_back(seconds_since(start));
  }
  std::sort(times.begin(), times.end());
  const double median_s = times[times.size() / 2];
  const auto chains = bench.chains();
  const double rays = static_cast<double>(options.width) * options.height;
  double worst = 0.0, brightest = 0.0;
  start = std::chrono::steady_clock::now();
  for (int n = 0; n < options.brute_rays; ++n) {
    // Steps that meet all columns and rows.
    const int column = static_cast<int>((n * 7919LL) % options.width),
              row = static_cast<int>((n * 104729LL) % options.height);
    const double here = bench.brute(chains, column, row);
    worst = std::max(worst, std::abs(here - light[static_cast<std::size_t>(row) * options.width + column]));
    brightest = std::max(brightest, here);
  }
  const double brute_s = seconds_since(start) / options.brute_rays * rays / thread_count(options.threads);
  const double lit =
      static_cast<double>(std::count_if(light.begin(), light.end(), [](double x) { return x > 0.0; })) / rays;
  fmt::print("{} strands, {} segments, {} x {} rays, {} threads, {:.0f} % lit\n", options.strands,
             emitter.segments(), options.width, options.height, thread_count(options.threads), 100.0 * lit);
  fmt::print(
      "made in {:.2f} s, marched in {:.2f} s ({:.2f} to {:.2f}); brute force {:.0f} s: {:.0f} times as "
      "long\n",
      making_s, median_s, times.front(), times.back(), brute_s, brute_s / median_s);
  fmt::print("largest difference {:.1e} of the brightest\n", worst / brightest);
  return worst / brightest;
}

}  // namespace
}  // namespace vegard::bench

int main(int argc, char** argv) {
  using namespace vegard::bench;
  Options options;
  vegard::apps::Program program("strand_ray_bench", "Rays through strands", {}, argc, argv);
  const vegard::apps::Command app = program.root();
  bool tiny = false;
  app.option("--strands", options.strands).range(1, 100000);
  app.option("--width", options.width).range(1, 10000);
  app.option("--height", options.height).range(1, 10000);
  app.option("--threads", options.threads).range(0, 1024);
  app.option("--repeat", options.repeat).range(1, 1000);
  app.option("--falloff", options.falloff).one_of({"smooth", "linear", "gaussian"});
  program.add("tiny", "").runs([&] {
    tiny = true;
    return 0;
  });
  if (const std::optional<int> end = program.read()) return *end;
  if (tiny) {
    options.strands = 20;
    options.width = 82;
    options.height = 69;
    options.repeat = 1;
  }
  const double difference = run(options);
  return difference < 1e-9 ? 0 : 1;
}
