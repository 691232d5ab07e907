#include "sim/render/volume_layer.h"

#include <algorithm>
#include <vector>

#include "sim/render/picture.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::sim {

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

}  // namespace vegard::sim
