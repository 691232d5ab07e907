// The part of a footprint's grid that has light, in floats.
#pragma once

#include <vector>

#include "sim/emit/footprint/footprint_kernel_types.h"
#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {

class TexelStore {
 public:
  TexelStore() = default;
  /// Texels with a flux of at most min_flux become 0, and the part has a border of such texels.
  /// `with_energy`: ln_energy is stored even if the grid has none.
  TexelStore(const FootprintGrid<double>& grid, double min_flux, bool with_energy);

  /// Returns a window that points into this object.
  TexelWindow window() const;

 private:
  int columns_ = 0, rows_ = 0, first_x_ = 0, first_y_ = 0;
  std::vector<float> flux_, ln_energy_;
};

}  // namespace vegard::sim
