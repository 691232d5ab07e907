#include "fit/photo/pointing/blind/map_flip.h"

#include <gtest/gtest.h>

#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/view/camera/camera.h"
#include "tests/support/star_field.h"

namespace vegard::tests::map_flip_test {
namespace {

TEST(MapFlip, IsSettledByStarsAlone) {
  const fit::SkyCamera camera = known_camera(sim::LensModel::equidistant, 160.0, 40.0, 86.0, 20.0);
  const std::vector<fit::StarSighting> sky =
      fit::catalogue_sky({69.6, 19.2, 100.0, true}, *sim::julian_date("2014-02-21T19:30:40Z"), 4.0);
  sim::DirectionMap map;
  map.width = 640;
  map.height = 480;
  const sim::Lens<double> lens = fit::true_lens(camera);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      double v[3];
      sim::unproject(lens, x + 0.5, y + 0.5, v);
      const Eigen::Vector3d enu = camera.camera_from_enu.transpose() * Eigen::Vector3d(v[0], v[1], v[2]);
      const sim::Direction at = sim::direction_of_enu(enu.data());
      map.azimuth_deg.push_back(static_cast<float>(at.azimuth_deg));
      map.elevation_deg.push_back(static_cast<float>(at.elevation_deg));
    }
  std::vector<fit::FoundStar> points;
  for (const fit::StarSighting& star : sky) {
    fit::FoundStar point;
    if (fit::place_of_star(camera, star.enu, point.x_px, point.y_px) && point.x_px > 0.0 &&
        point.y_px > 0.0 && point.x_px < 640.0 && point.y_px < 480.0)
      points.push_back(point);
  }
  ASSERT_GT(points.size(), 60u);
  for (const bool rows : {false, true})
    for (const bool columns : {false, true}) {
      sim::DirectionMap stored = map;
      fit::flip_map({rows, columns}, stored);
      const auto found = fit::flip_by_stars(stored, points, sky);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->flip.rows, rows);
      EXPECT_EQ(found->flip.columns, columns);
    }
  // Seed 5: points that are no stars settle nothing.
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const sim::Words words = sim::random_words(5, sim::Stream::stars, i);
    points[i].x_px = 640.0 * sim::uniform(words[0]);
    points[i].y_px = 480.0 * sim::uniform(words[1]);
  }
  EXPECT_FALSE(fit::flip_by_stars(map, points, sky));
}

}  // namespace
}  // namespace vegard::tests::map_flip_test
