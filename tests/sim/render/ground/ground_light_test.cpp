#include "sim/render/ground/ground_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/number/random.h"
#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/render/ground/ground_grid.h"
#include "sim/render/ground/ground_rates.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::sim::ground_light_test {
namespace {

const std::vector<double> kEnergies = {0.8, 2.0, 5.0};

Scene looking_up() {
  Scene scene = parse_scene(
      "[site]\nlatitude_deg = 67.0\n[field]\ninclination_deg = 90.0\n[camera]\nwidth = 40\nheight = "
      "30\nhfov_deg = 8\n"
      "elevation_deg = 90\n",
      "scene");
  scene.emission.flux_law = FluxLaw::linear;
  return scene;
}

Scene looking_north() {
  Scene scene = parse_scene(
      "[site]\nlatitude_deg = 67.0\naltitude_m = 500\n[field]\nmodel = \"dipole\"\n[camera]\nwidth = "
      "48\nheight = 36\n"
      "hfov_deg = 60\nelevation_deg = 30\n[air]\nmodel = \"standard\"\n",
      "scene");
  scene.emission.flux_law = FluxLaw::linear;
  return scene;
}

FilmGeometry film_of(const Scene& scene) {
  return {0.0, 0.0, 1.0, 1.0, scene.camera.width, scene.camera.height};
}

GroundLight light_of(const Scene& scene, const GroundGrid& grid, int threads = 1,
                     const ElectronSpectrum& spectrum = {}) {
  const FilmGeometry film = film_of(scene);
  const std::vector<std::uint8_t> wanted(static_cast<std::size_t>(film.rows) * film.columns, 1);
  return GroundLight(scene, scene.site, grid, film, wanted, kEnergies, 1.0, threads, 1.0, spectrum);
}

std::vector<float> random_numbers(std::size_t count, std::uint32_t which) {
  std::vector<float> numbers;
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(static_cast<float>(
        uniform(random_words(7, Stream::search, static_cast<std::uint32_t>(i), which)[0])));
  return numbers;
}

TEST(GroundLight, IsTheAdjointOfItsAdjoint) {
  // Seed 7. Sums of floats of one sign, some 10^5 of them in shares: 2e-5 is far above their rounding, and
  // any stretch that one side counts otherwise than the other is a share of about 1e-3 of a ray.
  const Scene scene = looking_north();
  const GroundGrid grid(rings_resolved(0.02, 4.0, 500.0));
  const GroundLight light = light_of(scene, grid);
  const std::vector<float> x = random_numbers(light.numbers(), 1), y = random_numbers(light.rays() * 3, 2);
  std::vector<float> forward, back(light.numbers(), 0.0f);
  light.forward(x, forward);
  light.add_adjoint(y, back);
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) left += static_cast<double>(forward[i]) * y[i];
  for (std::size_t i = 0; i < x.size(); ++i) right += static_cast<double>(x[i]) * back[i];
  EXPECT_GT(left, 0.0);
  EXPECT_NEAR(left, right, 2e-5 * left);
}

TEST(GroundLight, HasTheColumnOfTheTablesStraightUp) {
  // An even map seen along vertical field lines is the column of the profile. Stretches are rounded to 1/256
  // km with the remainder handed on, bins hold means: 0.1 % is left for the last of both.
  const Scene scene = looking_up();
  const GroundGrid grid(SquareCells{-200.0, -200.0, 5.0, 80, 80});
  using Kind = ElectronSpectrum::Kind;
  for (const Kind kind : {Kind::maxwellian, Kind::mono, Kind::gaussian, Kind::kappa}) {
    ElectronSpectrum spectrum;
    spectrum.kind = kind;
    const GroundLight light = light_of(scene, grid, 1, spectrum);
    for (std::size_t e = 0; e < kEnergies.size(); ++e) {
      std::vector<float> map(light.numbers(), 0.0f), rayleighs;
      for (std::size_t i = e; i < map.size(); i += kGroundEnergies) map[i] = 1.0f;
      light.forward(map, rayleighs);
      const HeightProfile profile =
          electron_profile(emission_source(scene), scene.emission.lines, spectrum, kEnergies[e]);
      const std::size_t middle = (15 * 40 + 20) * 3;
      for (int line = 0; line < 3; ++line) {
        const double column = column_below(profile, line, HeightProfile::kTopKm).rayleigh;
        EXPECT_NEAR(rayleighs[middle + line], column, 1e-3 * column)
            << spectrum_word(kind) << ", " << kEnergies[e] << " keV, line " << line;
      }
    }
  }
}

TEST(GroundLight, OfOneCellIsWhatAFineMarchFinds) {
  // Steps of 0.05 km along each ray, with the profile's own rows in place of bins: the sum over the film
  // agrees to 2 %, what the bins' middles and the cell's edge leave.
  Scene scene = looking_up();
  scene.camera.elevation_deg = 35.0;
  scene.camera.hfov_deg = 50.0;
  const GroundGrid grid(SquareCells{-300.0, 0.0, 10.0, 60, 40});
  const GroundLight light = light_of(scene, grid);
  const int cell = grid.cell_at(5.0, 185.0);
  ASSERT_GE(cell, 0);
  std::vector<float> map(light.numbers(), 0.0f), rayleighs;
  map[static_cast<std::size_t>(cell) * kGroundEnergies + 1] = 1.0f;
  light.forward(map, rayleighs);
  const HeightProfile profile =
      maxwellian_profile(emission_source(scene), scene.emission.lines, kEnergies[1]);
  const CameraView<double> view = camera_view(scene.camera);
  double sum = 0.0, expected = 0.0;
  for (int row = 0; row < scene.camera.height; ++row)
    for (int column = 0; column < scene.camera.width; ++column) {
      double enu[3];
      ASSERT_TRUE(enu_of_pixel(view, column + 0.5, row + 0.5, enu));
      for (double s = 0.025; s < 900.0; s += 0.05) {
        const double p[3] = {s * enu[0], s * enu[1], s * enu[2] + kEarthRadiusKm};
        const double radius = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        const double altitude = radius - kEarthRadiusKm;
        if (altitude < 80.0 || altitude >= 640.0) continue;
        // The uniform field is vertical at the site: lines are parallel to its up.
        if (std::floor(p[0] / 10.0) != 0.0 || std::floor(p[1] / 10.0) != 18.0) continue;
        const int at = static_cast<int>((altitude - 80.0) / 0.25 + 0.5);
        expected += 0.1 * 0.05 * profile.rate[static_cast<std::size_t>(at) * profile.stride + 1];
      }
      sum += rayleighs[(static_cast<std::size_t>(row) * scene.camera.width + column) * 3 + 1];
    }
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(sum, expected, 0.02 * expected);
}

TEST(GroundLight, DoesNotDependOnThreads) {
  const Scene scene = looking_north();
  const GroundGrid grid(rings_resolved(0.02, 4.0, 500.0));
  const GroundLight one = light_of(scene, grid, 1), two = light_of(scene, grid, 2);
  const std::vector<float> x = random_numbers(one.numbers(), 3);
  std::vector<float> a, b, back_a(one.numbers(), 0.0f), back_b(one.numbers(), 0.0f);
  one.forward(x, a);
  two.forward(x, b);
  one.add_adjoint(a, back_a);
  two.add_adjoint(b, back_b);
  EXPECT_EQ(a, b);
  EXPECT_EQ(back_a, back_b);
}

TEST(GroundLight, LeavesOutCells) {
  const Scene scene = looking_north();
  const GroundGrid grid(rings_resolved(0.02, 4.0, 500.0));
  GroundLight light = light_of(scene, grid);
  const std::vector<float> x = random_numbers(light.numbers(), 4), y = random_numbers(light.rays() * 3, 5);
  std::vector<float> whole, part, of_kept, none = x, back(light.numbers(), 0.0f);
  std::vector<std::uint8_t> kept(static_cast<std::size_t>(grid.cells()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    kept[i / kGroundEnergies] = i / kGroundEnergies % 3 == 0 ? 1 : 0;
    if (kept[i / kGroundEnergies] == 0) none[i] = 0.0f;
  }
  light.forward(x, whole);
  light.forward(none, of_kept);
  light.keep(kept);
  light.forward(x, part);
  EXPECT_EQ(part, of_kept);  // what is 0 adds nothing to any sum
  light.add_adjoint(y, back);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < back.size(); ++i) {
    if (kept[i / kGroundEnergies] == 0) {
      ASSERT_EQ(back[i], 0.0f) << i;
    }
    lit += back[i] > 0.0f ? 1 : 0;
  }
  EXPECT_GT(lit, 100u);
  // What was left out before stays out.
  std::vector<float> fewer = none;
  std::vector<std::uint8_t> other(kept.size());
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    other[i / kGroundEnergies] = i / kGroundEnergies % 2 == 0 ? 1 : 0;
    if (other[i / kGroundEnergies] == 0) fewer[i] = 0.0f;
  }
  light.keep(other);
  light.forward(x, part);
  light.keep_all();
  light.forward(fewer, of_kept);
  EXPECT_EQ(part, of_kept);
  light.forward(x, part);
  EXPECT_EQ(part, whole);
}

TEST(GroundLight, WithOtherRatesIsOneMadeForThem) {
  Scene scene = looking_north();
  const GroundGrid grid(rings_resolved(0.02, 4.0, 500.0));
  GroundLight light = light_of(scene, grid);
  const std::vector<float> x = random_numbers(light.numbers(), 6);
  std::vector<float> before, after, made;
  light.forward(x, before);
  scene.emission.modes = {1.0, -0.5};
  const ElectronSpectrum gaussian{ElectronSpectrum::Kind::gaussian, 0.25, 5.0};
  light.set_rates(ground_rates(scene, kEnergies, 1.0, 1.0, gaussian));
  light.forward(x, after);
  light_of(scene, grid, 1, gaussian).forward(x, made);
  EXPECT_EQ(after, made);
  EXPECT_NE(after, before);
}

TEST(ModeRates, AreThoseOfTablesWithTheModes) {
  Scene scene = looking_north();
  const ModeRates rates(scene, kEnergies, 1.0, 1.0, {});
  ASSERT_EQ(rates.modes(), emission_tables(scene).modes().count());
  std::vector<double> modes(static_cast<std::size_t>(rates.modes()), 0.0);
  EXPECT_EQ(rates.at(modes), ground_rates(scene, kEnergies, 1.0, 1.0, {}));
  modes[0] = 1.2;
  modes[1] = -0.8;
  modes.back() = 0.5;
  scene.emission.modes = modes;
  const std::vector<float> linear = rates.at(modes), exact = ground_rates(scene, kEnergies, 1.0, 1.0, {});
  ASSERT_EQ(linear.size(), exact.size());
  // Means over bins of at most 8 km, and spectra of several energies, are exponentials' sums: second order in
  // what the modes change within a bin.
  double most = 0.0, moved = 0.0;
  const std::vector<float> base = rates.at(std::vector<double>(modes.size(), 0.0));
  for (const float rate : exact) most = std::max(most, static_cast<double>(rate));
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(linear[i], exact[i], 0.02 * exact[i] + 1e-6 * most) << i;
    moved = std::max(moved, std::abs(exact[i] - base[i]) / most);
  }
  EXPECT_GT(moved, 0.05);  // else there is nothing to tell
}

TEST(ModeRates, HaveTheDerivativesOfDifferences) {
  const ModeRates rates(looking_north(), kEnergies, 1.0, 1.0, {});
  const std::vector<double> modes(static_cast<std::size_t>(rates.modes()), 0.3);
  const std::vector<float> here = rates.at(modes), by = rates.by_mode(1, here);
  constexpr double kStep =
      0.05;  // of which the third order is 1e-4 of the first where a mode changes light by 2
  std::vector<double> ahead = modes, behind = modes;
  ahead[1] += kStep;
  behind[1] -= kStep;
  const std::vector<float> more = rates.at(ahead), less = rates.at(behind);
  double most = 0.0;
  for (const float rate : here) most = std::max(most, static_cast<double>(rate));
  for (std::size_t i = 0; i < here.size(); ++i)
    EXPECT_NEAR(by[i], (more[i] - less[i]) / (2.0 * kStep), 2e-3 * std::abs(by[i]) + 1e-5 * most) << i;
}

TEST(SightLines, LightOverAFootIsSeenWhereTheRayThroughItIs) {
  const Scene scene = looking_north();
  double x = 0.0, y = 0.0;
  ASSERT_TRUE(pixel_over_foot(scene, scene.site, {20.0, 200.0}, kFootAltitudeKm, x, y));
  // At the feet's own altitude the field does not matter: the direction of the foot itself.
  const double radius = kEarthRadiusKm + kFootAltitudeKm;
  const double up = std::sqrt(radius * radius - 20.0 * 20.0 - 200.0 * 200.0) - kEarthRadiusKm - 0.5;
  double px = 0.0, py = 0.0;
  const double enu[3] = {20.0, 200.0, up};
  ASSERT_TRUE(pixel_of_enu(camera_view(scene.camera), enu, px, py));
  EXPECT_NEAR(x, px, 1e-9);
  EXPECT_NEAR(y, py, 1e-9);
  EXPECT_FALSE(pixel_over_foot(scene, scene.site, {0.0, -200.0}, 105.0, x, y));  // behind the camera
}

TEST(GroundGrid, FindsEachCellByItsMiddle) {
  for (GroundGrid grid :
       {GroundGrid(rings_resolved(0.02, 2.0, 300.0)), GroundGrid(SquareCells{-50.0, 20.0, 3.0, 40, 30})}) {
    for (int c = 0; c < grid.cells(); ++c) {
      const EastNorth middle = grid.middle_km(c);
      ASSERT_EQ(grid.cell_at(middle.east, middle.north), c);
    }
    // Those that are kept keep their place and get new numbers.
    std::vector<bool> kept(grid.cells(), false);
    const EastNorth place = grid.middle_km(grid.cells() / 2);
    kept[grid.cells() / 2] = true;
    grid.keep(kept);
    ASSERT_EQ(grid.cells(), 1);
    EXPECT_EQ(grid.cell_at(place.east, place.north), 0);
    EXPECT_NEAR(grid.middle_km(0).east, place.east, 1e-12);
  }
}

TEST(GroundGrid, OfRingsCoversTheDisc) {
  const GroundGrid grid(rings_resolved(0.02, 2.0, 300.0));
  double area = 0.0, farthest = 0.0;
  for (int c = 0; c < grid.cells(); ++c) {
    area += grid.area_km2(c);
    const EastNorth m = grid.middle_km(c);
    farthest = std::max(farthest, std::hypot(m.east, m.north) + 0.5 * grid.depth_km(c));
  }
  EXPECT_NEAR(area, 3.141592653589793 * farthest * farthest, 1e-9 * area);
}

TEST(GroundGrid, KnowsItsNeighbours) {
  const GroundGrid grid(rings_resolved(0.02, 2.0, 100.0));
  const int cell = grid.cell_at(3.0, 60.0);
  int expected = 0;
  const EastNorth here = grid.middle_km(cell);
  for (int c = 0; c < grid.cells(); ++c) {
    const EastNorth m = grid.middle_km(c);
    expected += std::hypot(m.east - here.east, m.north - here.north) <= 9.0 ? 1 : 0;
  }
  EXPECT_EQ(static_cast<int>(grid.near(cell, 9.0).size()), expected);
}

}  // namespace
}  // namespace vegard::sim::ground_light_test
