#include "fit/scene_fit.h"

#include "fit/fit.h"
#include "fit/stability.h"
#include "sim/base/error.h"

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

void require_still(const sim::Scene& scene) {
  if (scene.keys.empty()) return;
  throw sim::Error(sim::ErrorKind::scene, "a scene with keys moves, and a fit is of one that stands still")
      .file(scene.file)
      .line(scene.keys.front().line)
      .key("key")
      .expected("a scene without [[key]]");
}

FitResult fit_scene(const sim::Scene& scene, std::vector<Photo>& photos, const StoredMap* map,
                    const SceneFitOptions& options) {
  require_still(scene);
  FitResult result = fit_by_kind(scene, photos, map, options);
  if (options.stability) assess_stability(photos, options, result);
  return result;
}

}  // namespace vegard::fit
