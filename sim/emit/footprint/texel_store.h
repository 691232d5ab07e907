// The part of a footprint's grid that has light, in floats.
#pragma once

#include <vector>

#include "sim/emit/footprint/footprint_kernel_types.h"
#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {

class TexelStore {
 public:
  TexelStore() = default;
  /// Texels of no more than min_flux are 0 in it, and a border of those stands around. `with_energy`: it
  /// has ln_energy even where the grid has none.
  TexelStore(const FootprintGrid<double>& grid, double min_flux, bool with_energy);

  /// Points into this.
  TexelWindow window() const;

 private:
  int columns_ = 0, rows_ = 0, first_x_ = 0, first_y_ = 0;
  std::vector<float> flux_, ln_energy_;
};

}  // namespace vegard::sim
