#include "sim/light/spectrum_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/base/file/number_text.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

constexpr double kFirstTau = -14.0, kLastTau = 6.0, kTauStep = 0.125;
constexpr double kKappaStep = 0.05;          // of ln(E), at most
constexpr double kMaxwellianOfMono = 0.5;    // the E0 of a Maxwellian with this mean energy
constexpr double kSpectrumMinShare = 1e-14;  // a piece below that changes no float

bool is_by_energy(SlopeBy by) { return by == SlopeBy::log_energy || by == SlopeBy::energy_spread; }

/// Returns the logarithms of rates and their derivatives as `by` says; for the energy spread, those by the
/// logarithm of the energy.
std::vector<LogRate> mono_rates(const EmissionSource& source, const EmissionLine& line, double energy_kev,
                                SlopeBy by) {
  const MonoEnergeticTable& table = source.tables.mono();
  const LineColumn column = column_of(line, table);
  const bool by_energy = is_by_energy(by);
  std::vector<double> value, slope;
  for (const MonoRate& rate : table.at_energy(column.name, energy_kev, source.oxygen_factor)) {
    value.push_back(rate.value + std::log(column.ratio));
    slope.push_back(by_energy                      ? rate.slope
                    : by == SlopeBy::oxygen_factor ? rate.by_log_oxygen / source.oxygen_factor
                                                   : 0.0);
  }
  add_modes(source, column.name, kMaxwellianOfMono * energy_kev, table.altitudes_km(),
            by_energy ? SlopeBy::log_energy : by, value, slope);
  std::vector<LogRate> rates;
  for (std::size_t a = 0; a < value.size(); ++a) rates.push_back({value[a], slope[a]});
  return rates;
}

/// Sums over the pieces of a spectrum in logarithms: far below where the electrons stop every piece would
/// underflow. Returns values, and slopes as `by` says.
std::vector<LogRate> spectrum_rates(const EmissionSource& source, const EmissionLine& line,
                                    const std::vector<ElectronPiece>& pieces, SlopeBy by) {
  std::vector<std::vector<LogRate>> of_piece;
  for (const ElectronPiece& piece : pieces)
    of_piece.push_back(mono_rates(source, line, piece.energy_kev, by));
  const bool by_energy = is_by_energy(by);
  std::vector<LogRate> rates(of_piece.front().size());
  for (std::size_t a = 0; a < rates.size(); ++a) {
    double largest = -1e300, sum = 0.0, slope = 0.0;
    for (const std::vector<LogRate>& rate : of_piece) largest = std::max(largest, rate[a].value);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const LogRate& rate = of_piece[p][a];
      const double light = pieces[p].share * std::exp(rate.value - largest);
      sum += light;
      slope += light * (by_energy ? pieces[p].d_log_share + rate.slope * pieces[p].d_log_energy : rate.slope);
    }
    rates[a] = {largest + std::log(sum), slope / sum};
  }
  return rates;
}

/// Makes the shares' sum 1, with their derivatives, and leaves out what is next to nothing.
void normalise(std::vector<ElectronPiece>& pieces) {
  double sum = 0.0, sum_slope = 0.0;
  for (const ElectronPiece& piece : pieces) {
    sum += piece.share;
    sum_slope += piece.share * piece.d_log_share;
  }
  for (ElectronPiece& piece : pieces) {
    piece.share /= sum;
    piece.d_log_share -= sum_slope / sum;
  }
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                              [](const ElectronPiece& piece) { return piece.share < kSpectrumMinShare; }),
               pieces.end());
}

/// Returns a profile of the lines' rates at the altitudes of the tables.
template <class RatesOf>
HeightProfile sampled(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                      const RatesOf& rates_of) {
  HeightProfile profile = dark_profile(static_cast<int>(wavelengths_nm.size()));
  for (int l = 0; l < profile.lines; ++l) {
    const EmissionLine* line = find_emission_line(wavelengths_nm[l]);
    if (line == nullptr || !is_auroral(*line)) continue;
    std::vector<double> log_rate, log_slope;
    for (const LogRate& rate : rates_of(*line)) {
      log_rate.push_back(rate.value);
      log_slope.push_back(rate.slope);
    }
    sample_line(source.tables.mono().altitudes_km(), log_rate, log_slope, l, profile);
  }
  return profile;
}

}  // namespace

HeightProfile mono_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                           double energy_kev, SlopeBy by) {
  return sampled(source, wavelengths_nm, [&](const EmissionLine& line) {
    std::vector<LogRate> rates = mono_rates(source, line, energy_kev, by);
    if (by == SlopeBy::energy_spread)
      for (LogRate& rate : rates) rate.slope = 0.0;
    return rates;
  });
}

HeightProfile gaussian_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                               double energy_kev, double spread, SlopeBy by) {
  const std::vector<ElectronPiece> pieces = gaussian_pieces(energy_kev, spread, by);
  return sampled(source, wavelengths_nm,
                 [&](const EmissionLine& line) { return spectrum_rates(source, line, pieces, by); });
}

HeightProfile kappa_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                            double energy_kev, double kappa, SlopeBy by) {
  assert(by != SlopeBy::energy_spread);
  const std::vector<ElectronPiece> pieces = kappa_pieces(source, energy_kev, kappa, by);
  return sampled(source, wavelengths_nm,
                 [&](const EmissionLine& line) { return spectrum_rates(source, line, pieces, by); });
}

std::vector<ElectronPiece> gaussian_pieces(double energy_kev, double spread, SlopeBy by) {
  std::vector<ElectronPiece> pieces;
  const bool by_spread = by == SlopeBy::energy_spread;
  for (double tau = kFirstTau; tau <= kLastTau; tau += kTauStep) {
    // E = Ec x; the energy flux E phi(E) dE goes by x exp(-u^2/2) x d(tau), u = (x - 1)/spread.
    const double x = std::exp(spread * tau), u = (x - 1.0) / spread;
    const double share = x * x * std::exp(-0.5 * u * u);
    if (by_spread)
      pieces.push_back({energy_kev * x, share, tau, 2.0 * tau - u * (tau * x - u) / spread});
    else
      pieces.push_back({energy_kev * x, share, 1.0, 0.0});
  }
  normalise(pieces);
  return pieces;
}

std::vector<ElectronPiece> kappa_pieces(const EmissionSource& source, double energy_kev, double kappa,
                                        SlopeBy by) {
  assert(kappa > 2.0);
  const MonoEnergeticTable& table = source.tables.mono();
  const double first = std::log(table.min_energy_kev()), last = std::log(table.max_energy_kev());
  const int steps = std::max(1, static_cast<int>(std::ceil((last - first) / kKappaStep)));
  std::vector<ElectronPiece> pieces;
  double largest = -1e300;
  for (int i = 0; i <= steps; ++i) {
    // The energy flux E phi(E) dE, with dE in proportion to E; its logarithm, as powers may be small.
    const double log_energy = first + (last - first) * i / steps, energy = std::exp(log_energy);
    const double over_kappa = energy / (kappa * energy_kev);
    const double log_share = 3.0 * log_energy - (kappa + 1.0) * std::log1p(over_kappa);
    const double slope = by == SlopeBy::log_energy ? (kappa + 1.0) * over_kappa / (1.0 + over_kappa) : 0.0;
    largest = std::max(largest, log_share);
    pieces.push_back({energy, log_share, 0.0, slope});
  }
  for (ElectronPiece& piece : pieces) piece.share = std::exp(piece.share - largest);
  pieces.front().share *= 0.5;  // by trapezoids
  pieces.back().share *= 0.5;
  normalise(pieces);
  return pieces;
}

double gaussian_mean_energy_kev(double energy_kev, double spread) {
  constexpr double kRootHalf = 0.70710678118654752, kRootTwoPi = 2.5066282746310002;
  const double at_zero = 1.0 / spread;
  const double density = std::exp(-0.5 * at_zero * at_zero) / kRootTwoPi;
  return energy_kev * (1.0 + spread * density / (0.5 * std::erfc(-at_zero * kRootHalf)));
}

HeightProfile electron_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                               const ElectronSpectrum& spectrum, double energy_kev,
                               double energy_flux_mw_m2) {
  switch (spectrum.kind) {
    case ElectronSpectrum::Kind::gaussian:
      return gaussian_profile(source, wavelengths_nm, energy_kev, spectrum.spread);
    case ElectronSpectrum::Kind::mono:
      return mono_profile(source, wavelengths_nm, energy_kev);
    case ElectronSpectrum::Kind::kappa:
      return kappa_profile(source, wavelengths_nm, energy_kev, spectrum.kappa);
    case ElectronSpectrum::Kind::maxwellian:
      break;
  }
  return maxwellian_profile(source, wavelengths_nm, energy_kev, energy_flux_mw_m2);
}

double mean_energy_over_e0(const ElectronSpectrum& spectrum) {
  switch (spectrum.kind) {
    case ElectronSpectrum::Kind::gaussian:
      return gaussian_mean_energy_kev(1.0, spectrum.spread);
    case ElectronSpectrum::Kind::mono:
      return 1.0;
    case ElectronSpectrum::Kind::kappa:
      return 2.0 * spectrum.kappa / (spectrum.kappa - 2.0);
    case ElectronSpectrum::Kind::maxwellian:
      break;
  }
  return 2.0;
}

const char* spectrum_word(ElectronSpectrum::Kind kind) {
  switch (kind) {
    case ElectronSpectrum::Kind::gaussian:
      return "gaussian";
    case ElectronSpectrum::Kind::mono:
      return "mono";
    case ElectronSpectrum::Kind::kappa:
      return "kappa";
    case ElectronSpectrum::Kind::maxwellian:
      break;
  }
  return "maxwellian";
}

ElectronSpectrum::Kind spectrum_kind(const std::string& word) {
  using Kind = ElectronSpectrum::Kind;
  for (const Kind kind : {Kind::gaussian, Kind::mono, Kind::kappa})
    if (word == spectrum_word(kind)) return kind;
  return Kind::maxwellian;
}

std::string spectrum_in_words(const ElectronSpectrum& spectrum) {
  switch (spectrum.kind) {
    case ElectronSpectrum::Kind::gaussian:
      return "a Gaussian, spread " + short_number(spectrum.spread, 4);
    case ElectronSpectrum::Kind::mono:
      return "one energy";
    case ElectronSpectrum::Kind::kappa:
      return "a kappa distribution, kappa " + short_number(spectrum.kappa, 4);
    case ElectronSpectrum::Kind::maxwellian:
      break;
  }
  return "a Maxwellian";
}

}  // namespace vegard::sim
