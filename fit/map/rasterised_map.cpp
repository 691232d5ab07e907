#include "fit/map/rasterised_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace vegard::fit {
namespace {

constexpr double kMinLitShare = 1e-4;  // of the brightest pixel: a flux below it has no energy

}  // namespace

RasterisedMap rasterised_map(const MapResult& result) {
  const RasterGrid raster = raster_over(result);
  const RasterFlux flux = raster_flux(result, raster, result.cells);
  const std::vector<CellError> errors = cell_errors(result);
  // Errors are means by flux, so that dark cells do not speak for lit ones.
  std::vector<double> relative, ln_energy, sensitivity(result.sensitivity.begin(), result.sensitivity.end());
  for (std::size_t c = 0; c < errors.size(); ++c) {
    const double q = result.cells[c].flux_mw_m2;
    relative.push_back(q > 0.0 ? q * errors[c].relative_flux : 0.0);
    ln_energy.push_back(q > 0.0 ? q * errors[c].ln_energy : 0.0);
  }
  const std::vector<double> flux_error = rasterised(result, raster, relative);
  const std::vector<double> energy_error = rasterised(result, raster, ln_energy);
  const std::vector<double> seen = rasterised(result, raster, sensitivity);
  double most = 0.0;
  for (const double q : flux.flux) most = std::max(most, q);
  sim::Image image(raster.columns, raster.rows, {"Q", "E0", "Q_error", "lnE0_error", "sensitivity"});
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::uint8_t> in_view = places_in_view(result, raster);
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * raster.columns + column;
      const int y = raster.rows - 1 - row;  // the picture's first row is the northernmost
      const double q = flux.flux[i];
      const bool lit = q > kMinLitShare * most;
      const bool is_in_view = in_view[i] != 0;
      image.at(column, y, 0) = is_in_view ? static_cast<float>(q) : kNone;
      image.at(column, y, 1) =
          is_in_view && lit ? static_cast<float>(std::exp(flux.flux_ln_energy[i] / q)) : kNone;
      image.at(column, y, 2) = is_in_view && lit ? static_cast<float>(flux_error[i] / q) : kNone;
      image.at(column, y, 3) = is_in_view && lit ? static_cast<float>(energy_error[i] / q) : kNone;
      image.at(column, y, 4) = static_cast<float>(seen[i]);
    }
  return {raster, std::move(image)};
}

}  // namespace vegard::fit
