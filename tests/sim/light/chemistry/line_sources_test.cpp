#include "sim/light/chemistry/line_sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim::line_sources_test {
namespace {

constexpr double kCoarse = 0.4;  // of the energies, so that a test is quick: columns change by 0.3 %

AuroralRun run_of(double energy_kev, double flux_mw_m2 = 1.0, double oxygen = 1.0) {
  IncidentSpectrum spectrum;
  spectrum.energy_kev = energy_kev;
  const Degradation all = degradation(energy_grid(1e3 * highest_energy_kev(spectrum), kCoarse));
  return auroral_run(all, field_air(with_oxygen_factor(standard_air_table(), oxygen), 90.0, 0.5),
                     incident_flux(spectrum, all.grid, flux_mw_m2), PitchAngles::isotropic,
                     Reactions::standard());
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

// A step of precipitation: red after its own lifetime at each altitude, blue at once.
TEST(LineSources, SlowLinesComeLate) {
  const SourcedLine& red = line_of(usual_run(), "ver_6300");
  const SourcedLine later = after_seconds(red, 30.0);
  const std::vector<double> full = red.photons_cm3_s(), grown = later.photons_cm3_s();
  for (std::size_t m = 0; m < full.size(); ++m)
    EXPECT_NEAR(grown[m], full[m] * (1.0 - std::exp(-30.0 / red.lifetime_s[m])), 1e-9 * full[m]);
  const SourcedLine& blue = line_of(usual_run(), "ver_4278");
  EXPECT_EQ(after_seconds(blue, 0.001).photons_cm3_s(), blue.photons_cm3_s());
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
