#include "fit/parameters/photo_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fit/parameters/parameter_map.h"
#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::photo_frame_test {
namespace {

/// Where a sheet of a scene is at the photograph's time, in the numbers that a renderer has derivatives by.
double number_at_its_time(const sim::Scene& scene, const sim::ParameterId& id) {
  const sim::Sheet& sheet = scene.sheets[0];
  double number = *sim::number_at(scene, id);
  if (id.role() == sim::ParameterRole::centre)
    number += scene.time.start_s * (id.component == 0 ? sheet.drift_km_s.east : sheet.drift_km_s.north);
  if (id.role() == sim::ParameterRole::curve_east) number += scene.time.start_s * sheet.drift_km_s.east;
  if (id.role() == sim::ParameterRole::curve_north) number += scene.time.start_s * sheet.drift_km_s.north;
  return number;
}

/// Of a station 250 km away, forty seconds on: against differences of what put() makes of the sheet.
void expect_slopes(sim::Scene scene, const std::vector<std::string>& keys, std::size_t least) {
  scene.site.latitude_deg = 68.0;
  scene.site.longitude_deg = 20.0;
  scene.time.start_s = 40.0;
  scene.sheets[0].drift_km_s = {0.7, -0.4};
  for (const std::string& key : keys) scene.fit.free.push_back(tests::free_entry("sheet.main." + key));
  const std::vector<FreeNumber> free = free_numbers(scene);
  sim::Site there = scene.site;
  there.latitude_deg = 69.5;
  there.longitude_deg = 25.0;
  PhotoFrame frame;
  frame.name = "there";
  frame.station = sim::Station(scene.site, there);
  frame.sheets_at_home = scene.sheets;
  sim::Scene seen = scene;
  seen.site = there;
  frame.carry(seen);

  const ParameterMap map(seen, free, frame);
  std::vector<double> values;
  std::vector<int> moved;
  for (std::size_t j = 0; j < free.size(); ++j) {
    values.push_back(free[j].start);
    moved.push_back(static_cast<int>(j));
  }
  map.put(values, seen);
  const ParameterMap::Motion motion = map.motion(values, moved, seen);
  ASSERT_EQ(motion.slopes.size(), motion.numbers.size() * moved.size());
  ASSERT_GE(motion.numbers.size(), least);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const double step = 1e-3 * std::abs(values[k]);
    sim::Scene up = seen, down = seen;
    std::vector<double> more = values, less = values;
    more[k] += step;
    less[k] -= step;
    map.put(more, up);
    map.put(less, down);
    for (std::size_t i = 0; i < motion.numbers.size(); ++i) {
      const double difference =
          (number_at_its_time(up, motion.numbers[i]) - number_at_its_time(down, motion.numbers[i])) /
          (2.0 * step);
      EXPECT_NEAR(motion.slopes[i * moved.size() + k], difference, 1e-5 * std::max(1.0, std::abs(difference)))
          << "number " << i << " by " << free[k].label();
    }
  }
}

TEST(PhotoFrame, SlopesOfADriftingSheetAgreeWithDifferences) {
  expect_slopes(tests::small_scene(),
                {"center_km.east", "center_km.north", "bearing_deg", "length_km", "wavelength_km"}, 5);
}

TEST(PhotoFrame, SlopesOfADriftingCurveAgreeWithDifferences) {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].course = sim::SheetCourse::curve;
  scene.sheets[0].east_km = {-150.0, -20.0, 60.0, 300.0};
  scene.sheets[0].north_km = {180.0, 220.0, 160.0, 250.0};
  // Those that are not free drift otherwise too, as the mean of the points moves.
  expect_slopes(scene, {"east_km.1", "north_km.1", "north_km.3"}, 8);
}

}  // namespace
}  // namespace vegard::fit::photo_frame_test
