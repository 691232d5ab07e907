// The light of a map along lines of sight beside the plain product with the sparse matrix of the same
// operator, held in memory: time of A x and A' y by medians of turns in one run, on one thread, and memory.
//
//   build/release/tests/map_bench [WIDTH HEIGHT]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "sim/render/ground/ground_light.h"
#include "sim/scene/file/scene_toml.h"

namespace {

using namespace vegard::sim;  // NOLINT(google-build-using-namespace): one file, one program

/// Compressed rows: a row per ray and line, a column per cell and energy.
struct SparseMatrix {
  std::vector<std::size_t> first = {0};
  std::vector<std::uint32_t> column;
  std::vector<float> value;

  void times(const std::vector<float>& x, std::vector<float>& y) const {
    for (std::size_t row = 0; row + 1 < first.size(); ++row) {
      float sum = 0.0f;
      for (std::size_t i = first[row]; i < first[row + 1]; ++i) sum += value[i] * x[column[i]];
      y[row] = sum;
    }
  }
  void transposed_times(const std::vector<float>& y, std::vector<float>& x) const {
    std::fill(x.begin(), x.end(), 0.0f);
    for (std::size_t row = 0; row + 1 < first.size(); ++row)
      for (std::size_t i = first[row]; i < first[row + 1]; ++i) x[column[i]] += value[i] * y[row];
  }
  double megabytes() const {
    return (first.size() * sizeof(first[0]) + column.size() * (sizeof(column[0]) + sizeof(value[0]))) / 1e6;
  }
};

/// Stretches of one ray over one cell become one entry for each line and energy.
SparseMatrix matrix_of(const GroundLight& light, int energies) {
  SparseMatrix matrix;
  const SightLines& sight = light.sight();
  const LightBelow below = light.light_below();
  for (std::size_t ray = 0; ray < sight.rays(); ++ray) {
    std::map<std::uint32_t, std::vector<double>> cells;
    for (std::size_t i = sight.first[ray]; i < sight.first[ray + 1]; ++i) {
      const SightStretch s = sight.stretch[i];
      std::vector<double>& sums = cells[s.cell];
      sums.resize(static_cast<std::size_t>(below.lines) * energies, 0.0);
      const GroundNumbers *from = below.below + static_cast<std::size_t>(s.from) * below.lines,
                          *to = below.below + static_cast<std::size_t>(s.to) * below.lines;
      for (int line = 0; line < below.lines; ++line)
        for (int e = 0; e < energies; ++e)
          sums[static_cast<std::size_t>(line) * energies + e] +=
              static_cast<double>(s.km_per_km) * (to[line].of_energy[e] - from[line].of_energy[e]);
    }
    for (int line = 0; line < below.lines; ++line) {
      for (const auto& [cell, sums] : cells)
        for (int e = 0; e < energies; ++e) {
          matrix.column.push_back(cell * kGroundEnergies + static_cast<std::uint32_t>(e));
          matrix.value.push_back(static_cast<float>(sums[static_cast<std::size_t>(line) * energies + e]));
        }
      matrix.first.push_back(matrix.column.size());
    }
  }
  return matrix;
}

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc > 2 ? std::atoi(argv[1]) : 180, height = argc > 2 ? std::atoi(argv[2]) : 120;
  Scene scene = parse_scene(
      fmt::format(
          "[site]\nlatitude_deg = 67.0\n[field]\ninclination_deg = 78.0\n[camera]\nwidth = {}\nheight = {}\n"
          "hfov_deg = 66\nelevation_deg = 35\n[emission]\nflux_law = \"linear\"\n",
          width, height),
      "bench");
  const FilmGeometry film = {0.0, 0.0, 1.0, 1.0, width, height};
  const std::vector<std::uint8_t> wanted(static_cast<std::size_t>(width) * height, 1);
  std::vector<double> energies;
  for (int e = 0; e < kGroundEnergies; ++e)
    energies.push_back(0.4 * std::pow(35.0, e / (kGroundEnergies - 1.0)));
  const double resolution = 0.8 * 66.0 / width * 0.017453292519943295;
  GroundGrid grid(rings_resolved(resolution, 1.5, 600.0));
  // Cells that some ray sees, as a map has them.
  std::vector<bool> seen(static_cast<std::size_t>(grid.cells()), false);
  for (const SightStretch& s : sight_lines(scene, scene.site, grid, film, wanted, 1).stretch)
    seen[s.cell] = true;
  grid.keep(seen);
  const GroundLight light(scene, scene.site, grid, film, wanted, energies, 1.0, 1);
  const SparseMatrix matrix = matrix_of(light, kGroundEnergies);

  std::vector<float> x(light.numbers(), 1.0f), y(light.rays() * 3, 0.0f), y2 = y, x1 = x, x2 = x;
  std::vector<double> ours, theirs, ours_back, theirs_back;
  constexpr int kTurns = 9;
  for (int turn = 0; turn < kTurns; ++turn) {
    ours.push_back(seconds([&] { light.forward(x, y); }));
    theirs.push_back(seconds([&] { matrix.times(x, y2); }));
    ours_back.push_back(seconds([&] {
      std::fill(x1.begin(), x1.end(), 0.0f);
      light.add_adjoint(y, x1);
    }));
    theirs_back.push_back(seconds([&] { matrix.transposed_times(y, x2); }));
  }
  double apart = 0.0, size = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    apart = std::max(apart, static_cast<double>(std::abs(y[i] - y2[i])));
    size = std::max(size, static_cast<double>(std::abs(y2[i])));
  }
  const double ours_mb = light.sight().stretch.size() * sizeof(SightStretch) / 1e6;
  fmt::print("{} x {} rays, {} cells, {} energies, 3 lines; largest difference {:.1e} of the brightest\n",
             width, height, grid.cells(), kGroundEnergies, apart / size);
  fmt::print("{:<10} {:>12} {:>12} {:>12}\n", "", "A x (ms)", "A' y (ms)", "memory (MB)");
  fmt::print("{:<10} {:>12.2f} {:>12.2f} {:>12.1f}\n", "stretches", 1e3 * median(ours),
             1e3 * median(ours_back), ours_mb);
  fmt::print("{:<10} {:>12.2f} {:>12.2f} {:>12.1f}\n", "matrix", 1e3 * median(theirs),
             1e3 * median(theirs_back), matrix.megabytes());
  // A benchmark of two things that disagree would be worth nothing.
  return apart < 1e-4 * size ? 0 : 1;
}
