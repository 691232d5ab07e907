// Volumes: the same bytes for any number of threads and every instruction set.
#include <gtest/gtest.h>

#include "sim/render/beams/kernel.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/free_paths.h"
#include "tests/support/only_target.h"
#include "tests/support/same_bytes.h"

namespace vegard::sim::same_volumes_test {
namespace {

constexpr const char* kVolumes = R"(
seed = 8
[camera]
width = 96
height = 64
hfov_deg = 70
elevation_deg = 30
[blur]
width_deg = [0.4, 0.2, 0]
[march]
glow = 0.2
smooth_px = 0.7
[[footprint]]
name = "bands"
source = "noise"
center_km = [0, 300]
size_km = [500, 300]
cell_km = 3
flow_turns = 0.3
energy_flux_mw_m2 = 20
[[footprint]]
name = "oval"
shape = "shell"
face_cells = 512
width_km = 40
latitude_deg = [67, 68, 69]
longitude_deg = [-20, 0, 20]
point_energy = [0.5, 1, 2]
[[nebula]]
name = "cloud"
gas = "rough"
dust = "ring"
dust_depth = 3
elevation_deg = 33
distance_pc = 12
inner_rayleigh = [900, 500, 100]
outer_rayleigh = [100, 200, 300]
step = 0.1
[[node]]
name = "ball"
radius = 1.3
[[node]]
name = "rough"
kind = "turbulence"
of = "ball"
amplitude = 0.5
[[node]]
name = "ring"
kind = "torus"
thickness = 0.4
)";

Scene volumes() { return parse_scene(kVolumes, "volumes.toml"); }

Rendering rendered(int threads, const Scene& scene = volumes()) {
  RenderOptions options;
  options.threads = threads;
  return render(scene, options);
}

Exposure derived(int threads) {
  const Scene scene = volumes();
  const FilmGeometry film = film_for(scene, 0, 0, 96, 64, 4.0, 2.0);
  Exposure exposure;
  make_exposer(scene, film, threads)
      ->expose_with_derivatives(
          scene,
          tests::ids_of(scene, {"footprint." + scene.footprints[0].name + ".energy_kev", "nebula.dust_depth",
                                "node." + scene.nodes[1].name + ".amplitude", "camera.azimuth_deg"}),
          exposure);
  return exposure;
}

TEST(SameVolumes, ForAnyThreads) {
  const Rendering one = rendered(1);
  const Exposure derivatives = derived(1);
  for (const int threads : {2, 0}) {
    const Rendering again = rendered(threads);
    EXPECT_TRUE(tests::same_bytes(one.rayleigh.data, again.rayleigh.data)) << threads;
    EXPECT_TRUE(tests::same_bytes(one.rgb.data, again.rgb.data)) << threads;
    EXPECT_TRUE(tests::same_bytes(one.volume.data, again.volume.data)) << threads;
    EXPECT_TRUE(tests::same_bytes(derivatives.derivative, derived(threads).derivative)) << threads;
  }
}

TEST(SameVolumes, OnEveryInstructionSet) {
#ifdef VEGARD_ONE_INSTRUCTION_SET
  GTEST_SKIP() << "built for one instruction set";
#endif
  const Rendering picture = rendered(2);
  const std::int64_t available = hwy::SupportedTargets();
  int tried = 0;
  for (std::int64_t target : {std::int64_t{HWY_SSE4}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_AVX3}}) {
    if ((available & target) == 0) continue;
    const tests::Only only(target);
    ASSERT_STREQ(kernel_instruction_set(), hwy::TargetName(target));
    ++tried;
    EXPECT_TRUE(tests::same_bytes(rendered(2).rayleigh.data, picture.rayleigh.data))
        << hwy::TargetName(target);
  }
  EXPECT_GT(tried, 0);
}

TEST(SameVolumes, EveryOneOfThemShines) {
  const Rendering all = rendered(2);
  for (const char* name : {"bands", "oval", "cloud"}) {
    Scene without = volumes();
    for (std::size_t f = 0; f < without.footprints.size(); ++f)
      if (without.footprints[f].name == name) without.footprints.erase(without.footprints.begin() + f);
    if (without.nebulae[0].name == name) without.nebulae.clear();
    EXPECT_FALSE(tests::same_bytes(all.rayleigh.data, rendered(2, without).rayleigh.data)) << name;
  }
}

}  // namespace
}  // namespace vegard::sim::same_volumes_test
