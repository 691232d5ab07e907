#include "sim/light/spectrum_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/light/tables/emission_tables.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

constexpr double kFirstTau = -14.0, kLastTau = 6.0, kTauStep = 0.125;
constexpr double kMaxwellianOfMono = 0.5;    // the E0 of a Maxwellian with this mean energy
constexpr double kSpectrumMinShare = 1e-14;  // a piece below that changes no float

/// Returns the logarithms of rates and their derivatives as `by` says; for the energy spread, those by the
/// logarithm of the energy.
std::vector<LogRate> mono_rates(const EmissionSource& source, const EmissionLine& line, double energy_kev,
                                SlopeBy by) {
  const MonoEnergeticTable& table = source.tables.mono();
  const LineColumn column = column_of(line, table);
  const bool by_energy = by == SlopeBy::log_energy || by == SlopeBy::energy_spread;
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

/// Sums over the Gaussian pieces in logarithms: far below where the electrons stop every piece would
/// underflow. Returns values, and slopes as `by` says.
std::vector<LogRate> gaussian_rates(const EmissionSource& source, const EmissionLine& line,
                                    const std::vector<GaussianPiece>& pieces, SlopeBy by) {
  std::vector<std::vector<LogRate>> of_piece;
  for (const GaussianPiece& piece : pieces)
    of_piece.push_back(mono_rates(source, line, piece.energy_kev, by));
  std::vector<LogRate> rates(of_piece.front().size());
  for (std::size_t a = 0; a < rates.size(); ++a) {
    double largest = -1e300, sum = 0.0, slope = 0.0;
    for (const std::vector<LogRate>& rate : of_piece) largest = std::max(largest, rate[a].value);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const LogRate& rate = of_piece[p][a];
      const double light = pieces[p].share * std::exp(rate.value - largest);
      sum += light;
      slope +=
          light * (by == SlopeBy::energy_spread ? pieces[p].d_log_share_d_spread + rate.slope * pieces[p].tau
                                                : rate.slope);
    }
    rates[a] = {largest + std::log(sum), slope / sum};
  }
  return rates;
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
  const std::vector<GaussianPiece> pieces = gaussian_pieces(energy_kev, spread);
  return sampled(source, wavelengths_nm,
                 [&](const EmissionLine& line) { return gaussian_rates(source, line, pieces, by); });
}

std::vector<GaussianPiece> gaussian_pieces(double energy_kev, double spread) {
  std::vector<GaussianPiece> pieces;
  double sum = 0.0, sum_slope = 0.0;
  for (double tau = kFirstTau; tau <= kLastTau; tau += kTauStep) {
    // E = Ec x; the energy flux E phi(E) dE goes by x exp(-u^2/2) x d(tau), u = (x - 1)/spread.
    const double x = std::exp(spread * tau), u = (x - 1.0) / spread;
    const double share = x * x * std::exp(-0.5 * u * u);
    const double slope = 2.0 * tau - u * (tau * x - u) / spread;
    pieces.push_back({energy_kev * x, share, tau, slope});
    sum += share;
    sum_slope += share * slope;
  }
  for (GaussianPiece& piece : pieces) {
    piece.share /= sum;
    piece.d_log_share_d_spread -= sum_slope / sum;
  }
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                              [](const GaussianPiece& piece) { return piece.share < kSpectrumMinShare; }),
               pieces.end());
  return pieces;
}

double gaussian_mean_energy_kev(double energy_kev, double spread) {
  constexpr double kRootHalf = 0.70710678118654752, kRootTwoPi = 2.5066282746310002;
  const double at_zero = 1.0 / spread;
  const double density = std::exp(-0.5 * at_zero * at_zero) / kRootTwoPi;
  return energy_kev * (1.0 + spread * density / (0.5 * std::erfc(-at_zero * kRootHalf)));
}

}  // namespace vegard::sim
