#include "sim/emit/footprint/lit_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/number/distance_transform.h"
#include "sim/base/number/dual.h"
#include "sim/emit/footprint/foot.h"
#include "sim/light/sample.h"

namespace vegard::sim {
namespace {

constexpr int kTexels = LitMap::kCellTexels;

int cells_for(int first, int last) { return (last - first) / kTexels + 1; }

/// The texel place of a direction on a face; false where it is behind the cube's centre.
bool texel_of(const double direction[3], int face, int face_cells, double& x, double& y) {
  AirPoint<double> p;
  std::copy_n(direction, 3, p.x);
  p.square = 0.0;
  const FacePlace<double> at = place_on_face(p, face);
  if (at.ahead <= 1.0) return false;  // of directions that are thousands long
  x = (at.u + 1.0) * 0.5 * face_cells + 0.5;
  y = (at.v + 1.0) * 0.5 * face_cells + 0.5;
  return true;
}

/// The other way round.
void direction_of(double x, double y, int face, int face_cells, double direction[3]) {
  constexpr double kLength = 6000.0;
  const int a = face / 2;
  direction[a] = face % 2 == 0 ? kLength : -kLength;
  direction[(a + 1) % 3] = kLength * ((x - 0.5) / (0.5 * face_cells) - 1.0);
  direction[(a + 2) % 3] = kLength * ((y - 0.5) / (0.5 * face_cells) - 1.0);
}

}  // namespace

LitMap::LitMap(int first_x, int last_x, int first_y, int last_y)
    : first_x_(first_x),
      first_y_(first_y),
      columns_(cells_for(first_x, last_x)),
      rows_(cells_for(first_y, last_y)),
      marked_(static_cast<std::size_t>(columns_) * rows_, 0) {}

void LitMap::mark(double low_x, double high_x, double low_y, double high_y) {
  const auto index = [](double place, int first) {
    return static_cast<int>(std::floor(std::clamp((place - first) / kTexels, -1.0, 1e6)));
  };
  const int left = std::max(0, index(low_x, first_x_)),
            right = std::min(columns_ - 1, index(high_x, first_x_));
  const int low = std::max(0, index(low_y, first_y_)), high = std::min(rows_ - 1, index(high_y, first_y_));
  for (int row = low; row <= high; ++row)
    for (int column = left; column <= right; ++column)
      marked_[static_cast<std::size_t>(row) * columns_ + column] = 1;
}

void LitMap::mark_edge() {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      if (row == 0 || column == 0 || row == rows_ - 1 || column == columns_ - 1)
        marked_[static_cast<std::size_t>(row) * columns_ + column] = 1;
}

void LitMap::finish(int threads) {
  const std::vector<std::uint32_t> squares = squared_distance(marked_, columns_, rows_, false, threads);
  dark_.resize(squares.size());
  for (std::size_t i = 0; i < squares.size(); ++i) {
    // Two places in cells so far apart are closer by up to a diagonal of a cell.
    const double cells = squares[i] == kNoMark ? 1e6 : std::sqrt(static_cast<double>(squares[i]));
    dark_[i] = static_cast<float>(std::clamp((cells - std::sqrt(2.0)) * kTexels * (1.0 - 1e-6), 0.0, 1e6));
  }
  marked_ = {};
}

template <class T>
std::vector<std::uint8_t> lit_texels(const FootprintGrid<T>& grid, double min_flux) {
  std::vector<std::uint8_t> lit(grid.flux_mw_m2.size());
  for (std::size_t i = 0; i < lit.size(); ++i) lit[i] = value_of(grid.flux_mw_m2[i]) > min_flux ? 1 : 0;
  return lit;
}
template std::vector<std::uint8_t> lit_texels(const FootprintGrid<double>&, double);
template std::vector<std::uint8_t> lit_texels(const FootprintGrid<FreeDual>&, double);

LitMap plane_lit_map(int columns, int rows, const std::vector<std::uint8_t>& lit, int threads) {
  LitMap map(-1, columns, -1, rows);
  for (std::size_t i = 0; i < lit.size(); ++i)
    if (lit[i] != 0) map.mark_texel(static_cast<int>(i % columns), static_cast<int>(i / columns));
  map.finish(threads);
  return map;
}

std::vector<LitMap> cube_lit_maps(int face_cells, const std::array<std::vector<std::uint8_t>, 6>& lit,
                                  int threads) {
  // Squares of texels with light, by their first texel.
  struct Square {
    int x, y;
  };
  const int pitch = face_cells + 2;
  std::array<std::vector<Square>, 6> squares;
  for (int face = 0; face < 6; ++face) {
    if (lit[face].empty()) continue;
    const auto any_in = [&](int x0, int y0) {
      for (int y = y0; y < std::min(pitch, y0 + kTexels); ++y) {
        const auto row = lit[face].begin() + static_cast<std::ptrdiff_t>(y) * pitch;
        if (std::any_of(row + x0, row + std::min(pitch, x0 + kTexels), [](std::uint8_t l) { return l != 0; }))
          return true;
      }
      return false;
    };
    for (int y = 0; y < pitch; y += kTexels)
      for (int x = 0; x < pitch; x += kTexels)
        if (any_in(x, y)) squares[face].push_back({x, y});
  }
  const int beyond = face_cells / 8 + 2 * kTexels;
  std::vector<LitMap> maps;
  for (int face = 0; face < 6; ++face) {
    LitMap map(-beyond, face_cells + 1 + beyond, -beyond, face_cells + 1 + beyond);
    map.mark_edge();
    for (int other = 0; other < 6; ++other)
      for (const Square& square : squares[other]) {
        double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
        bool ahead = true;
        for (int corner = 0; corner < 4; ++corner) {
          double direction[3], x = 0.0, y = 0.0;
          direction_of(square.x + (corner % 2 == 0 ? -1.0 : kTexels),
                       square.y + (corner < 2 ? -1.0 : kTexels), other, face_cells, direction);
          ahead = ahead && texel_of(direction, face, face_cells, x, y);
          low_x = std::min(low_x, x), high_x = std::max(high_x, x);
          low_y = std::min(low_y, y), high_y = std::max(high_y, y);
        }
        // Half-way round a square that is behind is far beyond the map.
        if (ahead) map.mark(low_x, high_x, low_y, high_y);
      }
    map.finish(threads);
    maps.push_back(std::move(map));
  }
  return maps;
}

TexelStore::TexelStore(const FootprintGrid<double>& grid, double min_flux, bool with_energy) {
  int left = grid.columns, right = -1, low = grid.rows, high = -1;
  for (std::size_t i = 0; i < grid.flux_mw_m2.size(); ++i) {
    if (!(grid.flux_mw_m2[i] > min_flux)) continue;
    const int column = static_cast<int>(i % grid.columns), row = static_cast<int>(i / grid.columns);
    left = std::min(left, column), right = std::max(right, column);
    low = std::min(low, row), high = std::max(high, row);
  }
  if (right < 0) return;
  first_x_ = left - 1, first_y_ = low - 1;
  columns_ = right - left + 3, rows_ = high - low + 3;
  // What is read beyond the last texel of a row or the last row has no weight.
  flux_.assign(static_cast<std::size_t>(columns_) * (rows_ + 1) + 1, 0.0f);
  if (with_energy) ln_energy_ = flux_;
  for (int y = std::max(0, first_y_); y < std::min(grid.rows, first_y_ + rows_); ++y)
    for (int x = std::max(0, first_x_); x < std::min(grid.columns, first_x_ + columns_); ++x) {
      const std::size_t from = static_cast<std::size_t>(y) * grid.columns + x;
      const std::size_t to = static_cast<std::size_t>(y - first_y_) * columns_ + (x - first_x_);
      if (grid.flux_mw_m2[from] > min_flux) flux_[to] = static_cast<float>(grid.flux_mw_m2[from]);
      if (with_energy && !grid.ln_energy.empty()) ln_energy_[to] = static_cast<float>(grid.ln_energy[from]);
    }
}

TexelWindow TexelStore::window() const {
  TexelWindow window;
  if (flux_.empty()) return window;
  window.flux = flux_.data();
  window.ln_energy = ln_energy_.empty() ? nullptr : ln_energy_.data();
  window.columns = columns_;
  window.rows = rows_;
  window.first_x = first_x_;
  window.first_y = first_y_;
  return window;
}

}  // namespace vegard::sim
