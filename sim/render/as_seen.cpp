#include "sim/render/as_seen.h"

#include <algorithm>

#include <Eigen/LU>

#include "sim/view/colour/colour_table.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/line_spectrum.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim {
namespace {

/// Returns the matrix from the sensor's linear values to XYZ in cd m^-2.
Eigen::Matrix3d luminous_from_rgb(const Scene& scene) {
  const Matrix3 rgb = rgb_from_xyz(scene.sensor.primaries);
  Eigen::Matrix3d matrix;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) matrix(r, c) = rgb[r][c];
  return matrix.inverse() * white_luminance_cd_m2(scene);
}

}  // namespace

Image picture_as_seen(const Scene& scene, const Rendering& rendering, double half_cd_m2) {
  std::vector<EyeLight> per_rayleigh;
  for (double nm : scene.emission.lines)
    per_rayleigh.push_back(eye_light_per_rayleigh(components_of_line(scene, nm)));
  const Eigen::Matrix3d luminous = luminous_from_rgb(scene);
  Image shown = rendering.rgb;
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      const double open = rendering.foreground.empty() ? 1.0 : 1.0 - rendering.foreground.at(x, y, 3);
      EyeLight aurora;
      for (std::size_t l = 0; l < per_rayleigh.size(); ++l) {
        const double rayleigh = open * rendering.rayleigh.at(x, y, static_cast<int>(l));
        for (int i = 0; i < 3; ++i) aurora.xyz_cd_m2[i] += rayleigh * per_rayleigh[l].xyz_cd_m2[i];
        aurora.scotopic_cd_m2 += rayleigh * per_rayleigh[l].scotopic_cd_m2;
      }
      // Sky, pictures and stars: all that the picture has beside the aurora, but for what rounding leaves.
      Eigen::Vector3d other;
      for (int c = 0; c < 3; ++c)
        other[c] = std::max(0.0, shown.at(x, y, c) - open * rendering.aurora.at(x, y, c));
      const Eigen::Vector3d xyz = luminous * other;
      const EyeLight light = aurora + eye_light_of_colour({xyz[0], xyz[1], xyz[2]});
      const Vector3 display = displayed_as_seen(seen_linear_srgb(light), half_cd_m2);
      for (int c = 0; c < 3; ++c) shown.at(x, y, c) = static_cast<float>(srgb_encode(display[c]));
    }
  }
  ColourTable(scene).colour(shown);
  return shown;
}

}  // namespace vegard::sim
