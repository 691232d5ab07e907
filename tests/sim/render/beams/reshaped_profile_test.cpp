// What rays and the lower border do to a beam's height profile, against a profile that is reshaped itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/render/beams/beams.h"
#include "sim/render/beams/kernel.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/render/film.h"
#include "tests/support/exposed.h"
#include "tests/support/glow.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::reshaped_profile_test {
namespace {

constexpr double kPeakKm = 120.0;
constexpr int kPeak = static_cast<int>((kPeakKm - HeightProfile::kBottomKm) / HeightProfile::kStepKm);

/// A beam whose light is read elsewhere: the profile is read at read_at(altitude index), in steps.
template <class ReadAt>
HeightProfile reshaped(const HeightProfile& profile, const ReadAt& read_at) {
  HeightProfile result = profile;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const double at = read_at(a);
    const int below = static_cast<int>(std::floor(at));
    const bool inside = at >= 0.0 && below + 1 < HeightProfile::kAltitudes;
    for (int l = 0; l < profile.stride; ++l) {
      const auto rate = [&](int row) {
        return profile.rate[static_cast<std::size_t>(row) * profile.stride + l];
      };
      result.rate[static_cast<std::size_t>(a) * profile.stride + l] =
          inside ? static_cast<float>(rate(below) + (rate(below + 1) - rate(below)) * (at - below)) : 0.0f;
    }
  }
  return result;
}

struct Films {
  std::vector<double> by_beams, by_profile;
  std::vector<std::int64_t> fast;
};

template <class ReadAt>
Films films(double shift_km, double stretch, const ReadAt& read_at) {
  Scene scene = tests::small_scene();
  scene.sheets[0].beams = 60;
  const FilmGeometry film = tests::whole_picture(scene);
  const std::vector<HeightProfile> profiles = height_profiles(scene);
  const std::vector<HeightProfile> other = {reshaped(profiles[0], read_at)};
  const BeamLayout layout(scene, 0.0);
  const double step = layout.path_step(0);
  const KernelScene plain = kernel_scene(scene, scene.sheets[0], step, film, profiles),
                    with_other = kernel_scene(scene, scene.sheets[0], step, film, other);
  const std::size_t size = static_cast<std::size_t>(film.rows) * film.columns * profiles[0].stride;
  Films result{std::vector<double>(size), std::vector<double>(size), std::vector<std::int64_t>(size)};
  PackedChunk packed;
  for (const Chunk& chunk : layout.chunks()) {
    layout.pack(scene, chunk, plain, packed);
    fall_on_film_reference(with_other, packed.groups.data(), packed.groups.size(), result.by_profile.data());
    for (BeamGroup& group : packed.groups) {
      group.reads_elsewhere = true;
      group.peak_km = kPeakKm;
      std::fill_n(group.altitude_shift_km, kGroup, shift_km);
      std::fill_n(group.stretch_above, kGroup, stretch);
    }
    fall_on_film_reference(plain, packed.groups.data(), packed.groups.size(), result.by_beams.data());
    fall_on_film(plain, packed.groups.data(), packed.groups.size(), result.fast.data());
  }
  return result;
}

/// Root mean square difference, relative.
template <class Number>
double difference(const std::vector<Number>& a, const std::vector<double>& b, double scale) {
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    error += std::pow(static_cast<double>(a[i]) * scale - b[i], 2);
    size += b[i] * b[i];
  }
  return std::sqrt(error / size);
}

void expect_like_the_reshaped_profile(const Films& f) {
  // The reshaped profile is rounded to floats once more; the kernel for pictures sees points float by float.
  EXPECT_LT(difference(f.by_beams, f.by_profile, 1.0), 1e-6);
  EXPECT_LT(difference(f.fast, f.by_profile, 1.0 / kFilmUnitsPerRayleigh), 2e-3);
}

TEST(ReshapedProfile, ShiftedUpIsTheProfileShiftedUp) {
  expect_like_the_reshaped_profile(films(3.0, 1.0, [](int a) { return a - 12.0; }));
}

TEST(ReshapedProfile, ShiftedDownIsDarkBelowItsTable) {
  expect_like_the_reshaped_profile(films(-5.0, 1.0, [](int a) { return a + 20.0; }));
}

TEST(ReshapedProfile, StretchedAboveThePeakIsTheProfileStretched) {
  expect_like_the_reshaped_profile(
      films(0.0, 2.0, [](int a) { return a <= kPeak ? a : kPeak + (a - kPeak) / 2.0; }));
}

TEST(ReshapedProfile, IsStretchedFromItsShiftedPeak) {
  expect_like_the_reshaped_profile(films(2.0, 2.0, [](int a) {
    const double at = a - 8.0;
    return at <= kPeak ? at : kPeak + (at - kPeak) / 2.0;
  }));
}

TEST(PeakAltitude, IsWhereTheLightIsBrightest) {
  // The tables' own figures: 557.7 nm of electrons of 1, 3 and 10 keV peaks at 126, 109 and 101 km.
  EXPECT_NEAR(peak_altitude_km(maxwellian_profile(tests::glow(), {557.7}, 1.0)), 126.0, 1.0);
  EXPECT_NEAR(peak_altitude_km(maxwellian_profile(tests::glow(), {557.7}, 3.0)), 109.0, 1.0);
  EXPECT_NEAR(peak_altitude_km(maxwellian_profile(tests::glow(), {557.7}, 10.0)), 101.0, 1.0);
}

TEST(StructuredScene, MovesThePictureAndKeepsItsLight) {
  // What a fold, a curl, a ray, a patch or the border does shows, and light is only moved or has the mean 1:
  // a picture of 400 km by rays of 1 km has some 400 of them, a standard error of the light of 3 %; five of
  // it, and for patches of 5 km seven times as much. Seed of the small scene.
  Scene scene = tests::small_scene();
  const FilmGeometry film = tests::whole_picture(scene);
  const auto total = [&](const Scene& s, std::vector<float>& rayleigh) {
    Exposure exposure;
    make_exposer(s, film, 0)->expose(s, exposure);
    rayleigh.assign(exposure.rayleigh.begin(), exposure.rayleigh.end());
    double sum = 0.0;
    for (float r : rayleigh) sum += r;
    return sum;
  };
  std::vector<float> before, after;
  const double plain = total(scene, before);
  const auto expect_change = [&](void (*set)(Sheet&), double tolerance) {
    Scene changed = scene;
    set(changed.sheets[0]);
    EXPECT_NEAR(total(changed, after) / plain, 1.0, tolerance);
    EXPECT_NE(before, after);
  };
  expect_change([](Sheet& s) { s.fold_spacing_km = 20.0; }, 0.03);
  expect_change([](Sheet& s) { s.curl_spacing_km = 5.0; }, 0.03);
  expect_change([](Sheet& s) { s.ray_contrast = 0.6, s.ray_width_km = 1.0; }, 0.15);
  expect_change([](Sheet& s) { s.ray_length_contrast = 0.5, s.ray_width_km = 1.0; }, 0.15);
  expect_change([](Sheet& s) { s.patch_size_km = 5.0, s.patch_contrast = 0.5; }, 0.35);
  expect_change([](Sheet& s) { s.border_amplitude_km = 4.0; }, 0.05);
}

}  // namespace
}  // namespace vegard::sim::reshaped_profile_test
