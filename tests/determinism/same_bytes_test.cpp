#include <gtest/gtest.h>

#include "sim/render/beam_exposer.h"
#include "sim/render/beams/kernel.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/free_paths.h"
#include "tests/support/only_target.h"
#include "tests/support/same_bytes.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::same_bytes_test {
namespace {

/// Several chunks of beams, two sheets, and lines enough for both halves of a wide row.
Scene busy_scene() {
  Scene scene = tests::small_scene();
  scene.emission.lines = {630.0, 557.7, 427.8, 337.1, 844.6};
  scene.blur.width_deg = {0.43, 0.18, 0.0, 0.1, 0.0};
  Sheet second = scene.sheets[0];
  second.name = "second";
  second.center_km.north = 260.0;
  second.energy_kev = 7.0;
  second.path_spread = 0.3;
  scene.sheets.push_back(second);
  Sheet& first = scene.sheets[0];
  first.beams = 1500;
  first.fold_spacing_km = 20.0;
  first.curl_spacing_km = 6.0;
  first.ray_contrast = 0.5;
  first.ray_length_contrast = 0.3;
  first.ray_lifetime_s = 1.0;
  first.patch_size_km = 20.0;
  first.border_amplitude_km = 4.0;
  scene.stars.shown = true;
  return scene;
}

/// The same in motion, over four instants.
Scene exposed_scene() {
  Scene scene = busy_scene();
  scene.sheets[0].beams = 600;
  scene.sheets[0].drift_km_s = {8.5, -2.5};
  scene.sheets[1].sine_speed_km_s = 20.0;
  scene.time.exposure_s = 1.0;
  scene.time.instants = 4;
  return scene;
}

Rendering rendered(int threads, BlurModel blur_model = BlurModel::angle) {
  RenderOptions options;
  options.threads = threads;
  Scene scene = busy_scene();
  scene.blur.model = blur_model;
  scene.blur.wind_m_s = {80.0, -120.0};
  return render(scene, options);
}

Exposure with_derivatives(int threads) {
  Scene scene = busy_scene();
  scene.sheets[0].beams = 600;
  const FilmGeometry film = film_for(scene, 0, 0, 160, 120, 2.0, 1.0);
  Exposure exposure;
  make_exposer(scene, film, threads, 0.5)
      ->expose_with_derivatives(scene, tests::ids_of(tests::free_paths(scene)), exposure);
  return exposure;
}

/// Only the numbers of beams are free: the cheaper kernel.
Exposure with_beam_derivatives(int threads) {
  const Scene scene = busy_scene();
  const FilmGeometry film = film_for(scene, 0, 0, 160, 120, 2.0, 1.0);
  Exposure exposure;
  make_exposer(scene, film, threads)
      ->expose_with_derivatives(
          scene, {parameter_with(ParameterRole::phase, 0), parameter_with(ParameterRole::energy, 1)},
          exposure);
  return exposure;
}

TEST(SameBytes, OfAPictureForAnyThreadsAndRun) {
  const Rendering one = rendered(1);
  EXPECT_GT(one.deflection_points, 100000u);
  for (int threads : {1, 2, 3, 0}) {
    const Rendering again = rendered(threads);
    EXPECT_TRUE(tests::same_bytes(one.rayleigh.data, again.rayleigh.data)) << threads << " threads";
    EXPECT_TRUE(tests::same_bytes(one.rgb.data, again.rgb.data)) << threads << " threads";
    EXPECT_EQ(one.deflection_points, again.deflection_points);
  }
}

TEST(SameBytes, OfAPhysicallyBlurredPictureForAnyThreads) {
  const Rendering one = rendered(1, BlurModel::physical);
  EXPECT_FALSE(tests::same_bytes(one.rayleigh.data, rendered(1).rayleigh.data));
  for (int threads : {1, 2, 3}) {
    const Rendering again = rendered(threads, BlurModel::physical);
    EXPECT_TRUE(tests::same_bytes(one.rayleigh.data, again.rayleigh.data)) << threads << " threads";
    EXPECT_EQ(one.deflection_points, again.deflection_points);
  }
}

TEST(SameBytes, OfAnExposureOverInstantsForAnyThreads) {
  const Scene scene = exposed_scene();
  const FilmGeometry film = film_for(scene, 0, 0, 160, 120, 2.0, 1.0);
  const std::vector<ParameterId> free = {parameter_with(ParameterRole::centre, 0, 1),
                                         parameter_with(ParameterRole::energy, 1)};
  RenderOptions options;
  options.threads = 1;
  const Rendering one = render(scene, options);
  Exposure derived;
  make_exposer(scene, film, 1)->expose_with_derivatives(scene, free, derived);
  for (int threads : {2, 3, 0}) {
    options.threads = threads;
    EXPECT_TRUE(tests::same_bytes(one.rayleigh.data, render(scene, options).rayleigh.data))
        << threads << " threads";
    Exposure again;
    make_exposer(scene, film, threads)->expose_with_derivatives(scene, free, again);
    EXPECT_TRUE(tests::same_bytes(derived.rayleigh, again.rayleigh)) << threads << " threads";
    EXPECT_TRUE(tests::same_bytes(derived.derivative, again.derivative)) << threads << " threads";
  }
}

TEST(SameBytes, OfAnExposureThatIsMadeAgain) {
  const Scene scene = busy_scene();
  Scene moved = scene;
  moved.sheets[0].center_km.north += 20.0;
  const FilmGeometry film = film_for(scene, 0, 0, 160, 120, 1.0, 1.0);
  BeamExposer exposer(scene, film, 2);
  Exposure first, other, again;
  exposer.expose(scene, first);
  exposer.expose(moved, other);
  exposer.expose(scene, again);
  EXPECT_TRUE(tests::same_bytes(first.rayleigh, again.rayleigh));
  EXPECT_FALSE(tests::same_bytes(first.rayleigh, other.rayleigh));
}

TEST(SameBytes, OfDerivativesForAnyThreads) {
  for (const auto& make : {with_derivatives, with_beam_derivatives}) {
    const Exposure one = make(1), two = make(2), three = make(3);
    EXPECT_TRUE(tests::same_bytes(one.derivative, two.derivative));
    EXPECT_TRUE(tests::same_bytes(one.derivative, three.derivative));
    EXPECT_TRUE(tests::same_bytes(one.rayleigh, two.rayleigh));
  }
}

TEST(SameBytes, OfTheFilmWithAndWithoutDerivatives) {
  Scene scene = busy_scene();
  // As in every fit, which draws a lens that may come to have distortion as one that has.
  for (const tests::FreePath& path : tests::free_paths(scene))
    scene.fit.free.push_back(tests::free_entry(path.path.text));
  const FilmGeometry film = film_for(scene, 0, 0, 160, 120, 1.0, 1.0);
  BeamExposer exposer(scene, film, 2);
  Exposure plain, derived, few;
  exposer.expose(scene, plain);
  exposer.expose_with_derivatives(scene, tests::ids_of(tests::free_paths(scene)), derived);
  exposer.expose_with_derivatives(scene, {parameter_with(ParameterRole::phase, 0)}, few);
  EXPECT_TRUE(tests::same_bytes(plain.rayleigh, derived.rayleigh));
  EXPECT_TRUE(tests::same_bytes(plain.rayleigh, few.rayleigh));
  EXPECT_EQ(plain.deflection_points, derived.deflection_points);
  EXPECT_EQ(plain.deflection_points, few.deflection_points);
}

TEST(SameBytes, OnEveryInstructionSet) {
#ifdef VEGARD_ONE_INSTRUCTION_SET
  GTEST_SKIP() << "built for one instruction set";
#endif
  const std::string best = kernel_instruction_set();
  const Rendering picture = rendered(2), physical = rendered(2, BlurModel::physical);
  const Exposure derivatives = with_derivatives(2), beams = with_beam_derivatives(2);
  int tried = 0;
  const std::int64_t available = hwy::SupportedTargets();
  for (std::int64_t target : {std::int64_t{HWY_SSE4}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_AVX3}}) {
    if ((available & target) == 0) continue;
    const tests::Only only(target);
    SCOPED_TRACE(hwy::TargetName(target));
    ASSERT_STREQ(kernel_instruction_set(), hwy::TargetName(target));
    ++tried;
    EXPECT_TRUE(tests::same_bytes(rendered(2).rgb.data, picture.rgb.data));
    EXPECT_TRUE(tests::same_bytes(rendered(2, BlurModel::physical).rgb.data, physical.rgb.data));
    EXPECT_TRUE(tests::same_bytes(with_derivatives(2).derivative, derivatives.derivative));
    EXPECT_TRUE(tests::same_bytes(with_beam_derivatives(2).derivative, beams.derivative));
  }
  EXPECT_EQ(best, kernel_instruction_set());
  if (tried < 2) GTEST_SKIP() << "only " << tried << " of the instruction sets here";
}

}  // namespace
}  // namespace vegard::sim::same_bytes_test
