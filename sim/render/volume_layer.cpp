#include "sim/render/volume_layer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/base/parallel.h"
#include "sim/emit/nebula/nebula_emitter.h"
#include "sim/emit/nebula/nebula_frame.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/picture.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
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

VolumePictures volume_pictures(const Scene& scene, const FilmGeometry& film, const VolumeLight& light,
                               bool blurred, int threads) {
  const auto picture_of = [&](const float* planes, Image& out) {
    const Window pixels = pixels_on(film, scene.camera);
    if (blurred)
      blur_lines(scene, film, planes, pixels, threads, out);
    else
      take_lines(scene, film, planes, pixels, threads, out);
  };
  VolumePictures pictures;
  picture_of(light.rayleigh.data(), pictures.rayleigh);
  if (light.kept.empty() || scene.march.blend == BlendRule::add) return pictures;
  std::vector<float> hidden(light.kept.size());
  for (std::size_t i = 0; i < hidden.size(); ++i) hidden[i] = 1.0f - light.kept[i];
  picture_of(hidden.data(), pictures.hidden);
  return pictures;
}

Image hidden_colours(const Scene& scene, const Image& hidden) {
  std::vector<Vector3> weights = line_colours(scene);
  for (int c = 0; c < 3; ++c) {
    double sum = 0.0;
    for (Vector3& of_line : weights) sum += of_line[c] = std::max(of_line[c], 0.0);
    for (Vector3& of_line : weights)
      of_line[c] = sum > 0.0 ? of_line[c] / sum : 1.0 / static_cast<double>(weights.size());
  }
  Image colours(hidden.width, hidden.height, {"R", "G", "B"});
  for (int y = 0; y < hidden.height; ++y)
    for (int x = 0; x < hidden.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double share = 0.0;
        for (int l = 0; l < hidden.channels(); ++l) share += weights[l][c] * hidden.at(x, y, l);
        colours.at(x, y, c) = static_cast<float>(share);
      }
  return colours;
}

Image volume_layer(const Scene& scene, const Image& rgb, const Image& hidden) {
  const Vector3 luminance = inverse(rgb_from_xyz(scene.sensor.primaries))[1];
  const double white = luminance[0] + luminance[1] + luminance[2];
  Image layer(rgb.width, rgb.height, {"R", "G", "B", "A"});
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      double coverage = 0.0;
      for (int c = 0; c < 3; ++c) {
        layer.at(x, y, c) = rgb.at(x, y, c);
        if (!hidden.empty()) coverage += luminance[c] / white * hidden.at(x, y, c);
      }
      layer.at(x, y, 3) = static_cast<float>(coverage);
    }
  return layer;
}

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

Image literal_nebula_picture(const Scene& scene, const Nebula& nebula, const Image* depth_km, int threads) {
  const NumberAs<double>& number = plain_number;
  const NodeMap<double> map(scene, number);
  const LiteralCloud cloud = literal_cloud(map, nebula);
  const NebulaFrame<double> frame(nebula, number);
  const CameraView<double> view = camera_view(scene.camera);
  const double observer_km = scene.site.altitude_m * 1e-3;
  const std::array<double, 3> origin = {0.0, 0.0, frame.observer_distance()};
  Image picture(scene.camera.width, scene.camera.height, {"R", "G", "B", "A"});
  parallel_for(static_cast<std::size_t>(picture.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < picture.width; ++x) {
      double enu[3];
      if (!enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      double end_km = ground_km(observer_km, enu[2], scene.body.radius_km);
      if (depth_km != nullptr) end_km = std::min(end_km, static_cast<double>(depth_km->at(x, y, 0)));
      // An object nearer than the nebula's bound hides it; only an observer inside the bound sees light
      // before it.
      std::array<double, 3> direction;
      frame.turn(enu, direction.data());
      const std::array<double, 4> rgba = literal_march(cloud, origin, direction, end_km / frame.unit_km());
      for (int channel = 0; channel < 4; ++channel)
        picture.at(x, y, channel) = static_cast<float>(rgba[channel]);
    }
  });
  return picture;
}

}  // namespace vegard::sim
