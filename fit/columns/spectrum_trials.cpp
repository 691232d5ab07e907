#include "fit/columns/spectrum_trials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace vegard::fit {
namespace {

constexpr double kTriedKappa = 4.0;  // ESTIMATED: a tail of which the lines could tell

/// The options of each spectrum but the used one.
std::vector<ColumnModelOptions> other_spectra(const ColumnModelOptions& used) {
  using Kind = sim::ElectronSpectrum::Kind;
  std::vector<ColumnModelOptions> others;
  if (!used.soft_kev) {
    others.push_back(used);
    others.back().soft_kev = kUsualSoftKev;
  }
  for (const Kind kind : {Kind::maxwellian, Kind::gaussian, Kind::kappa}) {
    if (kind == used.spectrum.kind) continue;
    others.push_back(used);
    others.back().spectrum = {};
    others.back().spectrum.kind = kind;
    others.back().spectrum.kappa = kTriedKappa;
  }
  return others;
}

}  // namespace

bool asks_for_trials(double chi2, int degrees_of_freedom) {
  return degrees_of_freedom > 0 && chi2 >= kAskedFall;
}

void try_spectra(const sim::EmissionTables& tables, const ColumnModelOptions& options, const ColumnChi2& chi2,
                 int threads, ColumnInversion& inversion) {
  const double found = inversion.solutions.front().chi2;
  if (!asks_for_trials(found, inversion.degrees_of_freedom)) return;
  for (const ColumnModelOptions& other : other_spectra(options)) {
    const ColumnModel model(tables, chi2.model().lines_nm(), other, threads);
    ColumnFreedom free = chi2.free();
    free[kLnSoft] = other.soft_kev && !options.soft_kev ? true : free[kLnSoft];
    const ColumnChi2 of_other(model, free, chi2.fixed());
    const ColumnValley best = of_other.valleys(inversion.data).front();
    SpectrumTrial trial;
    trial.words = other.soft_kev && !options.soft_kev
                      ? fmt::format("a soft component of {:g} keV beside them", *other.soft_kev)
                      : sim::spectrum_in_words(other.spectrum);
    trial.chi2 = best.chi2;
    trial.energy_kev = std::exp(best.at[kLnEnergy]);
    trial.energy_flux_mw_m2 = std::exp(best.at[kLnFlux]);
    if (free[kLnSoft]) trial.soft_ratio = std::exp(best.at[kLnSoft]);
    trial.contradicts = contradicts_tables(best.chi2, degrees_of_freedom(of_other));
    inversion.spectra.push_back(std::move(trial));
  }
  std::stable_sort(inversion.spectra.begin(), inversion.spectra.end(),
                   [](const SpectrumTrial& a, const SpectrumTrial& b) { return a.chi2 < b.chi2; });
  const SpectrumTrial& best = inversion.spectra.front();
  if (best.contradicts || found - best.chi2 < kAskedFall) return;
  inversion.verdict = ColumnVerdict::other_spectrum;
  inversion.reason = fmt::format("chi2 falls from {:.3g} to {:.2g} with {}", found, best.chi2, best.words);
  if (best.soft_ratio)
    inversion.reason += fmt::format(", which has {:.0f} % of the energy flux",
                                    100.0 * *best.soft_ratio / (1.0 + *best.soft_ratio));
  inversion.reason += fmt::format("; E0 is then {:.3g} keV", best.energy_kev);
}

}  // namespace vegard::fit
