#include "sim/render/literal_layer.h"

#include <optional>

#include "sim/render/emitters/depth_file.h"
#include "sim/render/volumes/literal_nebula.h"
#include "sim/view/film/composite.h"

namespace vegard::sim {
namespace {

Image depths_along_rays(const Scene& scene, const DepthImage& depth, int threads) {
  FilmGeometry film;
  film.columns = scene.camera.width;
  film.rows = scene.camera.height;
  Image image(film.columns, film.rows, {"Z"});
  image.data = ray_ends_km(scene, film, depth, threads);
  return image;
}

}  // namespace

Image layer_of_literal(const Image& picture, BlendRule blend) {
  Image layer = picture;
  for (std::size_t i = 0; i < layer.data.size(); i += 4) {
    float& alpha = layer.data[i + 3];
    if (blend == BlendRule::add)
      alpha = 0.0f;
    else
      for (int c = 0; c < 3; ++c) layer.data[i + c] *= alpha;
  }
  return layer;
}

Image literal_layer(const Scene& scene, int threads) {
  Image all;
  std::optional<Image> depth_km;
  for (const Nebula& nebula : scene.nebulae) {
    if (nebula.method != NebulaMethod::literal) continue;
    if (!depth_km && !scene.march.depth.empty())
      depth_km = depths_along_rays(scene, read_depth(scene), threads);
    const Image picture = literal_nebula_picture(scene, nebula, depth_km ? &*depth_km : nullptr, threads);
    if (picture.empty()) continue;
    const Image layer = layer_of_literal(picture, scene.march.blend);
    if (all.empty())
      all = layer;
    else
      put_before(layer, all);
  }
  return all;
}

}  // namespace vegard::sim
