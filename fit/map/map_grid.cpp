#include "fit/map/map_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fit/map/cell_reader.h"
#include "sim/base/number/constants.h"
#include "sim/render/ground/ground_light.h"
#include "sim/scene/structs/site_axes.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kCellsPerResolution = 0.8;  // a cell's side over what a film's cell sees of it
constexpr double kMinCell_km = 1.5;
constexpr double kKeptShare = 3e-3, kKeptReach_km = 12.0;  // of the brightest cell; about cells with more
constexpr double kFarthest_km = 700.0, kNearestEnd_km = 250.0;
constexpr double kSquare_km = 1.5, kMaxSquares = 60000.0;

double resolution_rad(const sim::Camera& camera, int pixels_per_cell) {
  return pixels_per_cell * sim::kRadiansPerDegree / sim::pixels_per_degree(camera);
}

}  // namespace

double ground_reach_km(const std::vector<MapObservation>& pictures) {
  double lowest = 1.0;
  for (const MapObservation& picture : pictures) {
    const sim::CameraView<double> view = sim::camera_view(picture.scene().camera);
    const sim::FilmGeometry& film = picture.film();
    for (int row = 0; row < film.rows; ++row)
      for (int column = 0; column < film.columns; ++column) {
        const std::size_t i = (static_cast<std::size_t>(row) * film.columns + column) * 3;
        double enu[3];
        if (picture.sigma()[i] + picture.sigma()[i + 1] + picture.sigma()[i + 2] > 0.0f &&
            sim::enu_of_cell(view, film, row, column, enu))
          lowest = std::min(lowest, enu[2]);
      }
  }
  const double elevation = std::asin(std::max(lowest, 0.0));
  const double ratio = sim::kEarthRadiusKm * std::cos(elevation) / (sim::kEarthRadiusKm + kMappedBorder_km);
  return std::clamp(sim::kEarthRadiusKm * (std::acos(ratio) - elevation), kNearestEnd_km, kFarthest_km);
}

sim::GroundGrid map_grid(const std::vector<MapObservation>& pictures, const sim::Site& home,
                         double farthest_km, double coarseness) {
  double finest = 1e9;
  for (const MapObservation& picture : pictures)
    finest = std::min(finest,
                      resolution_rad(picture.scene().camera, static_cast<int>(picture.film().cell_width_px)));
  const bool elsewhere = std::any_of(pictures.begin(), pictures.end(), [&](const MapObservation& p) {
    return p.scene().site.latitude_deg != home.latitude_deg ||
           p.scene().site.longitude_deg != home.longitude_deg;
  });
  if (!elsewhere)
    return sim::GroundGrid(
        sim::rings_resolved(kCellsPerResolution * finest, kMinCell_km * coarseness, farthest_km));
  double west = 1e9, east = -1e9, south = 1e9, north = -1e9;
  for (const MapObservation& picture : pictures) {
    const sim::SiteTurn to_home = sim::turn_between(picture.scene().site, home);
    west = std::min(west, to_home.shift_km[0]);
    east = std::max(east, to_home.shift_km[0]);
    south = std::min(south, to_home.shift_km[1]);
    north = std::max(north, to_home.shift_km[1]);
  }
  // Of the farthest ground, where a second station is far away itself, no more than that much.
  const double around = std::min(farthest_km, 400.0);
  const double wide = east - west + 2.0 * around, high = north - south + 2.0 * around;
  const double step = coarseness * std::max(kSquare_km, std::sqrt(wide * high / kMaxSquares));
  return sim::GroundGrid(sim::SquareCells{west - around, south - around, step,
                                          static_cast<int>(wide / step) + 1,
                                          static_cast<int>(high / step) + 1});
}

std::vector<bool> cells_near_light(const sim::GroundGrid& coarse, const std::vector<float>& rough,
                                   const std::vector<double>& energies_kev, const sim::GroundGrid& fine) {
  const std::vector<CellFlux> cells = CellReader(coarse, energies_kev).cells(rough);
  std::vector<std::uint8_t> lit(cells.size(), 0);
  float most = 0.0f;
  for (const CellFlux& cell : cells) most = std::max(most, cell.flux_mw_m2);
  for (std::size_t c = 0; c < lit.size(); ++c)
    if (cells[c].flux_mw_m2 > kKeptShare * most)
      for (const auto& near : coarse.near(
               static_cast<int>(c), std::max(kKeptReach_km, 2.5 * coarse.depth_km(static_cast<int>(c)))))
        lit[near.cell] = 1;
  std::vector<bool> kept(fine.cells(), false);
  for (int c = 0; c < fine.cells(); ++c) {
    const sim::EastNorth middle = fine.middle_km(c);
    const int under = coarse.cell_at(middle.east, middle.north);
    kept[c] = under >= 0 && lit[under] != 0;
  }
  return kept;
}

std::vector<float> refined_map(const std::vector<float>& rough, const sim::GroundGrid& coarse,
                               const sim::GroundGrid& fine) {
  std::vector<float> map(static_cast<std::size_t>(fine.cells()) * sim::kGroundEnergies, 0.0f);
  const float most = brightest(rough);
  for (int c = 0; c < fine.cells(); ++c) {
    const sim::EastNorth middle = fine.middle_km(c);
    const int under = coarse.cell_at(middle.east, middle.north);
    for (int k = 0; k < sim::kGroundEnergies; ++k)
      map[static_cast<std::size_t>(c) * sim::kGroundEnergies + k] =
          rough[static_cast<std::size_t>(under) * sim::kGroundEnergies + k] + 1e-3f * most;
  }
  return map;
}

float brightest(const std::vector<float>& map) {
  float most = 0.0f;
  for (const float x : map) most = std::max(most, x);
  return most;
}

std::vector<float> regridded(const std::vector<float>& map, const sim::GroundGrid& from,
                             const sim::GroundGrid& to) {
  std::vector<float> there(static_cast<std::size_t>(to.cells()) * sim::kGroundEnergies, 0.0f);
  for (int c = 0; c < to.cells(); ++c) {
    const sim::EastNorth middle = to.middle_km(c);
    const int under = from.cell_at(middle.east, middle.north);
    if (under < 0) continue;
    for (int k = 0; k < sim::kGroundEnergies; ++k)
      there[static_cast<std::size_t>(c) * sim::kGroundEnergies + k] =
          map[static_cast<std::size_t>(under) * sim::kGroundEnergies + k];
  }
  return there;
}

std::vector<float> coarsened(const std::vector<float>& map, const sim::GroundGrid& from,
                             const sim::GroundGrid& to) {
  std::vector<double> sum(static_cast<std::size_t>(to.cells()) * sim::kGroundEnergies, 0.0);
  std::vector<double> area(static_cast<std::size_t>(to.cells()), 0.0);
  for (int c = 0; c < from.cells(); ++c) {
    const sim::EastNorth middle = from.middle_km(c);
    const int over = to.cell_at(middle.east, middle.north);
    if (over < 0) continue;
    area[static_cast<std::size_t>(over)] += from.area_km2(c);
    for (int k = 0; k < sim::kGroundEnergies; ++k)
      sum[static_cast<std::size_t>(over) * sim::kGroundEnergies + k] +=
          from.area_km2(c) * map[static_cast<std::size_t>(c) * sim::kGroundEnergies + k];
  }
  std::vector<float> mean(sum.size(), 0.0f);
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (area[i / sim::kGroundEnergies] > 0.0)
      mean[i] = static_cast<float>(sum[i] / area[i / sim::kGroundEnergies]);
  return mean;
}

}  // namespace vegard::fit
