// Sheets whose course is a curve, on the film: against a straight sheet, and with energies along them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/film.h"
#include "tests/support/exposed.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::curve_on_film_test {
namespace {

/// A straight sheet; its sine is too small to be seen.
Scene straight() {
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  sheet.thickness_km = 0.01;
  sheet.wavelength_km = 5000.0;
  sheet.phase_rad = 0.0;
  sheet.phase_shift_rad = 0.0;
  sheet.length_km = 220.0;
  return scene;
}

/// The same through points on its line.
Scene curved() {
  Scene scene = straight();
  Sheet& sheet = scene.sheets[0];
  const double bearing = sheet.bearing_deg * kRadiansPerDegree;
  sheet.course = SheetCourse::curve;
  for (const double t : {-110.0, -60.0, 15.0, 110.0}) {
    sheet.east_km.push_back(sheet.center_km.east + t * std::sin(bearing));
    sheet.north_km.push_back(sheet.center_km.north + t * std::cos(bearing));
  }
  return scene;
}

std::vector<float> film_of(const Scene& scene, int threads = 2) {
  BeamExposer exposer(scene, tests::whole_picture(scene), threads);
  Exposure exposure;
  exposer.expose(scene, exposure);
  return {exposure.rayleigh.begin(), exposure.rayleigh.end()};
}

/// Root mean square of the difference over that of the first.
double relative_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * static_cast<double>(a[i] - b[i]);
    size += a[i] * static_cast<double>(a[i]);
  }
  return std::sqrt(difference / size);
}

TEST(CurveOnFilm, AStraightOneIsTheStraightSheet) {
  // The same beams with the same random numbers, but for the sine's ten metres.
  EXPECT_LT(relative_difference(film_of(straight()), film_of(curved())), 0.01);
}

TEST(CurveOnFilm, OfEvenNumbersAtItsPointsIsThatOfTheSheetsOwn) {
  const std::vector<float> wanted = film_of(curved());
  Scene scene = curved();
  Sheet& sheet = scene.sheets[0];
  sheet.point_brightness = {1.0, 1.0, 1.0, 1.0};
  sheet.point_width_km.assign(4, sheet.width_km);
  EXPECT_LT(relative_difference(wanted, film_of(scene)), 1e-6);
  sheet.point_energy_kev.assign(4, sheet.energy_kev);
  // Two profiles 0.04 apart in ln E stand for the one between them.
  EXPECT_LT(relative_difference(wanted, film_of(scene)), 0.002);
}

TEST(CurveOnFilm, EachEnergyHasItsPlace) {
  Scene scene = curved();
  scene.sheets[0].point_energy_kev = {2.0, 2.0, 2.0, 6.0};
  Scene soft = curved(), hard = curved();
  soft.sheets[0].energy_kev = 2.0;
  hard.sheets[0].energy_kev = 6.0;
  const FilmGeometry film = tests::whole_picture(scene);
  const std::vector<float> mixed = film_of(scene), of_soft = film_of(soft), of_hard = film_of(hard);
  // Columns a tenth of the way in from either end; the sheet runs from left to right.
  const auto column = [&](const std::vector<float>& light, int c) {
    std::vector<float> numbers;
    for (int row = 0; row < film.rows; ++row)
      for (int k = -3; k <= 3; ++k)
        numbers.push_back(light[static_cast<std::size_t>(film.columns) * film.rows +
                                static_cast<std::size_t>(row) * film.columns + c + k]);
    return numbers;
  };
  int left = 0, right = 0;
  for (int c = film.columns / 10; c < film.columns - film.columns / 10; ++c) {
    double light = 0.0;
    for (const float number : column(of_soft, c)) light += number;
    if (light <= 0.0) continue;
    if (left == 0) left = c + 8;
    right = c - 8;
  }
  ASSERT_GT(right, left + 40);
  EXPECT_LT(relative_difference(column(of_soft, left), column(mixed, left)), 0.02);
  EXPECT_GT(relative_difference(column(of_hard, left), column(mixed, left)), 0.3);
  EXPECT_LT(relative_difference(column(of_hard, right), column(mixed, right)),
            relative_difference(column(of_soft, right), column(mixed, right)));
}

TEST(CurveOnFilm, IsTheSameForAnyNumberOfThreads) {
  Scene scene = curved();
  scene.sheets[0].point_energy_kev = {2.0, 3.0, 5.0, 6.0};
  scene.sheets[0].north_km[1] += 20.0;
  EXPECT_EQ(film_of(scene, 1), film_of(scene, 3));
}

}  // namespace
}  // namespace vegard::sim::curve_on_film_test
