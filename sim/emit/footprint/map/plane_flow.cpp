#include "sim/emit/footprint/map/plane_flow.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include <unsupported/Eigen/FFT>

#include "sim/base/number/constants.h"
#include "sim/base/number/noise.h"
#include "sim/base/parallel.h"
#include "sim/emit/footprint/map/flow_cubic.h"
#include "sim/emit/footprint/map/flow_reach.h"
#include "sim/light/sample.h"
#include "sim/scene/structs/body.h"

namespace vegard::sim {
namespace {

constexpr double kFlowMaxCells = 262144.0;  // of the flow's grid
constexpr double kAround = 1.25;            // the periodic plane over the box
constexpr double kFlowStep = 0.5;           // of time, over the inverse of the largest vorticity
constexpr int kStretchSteps = 6;            // of time, to a stretch
constexpr int kMidpointLooks = 3;           // each a quarter as far from the middle as the one before
constexpr int kRippleOctaves = 3;

/// The flow while it is worked out. Lengths are in its cells.
class Flow {
 public:
  Flow(int columns, int rows, int threads)
      : columns_(columns), rows_(rows), threads_(threads), cells_(static_cast<std::size_t>(columns) * rows) {}

  /// The vorticity at the very start, largest 1, and at the start of this stretch.
  FlowLayer first, start;
  /// The displacement of each cell's content since this stretch began: its earlier place less its place.
  FlowStretch back;
  FlowLayer stream, velocity_column, velocity_row;

  /// Stream function and velocities of the vorticity that has come to each cell.
  void solve() {
    std::vector<std::complex<double>> plane(cells_);
    each_row([&](int r) {
      FlowCubic cubic(columns_, rows_);
      for (int c = 0; c < columns_; ++c) {
        const std::size_t i = at(c, r);
        cubic.look(c + back.columns[i], r + back.rows[i]);
        plane[i] = cubic.of(start);
      }
    });
    transform_plane(plane, columns_, rows_, false, threads_);
    each_row([&](int r) {
      const double ky = 2.0 * kPi * wave_number(r, rows_) / rows_;
      for (int c = 0; c < columns_; ++c) {
        const double kx = 2.0 * kPi * wave_number(c, columns_) / columns_;
        const double square = kx * kx + ky * ky;
        // The mean has no flow.
        plane[at(c, r)] *= square > 0.0 ? -1.0 / square : 0.0;
      }
    });
    transform_plane(plane, columns_, rows_, true, threads_);
    for (std::size_t i = 0; i < cells_; ++i) stream[i] = plane[i].real();
    each_row([&](int r) {
      for (int c = 0; c < columns_; ++c) {
        const FlowPair velocity = velocity_at_cell(stream, c, r);
        velocity_column[at(c, r)] = velocity[0];
        velocity_row[at(c, r)] = velocity[1];
      }
    });
  }

  /// Follows every cell back by a step, by the implicit midpoint rule, which keeps areas. `middle` is the
  /// stream function in the step's middle.
  void step(double time, const FlowLayer& middle) {
    FlowStretch next;
    next.columns.resize(cells_);
    next.rows.resize(cells_);
    each_row([&](int r) {
      FlowCubic cubic(columns_, rows_);
      for (int c = 0; c < columns_; ++c) {
        FlowPair velocity = velocity_at_cell(middle, c, r);
        for (int k = 1; k < kMidpointLooks; ++k) {
          cubic.look_for_velocity(c - 0.5 * time * velocity[0], r - 0.5 * time * velocity[1]);
          velocity = cubic.velocity(middle);
        }
        cubic.look(c - time * velocity[0], r - time * velocity[1]);
        const FlowPair from = cubic.of(back) - time * velocity;
        const std::size_t i = at(c, r);
        next.columns[i] = from[0];
        next.rows[i] = from[1];
      }
    });
    back = std::move(next);
  }

  /// Begins another stretch: its vorticity is that of the very start, at the places where all stretches
  /// together lead back to, so that no error adds up.
  void begin_stretch(const std::vector<FlowStretch>& before) {
    back.columns.assign(cells_, 0.0);
    back.rows.assign(cells_, 0.0);
    start.resize(cells_);
    each_row([&](int r) {
      FlowCubic cubic(columns_, rows_);
      for (int c = 0; c < columns_; ++c) {
        double column = c, row = r;
        cubic.follow(before, column, row);
        cubic.look(column, row);
        start[at(c, r)] = cubic.of(first);
      }
    });
  }

  double energy() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < cells_; ++i)
      sum += 0.5 * (velocity_column[i] * velocity_column[i] + velocity_row[i] * velocity_row[i]);
    return sum;
  }

  /// At a cell's middle the slopes of a cubic convolution are central differences.
  FlowPair velocity_at_cell(const FlowLayer& stream_function, int c, int r) const {
    const int left = c > 0 ? c - 1 : columns_ - 1, right = c + 1 < columns_ ? c + 1 : 0,
              below = r > 0 ? r - 1 : rows_ - 1, above = r + 1 < rows_ ? r + 1 : 0;
    return FlowPair{0.5, 0.5} * FlowPair{stream_function[at(c, below)], stream_function[at(right, r)]} -
           FlowPair{0.5, 0.5} * FlowPair{stream_function[at(c, above)], stream_function[at(left, r)]};
  }

  std::size_t cells() const { return cells_; }
  std::size_t at(int column, int row) const { return static_cast<std::size_t>(row) * columns_ + column; }
  template <class Body>
  void each_row(const Body& body) {
    parallel_for(rows_, threads_, [&](std::size_t row, int) { body(static_cast<int>(row)); });
  }

 private:
  int columns_, rows_, threads_;
  std::size_t cells_;
};

using Complex = std::complex<double>;

/// One thread's room.
struct Work {
  Eigen::FFT<double> transform;
  std::vector<Complex> in, out;

  void run(bool backwards) {
    if (backwards)
      transform.inv(out, in);
    else
      transform.fwd(out, in);
  }
};

}  // namespace

double flow_turns_at(const Footprint& f, double instant_s) {
  constexpr double kMaxTurns = 10.0;
  return std::clamp(f.flow_turns + f.flow_turns_per_s * instant_s, 0.0, kMaxTurns);
}

PlaneFlow wind_up(const PlaneFootprint<double>& plane, const Footprint& f, double turns, std::uint64_t seed,
                  int index, bool stands_north, int threads) {
  PlaneFlow result;
  const FootprintGrid<double>& grid = plane.grid;
  if (turns <= 0.0 || grid.flux_mw_m2.empty()) return result;
  int block = 1;  // of the footprint's cells, to one of the flow's along either axis
  while (kAround * kAround * grid.columns * grid.rows / (block * block) > kFlowMaxCells) ++block;
  const int box_columns = (grid.columns + block - 1) / block, box_rows = (grid.rows + block - 1) / block;
  const int columns = transform_size(static_cast<int>(std::ceil(kAround * box_columns))),
            rows = transform_size(static_cast<int>(std::ceil(kAround * box_rows)));
  const int margin_columns = (columns - box_columns) / 2, margin_rows = (rows - box_rows) / 2;
  const double cell_km = block * plane.cell_km;
  Flow flow(columns, rows, threads);
  for (FlowLayer* layer : {&flow.first, &flow.stream, &flow.velocity_column, &flow.velocity_row})
    layer->assign(flow.cells(), 0.0);
  parallel_for(box_rows, threads, [&](std::size_t r, int) {
    const int row = static_cast<int>(r);
    for (int column = 0; column < box_columns; ++column) {
      double sum = 0.0;
      for (int j = row * block; j < std::min(grid.rows, (row + 1) * block); ++j)
        for (int i = column * block; i < std::min(grid.columns, (column + 1) * block); ++i)
          sum += grid.flux_mw_m2[static_cast<std::size_t>(j) * grid.columns + i];
      if (sum == 0.0) continue;
      // Counted from the middle of the box, so that it goes with the footprint.
      const double east = (column + 0.5 - 0.5 * box_columns) * cell_km,
                   north = (row + 0.5 - 0.5 * box_rows) * cell_km;
      const double noise = octave_noise(seed, Stream::ripple, static_cast<std::uint32_t>(index),
                                        kRippleOctaves, east / f.flow_scale_km, north / f.flow_scale_km, 0.5);
      flow.first[flow.at(column + margin_columns, row + margin_rows)] = sum * (1.0 + f.flow_ripple * noise);
    }
  });
  double largest = 0.0;
  for (const double w : flow.first) largest = std::max(largest, std::abs(w));
  if (largest <= 0.0) return result;
  // Counter-clockwise seen along B is so from above in the north.
  const double sense = (f.flow_sense == FlowSense::spiral) == stands_north ? 1.0 : -1.0;
  for (double& w : flow.first) w *= sense / largest;

  const double duration = 4.0 * kPi * turns;
  const int steps = std::max(1, static_cast<int>(std::ceil(duration / kFlowStep)));
  const double time = duration / steps;
  flow.begin_stretch({});
  flow.solve();
  result.energy_first = flow.energy();
  FlowLayer before = flow.stream, middle(flow.cells());
  for (int s = 0; s < steps; ++s) {
    // The stream function in the middle of the step is extrapolated from this step and the one before.
    for (std::size_t i = 0; i < flow.cells(); ++i) middle[i] = 1.5 * flow.stream[i] - 0.5 * before[i];
    before = flow.stream;
    flow.step(time, middle);
    if ((s + 1) % kStretchSteps == 0 || s + 1 == steps) {
      result.stretches.push_back(flow.back);
      flow.begin_stretch(result.stretches);
    }
    flow.solve();
  }
  result.energy_last = flow.energy();
  result.columns = columns;
  result.rows = rows;
  result.cell_km = cell_km;
  result.west_km = plane.west_km - margin_columns * cell_km;
  result.south_km = plane.south_km - margin_rows * cell_km;
  result.velocity_east = std::move(flow.velocity_column);
  result.velocity_north = std::move(flow.velocity_row);
  return result;
}

template <class T>
void carry(const PlaneFlow& flow, PlaneFootprint<T>& plane, int threads) {
  FootprintGrid<T>& grid = plane.grid;
  if (flow.columns == 0 || grid.flux_mw_m2.empty()) return;
  constexpr int kParts = 2;
  const bool has_energy = !grid.ln_energy.empty();
  const std::vector<T> flux = grid.flux_mw_m2, energy = grid.ln_energy;
  const LitCells lit(flux, grid.columns, grid.rows);
  const FlowReach reach(flow);
  const double flow_cells = plane.cell_km / flow.cell_km;
  // Cells of the footprint in cells of the flow, and back.
  const auto to_flow = [&](double cell, double from_km, double flow_from_km) {
    return (from_km + cell * plane.cell_km - flow_from_km) / flow.cell_km - 0.5;
  };
  const auto from_flow = [&](double cell, double from_km, double flow_from_km) {
    return (flow_from_km + (cell + 0.5) * flow.cell_km - from_km) / plane.cell_km - 0.5;
  };
  const auto came_from_light = [&](FlowCubic& cubic, int column, int end_column, int row, int end_row) {
    const FlowBox box =
        reach.follow(cubic, {to_flow(0.5 * (column + end_column), plane.west_km, flow.west_km),
                             to_flow(0.5 * (row + end_row), plane.south_km, flow.south_km),
                             0.5 * (end_column - column) * flow_cells, 0.5 * (end_row - row) * flow_cells});
    const double x = from_flow(box.column, plane.west_km, flow.west_km),
                 y = from_flow(box.row, plane.south_km, flow.south_km),
                 half_x = box.half_columns / flow_cells + 1.0, half_y = box.half_rows / flow_cells + 1.0;
    return lit.any(x - half_x, x + half_x, y - half_y, y + half_y);
  };
  constexpr int kTile = 8;
  const int tile_rows = (grid.rows + kTile - 1) / kTile;
  parallel_for(tile_rows, threads, [&](std::size_t tile_row, int) {
    FlowCubic cubic(flow.columns, flow.rows);
    const auto carry_cell = [&](int column, int row) {
      T sum(0.0), of_energy(0.0);
      for (int part = 0; part < kParts * kParts; ++part) {
        const int part_column = part % kParts, part_row = part / kParts;
        const double east = plane.west_km + (column + (part_column + 0.5) / kParts) * plane.cell_km;
        const double north =
            plane.south_km + (static_cast<double>(row) + (part_row + 0.5) / kParts) * plane.cell_km;
        double flow_column = (east - flow.west_km) / flow.cell_km - 0.5,
               flow_row = (north - flow.south_km) / flow.cell_km - 0.5;
        cubic.follow(flow.stretches, flow_column, flow_row);
        const double x =
            (flow.west_km + (flow_column + 0.5) * flow.cell_km - plane.west_km) / plane.cell_km - 0.5;
        const double y =
            (flow.south_km + (flow_row + 0.5) * flow.cell_km - plane.south_km) / plane.cell_km - 0.5;
        const double left = std::floor(x), below = std::floor(y);
        if (left < -1.0 || below < -1.0 || left >= grid.columns || below >= grid.rows) continue;
        for (int j = 0; j < 2; ++j)
          for (int i = 0; i < 2; ++i) {
            const int c = static_cast<int>(left) + i, r = static_cast<int>(below) + j;
            if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) continue;
            const double weight = (i == 0 ? left + 1.0 - x : x - left) *
                                  (j == 0 ? below + 1.0 - y : y - below) / (kParts * kParts);
            const std::size_t from = static_cast<std::size_t>(r) * grid.columns + c;
            sum = sum + flux[from] * weight;
            if (has_energy) of_energy = of_energy + flux[from] * energy[from] * weight;
          }
      }
      const std::size_t to = static_cast<std::size_t>(row) * grid.columns + column;
      grid.flux_mw_m2[to] = sum;
      if (has_energy) grid.ln_energy[to] = value_of(sum) > 0.0 ? of_energy / sum : T(0.0);
    };
    const int first_row = static_cast<int>(tile_row) * kTile,
              end_row = std::min(grid.rows, first_row + kTile);
    for (int column = 0; column < grid.columns; column += kTile) {
      const int end_column = std::min(grid.columns, column + kTile);
      const bool is_lit = came_from_light(cubic, column, end_column, first_row, end_row);
      for (int r = first_row; r < end_row; ++r)
        for (int c = column; c < end_column; ++c) {
          if (is_lit) {
            carry_cell(c, r);
            continue;
          }
          const std::size_t to = static_cast<std::size_t>(r) * grid.columns + c;
          grid.flux_mw_m2[to] = T(0.0);
          if (has_energy) grid.ln_energy[to] = T(0.0);
        }
    }
  });
}

template void carry(const PlaneFlow&, PlaneFootprint<double>&, int);
template void carry(const PlaneFlow&, PlaneFootprint<FreeDual>&, int);

int transform_size(int least) {
  for (int n = std::max(2, least + least % 2);; n += 2) {
    int rest = n;
    for (const int prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

void transform_plane(std::vector<Complex>& values, int columns, int rows, bool backwards, int threads) {
  std::vector<Work> work(thread_count(threads));
  parallel_for(rows, threads, [&](std::size_t row, int slot) {
    Work& w = work[slot];
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row) * columns;
    w.in.assign(begin, begin + columns);
    w.run(backwards);
    std::copy(w.out.begin(), w.out.end(), begin);
  });
  // Neighbouring columns lie in the same lines of the cache.
  constexpr int kColumns = 8;
  parallel_for((columns + kColumns - 1) / kColumns, threads, [&](std::size_t block, int slot) {
    Work& w = work[slot];
    const int first = static_cast<int>(block) * kColumns, count = std::min(kColumns, columns - first);
    std::vector<Complex> taken(static_cast<std::size_t>(rows) * kColumns);
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < count; ++c)
        taken[static_cast<std::size_t>(c) * rows + r] =
            values[static_cast<std::size_t>(r) * columns + first + c];
    for (int c = 0; c < count; ++c) {
      const auto begin = taken.begin() + static_cast<std::ptrdiff_t>(c) * rows;
      w.in.assign(begin, begin + rows);
      w.run(backwards);
      std::copy(w.out.begin(), w.out.end(), begin);
    }
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < count; ++c)
        values[static_cast<std::size_t>(r) * columns + first + c] =
            taken[static_cast<std::size_t>(c) * rows + r];
  });
}

}  // namespace vegard::sim
