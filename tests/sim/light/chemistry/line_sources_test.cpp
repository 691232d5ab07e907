#include "sim/light/chemistry/line_sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim::line_sources_test {
namespace {

constexpr double kCoarse = 0.4;  // of the energies, so that a test is quick: columns change by 0.3 %

AuroralRun run_of(double energy_kev, double flux_mw_m2 = 1.0, double oxygen = 1.0,
                  double seconds = std::numeric_limits<double>::infinity()) {
  IncidentSpectrum spectrum;
  spectrum.energy_kev = energy_kev;
  const Degradation all = degradation(energy_grid(1e3 * highest_energy_kev(spectrum), kCoarse));
  return auroral_run(all, field_air(with_oxygen_factor(standard_air_table(), oxygen), 90.0, 0.5),
                     incident_flux(spectrum, all.grid, flux_mw_m2), PitchAngles::isotropic,
                     Reactions::standard(), seconds);
}

const SourcedLine& line_of(const AuroralRun& run, const std::string& column) {
  for (const SourcedLine& line : run.light.lines)
    if (line.column == column) return line;
  throw std::runtime_error("no line " + column);
}

double rayleigh_of(const AuroralRun& run, const std::string& column) {
  return column_rayleigh(run.column, line_of(run, column).photons_cm3_s());
}

const AuroralRun& usual_run() {
  static const AuroralRun run = run_of(2.0);
  return run;
}

// Borst and Zipf 1970, Phys. Rev. A 1, 834: 14.1 ion pairs of N2 for a photon of 391.4 nm, at energies of 0.1
// keV and above; 5 % are between this and what slower electrons, and the shells' dependence on energy, make
// of it.
TEST(LineSources, OneIonisationOfNitrogenInFourteenShines) {
  const AuroralRun& run = usual_run();
  const double pairs = 1e-6 * path_integral(run.column, run.rates.ion_pairs_cm3_s[0]);
  const double violet = rayleigh_of(run, "ver_4278") / Reactions::standard().value(Reaction::light_4278);
  EXPECT_NEAR(pairs / violet, 14.1, 0.05 * 14.1);
}

// Light of O(1D) is its density times A: the density times the losses is what is made.
TEST(LineSources, AtomsLiveAsLongAsTheBlurHasThem) {
  const AuroralRun& run = usual_run();
  const EmissionLine& red = *find_emission_line(630.0);
  for (std::size_t m = 0; m < run.column.size(); ++m) {
    if (run.column.altitude_km[m] > 160.0) break;  // above, light counts: 110 s there, 117 s here
    EXPECT_NEAR(line_of(run, "ver_6300").lifetime_s[m] /
                    effective_lifetime_s(red, standard_air(run.column.altitude_km[m])),
                1.0, 0.02)
        << run.column.altitude_km[m];
  }
}

/// The light of one source of a line.
const std::vector<double>& light_by(const AuroralRun& run, const std::string& column,
                                    const std::string& name) {
  for (const LineSource& source : line_of(run, column).sources)
    if (source.name == name) return source.photons_cm3_s;
  throw std::runtime_error("no source " + name);
}

// Atoms that electrons excite from the onset on shine as A P tau (1 - exp(-t/tau)), tau by altitude. Those of
// O(1D) are also lost to thermal electrons, which become more: 1 % where they count.
TEST(LineSources, SlowLinesComeLate) {
  constexpr double kSeconds = 30.0;
  const AuroralRun run = run_of(0.5, 1.0, 1.0, kSeconds);
  const auto expect_grown = [&](const char* column, const char* state, Reaction light, double tolerance) {
    const std::vector<double>&shines = light_by(run, column, "O + e"),
          &lives = line_of(run, column).lifetime_s;
    const auto& excitations = gas_collisions(Gas::o).excitations;
    const auto found = std::find_if(excitations.begin(), excitations.end(),
                                    [&](const auto& excitation) { return excitation.name == state; });
    ASSERT_NE(found, excitations.end());
    const std::vector<double>& made =
        run.rates.excitation_cm3_s[static_cast<std::size_t>(Gas::o)]
                                  [static_cast<std::size_t>(found - excitations.begin())];
    const double by_light = Reactions::standard().value(light);
    for (std::size_t m = 0; m < shines.size(); ++m) {
      const double grown = by_light * made[m] * lives[m] * -std::expm1(-kSeconds / lives[m]);
      EXPECT_NEAR(shines[m], grown, tolerance * grown) << column << " at " << run.column.altitude_km[m];
    }
  };
  expect_grown("ver_5577", "O 1S", Reaction::o1s_5577, 1e-9);
  expect_grown("ver_6300", "O 1D", Reaction::o1d_6300, 0.01);
}

// N(2D) and what it makes come last: at 200 km it lives for some minutes.
TEST(LineSources, HoursAreASteadyState) {
  const AuroralRun steady = run_of(1.0), hours = run_of(1.0, 1.0, 1.0, 1e6);
  for (const char* slow : {"ver_5200", "ver_5577", "ver_6300"})
    EXPECT_NEAR(rayleigh_of(hours, slow) / rayleigh_of(steady, slow), 1.0, 0.01) << slow;
}

TEST(LineSources, LightGoesWithTheFluxWhereChemistryIsLinear) {
  const AuroralRun once = run_of(1.0, 0.5), twice = run_of(1.0, 1.0);
  for (const char* prompt : {"ver_3371", "ver_4278", "ver_7774", "ver_8446"})
    EXPECT_NEAR(rayleigh_of(twice, prompt) / rayleigh_of(once, prompt), 2.0, 0.02) << prompt;
  EXPECT_NEAR(rayleigh_of(twice, "ver_5577") / rayleigh_of(once, "ver_5577"), 2.0, 0.2);
}

// What the methods by ratios of columns rest on: atomic oxygen against nitrogen (Hecht et al. 1989, J.
// Geophys. Res. 94, 13541).
TEST(LineSources, MoreAtomicOxygenGivesMoreOfItsLight) {
  const AuroralRun less = run_of(1.0, 1.0, 0.5), more = run_of(1.0, 1.0, 2.0);
  EXPECT_GT(rayleigh_of(more, "ver_7774"), 1.5 * rayleigh_of(less, "ver_7774"));
  EXPECT_GT(rayleigh_of(more, "ver_5577"), 1.3 * rayleigh_of(less, "ver_5577"));
  EXPECT_LT(rayleigh_of(more, "ver_4278"), rayleigh_of(less, "ver_4278"));
}

TEST(LineSources, EnergyIsBalancedWithThermalElectronsToo) {
  const AuroralRun run = run_of(0.3);
  EXPECT_NEAR(run.rates.budget.missing_share(), 0.0, 0.01);
  EXPECT_GT(run.rates.budget.heating_ev, 0.01 * run.rates.budget.incident_ev);
}

// 3.37e-12 (1e5)^0.97 3^-0.94 ((3 - 0.1)/(3 - 0.053))^2.36, kT of 1160.45 K being 0.1 eV.
TEST(LineSources, ThermalElectronsSlowOthersAsPublished) {
  EXPECT_NEAR(loss_to_electrons_ev_cm(3.0, 1e5, 1160.451812) / 8.17e-8, 1.0, 0.01);
  EXPECT_EQ(loss_to_electrons_ev_cm(0.09, 1e5, 1160.451812), 0.0);
}

// A column along a slanted field is as bright seen vertically as its altitudes are thick.
TEST(LineSources, ColumnsAreOfTheAltitude) {
  FieldAir column = field_air(standard_air_table(), 60.0);
  const std::vector<double> rate(column.size(), 100.0);
  EXPECT_NEAR(column_rayleigh(column, rate), 1e-6 * 100.0 * 560e5, 1e-6);
}

}  // namespace
}  // namespace vegard::sim::line_sources_test
