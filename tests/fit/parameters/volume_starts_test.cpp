#include "fit/parameters/volume_starts.h"

#include <gtest/gtest.h>

#include "tests/support/free_paths.h"

namespace vegard::fit::volume_starts_test {
namespace {

struct Arc {
  sim::Scene scene;
  std::vector<FreeNumber> free;
  std::vector<double> start;
  explicit Arc(const std::vector<std::string>& paths) {
    scene.footprints.resize(1);
    scene.footprints[0].center_km = {30.0, 200.0};
    scene.footprints[0].east_km = {-100.0, 0.0, 100.0};
    scene.footprints[0].north_km = {5.0, -10.0, 20.0};
    for (const std::string& path : paths) scene.fit.free.push_back(tests::free_entry(path));
    free = free_numbers(scene);
    for (const FreeNumber& n : free) start.push_back(n.start);
  }
};

// Half as far again from the observer, who stands at the origin, wherever points count from.
TEST(VolumeStarts, MoveWholeFootprintsAsSeenByTheObserver) {
  const Arc fixed({"footprint.arc.north_km", "footprint.arc.energy_kev"});
  const auto moved = moved_footprints(fixed.scene, fixed.free, fixed.start, 1.5, 0.5);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(200.0 + moved[i], 1.5 * (200.0 + fixed.start[i]), 1e-6) << i;
  EXPECT_NEAR(moved[3], 1.5, 1e-9);

  const Arc carried({"footprint.arc.center_km", "footprint.arc.north_km"});
  const auto all = moved_footprints(carried.scene, carried.free, carried.start, 1.5, 1.0);
  EXPECT_NEAR(all[0], 45.0, 1e-6);
  EXPECT_NEAR(all[1], 300.0, 1e-6);
  for (int i = 2; i < 5; ++i) EXPECT_NEAR(all[i], 1.5 * carried.start[i], 1e-6) << i;
}

TEST(VolumeStarts, LeaveWhatIsNoPlaceAlone) {
  const Arc arc({"footprint.arc.width_km"});
  EXPECT_FALSE(has_movable_footprint(arc.free));
  EXPECT_NEAR(moved_footprints(arc.scene, arc.free, arc.start, 1.5, 2.0)[0], arc.start[0], 1e-9);
  EXPECT_TRUE(has_movable_footprint(Arc({"footprint.arc.energy_kev"}).free));
}

TEST(VolumeStarts, TellFootprintsApartByTheirPlaceAndEnergy) {
  const Arc arc({"footprint.arc.north_km.1", "footprint.arc.energy_kev"});
  EXPECT_FALSE(footprints_differ(arc.scene, arc.free, {-10.0, 3.0}, {5.0, 3.3}));
  EXPECT_TRUE(footprints_differ(arc.scene, arc.free, {-10.0, 3.0}, {15.0, 3.0}));
  EXPECT_TRUE(footprints_differ(arc.scene, arc.free, {-10.0, 3.0}, {-10.0, 5.0}));
}

TEST(VolumeStarts, ExpectErrorsByWhatANumberIs) {
  const Arc arc({"footprint.arc.north_km.1", "footprint.arc.width_km", "camera.azimuth_deg"});
  EXPECT_NEAR(*usual_error(arc.scene, arc.free[0], 0.3), 0.3 * std::hypot(30.0, 200.0), 1e-9);
  EXPECT_NEAR(*usual_error(arc.scene, arc.free[1], 0.3), 0.6 * 3.0, 1e-9);
  EXPECT_FALSE(usual_error(arc.scene, arc.free[2], 0.3)) << "no number of a volume";
}

TEST(VolumeStarts, KnowWhatStandsOnTheSun) {
  sim::Scene scene;
  scene.sun.shown = true;
  scene.loops.resize(1);
  scene.chromospheres.resize(1);
  scene.chromospheres[0].extinction = 1.0;
  for (const char* path : {"loop.loop.height", "loop.loop.tilt_deg", "chromosphere.chromosphere.scale",
                           "sun.azimuth_deg", "sun.position_angle_deg"})
    scene.fit.free.push_back(tests::free_entry(path));
  const std::vector<FreeNumber> free = free_numbers(scene);
  for (const FreeNumber& n : free) EXPECT_TRUE(is_of_volume(n)) << n.path;
  EXPECT_NEAR(*usual_error(scene, free[0], 0.3), 0.6 * 60.0, 1e-9);
  EXPECT_NEAR(*usual_error(scene, free[1], 0.3), 20.0, 1e-9);
  EXPECT_NEAR(*usual_error(scene, free[2], 0.3), 0.6 * 20.0, 1e-9);
  EXPECT_LT(*usual_error(scene, free[3], 0.3), 0.3) << "of a disc that is half a degree wide";
  EXPECT_NEAR(*usual_error(scene, free[4], 0.3), 20.0, 1e-9);
}

}  // namespace
}  // namespace vegard::fit::volume_starts_test
