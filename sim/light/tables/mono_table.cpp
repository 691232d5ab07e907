#include "sim/light/tables/mono_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/base/number/spline.h"

namespace vegard::sim {
namespace {

constexpr double kRangeFactor = 0.76, kRangeExponent = 1.03;  // see the header
constexpr double kMonoFloorOfPeak = 1e-6;                     // as the tables have it
constexpr double kPieceRatio = 1.05;                          // between the energies of two pieces
constexpr double kFirstPieceKev = 0.02;
constexpr int kPieces = 200;  // to 330 keV
constexpr int kCorrections = 1;

double piece_energy_kev(int piece) { return kFirstPieceKev * std::pow(kPieceRatio, piece); }

/// Returns ln of the ion pairs of mono-energetic electrons in the tables' air.
LogRate log_ion_pairs(const StoppingAir& air, double energy_kev) {
  LogRate rate = log_ionisation(air, range_energy_kev(energy_kev));
  rate.slope *= kRangeExponent;
  return rate;
}

/// Returns the logarithms of rates, raised to the floor below their peak.
std::vector<double> floored_logs(const std::vector<double>& rates) {
  const double floor = kMonoFloorOfPeak * *std::max_element(rates.begin(), rates.end());
  std::vector<double> logs;
  for (const double rate : rates) logs.push_back(std::log(std::max(rate, floor)));
  return logs;
}

}  // namespace

double range_energy_kev(double energy_kev) { return kRangeFactor * std::pow(energy_kev, kRangeExponent); }

std::vector<SpectrumPiece> maxwellian_pieces(double characteristic_energy_kev) {
  std::vector<SpectrumPiece> pieces(kPieces);
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const double energy = piece_energy_kev(i);
    // Energy flux E phi(E) dE, with dE in proportion to E.
    pieces[i] = {energy, energy * energy * energy * std::exp(-energy / characteristic_energy_kev)};
    sum += pieces[i].share;
  }
  for (SpectrumPiece& piece : pieces) piece.share /= sum;
  return pieces;
}

MonoEnergeticTable::MonoEnergeticTable(EmissionTable table)
    : table_(std::move(table)), altitudes_km_(table_->altitudes_km()) {}

MonoEnergeticTable::MonoEnergeticTable(const EmissionTable& maxwellian, const std::vector<StoppingAir>& air)
    : altitudes_km_(maxwellian.altitudes_km()), air_(air), factors_(maxwellian.oxygen_factors()) {
  assert(air_.size() == altitudes_km_.size());
  for (const double e0 : maxwellian.energies_kev()) log_energies_.push_back(std::log(2.0 * e0));
  for (const std::string& column : maxwellian.columns())
    for (const double factor : factors_) add(column, maxwellian, factor);
}

double MonoEnergeticTable::min_energy_kev() const {
  return table_ ? table_->energies_kev().front() : kFirstPieceKev;
}

double MonoEnergeticTable::max_energy_kev() const {
  return table_ ? table_->energies_kev().back() : piece_energy_kev(kPieces - 1);
}

bool MonoEnergeticTable::has(const std::string& column) const {
  return table_ ? table_->has(column) : yields_.count(column) > 0;
}

void MonoEnergeticTable::add(const std::string& column, const EmissionTable& table, double factor) {
  const std::size_t altitudes = altitudes_km_.size(), energies = log_energies_.size();
  std::vector<Yield> yields(altitudes, Yield{std::vector<double>(energies, 0.0), {}});

  // With no yield yet the Maxwellian made out of pieces is that of the ion pairs.
  for (int round = 0; round <= kCorrections; ++round) {
    std::vector<std::vector<double>> of_piece(altitudes, std::vector<double>(kPieces));
    for (std::size_t a = 0; a < altitudes; ++a) {
      yields[a].curvature = spline_curvature(log_energies_, yields[a].log_yield);
      for (int i = 0; i < kPieces; ++i) {
        const double energy = piece_energy_kev(i);
        of_piece[a][i] =
            std::exp(log_ion_pairs(air_[a], energy).value + log_yield(yields[a], std::log(energy)).value);
      }
    }
    for (std::size_t e = 0; e < energies; ++e) {
      const double e0 = table.energies_kev()[e];
      const std::vector<SpectrumPiece> pieces = maxwellian_pieces(e0);
      std::vector<double> wanted, made;
      for (const Emission1d& emission : table.at_energy(column, e0, factor)) wanted.push_back(emission.rate);
      for (std::size_t a = 0; a < altitudes; ++a) {
        double sum = 0.0;
        for (int i = 0; i < kPieces; ++i) sum += pieces[i].share * of_piece[a][i];
        made.push_back(sum);
      }
      const std::vector<double> log_wanted = floored_logs(wanted), log_made = floored_logs(made);
      for (std::size_t a = 0; a < altitudes; ++a) yields[a].log_yield[e] += log_wanted[a] - log_made[a];
    }
  }
  for (Yield& yield : yields) yield.curvature = spline_curvature(log_energies_, yield.log_yield);
  std::vector<Yield>& all = yields_[column];
  all.insert(all.end(), yields.begin(), yields.end());
}

SplineValue MonoEnergeticTable::log_yield(const Yield& yield, double log_energy) const {
  const double held = std::clamp(log_energy, log_energies_.front(), log_energies_.back());
  const SplineValue at = spline_at(log_energies_, yield.log_yield, yield.curvature, held);
  return {at.value, held == log_energy ? at.slope : 0.0};
}

std::vector<MonoRate> MonoEnergeticTable::at_energy(const std::string& column, double energy_kev,
                                                    double oxygen_factor) const {
  std::vector<MonoRate> rates;
  if (table_) {
    const double held = std::clamp(energy_kev, table_->energies_kev().front(), table_->energies_kev().back());
    for (const Emission1d& emission : table_->at_energy(column, held, oxygen_factor))
      rates.push_back({std::log(emission.rate),
                       held == energy_kev ? emission.d_rate_d_ln_energy / emission.rate : 0.0,
                       emission.d_rate_d_ln_oxygen / emission.rate});
    return rates;
  }
  const std::vector<Yield>& yields = yields_.at(column);
  const std::vector<SplineValue> weights = oxygen_weights(factors_, oxygen_factor);
  const std::size_t altitudes = altitudes_km_.size();
  for (std::size_t a = 0; a < altitudes; ++a) {
    const LogRate pairs = log_ion_pairs(air_[a], energy_kev);
    SplineValue yield;
    double by_oxygen = 0.0;
    for (std::size_t f = 0; f < factors_.size(); ++f) {
      const SplineValue of_factor = log_yield(yields[f * altitudes + a], std::log(energy_kev));
      yield.value += weights[f].value * of_factor.value;
      yield.slope += weights[f].value * of_factor.slope;
      by_oxygen += weights[f].slope * of_factor.value;
    }
    rates.push_back({pairs.value + yield.value, pairs.slope + yield.slope, by_oxygen});
  }
  return rates;
}

}  // namespace vegard::sim
