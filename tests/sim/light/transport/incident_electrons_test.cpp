#include "sim/light/transport/incident_electrons.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.h"

namespace vegard::sim::incident_electrons_test {
namespace {

struct Case {
  IncidentSpectrum spectrum;
  double mean_kev;
};

TEST(IncidentElectrons, HaveTheirEnergyFluxAndMeanEnergy) {
  Case mono{{}, 5.0}, gaussian{{}, 5.0}, maxwellian{{}, 10.0}, kappa{{}, 0.0}, accelerated{{}, 0.0},
      table{{}, 2.0};
  mono.spectrum.kind = SpectrumKind::mono;
  gaussian.spectrum.kind = SpectrumKind::gaussian;
  kappa.spectrum.kind = SpectrumKind::kappa;
  kappa.spectrum.kappa = 8.0;
  accelerated.spectrum.kind = SpectrumKind::accelerated;
  accelerated.spectrum.potential_kev = 3.0;
  for (Case* c : {&mono, &gaussian, &maxwellian, &kappa, &accelerated}) c->spectrum.energy_kev = 5.0;
  kappa.spectrum.energy_kev = 1.0;
  kappa.mean_kev = 2.0 * 8.0 / 6.0;
  accelerated.spectrum.energy_kev = 1.0;
  // Of (x + V) exp(-x): the mean of x + V is (2 + 2 V + V^2)/(1 + V).
  accelerated.mean_kev = (2.0 + 2.0 * 3.0 + 9.0) / 4.0;
  table.spectrum.kind = SpectrumKind::table;
  table.spectrum.table_energy_kev = {1.0, 3.0};
  table.spectrum.table_flux = {1.0, 1.0};
  for (const Case* c : {&mono, &gaussian, &maxwellian, &kappa, &accelerated, &table}) {
    const EnergyGrid grid = energy_grid(1e3 * highest_energy_kev(c->spectrum));
    const std::vector<double> flux = incident_flux(c->spectrum, grid, 2.0);
    double energy = 0.0;
    for (std::size_t i = 0; i < grid.size(); ++i) energy += flux[i] * grid.energy_ev[i];
    EXPECT_NEAR(energy / (2.0 * kEvPerErg), 1.0, 1e-12);
    // The grid's steps, and for kappa the tail that is cut.
    EXPECT_NEAR(1e-3 * mean_energy_ev(grid, flux) / c->mean_kev, 1.0, 0.01)
        << static_cast<int>(c->spectrum.kind);
  }
}

TEST(IncidentElectrons, ThatFallBetweenTheGridsEnergiesAreRefused) {
  IncidentSpectrum narrow;
  narrow.kind = SpectrumKind::table;
  narrow.table_energy_kev = {5.0, 5.00001, 5.00002};
  narrow.table_flux = {0.0, 1.0, 0.0};
  const EnergyGrid grid = energy_grid(5100.0);
  EXPECT_THROW(incident_flux(narrow, grid, 1.0), Error);
}

TEST(IncidentElectrons, ComeDownwardsThroughAPlane) {
  for (const int half : {4, 8})
    for (const PitchAngles angles : {PitchAngles::isotropic, PitchAngles::field_aligned}) {
      const Streams directions = pitch_streams(half);
      const std::vector<double> psi = incident_angles(directions, angles);
      double flux = 0.0;
      for (std::size_t k = 0; k < directions.size(); ++k)
        flux -= directions.weight[k] * directions.cosine[k] * psi[k];
      EXPECT_NEAR(flux, 1.0, 1e-12);
    }
}

}  // namespace
}  // namespace vegard::sim::incident_electrons_test
