#include "sim/render/volume_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/as_seen.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/view/film/composite.h"

namespace vegard::sim::volume_layer_test {
namespace {

constexpr int kWidth = 24, kHeight = 16;

Scene small_camera() {
  Scene scene;
  scene.camera.width = kWidth;
  scene.camera.height = kHeight;
  scene.camera.hfov_deg = 6.0;  // a degree is 4 pixels: the lines' blurs are 1.7, 0.7 and 0 pixels
  scene.camera.elevation_deg = 40.0;
  return scene;
}

Image filled(const std::vector<std::string>& names, const std::vector<float>& values) {
  Image image(kWidth, kHeight, names);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = values[i % values.size()];
  return image;
}

/// Light of 100, 200 and 300 R in the right half of a film, which hides all behind it.
VolumeLight wall(const FilmGeometry& film) {
  VolumeLight light;
  light.lines = 3;
  for (int l = 0; l < 3; ++l)
    for (int r = 0; r < film.rows; ++r)
      for (int c = 0; c < film.columns; ++c) {
        const bool lit = film.x0_px + c + 0.5 > kWidth / 2;
        light.rayleigh.push_back(lit ? 100.0f * static_cast<float>(l + 1) : 0.0f);
        light.kept.push_back(lit ? 0.0f : 1.0f);
      }
  return light;
}

FilmGeometry film_of(const Scene& scene) { return film_for(scene, 0, 0, kWidth, kHeight, 1.0, 1.0); }

TEST(VolumePictures, BlurWhatIsHiddenAsTheLight) {
  const Scene scene = small_camera();
  const FilmGeometry film = film_of(scene);
  const VolumePictures pictures = volume_pictures(scene, film, wall(film), true, 2);
  int soft = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int l = 0; l < 3; ++l) {
        const float hidden = pictures.hidden.at(x, y, l);
        // The same sums of the same weights, times 100 (l + 1), rounded in another place.
        ASSERT_NEAR(pictures.rayleigh.at(x, y, l), 100.0f * static_cast<float>(l + 1) * hidden, 1e-3);
        if (hidden > 0.01f && hidden < 0.99f) ++soft;
      }
  EXPECT_GE(soft, kHeight * 6) << "edges of two of the lines are soft";
  const VolumePictures sharp = volume_pictures(scene, film, wall(film), false, 2);
  for (int x = 0; x < kWidth; ++x) ASSERT_EQ(sharp.hidden.at(x, 3, 0), x >= kWidth / 2 ? 1.0f : 0.0f);
}

TEST(VolumePictures, OfLightThatIsOnlyAddedHideNothing) {
  Scene scene = small_camera();
  const FilmGeometry film = film_of(scene);
  const Image with_alpha = volume_pictures(scene, film, wall(film), true, 1).rayleigh;
  scene.march.blend = BlendRule::add;
  const VolumePictures added = volume_pictures(scene, film, wall(film), true, 1);
  EXPECT_TRUE(added.hidden.empty());
  EXPECT_EQ(added.rayleigh.data, with_alpha.data);
}

TEST(VolumePictures, OfWhatAbsorbsNothingAreTheSameByBothWaysOfBlending) {
  Scene scene = small_camera();
  const FilmGeometry film = film_of(scene);
  VolumeLight clear = wall(film);
  clear.kept.clear();
  EXPECT_TRUE(volume_pictures(scene, film, clear, true, 1).hidden.empty());
  // And if it says that it absorbs, but does not: to the last bit.
  clear.kept.assign(clear.rayleigh.size(), 1.0f);
  Rendering rendering;
  const VolumePictures pictures = volume_pictures(scene, film, clear, true, 1);
  rendering.aurora = filled({"R", "G", "B"}, {0.1f, 0.7f, 0.3f});
  rendering.background = filled({"R", "G", "B"}, {0.3f, 0.2f, 0.6f});
  rendering.stars = filled({"R", "G", "B"}, {0.01f, 0.9f, 0.3f, 0.123f});
  rendering.volume = volume_layer(scene, rendering.aurora, {});
  const Image added = shown_light(scene, rendering);
  rendering.hidden = hidden_colours(scene, pictures.hidden);
  EXPECT_EQ(shown_light(scene, rendering).data, added.data);
}

TEST(HiddenColours, OfLinesThatHideAlikeAreThatShare) {
  const Scene scene = small_camera();
  const Image colours = hidden_colours(scene, filled({"6300", "5577", "4278"}, {0.4f}));
  for (const float share : colours.data) ASSERT_NEAR(share, 0.4f, 1e-7);
}

TEST(HiddenColours, AreMeansByWhatTheSensorHasOfEachLine) {
  const Scene scene = small_camera();
  const std::vector<std::vector<float>> one_line = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double share[3][3];
  for (int l = 0; l < 3; ++l) {
    const Image colours = hidden_colours(scene, filled({"6300", "5577", "4278"}, one_line[l]));
    for (int c = 0; c < 3; ++c) share[l][c] = colours.at(5, 5, c);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[0][c] + share[1][c] + share[2][c], 1.0, 1e-6);
  EXPECT_GT(share[0][0], 0.5) << "red is above all 630.0 nm";
  EXPECT_GT(share[1][1], 0.9) << "green is 557.7 nm";
  EXPECT_GT(share[2][2], 0.9) << "blue is 427.8 nm";
}

TEST(VolumeLayer, LiesOverWhatIsBehindAsTheWholePictureHasIt) {
  Scene scene = small_camera();
  scene.sky.level = {0.1, 0.2, 0.3};
  Rendering rendering;
  rendering.aurora = filled({"R", "G", "B"}, {0.2f, 0.5f, 0.1f});
  rendering.background = filled({"R", "G", "B"}, {0.6f, 0.1f, 0.4f});
  rendering.hidden = filled({"R", "G", "B"}, {0.25f});  // of all channels alike, so that A says all
  rendering.volume = volume_layer(scene, rendering.aurora, rendering.hidden);
  const Image whole = shown_light(scene, rendering);
  const float behind[3] = {0.7f, 0.3f, 0.7f};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(rendering.volume.at(3, 4, 3), 0.25, 1e-6);
    EXPECT_NEAR(whole.at(3, 4, c), rendering.aurora.at(3, 4, c) + 0.75f * behind[c], 1e-6);
    EXPECT_NEAR(whole.at(3, 4, c),
                rendering.volume.at(3, 4, c) + (1.0f - rendering.volume.at(3, 4, 3)) * behind[c], 1e-6);
  }
}

TEST(VolumeLayer, IsHiddenByTheForeground) {
  const Scene scene = small_camera();
  Rendering rendering;
  rendering.aurora = filled({"R", "G", "B"}, {0.2f, 0.5f, 0.1f});
  rendering.hidden = filled({"R", "G", "B"}, {0.5f});
  rendering.volume = volume_layer(scene, rendering.aurora, rendering.hidden);
  rendering.foreground = filled({"R", "G", "B", "A"}, {0.01f, 0.02f, 0.03f, 1.0f});
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(shown_light(scene, rendering).at(2, 2, c), rendering.foreground.at(2, 2, c));
}

TEST(VolumeLayer, ThatHidesAllTakesTheSkyFromTheEyeToo) {
  Scene scene = small_camera();
  Rendering rendering;
  rendering.rayleigh = filled({"6300", "5577", "4278"}, {300.0f, 900.0f, 100.0f});
  rendering.aurora = filled({"R", "G", "B"}, {0.02f, 0.04f, 0.01f});
  rendering.volume = volume_layer(scene, rendering.aurora, {});
  rendering.rgb = shown_light(scene, rendering);
  const Image dark_sky = picture_as_seen(scene, rendering);
  scene.sky.level = {0.1, 0.2, 0.3};
  rendering.rgb = shown_light(scene, rendering);
  EXPECT_NE(picture_as_seen(scene, rendering).data, dark_sky.data);
  rendering.hidden = filled({"R", "G", "B"}, {1.0f});
  rendering.rgb = shown_light(scene, rendering);
  EXPECT_EQ(picture_as_seen(scene, rendering).data, dark_sky.data);
}

TEST(LiteralLayer, BlendsByTheTwoIdentities) {
  const Scene scene = small_camera();
  const Image nebula = filled({"R", "G", "B", "A"}, {0.3f, 0.8f, 0.6f, 0.35f, 0.9f, 0.1f, 0.2f, 1.0f});
  const Image behind = filled({"R", "G", "B"}, {0.25f, 0.5f, 0.125f, 0.7f, 0.3f});
  Image alpha = behind, added = behind;
  cover(layer_of_literal(nebula, BlendRule::alpha), alpha);
  cover(layer_of_literal(nebula, BlendRule::add), added);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c) {
        const float of_it = nebula.at(x, y, c), a = nebula.at(x, y, 3), was = behind.at(x, y, c);
        ASSERT_EQ(alpha.at(x, y, c), of_it * a + (1.0f - a) * was);
        ASSERT_EQ(added.at(x, y, c), of_it + was);
      }
}

TEST(LiteralLayer, OfTwoIsOneBeforeTheOther) {
  const Image far =
      layer_of_literal(filled({"R", "G", "B", "A"}, {0.3f, 0.8f, 0.6f, 0.35f}), BlendRule::alpha);
  const Image near =
      layer_of_literal(filled({"R", "G", "B", "A"}, {0.5f, 0.1f, 0.2f, 0.6f}), BlendRule::alpha);
  Image in_turn = filled({"R", "G", "B"}, {0.25f, 0.5f, 0.125f}), at_once = in_turn, both = far;
  cover(far, in_turn);
  cover(near, in_turn);
  put_before(near, both);
  cover(both, at_once);
  for (std::size_t i = 0; i < in_turn.data.size(); ++i) ASSERT_NEAR(at_once.data[i], in_turn.data[i], 1e-6);
}

TEST(LiteralLayer, IsBehindTheVolumesAndBeforeTheSky) {
  Scene scene = small_camera();
  scene.sky.level = {0.4, 0.4, 0.4};
  Rendering rendering;
  rendering.aurora = filled({"R", "G", "B"}, {0.1f});
  rendering.hidden = filled({"R", "G", "B"}, {0.5f});
  rendering.literal =
      layer_of_literal(filled({"R", "G", "B", "A"}, {0.8f, 0.8f, 0.8f, 0.25f}), BlendRule::alpha);
  rendering.volume = rendering.literal;
  // 0.1 + 0.5 (0.8 x 0.25 + 0.75 x 0.4)
  EXPECT_NEAR(shown_light(scene, rendering).at(1, 1, 1), 0.35, 1e-6);
}

TEST(Air, DimsTheVolumesShareAsTheWhole) {
  Scene scene = small_camera();
  scene.air.model = AirModel::standard;
  Exposure exposure;
  exposure.geometry = film_of(scene);
  exposure.lines = 3;
  exposure.volumes = wall(exposure.geometry);
  exposure.rayleigh = exposure.volumes.rayleigh;
  const float before = exposure.rayleigh.back();
  dim_by_air(scene, exposure, 1);
  EXPECT_LT(exposure.rayleigh.back(), before);
  EXPECT_EQ(exposure.volumes.rayleigh, exposure.rayleigh);
}

TEST(FilmFor, LeavesRoomForTheSoftenedLightOfVolumes) {
  Scene scene = small_camera();
  const int columns = film_of(scene).columns;
  scene.march.smooth_px = 10.0;
  EXPECT_EQ(film_of(scene).columns, columns) << "no volumes, no need";
  scene.footprints.emplace_back();
  EXPECT_GE(film_of(scene).columns, kWidth + 2 * 40);
}

}  // namespace
}  // namespace vegard::sim::volume_layer_test
