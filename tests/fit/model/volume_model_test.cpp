// The model of a photograph of volumes: its derivatives by their numbers, the camera's among them, against
// central differences.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fit/model/profile_model.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::volume_model_test {
namespace {

const char* const kCamera = R"(
[camera]
width = 72
height = 54
hfov_deg = 0.4
elevation_deg = 60
[emission]
lines = [656.3, 500.7]
[blur]
width_deg = [0.005, 0.0]
)";

const char* const kNebula = R"(
[[nebula]]
elevation_deg = 60
position_angle_deg = 30
edge = 0.15
step = 0.05
gas = "rough"
dust = "belt"
inner_rayleigh = [8000, 24000]
outer_rayleigh = [20000, 4000]
dust_depth = 2
[[node]]
name = "rough"
kind = "turbulence"
of = "lobes"
amplitude = 0.1
frequency = 2
octaves = 2
[[node]]
name = "lobes"
kind = "lobes"
length = 2
radius = 0.8
waist = 0.25
thickness = 0.2
angles_deg = [35, 0, 0]
[[node]]
name = "belt"
kind = "torus"
radius = 0.5
thickness = 0.4
angles_deg = [35, 0, 0]
)";

Photo dark_photo(const sim::Scene& scene) {
  Photo photo;
  photo.linear = sim::Image(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  return photo;
}

double length(const std::vector<double>& v) {
  double square = 0.0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}

struct Step {
  const char* path;
  double step;
};

/// Steps are so long that the film's floats do not matter (1e-7 of the light, over a change of 1e-3 of it),
/// and so short that the light is straight within them: 2 % is left for both.
void expect_derivatives(const sim::Scene& scene, const std::vector<Step>& steps) {
  const Photo photo = dark_photo(scene);
  const Region region{0, 0, scene.camera.width, scene.camera.height};
  ProfileModel model(scene, photo, region, 6, 1.0, 0.0, 2);
  std::vector<sim::ParameterId> free;
  for (const Step& s : steps) free.push_back(sim::parameter_at(scene, s.path).value());
  ModelProfile here;
  model.evaluate_with_derivatives(scene, free, here);
  ASSERT_GT(length(here.value), 0.0);
  ModelProfile plain;
  model.evaluate(scene, plain);
  for (std::size_t i = 0; i < plain.value.size(); ++i)
    ASSERT_NEAR(here.value[i], plain.value[i], 1e-4 * length(plain.value)) << i;
  for (std::size_t j = 0; j < steps.size(); ++j) {
    std::vector<double> difference(plain.value.size()), slope(plain.value.size());
    for (const double sign : {1.0, -1.0}) {
      sim::Scene moved = scene;
      *sim::number_at(moved, free[j]) += sign * steps[j].step;
      ModelProfile there;
      model.evaluate(moved, there);
      for (std::size_t i = 0; i < there.value.size(); ++i)
        difference[i] += sign * there.value[i] / (2.0 * steps[j].step);
    }
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = here.derivative[i * steps.size() + j];
    const double size = length(difference);
    EXPECT_GT(size, 0.0) << steps[j].path;
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] -= difference[i];
    EXPECT_LT(length(slope), 0.02 * size) << steps[j].path;
  }
}

TEST(VolumeModel, HasTheDerivativesOfANebulaWithTurbulence) {
  expect_derivatives(sim::parse_scene(std::string(kCamera) + kNebula, "nebula.toml"),
                     {{"nebula.nebula.position_angle_deg", 0.05},
                      {"nebula.nebula.azimuth_deg", 2e-4},
                      {"nebula.nebula.distance_pc", 1.0},
                      {"nebula.nebula.edge", 1e-3},
                      {"nebula.nebula.inner_rayleigh.5007", 100.0},
                      {"nebula.nebula.outer_rayleigh.6563", 100.0},
                      {"nebula.nebula.dust_depth", 0.01},
                      {"node.lobes.length", 2e-3},
                      {"node.lobes.radius", 2e-3},
                      {"node.rough.amplitude", 1e-3},
                      {"node.belt.angles_deg.right", 0.1},
                      {"camera.azimuth_deg", 2e-4},
                      {"camera.hfov_deg", 1e-4},
                      {"blur.width_deg.6563", 1e-4}});
}

const char* const kArc = R"(
[camera]
width = 72
height = 54
hfov_deg = 80
elevation_deg = 28
[blur]
width_deg = [1.0, 0.5, 0.2]
[[footprint]]
size_km = [700, 200]
cell_km = 4
east_km = [-300, -140, 0, 130, 300]
north_km = [12, -20, 16, 30, -12]
width_km = 10
energy_kev = 4
point_energy = [1, 1, 1.2, 1, 1]
point_flux = [1, 1.5, 1, 1, 1]
)";

const std::vector<Step> kNumbersOfArc = {
    {"footprint.arc.north_km.1", 0.1},      {"footprint.arc.north_km.2", 0.1},
    {"footprint.arc.east_km.3", 0.3},       {"footprint.arc.center_km.east", 0.3},
    {"footprint.arc.center_km.north", 0.1}, {"footprint.arc.width_km", 0.05},
    {"footprint.arc.energy_kev", 0.02},     {"footprint.arc.energy_flux_mw_m2", 0.05},
    {"footprint.arc.point_flux.1", 0.02},   {"footprint.arc.point_energy.2", 0.005},
    {"camera.azimuth_deg", 0.02},           {"camera.elevation_deg", 0.02},
    {"field.inclination_deg", 0.02}};

TEST(VolumeModel, HasTheDerivativesOfAFootprint) {
  expect_derivatives(sim::parse_scene(kArc, "arc.toml"), kNumbersOfArc);
}

// Softened, and not marched at every cell where light alone is asked for.
TEST(VolumeModel, HasTheDerivativesOfASoftenedFootprint) {
  const std::string march = "[march]\nshrink = 3\nsmooth_px = 1.5\nglow = 0.2\nglow_deg = 3\n";
  expect_derivatives(sim::parse_scene(kArc + march, "arc.toml"),
                     {{"footprint.arc.north_km.1", 0.1}, {"footprint.arc.energy_kev", 0.02}});
}

// Numbers of sheets and of footprints together, each at its own place in the list.
TEST(VolumeModel, HasTheDerivativesOfSheetsBesideAFootprint) {
  const std::string sheet =
      "[[sheet]]\ncenter_km = [0.0, 160.0]\nbeams = 500\nlayers = 1\nwidth_km = 8\n"
      "[emission]\nflux_law = 'linear'\n";
  expect_derivatives(sim::parse_scene(kArc + sheet, "arc.toml"), {{"footprint.arc.north_km.1", 0.1},
                                                                  {"sheet.main.center_km.north", 0.02},
                                                                  {"sheet.main.energy_flux_mw_m2", 0.05},
                                                                  {"footprint.arc.width_km", 0.05}});
}

// A sheet in voxels of 8 km. Light is linear between voxels' centres, so its slope has steps: a short step
// keeps to one side of most.
TEST(VolumeModel, HasTheDerivativesOfAGrid) {
  const tests::TemporaryFolder folder;
  sim::Scene scene = sim::parse_scene(
      "[camera]\nwidth = 72\nheight = 54\nhfov_deg = 80\nelevation_deg = 28\n"
      "[[sheet]]\ncenter_km = [0.0, 180.0]\nlayers = 1\nwidth_km = 12\nbeams = 4000\n",
      folder / "arc.toml");
  sim::SceneGridOptions options;
  options.voxel = 8.0;
  sim::SceneGrid made = sim::grid_of_scene(scene, options);
  sim::write_vdb(folder / "arc.vdb", std::move(made.grid), {}, {});
  scene.sheets.clear();
  scene.volumes.resize(1);
  scene.volumes[0].file = "arc.vdb";
  scene.volumes[0].gain = 2.0;
  expect_derivatives(scene, {{"volume.volume.gain", 0.01},
                             {"volume.volume.shift_km.north", 0.05},
                             {"volume.volume.shift_km.up", 0.05},
                             {"camera.elevation_deg", 0.01}});
}

}  // namespace
}  // namespace vegard::fit::volume_model_test
