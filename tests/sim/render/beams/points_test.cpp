// The cloud of points against the film, and against the light that the sheets are said to give.
#include "sim/render/beams/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "tests/support/all_points.h"
#include "tests/support/exposed.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::points_test {
namespace {

using tests::all_points;

std::vector<double> photons_per_line(const EmissionPoints& points) {
  std::vector<double> sum(points.lines, 0.0);
  for (std::size_t i = 0; i < points.photons_per_s.size(); ++i)
    sum[i % points.lines] += points.photons_per_s[i];
  return sum;
}

/// Under which field does not matter; the film's kernel and the points' loop have their axes from one place.
class PointsUnder : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Field, PointsUnder, testing::Values("uniform", "dipole", "igrf"));

TEST_P(PointsUnder, ProjectedGiveTheRayleighsOfTheFilm) {
  Scene scene = tests::small_scene();
  scene.field.model = tests::kind_named<FieldModel>(GetParam());
  scene.site.time_utc = "2012-03-04T00:00:00Z";
  scene.sheets[0].arcs = 2;
  scene.sheets[0].path_spread = 0.3;
  scene.time.start_s = 3.0;
  scene.sheets[0].drift_km_s = {0.0, 2.5};
  scene.emission.lag = EmissionLag::none;  // points are those of the instant
  const EmissionPoints points = all_points(scene);
  const CameraView<double> view = camera_view(scene.camera);
  const FilmGeometry film = tests::whole_picture(scene);
  std::vector<double> sum(points.lines, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double in_camera[3] = {}, range2 = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double x = points.position_in_enu_km[3 * i + k];
      range2 += x * x;
      for (int r = 0; r < 3; ++r) in_camera[r] += view.camera_from_enu[r][k] * x;
    }
    if (in_camera[2] <= 0.0) continue;
    // In cells, (0, 0) the centre of the first; the bilinear splat takes what has four of them around it.
    const double column = in_camera[0] / in_camera[2] * view.lens.focal_px + 0.5 * film.columns - 0.5;
    const double row = in_camera[1] / in_camera[2] * view.lens.focal_px + 0.5 * film.rows - 0.5;
    if (column < 0.0 || column >= film.columns - 1 || row < 0.0 || row >= film.rows - 1) continue;
    const double cosine = in_camera[2] / std::sqrt(range2);
    const double steradian = std::pow(cosine, 3) / (view.lens.focal_px * view.lens.focal_px);
    for (int l = 0; l < points.lines; ++l)
      sum[l] += 1e-16 * points.photons_per_s[i * points.lines + l] / (range2 * steradian);
  }
  std::vector<double> rayleigh;
  BeamExposer(scene, film, 0).expose_reference(scene, rayleigh);
  const std::size_t cells = rayleigh.size() / points.lines;
  for (int l = 0; l < points.lines; ++l) {
    double light = 0.0;
    for (std::size_t i = 0; i < cells; ++i) light += rayleigh[l * cells + i];
    EXPECT_GT(light, 1e5);
    // Positions are floats: a few points in a million are on the other side of the film's edge.
    EXPECT_NEAR(sum[l] / light, 1.0, 1e-5) << l;
  }
}

TEST(Points, GiveOffTheLightOfTheSheetsWhereverTheCameraLooks) {
  // A sheet gives off Q * width * sqrt(2 pi) * length * integral of the profile over altitude. Overhead,
  // where the Earth is level; 6 * 10^5 random depths between 80 and 500 km.
  Scene scene = tests::small_scene();
  scene.site.altitude_m = 0.0;
  scene.camera.elevation_deg = -60.0;
  scene.field.inclination_deg = 90.0;
  Sheet& sheet = scene.sheets[0];
  sheet.center_km = {0.0, 0.0};
  sheet.length_km = 60.0;
  sheet.beams = 500;
  sheet.layers = 2;
  sheet.loss_cone_deg = 0.0;
  sheet.pitch_law = PitchLaw::constant;
  const EmissionPoints points = all_points(scene);
  EXPECT_NEAR(static_cast<double>(points.size()), 1000 * 600.0, 4 * 14.0 * std::sqrt(1000.0));
  const std::vector<double> photons = photons_per_line(points);
  const HeightProfile profile = sheet_profile(scene.emission.lines, scene, 0);
  const int top = static_cast<int>((sheet.top_km - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
  const double volume_per_km =
      1e15 * sheet.layers * sheet.energy_flux_mw_m2 * sheet.width_km * std::sqrt(2 * M_PI) * sheet.length_km;
  for (int l = 0; l < points.lines; ++l) {
    double column = 0.0;
    for (int a = 0; a < top; ++a)
      column += 0.5 * HeightProfile::kStepKm *
                (profile.rate[a * profile.stride + l] + profile.rate[(a + 1) * profile.stride + l]);
    // The trapezium rule on random nodes, some ten per scale height, a thousand beams: 0.1 %; the sheet of
    // 60 km leans by as little.
    EXPECT_NEAR(photons[l] / (volume_per_km * column), 1.0, 0.003) << l;
  }
}

TEST(Points, ThinnedOutKeepTheLight) {
  Scene scene = tests::small_scene();
  Sheet faint = scene.sheets[0];
  faint.name = "faint";
  faint.beams = 40;
  faint.center_km.north = 300.0;
  scene.sheets.push_back(faint);
  const EmissionPoints all = all_points(scene);
  const std::vector<double> photons = photons_per_line(all);
  for (int every : {3, 25}) {
    const EmissionPoints some = all_points(scene, every);
    EXPECT_NEAR(static_cast<double>(some.size()) * every / all.size(), 1.0, 0.05);
    const std::vector<double> kept = photons_per_line(some);
    // Neighbouring beams have stretches of the arc between 0.5 and 1.5: 30 of them scatter by some 5 %.
    for (int l = 0; l < all.lines; ++l)
      EXPECT_NEAR(kept[l] / photons[l], 1.0, every == 3 ? 0.05 : 0.15) << every;
  }
}

TEST(Points, ThinningIsTheLeastThatIsEnough) {
  const Scene scene = tests::small_scene();
  const std::size_t all = all_points(scene).size();
  EXPECT_EQ(thinning_for(scene, all, 0), 1);
  for (std::uint64_t most : {all - 1, all / 4, all / 20}) {
    const int every = thinning_for(scene, most, 0);
    EXPECT_EQ(every % 2, 1);
    ASSERT_GT(every, 1);
    EXPECT_LE(all_points(scene, every).size(), most);
    EXPECT_GT(all_points(scene, every - 2).size(), most);
  }
  EXPECT_EQ(thinning_for(scene, 1000, 0), 0) << "two layers with a beam of 600 points each";
}

TEST(Points, ThinningIsTheLeastForSheetsThatHaveLittleInCommon) {
  // The second has most points of few beams, and the first of many.
  Scene scene = tests::small_scene();
  scene.sheets[0].beams = 2000;
  scene.sheets[0].layers = 1;
  scene.sheets[0].path_step = 1.0 / 10.0;
  Sheet few = scene.sheets[0];
  few.name = "few";
  few.beams = 3;
  few.path_step = 1.0 / 1000.0;
  scene.sheets.push_back(few);
  std::vector<std::size_t> counts;  // of 1, 3, 5, …
  for (int every = 1; every <= 81; every += 2) counts.push_back(all_points(scene, every).size());
  for (std::size_t most : {counts[0] - 1, counts[1], counts[5], counts[20], counts[35]}) {
    const auto smallest =
        std::find_if(counts.begin(), counts.end(), [most](std::size_t count) { return count <= most; });
    EXPECT_EQ(thinning_for(scene, most, 0), 1 + 2 * (smallest - counts.begin())) << most;
  }
}

TEST(Points, AreEnoughWhereThereAreNone) {
  Scene scene = tests::small_scene();
  scene.sheets.clear();
  EXPECT_EQ(thinning_for(scene, 1, 0), 1);
}

TEST(Points, AreTheSameForAnyThreadsAndOfTheFirstInstant) {
  Scene scene = tests::small_scene();
  scene.sheets[0].drift_km_s = {1.0, 0.0};
  const EmissionPoints one = all_points(scene, 1, 1);
  scene.time.instants = 3;
  scene.time.exposure_s = 5.0;
  const EmissionPoints two = all_points(scene, 1, 2);
  EXPECT_EQ(one.position_in_enu_km, two.position_in_enu_km);
  EXPECT_EQ(one.photons_per_s, two.photons_per_s);
  scene.time.start_s = 7.0;
  const EmissionPoints later = all_points(scene);
  ASSERT_EQ(later.size(), one.size());
  EXPECT_NEAR(later.position_in_enu_km[0] - one.position_in_enu_km[0], 7.0, 1e-3);
}

}  // namespace
}  // namespace vegard::sim::points_test
