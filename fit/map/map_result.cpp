#include "fit/map/map_result.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "fit/map/map_grid.h"
#include "sim/base/number/constants.h"
#include "sim/render/ground/sight_lines.h"

namespace vegard::fit {
namespace {

bool is_at_place_of(const sim::Scene& scene, const sim::Scene& other) {
  return scene.site.latitude_deg == other.site.latitude_deg &&
         scene.site.longitude_deg == other.site.longitude_deg;
}

}  // namespace

bool is_of_one_station(const MapResult& result) {
  return std::all_of(result.photos.begin(), result.photos.end(), [&](const MappedPhoto& photo) {
    return is_at_place_of(photo.scene, result.photos.front().scene);
  });
}

bool is_of_one_station(const std::vector<sim::Scene>& scenes) {
  return std::all_of(scenes.begin(), scenes.end(),
                     [&](const sim::Scene& scene) { return is_at_place_of(scene, scenes.front()); });
}

bool is_prior_at_its_end(const MapResult& result) {
  return result.sparsity == kPriorTrials[std::size(kPriorTrials) - 1];
}

bool is_border_in_view(const MapResult& result, sim::EastNorth foot_km) {
  for (const MappedPhoto& photo : result.photos) {
    double x = 0.0, y = 0.0;
    if (!sim::pixel_over_foot(photo.scene, result.scene.site, foot_km, kMappedBorder_km, x, y)) continue;
    const sim::FilmGeometry& film = photo.film;
    const int column = static_cast<int>((x - film.x0_px) / film.cell_width_px);
    const int row = static_cast<int>((y - film.y0_px) / film.cell_height_px);
    const std::size_t i = (static_cast<std::size_t>(row) * film.columns + column) * 3;
    if (photo.sigma[i] + photo.sigma[i + 1] + photo.sigma[i + 2] > 0.0f) return true;
  }
  return false;
}

std::vector<CellError> cell_errors(const MapResult& result) {
  std::vector<CellError> errors(result.cells.size());
  for (std::size_t c = 0; c < errors.size(); ++c) {
    double flux = 0.0, energy = 0.0, lit = 0.0;
    for (const std::vector<CellFlux>& replicate : result.replicates) {
      flux += std::pow(replicate[c].flux_mw_m2 - result.cells[c].flux_mw_m2, 2);
      if (replicate[c].flux_mw_m2 == 0.0f && replicate[c].ln_energy == 0.0f) continue;  // no light near it
      energy += std::pow(replicate[c].ln_energy - result.cells[c].ln_energy, 2);
      lit += 1.0;
    }
    const auto count = static_cast<double>(result.replicates.size());
    const double cell_flux = result.cells[c].flux_mw_m2;
    errors[c].relative_flux =
        count > 0.0 && cell_flux > 0.0 ? std::sqrt(flux / count) / cell_flux : sim::kNaN;
    errors[c].ln_energy =
        lit > 0.0 ? std::hypot(kEnergyInflation * std::sqrt(energy / lit),
                               static_cast<double>(result.cells[c].ln_energy) - result.ln_energy_around[c])
                  : sim::kNaN;
  }
  return errors;
}

}  // namespace vegard::fit
