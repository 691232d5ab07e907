// Light follows the electrons after the excited atoms' lifetimes (docs/physics.md rows B18 and B26).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/emit/aurora/motion.h"
#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/scene/lines/emission_lines.h"
#include "tests/support/exposed.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::lag_test {
namespace {

using tests::exposed;

double total(const Exposure& exposure, int line) {
  const auto first = exposure.rayleigh.begin() + static_cast<std::ptrdiff_t>(line * exposure.cells());
  return std::accumulate(first, first + static_cast<std::ptrdiff_t>(exposure.cells()), 0.0);
}

Scene without_lag(Scene scene) {
  scene.emission.lag = EmissionLag::none;
  return scene;
}

/// All light within a few kilometres of one altitude, where a line has one lifetime.
Scene thin_scene(double altitude_km) {
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  sheet.profile = ProfileKind::form;
  sheet.peak_km = altitude_km;
  sheet.lower_km = sheet.upper_km = 1.0;
  sheet.length_km = 60.0;
  sheet.beams = 1000;
  scene.substorm.quiet = scene.substorm.grown = 0.0;
  scene.substorm.onset_s = 0.0;
  scene.substorm.growth_s = scene.substorm.expansion_s = 1.0;
  scene.substorm.recovery_s = 1e6;
  return scene;
}

double lifetime_s(double line_nm, double altitude_km) {
  return effective_lifetime_s(*find_emission_line(line_nm), standard_air(altitude_km));
}

/// The past's level weighted with exponential decay, by Simpson's rule.
double lagging_level(const Substorm& substorm, double instant_s, double tau_s) {
  constexpr int kSteps = 20000;
  const double longest = 12.0 * tau_s + 10.0, step = longest / kSteps;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i)
    sum += (i == 0 || i == kSteps ? 1.0
            : i % 2 == 1          ? 4.0
                                  : 2.0) *
           substorm_level(substorm, instant_s - i * step) * std::exp(-i * step / tau_s);
  return sum * step / 3.0 / tau_s;
}

TEST(Lag, AStepOfPrecipitationRisesAsOneLessAnExponential) {
  // Within an interval of ages beams stand evenly in the logarithm where the light falls off exponentially:
  // that is off by 1.8 % of the step at most, at three lives and where an interval has two of them; worked
  // out for lifetimes from 0.3 to 100 s. Here it is less, and what a seventh of 1000 beams a layer do not
  // sample is beside it.
  for (const auto& [altitude_km, line, nm] :
       {std::tuple(250.0, 0, 630.0), std::tuple(200.0, 0, 630.0), std::tuple(150.0, 1, 557.7)}) {
    Scene scene = thin_scene(altitude_km);
    const double tau = lifetime_s(nm, altitude_km);
    scene.time.start_s = 1000.0;
    const double steady = total(exposed(without_lag(scene)), line);
    for (const double lives : {0.5, 1.0, 2.0, 4.0}) {
      SCOPED_TRACE(testing::Message()
                   << nm << " nm at " << altitude_km << " km after " << lives * tau << " s");
      scene.time.start_s = 0.5 + lives * tau;  // the step takes a second
      const double level = total(exposed(scene), line) / steady;
      EXPECT_NEAR(level, lagging_level(scene.substorm, scene.time.start_s, tau), 0.02);
      if (tau > 5.0) {
        EXPECT_NEAR(level, 1.0 - std::exp(-lives), 0.02);
      }
    }
  }
}

TEST(Lag, MovesLightInTimeAndKeepsItsTotal) {
  // A second's pulse seen until 250 s later, some eight lifetimes.
  Scene scene = thin_scene(250.0);
  scene.substorm.recovery_s = 1.0;
  scene.sheets[0].beams = 150;
  scene.sheets[0].layers = 1;
  scene.time.start_s = -1.25;
  scene.time.exposure_s = 251.0;
  scene.time.instants = 251 * 2;
  const Exposure late = exposed(scene), prompt = exposed(without_lag(scene));
  // A seventh of the beams stand for all: their distances differ.
  for (int line = 0; line < 2; ++line)
    EXPECT_NEAR(total(late, line) / total(prompt, line), 1.0, 0.02) << line;
  EXPECT_EQ(total(late, 2), total(prompt, 2)) << "427.8 nm is prompt";
}

TEST(Lag, LeavesASteadyAuroraAsItIs) {
  Scene scene = tests::small_scene();
  scene.sheets[0].ray_contrast = 0.8;
  scene.sheets[0].fold_spacing_km = 25.0;
  scene.time.start_s = 12.0;
  EXPECT_EQ(exposed(scene).rayleigh, exposed(without_lag(scene)).rayleigh);
}

TEST(Lag, RedHardlyChangesWhereItFlickered) {
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  sheet.ray_contrast = 1.0;
  sheet.ray_width_km = 5.0;
  sheet.ray_lifetime_s = 0.5;
  sheet.beams = 1000;
  // Of a patch of the picture, within two seconds.
  const auto brightest_over_darkest = [](const Scene& of, int line, int last_row) {
    double least = 1e30, most = 0.0;
    for (int i = 0; i < 8; ++i) {
      Scene at = of;
      at.time.start_s = 0.25 * i;
      const Exposure exposure = exposed(at);
      double light = 0.0;
      for (int row = 0; row <= last_row; ++row)
        for (int column = 80; column < 90; ++column)
          light += exposure.rayleigh[line * exposure.cells() + row * exposure.geometry.columns + column];
      least = std::min(least, light);
      most = std::max(most, light);
    }
    return most / least;
  };
  const Scene prompt = without_lag(scene);
  // Above 53 degrees the sheet is higher than 250 km: 630.0 nm lives for 30 s and more there.
  constexpr int kHigh = 24, kAll = 119;
  EXPECT_GT(brightest_over_darkest(prompt, 0, kHigh), 2.0);
  EXPECT_LT(brightest_over_darkest(scene, 0, kHigh), 1.05);
  // Of green, with 0.7 s and rays of 0.5 s, some remains; blue is as it was.
  const double green = brightest_over_darkest(scene, 1, kAll);
  EXPECT_GT(green, 1.05);
  EXPECT_LT(green, 0.7 * brightest_over_darkest(prompt, 1, kAll));
  EXPECT_EQ(brightest_over_darkest(scene, 2, kAll), brightest_over_darkest(prompt, 2, kAll));
}

TEST(Lag, OfADriftingSheetLeavesRedBehindByItsLifetimesWay) {
  const auto mean_row = [](const Exposure& exposure, int line) {
    double sum = 0.0, rows = 0.0;
    for (std::size_t c = 0; c < exposure.cells(); ++c) {
      const double light = exposure.rayleigh[line * exposure.cells() + c];
      sum += light;
      rows += light * static_cast<double>(c / exposure.geometry.columns);
    }
    return rows / sum;
  };
  Scene scene = thin_scene(250.0);
  scene.substorm = {};
  const double here = mean_row(exposed(scene), 0);
  scene.sheets[0].drift_km_s = {0.0, -0.2};  // towards the observer, and up in the picture
  const double behind = mean_row(exposed(scene), 0) - here;
  EXPECT_EQ(mean_row(exposed(without_lag(scene)), 0), here) << "at the clock's zero it is where it is";
  scene.sheets[0].drift_km_s = {0.0, 0.0};
  scene.sheets[0].center_km.north += 0.2 * lifetime_s(630.0, 250.0);
  const double way = mean_row(exposed(scene), 0) - here;
  EXPECT_GT(way, 1.0);
  // Rows are not straight in the distance, and light that is far behind is fainter.
  EXPECT_NEAR(behind, way, 0.15 * way);
}

TEST(Lag, IsThatOfTheMeanOverAllDrawsToo) {
  Scene scene = tests::small_scene();
  scene.sheets[0].beams = 3000;
  scene.sheets[0].drift_km_s = {0.0, -0.3};
  scene.sheets[0].sine_speed_km_s = 2.0;
  const FilmGeometry film = tests::whole_picture(scene);
  BeamSampling sampling;
  sampling.mean = true;
  Exposure mean;
  make_exposer(scene, film, 0, 0.0, sampling)->expose(scene, mean);
  const Exposure drawn = exposed(scene), prompt = exposed(without_lag(scene));
  // Rows of the picture, in which draws differ by the noise of their beams: some hundred cross each.
  for (int line = 0; line < 3; ++line) {
    double error = 0.0, size = 0.0, lag = 0.0;
    for (int row = 0; row < film.rows; row += 10) {
      double a = 0.0, b = 0.0, c = 0.0;
      for (int cell = row * film.columns; cell < (row + 10) * film.columns; ++cell) {
        a += mean.rayleigh[line * mean.cells() + cell];
        b += drawn.rayleigh[line * mean.cells() + cell];
        c += prompt.rayleigh[line * mean.cells() + cell];
      }
      error += (a - b) * (a - b);
      lag += (c - b) * (c - b);
      size += b * b;
    }
    EXPECT_LT(std::sqrt(error / size), 0.02) << line;
    if (line == 0) {
      EXPECT_GT(std::sqrt(lag / size), 0.04) << "it lags";
    }
  }
}

TEST(Lag, GivesTheSameBytesForEveryNumberOfThreads) {
  Scene scene = tests::small_scene();
  scene.sheets[0].drift_km_s = {0.3, -0.5};
  scene.sheets[0].ray_contrast = 0.8;
  scene.sheets[0].ray_lifetime_s = 1.0;
  scene.sheets[0].curl_spacing_km = 6.0;
  scene.sheets[0].curl_lifetime_s = 0.5;
  const FilmGeometry film = tests::whole_picture(scene);
  Exposure one, four;
  make_exposer(scene, film, 1)->expose(scene, one);
  make_exposer(scene, film, 4)->expose(scene, four);
  EXPECT_EQ(one.rayleigh, four.rayleigh);
}

TEST(Lag, WorksWithThePhysicalBlurWhoseWindCarriesLightByItsAge) {
  Scene scene = tests::small_scene();
  scene.sheets[0].drift_km_s = {0.0, -0.01};
  scene.blur.model = BlurModel::physical;
  const Image still_air = render(scene, {}).rayleigh;
  scene.blur.wind_m_s = {200.0, 0.0};
  const Image windy = render(scene, {}).rayleigh;
  Scene steady = scene;
  steady.sheets[0].drift_km_s = {0.0, 0.0};
  const Image carried = render(steady, {}).rayleigh;
  const auto mean_column = [](const Image& image) {
    double sum = 0.0, columns = 0.0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        sum += image.at(x, y, 0);
        columns += static_cast<double>(image.at(x, y, 0)) * x;
      }
    return columns / sum;
  };
  const double way = mean_column(windy) - mean_column(still_air);
  EXPECT_GT(way, 0.2) << "to the east";
  EXPECT_NEAR(way, mean_column(carried) - mean_column(still_air), 0.25 * way) << "as far in the mean";
}

}  // namespace
}  // namespace vegard::sim::lag_test
