// The stars of the Sun's scene in grids, against those of its picture.
#include "sim/render/emitters/star_spheres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim::star_spheres_test {
namespace {

Scene starry(double sphere_distance) {
  Scene scene = parse_scene(
      "[site]\naltitude_m = 1e9\n"
      "[emission]\nlines = [630.0, 557.7, 427.8]\n"
      "[camera]\nwidth = 320\nheight = 260\nhfov_deg = 30\nazimuth_deg = 180\nelevation_deg = 20\n"
      "[sensor]\nresponse = \"filters\"\n"
      "[stars]\nshown = true\nfaintest_magnitude = 5.5\nwidth_deg = 0.15\n"
      "[sun]\nshown = true\nazimuth_deg = 184\nelevation_deg = 18\nlatitude_deg = 5\nlongitude_deg = 30\n"
      "position_angle_deg = 12\nunit_km = 1000\nradius = 100\ndistance_km = 700000\n",
      "test");
  scene.stars.sphere_distance = sphere_distance;
  return scene;
}

/// Where a place of the Sun's frame is seen, and the linear RGB that it adds, times steradian and length.
std::array<double, 3> direction_of(const Scene& scene, const double place[3]) {
  const SunFrame<double> frame(scene.sun, plain_number);
  double observer[3];
  frame.observer(observer);
  // The frame's axes in east, north and up, by rays along these.
  std::array<double, 3> enu{};
  for (int e = 0; e < 3; ++e) {
    const double axis[3] = {e == 0 ? 1.0 : 0.0, e == 1 ? 1.0 : 0.0, e == 2 ? 1.0 : 0.0};
    const SkyRay<double> ray = frame.ray(axis);
    for (int a = 0; a < 3; ++a) enu[e] += (place[a] - observer[a]) * ray.direction[a];
  }
  return enu;
}

TEST(StarSpheres, AreWhereThePictureHasItsStarsAndAsBright) {
  const Scene scene = starry(1.5);
  SceneGridOptions options;
  options.voxel = 0.5 * star_sphere_radius(scene);
  const SceneGrid made = grid_of_scene(scene, options);
  ASSERT_FALSE(made.grid.bricks.empty());
  EXPECT_EQ(made.unit_cm, 1e8);
  // The grid as a picture: each voxel's light goes to the pixel that it is seen in.
  const Image stars = star_light(scene, {0.0});
  const CameraView<double> view = camera_view(scene.camera);
  const std::vector<Vector3> colours = line_colours(scene);
  Image seen(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  double of_grid[3] = {}, of_picture[3] = {}, observer[3];
  SunFrame<double>(scene.sun, plain_number).observer(observer);
  const double voxel = made.grid.voxel, volume = voxel * voxel * voxel;
  for (const auto& [at, brick] : made.grid.bricks)
    for (int v = 0; v < SparseGrid::kVoxels; ++v) {
      if (brick[v] + brick[SparseGrid::kVoxels + v] + brick[2 * SparseGrid::kVoxels + v] <= 0.0f) continue;
      const int corner[3] = {at.x * 8 + v / 64, at.y * 8 + v / 8 % 8, at.z * 8 + v % 8};
      double place[3], square = 0.0;
      for (int a = 0; a < 3; ++a) {
        place[a] = made.grid.origin[a] + (corner[a] + 0.5) * voxel;
        square += (place[a] - observer[a]) * (place[a] - observer[a]);
      }
      const std::array<double, 3> enu = direction_of(scene, place);
      double x = 0.0, y = 0.0;
      ASSERT_TRUE(pixel_of_enu(view, enu.data(), x, y));
      const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
      for (int l = 0; l < 3; ++l)
        for (int c = 0; c < 3; ++c) {
          const double light = 1e-3 * colours[l][c] * brick[l * SparseGrid::kVoxels + v] * volume /
                               (photons_per_volume(1.0, made.unit_cm) * square);
          of_grid[c] += light;
          if (column >= 0 && row >= 0 && column < seen.width && row < seen.height)
            seen.at(column, row, c) += static_cast<float>(light);
        }
    }
  double most = 0.0;
  int brightest[2] = {0, 0};
  for (int y = 0; y < stars.height; ++y)
    for (int x = 0; x < stars.width; ++x) {
      for (int c = 0; c < 3; ++c)
        of_picture[c] += stars.at(x, y, c) * pixel_steradians(view.lens, x + 0.5, y + 0.5);
      if (stars.at(x, y, 1) > most) {
        most = stars.at(x, y, 1);
        brightest[0] = x;
        brightest[1] = y;
      }
    }
  // Spheres of two voxels' radius: each sum of voxels is within some hundredths of the integral.
  for (int c = 0; c < 3; ++c) {
    ASSERT_GT(of_picture[c], 0.0);
    EXPECT_NEAR(of_grid[c] / of_picture[c], 1.0, 0.05) << c;
  }
  // The picture's brightest star has its light in the grid within its image.
  double near = 0.0, in_picture = 0.0;
  for (int y = brightest[1] - 8; y <= brightest[1] + 8; ++y)
    for (int x = brightest[0] - 8; x <= brightest[0] + 8; ++x) {
      if (x < 0 || y < 0 || x >= stars.width || y >= stars.height) continue;
      near += seen.at(x, y, 1);
      in_picture += stars.at(x, y, 1) * pixel_steradians(view.lens, x + 0.5, y + 0.5);
    }
  EXPECT_NEAR(near / in_picture, 1.0, 0.1);
}

TEST(StarSpheres, AreAsWideAsAStarsImage) {
  const Scene scene = starry(2.0);
  const StarField field = star_field(scene);
  ASSERT_GT(field.spheres().size(), 5u);
  const StarSphere& star = field.spheres()[0];
  // The second moment of one star's light across one axis.
  const double radius = field.radius(), step = radius / 12.0;
  double sum = 0.0, square = 0.0;
  for (int i = -12; i <= 12; ++i)
    for (int j = -12; j <= 12; ++j)
      for (int k = -12; k <= 12; ++k) {
        const double x = star.middle[0] + i * step, y = star.middle[1] + j * step,
                     z = star.middle[2] + k * step;
        const double* const point[3] = {&x, &y, &z};
        float light[3], density = 1.0f;
        float* const emission[3] = {&light[0], &light[1], &light[2]};
        field.sample(1, point, emission, &density);
        EXPECT_EQ(density, 0.0f);
        sum += light[1];
        square += light[1] * i * i * step * step;
      }
  const double distance = 2.0 * scene.sun.distance_km / scene.sun.unit_km;
  EXPECT_NEAR(std::sqrt(square / sum) / distance / kRadiansPerDegree, scene.stars.width_deg,
              0.002 * scene.stars.width_deg);
}

TEST(StarSpheres, AreLeftOutUnlessTheyAreAskedFor) {
  for (Scene scene : {starry(0.0), starry(1.5)}) {
    if (scene.stars.sphere_distance > 0.0) scene.stars.shown = false;
    EXPECT_FALSE(has_star_spheres(scene));
    EXPECT_TRUE(grid_of_scene(scene, {}).grid.bricks.empty());
  }
}

TEST(StarSpheres, AreTheDensityOfAGridOfStarsAlone) {
  const Scene scene = starry(1.5);
  SceneGridOptions options;
  options.voxel = 0.0;
  const SceneGrid made = grid_of_scene(scene, options);
  EXPECT_LE(made.grid.voxel, star_sphere_radius(scene));
  EXPECT_FALSE(made.absorbs);
  float most = 0.0f;
  for (const auto& [at, brick] : made.grid.bricks)
    most = std::max(most, *std::max_element(brick.begin() + 3 * SparseGrid::kVoxels, brick.end()));
  EXPECT_EQ(most, 1.0f);
}

}  // namespace
}  // namespace vegard::sim::star_spheres_test
