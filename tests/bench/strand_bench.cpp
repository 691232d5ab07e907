// How fast strands become voxels, beside the source's way: every voxel, every strand, 400 steps of t.
//
//   strand_bench [--voxels N] [--strands N] [--threads N] [--repeat N]
//     N^3 voxels about so many strands of five macro-loops (default: 300, 400). The plain way is run for a
//     subset of the voxels, spread over the box, and its time multiplied; both are of the same radii.
//   strand_bench tiny
//     A check that it still runs, and that both come to the same densities.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

#include "apps/options/command.h"
#include "sim/base/number/mask5.h"
#include "sim/emit/grid/grid_filter.h"
#include "sim/emit/sun/strand/closest_point.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_grid.h"

namespace vegard::bench {
namespace {

using namespace sim;

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  return of[of.size() / 2];
}

/// Macro-loops side by side, in a box some 130 wide.
Strands<double> five_loops(int strands) {
  Strands<double> all;
  for (std::uint32_t i = 0; i < 5; ++i) {
    Loop loop;
    loop.latitude_deg = 2.0 * i - 4.0;
    loop.bearing_deg = 75.0 + 8.0 * i;
    loop.height = 50.0 + 8.0 * i;
    loop.width = 70.0 + 6.0 * i;
    loop.tilt_deg = 15.0 * i - 30.0;
    loop.name = "loop" + std::to_string(i);
    loop.strands = strands / 5;
    loop.strand_radius = 1.0;
    loop.root_noise = 1.0;
    loop.height_noise = 0.05;
    loop.filaments = 8;
    const Strands<double> some =
        strands_of<double>(Sun{}, loop, 1, [](const double& number) { return number; });
    all.all.insert(all.all.end(), some.all.begin(), some.all.end());
  }
  return all;
}

/// The cube about all points of the curves.
SparseGrid cube_about(const Strands<double>& strands, int voxels) {
  double low[3], high[3], edge = 0.0;
  for (int a = 0; a < 3; ++a) {
    low[a] = 1e300;
    high[a] = -1e300;
    for (const Strand<double>& s : strands.all)
      for (int step = 0; step <= 100; ++step) {
        const double t = step / 100.0, u = 1.0 - t;
        const double at = u * u * u * s.points[0][a] + 3 * u * u * t * s.points[1][a] +
                          3 * u * t * t * s.points[2][a] + t * t * t * s.points[3][a];
        low[a] = std::min(low[a], at - s.radius_first);
        high[a] = std::max(high[a], at + s.radius_first);
      }
    edge = std::max(edge, high[a] - low[a]);
  }
  SparseGrid grid;
  grid.voxel = edge / voxels;
  grid.channels.push_back({"density", ""});
  for (int a = 0; a < 3; ++a) grid.origin[a] = 0.5 * (low[a] + high[a] - edge);
  return grid;
}

/// The source's loop: the nearest of 400 places, steps of 0.0025.
double plainly(const Strands<double>& strands, const double place[3]) {
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (const Strand<double>& s : strands.all) {
    double least = 1e300, nearest = 0.0;
    for (int step = 0; step < kSteps; ++step) {
      const double t = step * (1.0 / kSteps), u = 1.0 - t;
      const double w[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
      double square = 0.0;
      for (int a = 0; a < 3; ++a) {
        const double off = w[0] * s.points[0][a] + w[1] * s.points[1][a] + w[2] * s.points[2][a] +
                           w[3] * s.points[3][a] - place[a];
        square += off * off;
      }
      const double distance = std::sqrt(square);
      if (distance < least) {
        least = distance;
        nearest = t;
      }
    }
    if (least < s.radius_first)
      sum += density_in_middle(s, nearest) * falloff_across(strands.falloff, least / s.radius_first);
  }
  return sum;
}

int run(int voxels, int strand_count, int threads, int repeat) {
  const Strands<double> strands = five_loops(strand_count);
  const SparseGrid cube = cube_about(strands, voxels);
  StrandGridOptions options;
  options.threads = threads;
  SparseGrid grid;
  // A subset of the voxels of the cube, every so many along each axis.
  const int apart = std::max(1, voxels / 12);
  double worst = 0.0, plain_off = 0.0, brightest = 0.0;
  std::vector<double> fast, slow;
  for (int n = 0; n < repeat; ++n) {
    grid = cube;
    fast.push_back(seconds_of([&] { add_strands(strands, {1.0}, options, grid); }));
    long count = 0;
    const double seconds = seconds_of([&] {
      for (int i = apart / 2; i < voxels; i += apart)
        for (int j = apart / 2; j < voxels; j += apart)
          for (int k = apart / 2; k < voxels; k += apart, ++count) {
            const double place[3] = {cube.origin[0] + cube.voxel * (i + 0.5),
                                     cube.origin[1] + cube.voxel * (j + 0.5),
                                     cube.origin[2] + cube.voxel * (k + 0.5)};
            const double is = plainly(strands, place);
            plain_off = std::max(plain_off, std::abs(is - grid.value(0, i, j, k)));
          }
    });
    slow.push_back(seconds / static_cast<double>(count) * std::pow(voxels, 3));
  }
  // By the definition, which finds the nearest point for certain.
  for (int i = apart / 2; i < voxels; i += apart)
    for (int j = apart / 2; j < voxels; j += apart)
      for (int k = apart / 2; k < voxels; k += apart) {
        double is = 0.0;
        for (const Strand<double>& strand : strands.all)
          is += density_at(strand, strands.falloff,
                           {cube.origin[0] + cube.voxel * (i + 0.5), cube.origin[1] + cube.voxel * (j + 0.5),
                            cube.origin[2] + cube.voxel * (k + 0.5)});
        brightest = std::max(brightest, is);
        worst = std::max(worst, std::abs(is - grid.value(0, i, j, k)));
      }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double bytes = static_cast<double>(grid.bricks.size()) * SparseGrid::kVoxels * sizeof(float);
  fmt::print("{}^3 voxels of {:.3g}, {} strands of radius {:.2g} voxels\n", voxels, cube.voxel,
             strands.all.size(), 1.0 / cube.voxel);
  fmt::print("  strands to grid  {:.3g} s (median of {}; {:.3g} to {:.3g})\n", median(fast), repeat,
             *std::min_element(fast.begin(), fast.end()), *std::max_element(fast.begin(), fast.end()));
  fmt::print("  the plain way    {:.4g} s (scaled from {} voxels, one thread)\n", median(slow),
             std::pow((voxels - apart / 2 + apart - 1) / apart, 3));
  fmt::print("  ratio            {:.0f}\n", median(slow) / median(fast));
  fmt::print("  grid             {} bricks, {:.1f} MB (dense: {:.0f} MB); the process at most {:.0f} MB\n",
             grid.bricks.size(), bytes / 1048576.0, std::pow(voxels, 3) * 4.0 / 1048576.0,
             static_cast<double>(usage.ru_maxrss) / 1024.0);
  fmt::print("  off at most      {:.2g} of densities up to {:.3g}; the plain way, by its steps, {:.2g}\n",
             worst, brightest, plain_off);
  SparseGrid filtered = grid;
  fmt::print("  blur             {:.3g} s\n",
             seconds_of([&] { filter_grid(filtered, blur_mask(), threads); }));
  return brightest > 0.0 && worst < 1e-4 * brightest ? 0 : 1;
}

int main_of(int argc, char** argv) {
  apps::Program program("strand_bench", "Strands to voxels", {}, argc, argv);
  const apps::Command app = program.root();
  int voxels = 300, strands = 400, threads = 0, repeat = 3;
  app.option("--voxels", voxels).range(8, 4096);
  app.option("--strands", strands).range(5, 100000);
  app.option("--threads", threads);
  app.option("--repeat", repeat).range(1, 100);
  bool tiny = false;
  program.add("tiny", "").runs([&] {
    tiny = true;
    return 0;
  });
  if (const std::optional<int> end = program.read()) return *end;
  if (tiny) return run(40, 20, 1, 1);
  return run(voxels, strands, threads, repeat);
}

}  // namespace
}  // namespace vegard::bench

int main(int argc, char** argv) { return vegard::bench::main_of(argc, argv); }
