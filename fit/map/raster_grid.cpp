#include "fit/map/raster_grid.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

constexpr double kPixel_km = 2.0;
constexpr int kMaxSide = 800, kMargin_px = 10;
constexpr int kPartsOfPixel = 4;  // of a pixel's side, at the middles of which the cells are asked

}  // namespace

RasterGrid raster_over(const MapResult& result) {
  double west = 1e9, east = -1e9, south = 1e9, north = -1e9;
  for (int c = 0; c < result.grid.cells(); ++c) {
    const sim::EastNorth m = result.grid.middle_km(c);
    west = std::min(west, m.east);
    east = std::max(east, m.east);
    south = std::min(south, m.north);
    north = std::max(north, m.north);
  }
  RasterGrid raster;
  raster.step_km = std::max(kPixel_km, std::max(east - west, north - south) / kMaxSide);
  const auto below = [&](double km) {
    return (std::floor(km / raster.step_km) - kMargin_px) * raster.step_km;
  };
  raster.west_km = below(west);
  raster.south_km = below(south);
  raster.columns = static_cast<int>((east - raster.west_km) / raster.step_km) + 1 + kMargin_px;
  raster.rows = static_cast<int>((north - raster.south_km) / raster.step_km) + 1 + kMargin_px;
  return raster;
}

std::vector<double> rasterised(const MapResult& result, const RasterGrid& raster,
                               const std::vector<double>& cell_values) {
  std::vector<double> values(raster.size(), 0.0);
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column) {
      double sum = 0.0;
      for (int y = 0; y < kPartsOfPixel; ++y)
        for (int x = 0; x < kPartsOfPixel; ++x) {
          const sim::EastNorth at =
              raster.place(column + (x + 0.5) / kPartsOfPixel - 0.5, row + (y + 0.5) / kPartsOfPixel - 0.5);
          const int cell = result.grid.cell_at(at.east, at.north);
          if (cell >= 0) sum += cell_values[static_cast<std::size_t>(cell)];
        }
      values[static_cast<std::size_t>(row) * raster.columns + column] = sum / (kPartsOfPixel * kPartsOfPixel);
    }
  return values;
}

RasterFlux raster_flux(const MapResult& result, const RasterGrid& raster,
                       const std::vector<CellFlux>& cells) {
  std::vector<double> flux, ln;
  for (const CellFlux& cell : cells) {
    flux.push_back(cell.flux_mw_m2);
    ln.push_back(static_cast<double>(cell.flux_mw_m2) * cell.ln_energy);
  }
  return {rasterised(result, raster, flux), rasterised(result, raster, ln)};
}

std::vector<std::uint8_t> places_in_view(const MapResult& result, const RasterGrid& raster) {
  std::vector<std::uint8_t> in_view(raster.size(), 0);
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column)
      in_view[static_cast<std::size_t>(row) * raster.columns + column] =
          is_border_in_view(result, raster.place(column, row)) ? 1 : 0;
  return in_view;
}

std::vector<double> smoothed_raster(const RasterGrid& raster, const std::vector<double>& values,
                                    double sigma_px) {
  const int reach = static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<double> weight;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    weight.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += weight.back();
  }
  for (double& w : weight) w /= sum;
  std::vector<double> across(values.size(), 0.0), out(values.size(), 0.0);
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column)
      for (int k = std::max(-reach, -column); k <= std::min(reach, raster.columns - 1 - column); ++k)
        across[static_cast<std::size_t>(row) * raster.columns + column] +=
            weight[static_cast<std::size_t>(k + reach)] *
            values[static_cast<std::size_t>(row) * raster.columns + column + k];
  for (int row = 0; row < raster.rows; ++row)
    for (int k = std::max(-reach, -row); k <= std::min(reach, raster.rows - 1 - row); ++k)
      for (int column = 0; column < raster.columns; ++column)
        out[static_cast<std::size_t>(row) * raster.columns + column] +=
            weight[static_cast<std::size_t>(k + reach)] *
            across[static_cast<std::size_t>(row + k) * raster.columns + column];
  return out;
}

double raster_value(const RasterGrid& raster, const std::vector<double>& values, sim::EastNorth km) {
  const double x = (km.east - raster.west_km) / raster.step_km,
               y = (km.north - raster.south_km) / raster.step_km;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  if (i < 0 || j < 0 || i + 1 >= raster.columns || j + 1 >= raster.rows) return 0.0;
  const double u = x - i, w = y - j;
  const auto v = [&](int dx, int dy) {
    return values[static_cast<std::size_t>(j + dy) * raster.columns + i + dx];
  };
  return (1.0 - w) * ((1.0 - u) * v(0, 0) + u * v(1, 0)) + w * ((1.0 - u) * v(0, 1) + u * v(1, 1));
}

}  // namespace vegard::fit
