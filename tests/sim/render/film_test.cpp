#include "sim/render/film.h"
#include "sim/render/beam_exposer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/beams/kernel.h"
#include "tests/support/block_means.h"
#include "tests/support/exposed.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::film_test {
namespace {

using tests::exposed;
using tests::whole_picture;

double total(const Exposure& exposure, int line) {
  const auto first = exposure.rayleigh.begin() + static_cast<std::ptrdiff_t>(line * exposure.cells());
  return std::accumulate(first, first + static_cast<std::ptrdiff_t>(exposure.cells()), 0.0);
}

TEST(Film, AColumnOfKnownEmissionGivesItsRayleighs) {
  // docs/physics.md row B21. A sheet 60 km wide around the zenith, seen within 2 degrees of it: 0.1 * Q *
  // integral of the volume emission rate. Some 4000 beams cross the picture at the green line's altitude;
  // with a quarter of them the mean scatters by 1.2 % from seed to seed, with eight times as many it
  // is 1.001.
  Scene scene;
  scene.camera.width = 40;
  scene.camera.height = 40;
  scene.camera.hfov_deg = 4.0;
  scene.camera.elevation_deg = 90.0;
  scene.field.inclination_deg = 90.0;
  Sheet sheet;
  sheet.center_km = {0.0, 0.0};
  sheet.length_km = 40.0;
  sheet.thickness_km = 0.01;
  sheet.width_km = 60.0;
  sheet.layers = 1;
  sheet.beams = 400000;
  sheet.energy_flux_mw_m2 = 2.0;
  tests::fall_straight(sheet);
  scene.sheets = {sheet};
  FilmGeometry film = whole_picture(scene);
  const Exposure exposure = exposed(scene, film);
  const HeightProfile profile = sheet_profile(scene.emission.lines, scene, 0);
  for (int l = 0; l < 3; ++l) {
    double column = 0.0;
    const int top = static_cast<int>((sheet.top_km - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
    for (int a = 0; a < top; ++a)
      column += 0.05 * HeightProfile::kStepKm * (profile.rate[a * 4 + l] + profile.rate[(a + 1) * 4 + l]);
    double mean = 0.0;
    int cells = 0;
    for (int r = 2; r < 38; ++r)
      for (int c = 2; c < 38; ++c, ++cells) mean += exposure.rayleigh[(l * 40 + r) * 40 + c];
    EXPECT_NEAR(mean / cells / (2.0 * column), 1.0, 0.015) << "line " << l;
  }
}

TEST(Film, BeamsAgreeWithLinesOfSightWithinTheirNoiseWhichFallsFasterThanTheRootOfTheirNumber) {
  // Eight seeds each. The noise is the scatter between them; one picture differs from the integral by that
  // noise, and by up to 0.3 % that no number of beams takes away (the bilinear splat's own smoothing).
  // Independent places would have the noise fall to 1/4 from one number to the next; stratified along and
  // across, it falls to less than 1/8 (tests/bench/noise_curve.cpp shows the curve).
  for (int line : {0, 1}) {
    const std::vector<double> truth = tests::blocks_by_lines_of_sight(tests::undeflected_scene(1), line);
    double noise_before = 0.0;
    for (int beams : {64, 1024, 16384}) {
      std::vector<std::vector<double>> of_seed;
      for (int seed = 1; seed <= 8; ++seed) {
        Scene scene = tests::undeflected_scene(beams);
        scene.seed = seed;
        of_seed.push_back(tests::blocks_by_beams(scene, line));
      }
      const double noise = tests::relative_scatter(of_seed, truth);
      const double difference = tests::relative_rms(of_seed[0], truth);
      EXPECT_LT(difference, std::hypot(1.5 * noise, 0.0032)) << beams << " beams";
      EXPECT_GT(difference, 0.5 * noise) << beams << " beams";
      if (noise_before > 0.0) {
        EXPECT_LT(noise, noise_before / 8.0) << beams << " beams";
      }
      noise_before = noise;
    }
  }
}

TEST(Film, LightPerSolidAngleDoesNotDependOnTheResolution) {
  // The same beams at twice the pixels: the splat reaches half as far, which moves light over the blocks'
  // edges only.
  const Scene scene = tests::undeflected_scene(5000);
  EXPECT_LT(tests::relative_rms(tests::blocks_by_beams(scene, 1, 2), tests::blocks_by_beams(scene, 1)),
            0.004);
}

TEST(Film, OblongCellsHoldTheSameRayleighs) {
  const Scene scene = tests::undeflected_scene(5000);
  FilmGeometry wide = whole_picture(scene);
  wide.cell_width_px = 4.0;
  wide.columns /= 4;
  const Exposure coarse = exposed(scene, wide), fine = exposed(scene, whole_picture(scene));
  double sum_coarse = 0.0, sum_fine = 0.0;
  for (int r = 8; r < 40; ++r) {
    for (int c = 4; c < 12; ++c) sum_coarse += coarse.rayleigh[(48 + r) * 16 + c] * 4;
    for (int c = 16; c < 48; ++c) sum_fine += fine.rayleigh[(48 + r) * 64 + c];
  }
  EXPECT_NEAR(sum_coarse / sum_fine, 1.0, 0.005);
}

TEST(Splat, KeepsTheLightAndItsCentre) {
  FilmGeometry film;
  film.columns = 31;
  film.rows = 17;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 0.999f);
  for (int stride : {4, 8}) {
    std::vector<float> column, row, weights;
    std::vector<double> light(stride, 0.0), at_column(stride, 0.0), at_row(stride, 0.0);
    for (int i = 0; i < 500; ++i) {
      column.push_back(unit(random) * 30.0f);
      row.push_back(unit(random) * 16.0f);
      for (int l = 0; l < stride; ++l) {
        weights.push_back(unit(random) * 10.0f);
        light[l] += weights.back();
        at_column[l] += static_cast<double>(weights.back()) * column.back();
        at_row[l] += static_cast<double>(weights.back()) * row.back();
      }
    }
    std::vector<std::int64_t> cells(film.columns * film.rows * stride, 0);
    splat_on_film(film, stride, column.data(), row.data(), weights.data(), 500, cells.data());
    for (int l = 0; l < stride; ++l) {
      double sum = 0.0, sum_column = 0.0, sum_row = 0.0;
      for (int r = 0; r < film.rows; ++r)
        for (int c = 0; c < film.columns; ++c) {
          const double rayleigh = cells[(r * film.columns + c) * stride + l] / kFilmUnitsPerRayleigh;
          sum += rayleigh;
          sum_column += rayleigh * c;
          sum_row += rayleigh * r;
        }
      // 500 samples, each in four cells rounded to a float and to a millionth of a rayleigh.
      EXPECT_NEAR(sum, light[l], 1e-3);
      EXPECT_NEAR(sum_column / sum, at_column[l] / light[l], 1e-5);
      EXPECT_NEAR(sum_row / sum, at_row[l] / light[l], 1e-5);
    }
  }
}

/// One vertical beam to the north; a film on which it stands at column 79.3, counted from the centre of the
/// first cell.
Scene one_beam(double distance_km) {
  Scene scene = tests::small_scene();
  scene.camera.azimuth_deg = scene.camera.roll_deg = 0.0;
  scene.camera.hfov_deg = 120.0;
  scene.field.inclination_deg = 90.0;
  scene.field.declination_deg = 0.0;
  Sheet& sheet = scene.sheets[0];
  sheet.center_km = {0.0, distance_km};
  sheet.bearing_deg = 90.0;
  sheet.layers = sheet.beams = 1;
  sheet.width_km = 1e-5;
  sheet.thickness_km = 0.0;
  sheet.energy_flux_mw_m2 = 1e7;
  sheet.spacing_jitter = 0.0;
  tests::fall_straight(sheet);
  return scene;
}
FilmGeometry shifted_film(const Scene& scene) {
  FilmGeometry film = whole_picture(scene);
  film.x0_px = 0.2;
  return film;
}

double in_column(const Exposure& exposure, int column) {
  double sum = 0.0;
  for (int r = 0; r < exposure.geometry.rows; ++r)
    sum += exposure
               .rayleigh[exposure.cells() + static_cast<std::size_t>(r) * exposure.geometry.columns + column];
  return sum;
}

TEST(Film, BilinearSharesBetweenColumnsAndNearestDoesNot) {
  Scene scene = one_beam(200.0);
  const Exposure shared = exposed(scene, shifted_film(scene));
  EXPECT_GT(total(shared, 1), 0.0);
  EXPECT_NEAR(in_column(shared, 79) / total(shared, 1), 0.7, 1e-4);
  EXPECT_NEAR(in_column(shared, 80) / total(shared, 1), 0.3, 1e-4);
  scene.film.splat = SplatRule::nearest;
  const Exposure nearest = exposed(scene, shifted_film(scene));
  EXPECT_EQ(in_column(nearest, 79), total(nearest, 1));
  EXPECT_NEAR(total(nearest, 1) / total(shared, 1), 1.0, 1e-3);
}

TEST(Film, UnitWeightCountsEveryPointAlike) {
  Scene near = one_beam(180.0), far = one_beam(360.0);
  // By the inverse square of the distance to where the light is, at 109 to 200 km: about a factor of three.
  const double fall_off =
      total(exposed(near, whole_picture(near)), 1) / total(exposed(far, whole_picture(far)), 1);
  EXPECT_GT(fall_off, 2.4);
  EXPECT_LT(fall_off, 4.0);
  near.film.weight = far.film.weight = PointWeight::unit;
  const double counted = total(exposed(near, whole_picture(near)), 1);
  EXPECT_NEAR(counted / total(exposed(far, whole_picture(far)), 1), 1.0, 1e-3);
  near.sheets[0].energy_flux_mw_m2 *= 3.0;
  EXPECT_EQ(total(exposed(near, whole_picture(near)), 1), counted);
}

TEST(Film, CountsTheDeflectionPointsOfTheBeamsInSight) {
  Scene scene = one_beam(200.0);
  scene.sheets[0].beams = 100;
  scene.sheets[0].length_km = 10.0;
  // 100 beams of 600 +- 14 points.
  EXPECT_NEAR(static_cast<double>(exposed(scene, whole_picture(scene)).deflection_points), 59967.0,
              4 * 141.0);
  scene.sheets[0].path_spread = 1.0;
  const double half = static_cast<double>(exposed(scene, whole_picture(scene)).deflection_points);
  EXPECT_NEAR(half, 30000.0, 4 * 0.29 * 600.0 * 10.0) << "depths uniform in the whole path";
}

TEST(Film, FollowsTheReferenceInDouble) {
  const Scene scene = tests::small_scene();
  const FilmGeometry film = film_for(scene, 0, 0, 160, 120, 1.0, 1.0);
  BeamExposer exposer(scene, film, 0);
  Exposure exposure;
  std::vector<double> reference;
  exposer.expose(scene, exposure);
  exposer.expose_reference(scene, reference);
  ASSERT_EQ(reference.size(), exposure.rayleigh.size());
  std::vector<double> fast(exposure.rayleigh.begin(), exposure.rayleigh.end());
  EXPECT_LT(tests::relative_rms(fast, reference), 1e-3);
  EXPECT_GT(tests::relative_rms(fast, reference), 0.0);
}

TEST(Film, ABeamUnderADipoleFallsAsUnderTheUniformFieldOfItsFoot) {
  Scene scene = one_beam(170.0);
  scene.sheets[0].loss_cone_deg = 2.5;
  scene.field.model = FieldModel::dipole;
  scene.site.latitude_deg = 67.0;
  scene.site.longitude_deg = 25.0;
  const Exposure under_dipole = exposed(scene, shifted_film(scene));
  const EastNorth foot = scene.sheets[0].center_km;
  const FallFrame<double> fall =
      dipole_fall_frame(dipole_axis(scene.field, scene.site), foot.east, foot.north);
  scene.field.model = FieldModel::uniform;
  const Exposure elsewhere = exposed(scene, shifted_film(scene));
  scene.field.inclination_deg = std::asin(-fall.along[2]) / kRadiansPerDegree;
  scene.field.declination_deg = std::atan2(fall.along[0], fall.along[1]) / kRadiansPerDegree;
  const Exposure under_uniform = exposed(scene, shifted_film(scene));
  const auto difference = [&](const Exposure& other) {
    double off = 0.0;
    for (std::size_t i = 0; i < other.rayleigh.size(); ++i)
      off += std::abs(other.rayleigh[i] - under_dipole.rayleigh[i]);
    return off / (total(under_dipole, 0) + total(under_dipole, 1) + total(under_dipole, 2));
  };
  EXPECT_GT(total(under_dipole, 1), 0.0);
  EXPECT_LT(difference(under_uniform), 1e-3) << "floats, and a foot that the sine and width move by little";
  EXPECT_GT(difference(elsewhere), 0.1) << "the default field is another";
}

TEST(Film, BeamsThatDoNotDescendAreDark) {
  // 1500 km away the vertical leans 13 degrees from the observer's: a field that dips 2 degrees to the north
  // rises there by 11, and its line comes down behind the observer. Such light would be negative.
  Scene scene = tests::small_scene();
  scene.camera.elevation_deg = 10.0;
  scene.camera.roll_deg = 0.0;
  scene.field.inclination_deg = 2.0;
  scene.sheets[0].center_km = {0.0, 1500.0};
  const auto light = [&](double declination_deg, double azimuth_deg) {
    scene.field.declination_deg = declination_deg;
    scene.camera.azimuth_deg = azimuth_deg;
    return total(exposed(scene, whole_picture(scene)), 0);
  };
  EXPECT_EQ(light(0.0, 0.0), 0.0);
  EXPECT_EQ(light(0.0, 180.0), 0.0);
  EXPECT_GT(light(180.0, 0.0), 0.0) << "the field that descends there is seen";
}

TEST(FilmFor, CoversTheRegionWithFourSigmaAround) {
  const Scene scene = tests::small_scene();
  const FilmGeometry film = film_for(scene, 20, 10, 100, 50, 4.0, 1.0);
  const double reach = 4.0 * 0.43 * 160 / 60.0;
  EXPECT_LE(film.x0_px, 20 - reach);
  EXPECT_LE(film.y0_px, 10 - reach);
  EXPECT_GE(film.x0_px + film.columns * 4.0, 120 + reach);
  EXPECT_GE(film.y0_px + film.rows, 60 + reach);
  EXPECT_EQ(std::remainder(20 - film.x0_px, 4.0), 0.0) << "the region begins with a cell";
}

}  // namespace
}  // namespace vegard::sim::film_test
