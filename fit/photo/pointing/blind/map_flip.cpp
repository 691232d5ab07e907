#include "fit/photo/pointing/blind/map_flip.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fit/photo/pointing/chance_agreement.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kFlipReach_px = 2.0;
constexpr double kFlipChance_log10 = -6.0;

/// The direction of a map's pixel; false if it has none.
bool map_looks_at(const sim::DirectionMap& map, int x, int y, Eigen::Vector3d& enu) {
  if (x < 0 || y < 0 || x >= map.width || y >= map.height) return false;
  const std::size_t i = map.index(x, y);
  if (!std::isfinite(map.azimuth_deg[i]) || !std::isfinite(map.elevation_deg[i])) return false;
  double v[3];
  sim::enu_of_direction({map.azimuth_deg[i], map.elevation_deg[i]}, v);
  enu = {v[0], v[1], v[2]};
  return true;
}

/// The number of stars with a point of light within the reach.
int stars_with_points(const sim::DirectionMap& map, const SkyMapFlip& flip,
                      const std::vector<FoundStar>& points, const std::vector<StarSighting>& sky) {
  std::vector<char> seen(sky.size(), 0);
  for (const FoundStar& point : points) {
    const int column = static_cast<int>(point.x_px), row = static_cast<int>(point.y_px);
    const int x = flip.columns ? map.width - 1 - column : column;
    const int y = flip.rows ? map.height - 1 - row : row;
    Eigen::Vector3d there, beside, below;
    if (!map_looks_at(map, x, y, there)) continue;
    if (!map_looks_at(map, x + 1, y, beside) && !map_looks_at(map, x - 1, y, beside)) continue;
    if (!map_looks_at(map, x, y + 1, below) && !map_looks_at(map, x, y - 1, below)) continue;
    const double reach = kFlipReach_px * std::max((beside - there).norm(), (below - there).norm());
    for (std::size_t i = 0; i < sky.size(); ++i)
      if ((Eigen::Vector3d(sky[i].enu[0], sky[i].enu[1], sky[i].enu[2]) - there).norm() < reach) seen[i] = 1;
  }
  return static_cast<int>(std::count(seen.begin(), seen.end(), 1));
}

}  // namespace

std::optional<MapFlip> flip_by_stars(const sim::DirectionMap& map, const std::vector<FoundStar>& points,
                                     const std::vector<StarSighting>& sky) {
  MapFlip best;
  best.stars = -1;
  for (const bool rows : {false, true})
    for (const bool columns : {false, true}) {
      const SkyMapFlip flip{rows, columns};
      const int stars = stars_with_points(map, flip, points, sky);
      if (stars > best.stars) {
        best.others = std::max(best.others, best.stars);
        best.stars = stars;
        best.flip = flip;
      } else {
        best.others = std::max(best.others, stars);
      }
    }
  if (log10_poisson_tail(best.stars, std::max(1, best.others)) > kFlipChance_log10) return std::nullopt;
  return best;
}

const char* words_of(const SkyMapFlip& flip) {
  if (flip.rows) return flip.columns ? "both" : "rows";
  return flip.columns ? "columns" : "as stored";
}

}  // namespace vegard::fit
