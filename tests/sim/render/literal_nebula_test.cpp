#include "sim/render/volume_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/emit/nebula/nebula_frame.h"
#include "sim/render/film.h"
#include "sim/render/volumes/volumes.h"
#include "tests/support/one_nebula.h"

namespace vegard::sim::literal_nebula_test {
namespace {

/// A ball half-way down to the horizon of a camera that looks north.
Scene half_set() {
  Scene scene = tests::one_nebula(tests::node_of("ball", "sphere"));
  scene.nebulae[0].distance_pc = 10.0;
  scene.nebulae[0].edge = 0.1;
  scene.camera.width = 40;
  scene.camera.height = 30;
  scene.camera.hfov_deg = 30.0;
  scene.camera.azimuth_deg = 0.0;
  scene.camera.elevation_deg = 0.0;
  scene.site.altitude_m = 0.0;
  return scene;
}

TEST(LiteralNebula, IsThereAboveTheHorizonOnly) {
  const Scene scene = half_set();
  const Image picture = literal_nebula_picture(scene, scene.nebulae[0], nullptr, 1);
  ASSERT_EQ(picture.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_GT(picture.at(20, 12, 3), 0.5f);
  EXPECT_GT(picture.at(20, 12, 0), 0.0f);
  EXPECT_EQ(picture.at(20, 17, 3), 0.0f) << "below it there is the Earth";
  EXPECT_EQ(picture.at(0, 0, 3), 0.0f) << "beside its bound";
  EXPECT_EQ(literal_nebula_picture(scene, scene.nebulae[0], nullptr, 2).data, picture.data);
}

TEST(LiteralNebula, StopsAtTheDepthPicture) {
  const Scene scene = half_set();
  Image depth(40, 30, {"Z"});
  std::fill(depth.data.begin(), depth.data.end(), std::numeric_limits<float>::infinity());
  depth.at(20, 12, 0) = 100.0f;  // a hill
  const Image free = literal_nebula_picture(scene, scene.nebulae[0], nullptr, 1),
              hidden = literal_nebula_picture(scene, scene.nebulae[0], &depth, 1);
  EXPECT_EQ(hidden.at(20, 12, 3), 0.0f);
  EXPECT_EQ(hidden.at(19, 12, 3), free.at(19, 12, 3));
}

TEST(NebulaOnFilm, ShinesInRayleighsAboveTheHorizon) {
  const Scene scene = half_set();
  const Volumes volumes(scene, 1);
  FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  const VolumeLight light = volumes.light(scene, film);
  const auto at = [&](int x, int y) {
    const auto row = static_cast<std::size_t>(y - film.y0_px),
               column = static_cast<std::size_t>(x - film.x0_px);
    return light.rayleigh[row * film.columns + column];
  };
  EXPECT_GT(at(20, 14), 1.8f) << "hardly less than the chord through its middle, 2, and a soft edge";
  EXPECT_LT(at(20, 14), 2.2f);
  EXPECT_EQ(at(20, 16), 0.0f);
  EXPECT_EQ(at(0, 0), 0.0f);
}

}  // namespace
}  // namespace vegard::sim::literal_nebula_test
