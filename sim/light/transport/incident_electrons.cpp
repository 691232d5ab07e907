#include "sim/light/transport/incident_electrons.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

constexpr double kNegligible = 1e-4;

double table_value(const IncidentSpectrum& spectrum, double energy_kev) {
  const std::vector<double>& e = spectrum.table_energy_kev;
  if (energy_kev < e.front() || energy_kev > e.back()) return 0.0;
  const auto after = std::upper_bound(e.begin(), e.end(), energy_kev);
  if (after == e.end()) return spectrum.table_flux.back();
  const auto i = static_cast<std::size_t>(after - e.begin());
  const double way = (energy_kev - e[i - 1]) / (e[i] - e[i - 1]);
  return spectrum.table_flux[i - 1] + way * (spectrum.table_flux[i] - spectrum.table_flux[i - 1]);
}

/// Returns the density of a spectrum other than mono, up to a factor.
double spectrum_density(const IncidentSpectrum& spectrum, double energy_kev) {
  const double e0 = spectrum.energy_kev;
  switch (spectrum.kind) {
    case SpectrumKind::gaussian: {
      const double away = (energy_kev - e0) / (spectrum.spread * e0);
      return std::exp(-0.5 * away * away);
    }
    case SpectrumKind::maxwellian:
      return energy_kev * std::exp(-energy_kev / e0);
    case SpectrumKind::kappa:
      return energy_kev * std::pow(1.0 + energy_kev / (spectrum.kappa * e0), -spectrum.kappa - 1.0);
    case SpectrumKind::accelerated:
      if (energy_kev < spectrum.potential_kev) return 0.0;
      return energy_kev * std::exp(-(energy_kev - spectrum.potential_kev) / e0);
    case SpectrumKind::table:
      return table_value(spectrum, energy_kev);
    case SpectrumKind::mono:
      break;
  }
  return 0.0;
}

/// Returns the flux of the energies within a step that have a density, for spectra that begin or end within
/// it.
double flux_about(const IncidentSpectrum& spectrum, double low_kev, double high_kev) {
  constexpr int kParts = 8;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i)
    sum += spectrum_density(spectrum, low_kev + (high_kev - low_kev) * (i + 0.5) / kParts);
  return sum * (high_kev - low_kev) / kParts;
}

}  // namespace

double highest_energy_kev(const IncidentSpectrum& spectrum) {
  if (spectrum.kind == SpectrumKind::mono) return spectrum.energy_kev;
  if (spectrum.kind == SpectrumKind::table) return std::min(kHighestKev, spectrum.table_energy_kev.back());
  // From above, until the energy that is left out is no longer negligible.
  constexpr double kStep = 1.01;
  double all = 0.0;
  for (double e = 1e-3; e < kHighestKev; e *= kStep)
    all += e * spectrum_density(spectrum, e) * e * (kStep - 1.0);
  double left = 0.0, highest = kHighestKev;
  while (highest > 2e-3) {
    const double lower = highest / kStep;
    left += lower * spectrum_density(spectrum, lower) * (highest - lower);
    if (left > kNegligible * all) break;
    highest = lower;
  }
  return highest;
}

std::vector<double> incident_flux(const IncidentSpectrum& spectrum, const EnergyGrid& grid,
                                  double energy_flux_mw_m2) {
  std::vector<double> flux(grid.size(), 0.0);
  if (spectrum.kind == SpectrumKind::mono) {
    const EnergyShare share = share_of_energy(grid, 1e3 * spectrum.energy_kev);
    flux[share.lower] = share.at_lower;
    flux[share.lower + 1] = share.at_upper;
  } else {
    for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
      const double low = 1e-3 * grid.energy_ev[i], high = 1e-3 * grid.energy_ev[i + 1];
      const double about = flux_about(spectrum, low, high);
      flux[i] += 0.5 * about;
      flux[i + 1] += 0.5 * about;
    }
  }
  double energy = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) energy += flux[i] * grid.energy_ev[i];
  if (!(energy > 0.0))
    throw Error(ErrorKind::unreadable_input,
                "the spectrum is narrower than the steps of energy, and none of its electrons is met")
        .expected("one that is a percent wide at least")
        .hint("electrons of one energy are the spectrum \"mono\"");
  const double factor = energy_flux_mw_m2 * kEvPerErg / energy;
  for (double& f : flux) f *= factor;
  return flux;
}

double mean_energy_ev(const EnergyGrid& grid, const std::vector<double>& flux) {
  double number = 0.0, energy = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    number += flux[i];
    energy += flux[i] * grid.energy_ev[i];
  }
  return number > 0.0 ? energy / number : 0.0;
}

std::vector<double> incident_angles(const Streams& streams, PitchAngles angles) {
  std::vector<double> result(streams.size(), 0.0);
  if (angles == PitchAngles::isotropic) {
    for (std::size_t k = 0; k < streams.half(); ++k) result[k] = 2.0;
    return result;
  }
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < streams.half(); ++k)
    if (streams.cosine[k] < streams.cosine[nearest]) nearest = k;
  result[nearest] = 1.0 / (streams.weight[nearest] * -streams.cosine[nearest]);
  return result;
}

}  // namespace vegard::sim
