// The picture that a fit bins is that which render() makes, cell by cell and to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fit/model/profile_model.h"
#include "sim/render/film.h"
#include "sim/render/picture.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/colour/line_colours.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::binned_picture_test {
namespace {

const char* const kArc = R"(
[camera]
width = 160
height = 120
hfov_deg = 80
elevation_deg = 28
[sensor]
gain_per_kilorayleigh = 1
[blur]
width_deg = [1.0, 0.5, 0.2]
[[footprint]]
size_km = [700, 200]
cell_km = 4
east_km = [-300, -140, 0, 130, 300]
north_km = [12, -20, 16, 30, -12]
width_km = 10
energy_kev = 4
[air]
model = "standard"
)";

/// Without what a fit leaves out of its model: the beams' random spacing, and the gain, which it finds
/// itself.
sim::Scene sheet_scene() {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sensor.gain_per_kilorayleigh = 1.0;
  return scene;
}

/// As render() makes it, by the beams of a fit: it lays out half a sheet more on either side, so that other
/// random numbers are drawn.
sim::Image aurora_by_the_beams_of_a_fit(const sim::Scene& scene) {
  const sim::FilmGeometry film =
      sim::film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  sim::Exposure exposure;
  sim::make_exposer(scene, film, 1, 0.5)->expose(scene, exposure);
  sim::dim_by_air(scene, exposure, 1);
  return sim::rgb_from_rayleigh(sim::rayleigh_image(scene, exposure, 1), sim::line_colours(scene));
}

TEST(ProfileModel, BinsThePictureThatRenderMakes) {
  std::vector<std::pair<std::string, sim::Scene>> scenes(3, {"as it is", sheet_scene()});
  scenes[1].first = "through air";
  scenes[1].second.air.model = sim::AirModel::standard;
  scenes[2].first = "the paper's kernels, five lines";
  scenes[2].second.blur.kernel = sim::BlurKernelKind::paper;
  scenes[2].second.emission.lines = {630.0, 557.7, 427.8, 391.4, 844.6};
  scenes[2].second.blur.width_deg = {0.9, 0.3, 0.0, 0.1, 0.5};
  scenes.emplace_back("a footprint", sim::parse_scene(kArc, "arc.toml"));
  for (auto& of : scenes) of.second.fit.model = sim::FitModel::draws;  // the very beams of the picture
  for (const auto& [what, scene] : scenes)
    for (const bool keeps_negative_light : {false, true}) {
      SCOPED_TRACE(what);
      sim::Image light =
          scene.sheets.empty() ? sim::render(scene).aurora : aurora_by_the_beams_of_a_fit(scene);
      Photo photo;
      photo.linear = light;
      photo.usable.assign(light.data.size(), 1);
      photo.floating = keeps_negative_light;
      photo.srgb = !keeps_negative_light;
      if (!keeps_negative_light) sim::clip_out_of_gamut(light);

      const Region region{0, 0, light.width, light.height};  // so that the films are the same, too
      constexpr int kBands = 12;                             // so narrow that a cell is a pixel
      ProfileModel model(scene, photo, region, kBands, 1.0, 0.0, 2);
      ModelProfile profile;
      model.evaluate(scene, profile);
      const sim::Image& binned = model.picture().rgb();
      const sim::FilmGeometry film =
          sim::film_for(scene, region.x, region.y, region.width, region.height, 1.0, 1.0);
      ASSERT_EQ(binned.width, film.columns);
      const int column = static_cast<int>(region.x - film.x0_px),
                row = static_cast<int>(region.y - film.y0_px);
      photo.linear = light;  // what its bins ought to be
      const Profile means = extract_profile(photo, region, kBands);
      ASSERT_EQ(profile.value.size(), means.mean.size());
      for (int y = 0; y < region.height; ++y)
        for (int x = 0; x < region.width; ++x)
          for (int c = 0; c < 3; ++c)
            ASSERT_EQ(binned.at(column + x, row + y, c), light.at(region.x + x, region.y + y, c))
                << x << " " << y << " " << c;
      // Both are means of thirteen floats or so, one of them by a float's 1 / 13.
      for (std::size_t i = 0; i < means.mean.size(); ++i)
        EXPECT_NEAR(profile.value[i], means.mean[i], 2e-7 * std::abs(means.mean[i]) + 1e-12) << i;
    }
}

}  // namespace
}  // namespace vegard::fit::binned_picture_test
