#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "march_case.h"
#include "sim/emit/footprint/footprint_emitter.h"
#include "sim/light/profile_table.h"
#include "tests/sim/light/made_tables.h"

namespace vegard::sim::footprint_derivatives_test {
namespace {

using namespace march_case;

/// An arc whose flux and place depend on x: tangents are with respect to it.
template <class T>
PlaneFootprint<T> arc_at(const T& north_km, const T& flux, const T& ln_energy) {
  PlaneFootprint<T> map;
  map.west_km = map.south_km = -200.0;
  map.cell_km = 2.0;
  map.grid.columns = map.grid.rows = 200;
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 200; ++column) {
      const T off = (T(-199.0 + 2.0 * row) - north_km) * (1.0 / 12.0);
      map.grid.flux_mw_m2.push_back(flux * exponential(off * off * -0.5) *
                                    (1.0 + 0.3 * std::sin(0.05 * column)));
      map.grid.ln_energy.push_back(ln_energy * (column * 0.01));
    }
  return map;
}

struct Numbers {
  double north_km = 60.0, flux = 5.0, ln_energy = 0.3, inclination_deg = 77.0, energy_kev = 3.0;
  double elevation_deg = 40.0;
  double oxygen = 0.0;  ///< above 0: the factor, of tables that have several
};

/// The light of a few rays for T, where `with` gives a number as T.
template <class T>
std::vector<T> light_of(const Numbers& n, const std::function<T(double, int)>& with,
                        const ProfileTable* given = nullptr) {
  Scene scene = scene_at(0.0, "box", "field");
  Footprint& f = scene.footprints[0];
  f.energy_flux_mw_m2 = n.flux;
  f.energy_kev = n.energy_kev;
  scene.field.inclination_deg = n.inclination_deg;
  scene.march.step_km = 4.0;
  if (n.oxygen > 0.0) {
    tests::give_tables_with_oxygen(scene);
    scene.emission.oxygen_factor = n.oxygen;
  }
  const NumberAs<T> number = [&](const double& x) {
    if (&x == &scene.field.inclination_deg) return with(x, 3);
    if (&x == &f.energy_kev) return with(x, 4);
    if (&x == &f.energy_flux_mw_m2) return with(x, 1);
    if (&x == &scene.emission.oxygen_factor) return with(x, 6);
    return T(x);
  };
  const ProfileTable profiles =
      given != nullptr ? *given : profile_table(scene.emission.lines, scene, f, 0.0, 0.7);
  const ProfileChanges changes = profile_changes(scene.emission.lines, scene, f, profiles);
  const auto emitter =
      plane_footprint_emitter<T>(scene, f, arc_at(with(n.north_km, 0), with(n.flux, 1), with(n.ln_energy, 2)),
                                 profiles, changes, number, 1, MarchBy::reference);
  std::vector<T> direction[3], rayleigh(3 * 4, T(0.0)), kept(3 * 4, T(1.0));
  std::vector<double> end(4, kInfinity), entry(4, kInfinity), depth(4, kInfinity);
  for (int i = 0; i < 4; ++i) {
    const T e = (with(n.elevation_deg, 5) + 9.0 * i) * 0.017453292519943295;
    direction[0].push_back(cosine(e) * std::sin(0.2 * i));
    direction[1].push_back(cosine(e) * std::cos(0.2 * i));
    direction[2].push_back(sine(e));
  }
  emitter->march({4, {direction[0].data(), direction[1].data(), direction[2].data()}, end.data()},
                 {3, rayleigh.data(), kept.data(), entry.data(), depth.data()});
  return rayleigh;
}

TEST(FootprintDerivatives, AreThoseOfDifferences) {
  const Numbers numbers;
  const std::vector<FreeDual> dual = light_of<FreeDual>(numbers, [](double x, int which) {
    FreeDual d(x);
    d.d.t[which] = 1.0;
    return d;
  });
  const auto plain = [](const Numbers& n) { return light_of<double>(n, [](double x, int) { return x; }); };
  const std::vector<double> here = plain(numbers);
  const auto check = [&](int which, double Numbers::*number, double step, double tolerance) {
    Numbers less = numbers, more = numbers;
    less.*number -= step;
    more.*number += step;
    const std::vector<double> low = plain(less), high = plain(more);
    double most = 0.0;
    for (const FreeDual& d : dual) most = std::max(most, std::abs(d.d.t[which]));
    ASSERT_GT(most, 0.0);
    for (std::size_t i = 0; i < dual.size(); ++i)
      EXPECT_NEAR(dual[i].d.t[which], (high[i] - low[i]) / (2.0 * step), tolerance * most)
          << which << " " << i;
  };
  for (std::size_t i = 0; i < dual.size(); ++i) EXPECT_NEAR(dual[i].v, here[i], 1e-9 * here[i]);
  // The bilinear footprint and the rows of the profile have kinks, which a difference may straddle.
  check(0, &Numbers::north_km, 1e-4, 1e-6);
  check(1, &Numbers::flux, 1e-3, 2e-3);  // the profile's table is in floats
  check(3, &Numbers::inclination_deg, 1e-5, 1e-3);
  check(4, &Numbers::energy_kev, 1e-3, 2e-3);
  check(5, &Numbers::elevation_deg, 1e-5, 1e-3);
}

TEST(FootprintDerivatives, ByTheTablesOxygenAreThoseOfDifferences) {
  Numbers numbers;
  numbers.oxygen = 1.3;
  const std::vector<FreeDual> dual = light_of<FreeDual>(numbers, [](double x, int which) {
    FreeDual d(x);
    if (which == 6) d.d.t[6] = 1.0;
    return d;
  });
  const auto at = [&](double oxygen) {
    Numbers there = numbers;
    there.oxygen = oxygen;
    return light_of<double>(there, [](double x, int) { return x; });
  };
  constexpr double kStep = 1e-2;
  const std::vector<double> low = at(numbers.oxygen - kStep), high = at(numbers.oxygen + kStep);
  double most = 0.0;
  for (const FreeDual& d : dual) most = std::max(most, std::abs(d.d.t[6]));
  ASSERT_GT(most, 0.0);
  for (std::size_t i = 0; i < dual.size(); ++i)
    EXPECT_NEAR(dual[i].d.t[6], (high[i] - low[i]) / (2.0 * kStep), 1e-3 * most) << i;
}

// The tangents go by the slopes of the profiles, and light is linear between the rungs of their ladder: a
// difference sees chords, and the nearer the rungs stand the less they miss.
TEST(FootprintDerivatives, ByTheEnergyOfAMapAreThoseOfDifferences) {
  const Scene scene = scene_at(0.0, "box", "field");
  ProfileTable fine;
  fine.ln_step = 0.005;
  for (int i = 0; i <= 130; ++i)
    fine.of_energy.push_back(
        profile_table(scene.emission.lines, scene, scene.footprints[0], i * fine.ln_step, i * fine.ln_step)
            .of_energy.back());
  const Numbers numbers;
  const std::vector<FreeDual> dual = light_of<FreeDual>(
      numbers,
      [](double x, int which) {
        FreeDual d(x);
        if (which == 2) d.d.t[2] = 1.0;
        return d;
      },
      &fine);
  constexpr double kStep = 0.01;
  const auto moved = [&](double by) {
    Numbers there = numbers;
    there.ln_energy += by;
    return light_of<double>(
        there, [](double x, int) { return x; }, &fine);
  };
  const std::vector<double> low = moved(-kStep), high = moved(kStep);
  double most = 0.0;
  for (const FreeDual& d : dual) most = std::max(most, std::abs(d.d.t[2]));
  ASSERT_GT(most, 0.0);
  for (std::size_t i = 0; i < dual.size(); ++i)
    EXPECT_NEAR(dual[i].d.t[2], (high[i] - low[i]) / (2.0 * kStep), 1e-3 * most) << i;
}

}  // namespace
}  // namespace vegard::sim::footprint_derivatives_test
