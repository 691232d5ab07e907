#include "sim/light/mono_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/base/number/spline.h"
#include "sim/light/emission_table.h"
#include "sim/light/glow_air.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

constexpr double kRangeFactor = 0.76, kRangeExponent = 1.03;  // see the header
constexpr double kMonoFloorOfPeak = 1e-6;                     // as the tables have it
constexpr double kPieceRatio = 1.05;                          // between the energies of two pieces
constexpr double kFirstPieceKev = 0.02;
constexpr int kPieces = 200;  // to 330 keV
constexpr int kCorrections = 1;

double piece_energy_kev(int piece) { return kFirstPieceKev * std::pow(kPieceRatio, piece); }

/// ln of the ion pairs of mono-energetic electrons in GLOW's air.
LogRate log_ion_pairs(std::size_t altitude, double energy_kev) {
  LogRate rate = log_ionisation(glow_air()[altitude], range_energy_kev(energy_kev));
  rate.slope *= kRangeExponent;
  return rate;
}

/// The logarithms of rates, raised to the floor below their peak.
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

const MonoEnergeticTable& MonoEnergeticTable::glow() {
  static const MonoEnergeticTable table;
  return table;
}

MonoEnergeticTable::MonoEnergeticTable() {
  for (const double e0 : EmissionTable::glow().energies_kev()) log_energies_.push_back(std::log(2.0 * e0));
  add("ionisation_electron");
  for (const EmissionLine& line : emission_lines())
    if (is_auroral(line) && yields_.count(line.table_column) == 0) add(line.table_column);
}

void MonoEnergeticTable::add(const std::string& column) {
  const EmissionTable& table = EmissionTable::glow();
  const std::size_t altitudes = table.altitudes_km().size(), energies = log_energies_.size();
  assert(glow_air().size() == altitudes);
  std::vector<Yield>& yields = yields_[column];
  yields.assign(altitudes, Yield{std::vector<double>(energies, 0.0), {}});

  // With no yield yet the Maxwellian made out of pieces is that of the ion pairs.
  for (int round = 0; round <= kCorrections; ++round) {
    std::vector<std::vector<double>> of_piece(altitudes, std::vector<double>(kPieces));
    for (std::size_t a = 0; a < altitudes; ++a) {
      yields[a].curvature = spline_curvature(log_energies_, yields[a].log_yield);
      for (int i = 0; i < kPieces; ++i) {
        const double energy = piece_energy_kev(i);
        of_piece[a][i] =
            std::exp(log_ion_pairs(a, energy).value + log_yield(yields[a], std::log(energy)).value);
      }
    }
    for (std::size_t e = 0; e < energies; ++e) {
      const double e0 = table.energies_kev()[e];
      const std::vector<SpectrumPiece> pieces = maxwellian_pieces(e0);
      std::vector<double> wanted, made;
      for (const Emission1d& emission : table.at_energy(column, e0)) wanted.push_back(emission.rate);
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
}

LogRate MonoEnergeticTable::log_yield(const Yield& yield, double log_energy) const {
  const double held = std::clamp(log_energy, log_energies_.front(), log_energies_.back());
  const SplineValue at = spline_at(log_energies_, yield.log_yield, yield.curvature, held);
  return {at.value, held == log_energy ? at.slope : 0.0};
}

std::vector<LogRate> MonoEnergeticTable::at_energy(const std::string& column, double energy_kev) const {
  const std::vector<Yield>& yields = yields_.at(column);
  std::vector<LogRate> rates;
  for (std::size_t a = 0; a < yields.size(); ++a) {
    const LogRate pairs = log_ion_pairs(a, energy_kev), yield = log_yield(yields[a], std::log(energy_kev));
    rates.push_back({pairs.value + yield.value, pairs.slope + yield.slope});
  }
  return rates;
}

}  // namespace vegard::sim
