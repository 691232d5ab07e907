#include "sim/light/transport/electron_transport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vegard::sim::electron_transport_test {
namespace {

struct Descent {
  FieldAir column;
  EnergyGrid grid;
  ElectronRates rates;

  double peak_km() const {
    std::size_t best = 0;
    for (std::size_t m = 0; m < column.size(); ++m)
      if (rates.all_ion_pairs(m) > rates.all_ion_pairs(best)) best = m;
    return column.altitude_km[best];
  }
};

struct RunOptions {
  double places = 1.0, energies = 1.0, flux = 1.0;
  PitchAngles angles = PitchAngles::isotropic;
  int half_streams = 4;
  AirTable air = standard_air_table();
};

AirTable only(Gas gas) {
  AirTable air = standard_air_table();
  for (std::size_t a = 0; a < air.altitude_km.size(); ++a) {
    double all = 0.0;
    for (const auto& density : air.density_cm3) all += density[a];
    // A trace of the others is left, so that their scale heights are known.
    constexpr double kTrace = 1e-6;
    for (std::size_t g = 0; g < air.density_cm3.size(); ++g)
      air.density_cm3[g][a] = (g == static_cast<std::size_t>(gas) ? 1.0 : kTrace) * all;
  }
  return air;
}

Descent run_mono(double energy_kev, const RunOptions& options = {}) {
  IncidentSpectrum spectrum;
  spectrum.kind = SpectrumKind::mono;
  spectrum.energy_kev = energy_kev;
  const Degradation all = degradation(energy_grid(1e3 * energy_kev, options.energies));
  Descent run;
  run.column = field_air(options.air, 90.0, options.places);
  run.grid = all.grid;
  TransportOptions transport;
  transport.half_streams = options.half_streams;
  run.rates = electron_transport(all, run.column, incident_flux(spectrum, all.grid, options.flux),
                                 options.angles, transport);
  return run;
}

TEST(ElectronTransport, LosesNoEnergy) {
  for (const double energy : {0.2, 5.0, 20.0}) {
    const Descent run = run_mono(energy);
    EXPECT_NEAR(run.rates.budget.missing_share(), 0.0, 0.01) << energy;
    EXPECT_NEAR(path_integral(run.column, run.rates.deposited_ev_cm3_s) / run.rates.budget.deposited_ev(),
                1.0, 0.001);
  }
}

TEST(ElectronTransport, ErrorsOfTheGridsFallWithTheirSteps) {
  RunOptions coarse, fine_energies, fine_angles;
  coarse.places = fine_energies.places = fine_angles.places = 0.4;
  fine_energies.energies = 2.0;
  fine_angles.half_streams = 8;
  const Descent first = run_mono(3.0, coarse), places = run_mono(3.0),
                energies = run_mono(3.0, fine_energies), angles = run_mono(3.0, fine_angles);
  const double pairs = first.rates.budget.ion_pairs;
  EXPECT_LT(std::abs(places.rates.budget.missing_share()),
            0.4 * std::abs(first.rates.budget.missing_share()));
  EXPECT_NEAR(places.rates.budget.ion_pairs / pairs, 1.0, 0.02);
  EXPECT_NEAR(energies.rates.budget.ion_pairs / pairs, 1.0, 0.01);
  EXPECT_NEAR(angles.rates.budget.ion_pairs / pairs, 1.0, 0.01);
  for (const Descent* run : {&places, &energies, &angles}) EXPECT_NEAR(run->peak_km(), first.peak_km(), 0.8);
}

TEST(ElectronTransport, IsLinearInTheFlux) {
  RunOptions ten;
  ten.flux = 10.0;
  ten.places = 0.4;
  RunOptions one = ten;
  one.flux = 1.0;
  const Descent strong = run_mono(1.0, ten), weak = run_mono(1.0, one);
  for (std::size_t m = 0; m < weak.column.size(); m += 10)
    EXPECT_NEAR(strong.rates.all_ion_pairs(m), 10.0 * weak.rates.all_ion_pairs(m),
                1e-9 * strong.rates.all_ion_pairs(m));
}

TEST(ElectronTransport, PassesWhereThereIsNoAir) {
  AirTable nothing = standard_air_table();
  for (auto& gas : nothing.density_cm3)
    for (double& density : gas) density *= 1e-14;
  const Degradation all = degradation(energy_grid(2000.0));
  const FieldAir column = field_air(nothing, 70.0, 0.4);
  IncidentSpectrum spectrum;
  spectrum.energy_kev = 0.2;
  const std::vector<double> flux = incident_flux(spectrum, all.grid, 1.0);
  for (const PitchAngles angles : {PitchAngles::isotropic, PitchAngles::field_aligned}) {
    const ElectronBudget budget = electron_transport(all, column, flux, angles).budget;
    EXPECT_NEAR(budget.through_ev / budget.incident_ev, 1.0, 1e-4);
    EXPECT_LT(budget.back_ev / budget.incident_ev, 1e-4);
  }
}

TEST(ElectronTransport, SpendsOnAnIonPairWhatIsMeasured) {
  // Dry air takes 33.97 eV (ICRU Report 31); above 100 km there is atomic oxygen, which takes less.
  EXPECT_NEAR(run_mono(10.0).rates.budget.ev_per_ion_pair(), 33.97, 0.02 * 33.97);
  // Nitrogen takes 34.8 eV (ICRU Report 31).
  RunOptions nitrogen;
  nitrogen.places = 0.4;
  nitrogen.air = only(Gas::n2);
  EXPECT_NEAR(run_mono(10.0, nitrogen).rates.budget.ev_per_ion_pair(), 34.8, 0.02 * 34.8);
}

TEST(ElectronTransport, SendsBackWhatOthersFind) {
  // Isotropic electrons of some keV: 15 to 20 % of their energy (Banks, Chappell and Nagy 1974, J. Geophys.
  // Res. 79, 1459), those along the field less.
  RunOptions aligned;
  aligned.places = 0.4;
  aligned.angles = PitchAngles::field_aligned;
  RunOptions isotropic = aligned;
  isotropic.angles = PitchAngles::isotropic;
  const ElectronBudget from_all = run_mono(5.0, isotropic).rates.budget,
                       along = run_mono(5.0, aligned).rates.budget;
  EXPECT_GT(from_all.back_ev / from_all.incident_ev, 0.14);
  EXPECT_LT(from_all.back_ev / from_all.incident_ev, 0.20);
  EXPECT_LT(along.back_ev / along.incident_ev, 0.6 * from_all.back_ev / from_all.incident_ev);
}

TEST(ElectronTransport, IonisesWhereFangsFormulaHasIt) {
  for (const double energy : {5.0, 10.0, 20.0}) {
    const Descent run = run_mono(energy);
    std::vector<double> fang;
    for (std::size_t m = 0; m < run.column.size(); ++m)
      fang.push_back(std::exp(log_ionisation(stopping_air(run.column, m), energy).value));
    const auto highest = static_cast<std::size_t>(std::max_element(fang.begin(), fang.end()) - fang.begin());
    EXPECT_NEAR(run.peak_km(), run.column.altitude_km[highest], 2.0) << energy;
    // Fang's pairs are made of all the energy, at 35 eV; here some comes back, and a pair takes what is
    // measured.
    const ElectronBudget& budget = run.rates.budget;
    const double expected = (1.0 - budget.back_ev / budget.incident_ev) * 35.0 / budget.ev_per_ion_pair();
    EXPECT_NEAR(budget.ion_pairs / path_integral(run.column, fang) / expected, 1.0, 0.03) << energy;
    // How sharp the layer is: its peak over its column.
    double most = 0.0;
    for (std::size_t m = 0; m < run.column.size(); ++m) most = std::max(most, run.rates.all_ion_pairs(m));
    const double sharpness = most / run.rates.budget.ion_pairs,
                 of_fang = fang[highest] / path_integral(run.column, fang);
    EXPECT_NEAR(sharpness / of_fang, 1.0, 0.06) << energy;
  }
}

}  // namespace
}  // namespace vegard::sim::electron_transport_test
