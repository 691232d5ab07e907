#include "sim/emit/footprint/texel_store.h"

#include <algorithm>
#include <cstddef>

namespace vegard::sim {

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
