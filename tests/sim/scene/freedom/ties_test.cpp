#include "sim/scene/freedom/ties.h"

#include <gtest/gtest.h>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim::ties_test {
namespace {

TEST(Ties, ComeAfterThoseThatTheyUse) {
  const Scene scene = parse_scene(R"(
[[sheet]]
width_km = 0.5
[fit]
free = [{ name = "t", start = 2, min = 1, max = 3 }]
tied = [
  { path = "sheet.main.bearing_deg", equals = "90 + sheet.thickness_km - sheet.main.wavelength_km / t" },
  { path = "sheet.main.thickness_km", equals = "t + sheet.width_km" },
  { path = "sheet.wavelength_km", equals = "20 * sheet.main.thickness_km" },
]
)",
                                  "");
  const std::vector<Tie> ties = ties_of(scene);
  ASSERT_EQ(ties.size(), 3u);
  EXPECT_EQ(ties[0].path.text, "sheet.main.thickness_km");
  EXPECT_EQ(ties[1].path.text, "sheet.main.wavelength_km");
  EXPECT_EQ(ties[2].path.text, "sheet.main.bearing_deg");
  ASSERT_EQ(ties[0].inputs.size(), 2u);
  EXPECT_EQ(ties[0].inputs[0].path.row, nullptr);
  EXPECT_EQ(ties[0].inputs[0].name, "t");
  EXPECT_EQ(ties[0].inputs[1].path.text, "sheet.main.width_km") << "the name of the only sheet is filled in";
  EXPECT_DOUBLE_EQ(ties[0].expression.value({2.0, 0.5}), 2.5);
}

TEST(Ties, OfOnePhotographAreItsOwn) {
  Scene scene = parse_scene("[[sheet]]\n", "");
  scene.fit.photos.resize(2);
  scene.fit.photos[0].name = "left";
  scene.fit.photos[1].name = "right";
  for (PhotoEntry& photo : scene.fit.photos) photo.file = photo.name + ".png";
  scene.fit.tied = {{"camera.hfov_deg", "50", "left", 0},
                    {"camera.hfov_deg", "60", "right", 0},
                    {"sheet.main.length_km", "camera.hfov_deg * 4", "", 0}};
  validate(scene);
  const std::vector<Tie> right = ties_of(scene, "right");
  ASSERT_EQ(right.size(), 2u);
  EXPECT_EQ(right[0].expression.text(), "60");
  EXPECT_EQ(ties_of(scene).size(), 1u);
}

}  // namespace
}  // namespace vegard::sim::ties_test
