#include "fit/map/map_reading.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kWideReach_km = 10.0;

void put_photos(const MapProblem& problem, std::vector<MapObservation>& pictures, MapResult& result) {
  result.chi2 = result.chi2_without_aurora = 0.0;
  result.photos.clear();
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    MapObservation& picture = pictures[p];
    MappedPhoto photo;
    photo.name = problem.scene.fit.photos.empty() ? "" : problem.scene.fit.photos[p].name;
    photo.scene = problem.scenes[p];
    if (!problem.modes.empty()) photo.scene.emission.modes = problem.modes;
    photo.film = picture.film();
    photo.data = picture.data();
    photo.sigma = picture.sigma();
    photo.gain = picture.gain;
    photo.values = picture.values();
    MapLight residual, none(picture.cells() * 3, 0.0f);
    result.chi2_without_aurora += picture.residual(none, residual);
    picture.forward(result.map, photo.model);
    photo.chi2 = picture.residual(photo.model, residual);
    photo.sky = picture.sky();
    result.chi2 += photo.chi2;
    result.photos.push_back(std::move(photo));
  }
}

void tell_what_is_seen(const std::vector<MapObservation>& pictures, MapResult& result) {
  const auto cells = static_cast<std::size_t>(result.grid.cells());
  result.border_in_view.assign(cells, 0);
  for (std::size_t c = 0; c < cells; ++c)
    result.border_in_view[c] = is_border_in_view(result, result.grid.middle_km(static_cast<int>(c))) ? 1 : 0;
  // Signal over noise of a cell by itself, at the median of the flux-weighted energies: sqrt(a' W a), where a
  // and W are taken as if a cell's light fell on pixels of like weight.
  result.sensitivity.assign(cells, 0.0f);
  for (const MapObservation& picture : pictures) {
    MapLight weighted = picture.weight();
    std::vector<float> back(cells * kGroundEnergies, 0.0f);
    for (float& w : weighted) w = std::sqrt(w);
    picture.add_adjoint(weighted, back);
    const std::size_t middle = result.energies_kev.size() / 2;
    for (std::size_t c = 0; c < cells; ++c)
      result.sensitivity[c] = static_cast<float>(
          std::hypot(result.sensitivity[c], std::max(0.0f, back[c * kGroundEnergies + middle])));
  }
}

}  // namespace

MapReading::MapReading(const sim::GroundGrid& grid, const std::vector<double>& energies_kev)
    : near_(grid, energies_kev), wide_(grid, energies_kev, kWideReach_km) {}

void MapReading::read_cells(MapResult& result) const {
  result.cells = near_.cells(result.map);
  result.ln_energy_around.clear();
  for (const CellFlux& cell : wide_.cells(result.map)) result.ln_energy_around.push_back(cell.ln_energy);
}

void MapReading::read(const MapProblem& problem, std::vector<MapObservation>& pictures,
                      MapResult& result) const {
  if (!problem.modes.empty()) result.scene.emission.modes = problem.modes;
  read_cells(result);
  result.values = all_values(pictures);
  put_photos(problem, pictures, result);
  tell_what_is_seen(pictures, result);
}

}  // namespace vegard::fit
