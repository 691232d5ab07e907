#include "fit/scene_fit.h"

#include "fit/fit.h"
#include "fit/stability.h"

namespace vegard::fit {
namespace {

FitResult fit_by_kind(const sim::Scene& scene, std::vector<Photo>& photos, const StoredMap* map,
                      const FitOptions& options) {
  if (map != nullptr) return fit_curtains(scene, photos, map->curtains, map->faint, options);
  if (!scene.fit.photos.empty()) return fit_photos(scene, photos, options);
  return photos.front().unknowns > 0 ? fit_photo_and_transfer_curve(scene, photos.front(), options)
                                     : fit_photo(scene, photos.front(), options);
}

}  // namespace

FitResult fit_scene(const sim::Scene& scene, std::vector<Photo>& photos, const StoredMap* map,
                    const SceneFitOptions& options) {
  FitResult result = fit_by_kind(scene, photos, map, options);
  if (options.stability) assess_stability(photos, options, result);
  return result;
}

}  // namespace vegard::fit
