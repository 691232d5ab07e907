#include "sim/light/spectrum_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/light/tables/emission_tables.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

constexpr double kFirstTau = -14.0, kLastTau = 6.0, kTauStep = 0.125;
constexpr double kSpectrumMinShare = 1e-14;  // a piece below that changes no float

std::vector<MonoRate> mono_rates(const EmissionSource& source, const EmissionLine& line, double energy_kev) {
  const MonoEnergeticTable& table = source.tables.mono();
  const LineColumn column = column_of(line, table);
  std::vector<MonoRate> rates = table.at_energy(column.name, energy_kev, source.oxygen_factor);
  for (MonoRate& rate : rates) rate.value += std::log(column.ratio);
  return rates;
}

double slope_of(const MonoRate& rate, SlopeBy by, double oxygen_factor) {
  if (by == SlopeBy::log_energy) return rate.slope;
  return by == SlopeBy::oxygen_factor ? rate.by_log_oxygen / oxygen_factor : 0.0;
}

/// Sums over the Gaussian pieces in logarithms: far below where the electrons stop every piece would
/// underflow. Returns values, and slopes as `by` says.
std::vector<LogRate> gaussian_rates(const EmissionSource& source, const EmissionLine& line,
                                    const std::vector<GaussianPiece>& pieces, SlopeBy by) {
  std::vector<std::vector<MonoRate>> of_piece;
  for (const GaussianPiece& piece : pieces) of_piece.push_back(mono_rates(source, line, piece.energy_kev));
  std::vector<LogRate> rates(of_piece.front().size());
  for (std::size_t a = 0; a < rates.size(); ++a) {
    double largest = -1e300, sum = 0.0, slope = 0.0;
    for (const std::vector<MonoRate>& rate : of_piece) largest = std::max(largest, rate[a].value);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const MonoRate& rate = of_piece[p][a];
      const double light = pieces[p].share * std::exp(rate.value - largest);
      sum += light;
      slope +=
          light * (by == SlopeBy::energy_spread ? pieces[p].d_log_share_d_spread + rate.slope * pieces[p].tau
                                                : slope_of(rate, by, source.oxygen_factor));
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
    std::vector<LogRate> rates;
    for (const MonoRate& rate : mono_rates(source, line, energy_kev))
      rates.push_back({rate.value, slope_of(rate, by, source.oxygen_factor)});
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
