#include "sim/light/transport/collisions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"
#include "sim/light/transport/electron_grid.h"

namespace vegard::sim {
namespace {

constexpr double kUnitCm2 = 1e-16;  // of the table

struct ProcessRow {
  int process;  // of cross_sections.csv
  Gas gas;
  const char* name;
  double loss_ev;
  CollisionTail tail;
};

constexpr CollisionTail kAllowed = CollisionTail::allowed, kForbidden = CollisionTail::forbidden,
                        kExchange = CollisionTail::exchange;

constexpr ProcessRow kExcitations[] = {
    {120, Gas::n2, "N2 v=1", 0.29, kForbidden},
    {121, Gas::n2, "N2 v=2", 0.59, kForbidden},
    {122, Gas::n2, "N2 v=3-8", 1.3, kForbidden},
    {130, Gas::n2, "N2 A3Sigma v=0-4", 6.17, kExchange},
    {131, Gas::n2, "N2 A3Sigma v=5-9", 7.0, kExchange},
    {132, Gas::n2, "N2 A3Sigma v=10-", 7.8, kExchange},
    {133, Gas::n2, "N2 B3Pi", 7.35, kExchange},
    {134, Gas::n2, "N2 W3Delta", 7.36, kExchange},
    {135, Gas::n2, "N2 B'3Sigma", 8.16, kExchange},
    {136, Gas::n2, "N2 a'1Sigma", 8.4, kForbidden},
    {137, Gas::n2, "N2 a1Pi", 8.55, kForbidden},
    {138, Gas::n2, "N2 w1Delta", 8.89, kForbidden},
    {139, Gas::n2, "N2 C3Pi", 11.03, kExchange},
    {140, Gas::n2, "N2 E3Sigma", 11.87, kExchange},
    {141, Gas::n2, "N2 a''1Sigma", 12.25, kForbidden},
    {142, Gas::n2, "N2 singlets from 13 eV", 13.0, kAllowed},
    {220, Gas::o2, "O2 v=1", 0.19, kForbidden},
    {221, Gas::o2, "O2 v=2-3", 0.42, kForbidden},
    {230, Gas::o2, "O2 a1Delta", 0.977, kExchange},
    {231, Gas::o2, "O2 b1Sigma", 1.627, kExchange},
    {232, Gas::o2, "O2 A A' c bound", 4.5, kForbidden},
    {233, Gas::o2, "O2 Herzberg continuum", 6.0, kForbidden},
    {234, Gas::o2, "O2 8.4 eV", 8.4, kAllowed},
    {236, Gas::o2, "O2 9.97 eV", 9.97, kForbidden},
    {235, Gas::o2, "O2 14.7 eV", 14.7, kAllowed},
    {330, Gas::o, "O 1D", 1.96, kExchange},
    {331, Gas::o, "O 1S", 4.18, kExchange},
    {332, Gas::o, "O core 4S", 9.5, kAllowed},
    {333, Gas::o, "O core 2D", 12.5, kAllowed},
    {334, Gas::o, "O core 2P", 14.1, kAllowed},
    {335, Gas::o, "O 2s2p5", 15.7, kAllowed},
};

struct ShellRow {
  int shell;  // of shells.csv
  Gas gas;
  const char* name;
};

constexpr ShellRow kShells[] = {
    {100, Gas::n2, "N2+ X"}, {101, Gas::n2, "N2+ A"},  {102, Gas::n2, "N2+ B"},   {103, Gas::n2, "N+ + N"},
    {104, Gas::n2, "N2 1s"}, {200, Gas::o2, "O2+ X"},  {201, Gas::o2, "O2+ a A"}, {202, Gas::o2, "O2+ b"},
    {203, Gas::o2, "O2+ c"}, {204, Gas::o2, "O+ + O"}, {205, Gas::o2, "O2 1s"},   {300, Gas::o, "O+ 4S"},
    {301, Gas::o, "O+ 2D"},  {302, Gas::o, "O+ 2P"},   {303, Gas::o, "O+ 2s2p4"}, {304, Gas::o, "O 1s"},
};

constexpr std::array<const char*, kGases> kGasNames = {"N2", "O2", "O"};
constexpr std::array<int, kGases> kElastic = {100, 200, 300}, kIonisation = {110, 210, 310};
constexpr std::array<double, kGases> kCharge = {7.0, 8.0, 8.0};  // of a nucleus
constexpr int kTransferOfN2 = 101;

using Factors = std::map<int, double>;

CollisionCurve collision_curve(const CsvTable& table, int process, const Factors& factors = {}) {
  const auto scaled = factors.find(process);
  const double unit_cm2 = kUnitCm2 * (scaled == factors.end() ? 1.0 : scaled->second);
  const auto& numbers = table.column("process");
  const auto &energy = table.column("energy_eV"), &value = table.column("cross_section_1e-16_cm2");
  CollisionCurve curve;
  for (std::size_t r = 0; r < table.rows(); ++r)
    if (numbers[r] == process) {
      curve.energy_ev.push_back(energy[r]);
      curve.cm2.push_back(unit_cm2 * value[r]);
    }
  return curve;
}

// Screened Rutherford scattering as Monte Carlo codes have it: D. C. Joy, "Monte Carlo modeling for electron
// microscopy and microanalysis", 1995, equations (3.2) and (3.3). Up to a factor, which the tables give.

double screening(double charge, double energy_ev) { return 3.4 * std::pow(charge, 0.67) / energy_ev; }

double rutherford(double charge, double energy_ev) {
  const double a = screening(charge, energy_ev);
  const double relativistic = (energy_ev + kElectronRestEv) / (energy_ev + 2.0 * kElectronRestEv);
  return relativistic * relativistic / (energy_ev * energy_ev * a * (1.0 + a));
}

GasCollisions read_gas(const CsvTable& table, const CsvTable& shells, Gas gas, const Factors& factors) {
  const auto g = static_cast<std::size_t>(gas);
  GasCollisions result;
  result.name = kGasNames[g];
  result.nuclear_charge = kCharge[g];
  result.elastic = collision_curve(table, kElastic[g], factors);
  result.ionisation = collision_curve(table, kIonisation[g], factors);
  for (const ProcessRow& row : kExcitations) {
    if (row.gas != gas) continue;
    Excitation excitation{row.name, collision_curve(table, row.process, factors)};
    excitation.curve.loss_ev = row.loss_ev;
    excitation.curve.tail = row.tail;
    result.excitations.push_back(excitation);
  }
  const auto& numbers = shells.column("shell");
  for (const ShellRow& row : kShells)
    for (std::size_t r = 0; r < shells.rows(); ++r)
      if (row.gas == gas && numbers[r] == row.shell)
        result.shells.push_back({row.name, shells.column("loss_eV")[r], shells.column("binding_eV")[r],
                                 shells.column("kinetic_eV")[r], shells.column("electrons")[r],
                                 shells.column("auger_eV")[r]});
  return result;
}

double shells_cm2(const GasCollisions& gas, double energy_ev) {
  double sum = 0.0;
  for (const IonisedShell& shell : gas.shells) sum += ShellSpectrum(shell, energy_ev).cm2();
  return sum;
}

constexpr double kBohrCm = 0.529177211e-8;
constexpr double kFineStructure = 7.2973525693e-3;

double beta2_of(double energy_ev) {
  const double gamma = 1.0 + energy_ev / kElectronRestEv;
  return (gamma - 1.0) * (gamma + 1.0) / (gamma * gamma);
}

/// Returns m v^2/2 of an electron, relativistic.
double half_mv2_ev(double energy_ev) {
  const double gamma = 1.0 + energy_ev / kElectronRestEv;
  return 0.5 * kElectronRestEv * (gamma - 1.0) * (gamma + 1.0) / (gamma * gamma);
}

}  // namespace

double CollisionCurve::at(double energy) const {
  if (energy <= loss_ev || energy < energy_ev.front()) return 0.0;
  if (energy < energy_ev.back()) {
    const auto after = std::upper_bound(energy_ev.begin(), energy_ev.end(), energy);
    const auto i = static_cast<std::size_t>(after - energy_ev.begin());
    const double low = cm2[i - 1], high = cm2[i];
    if (low <= 0.0 || high <= 0.0)
      return low + (high - low) * (energy - energy_ev[i - 1]) / (energy_ev[i] - energy_ev[i - 1]);
    const double place = std::log(energy / energy_ev[i - 1]) / std::log(energy_ev[i] / energy_ev[i - 1]);
    return low * std::pow(high / low, place);
  }
  const double t = half_mv2_ev(energy), last = half_mv2_ev(energy_ev.back());
  switch (tail) {
    case CollisionTail::allowed:
      return cm2.back() * last / t * std::log(4.0 * t / loss_ev) / std::log(4.0 * last / loss_ev);
    case CollisionTail::forbidden:
      return cm2.back() * last / t;
    case CollisionTail::exchange:
      return cm2.back() * std::pow(last / t, 3);
  }
  return 0.0;
}

double GasCollisions::elastic_cm2(double energy_ev) const {
  const double end = elastic.energy_ev.back();
  if (energy_ev <= elastic.energy_ev.front()) return elastic.cm2.front();
  if (energy_ev < end) return elastic.at(energy_ev);
  return elastic.cm2.back() * rutherford(nuclear_charge, energy_ev) / rutherford(nuclear_charge, end);
}

double GasCollisions::shell_factor(double energy_ev) const {
  const double first = ionisation.energy_ev.front(), end = ionisation.energy_ev.back();
  const double inside = std::clamp(energy_ev, first, end);
  const double by_formula = shells_cm2(*this, inside);
  if (by_formula <= 0.0) return 1.0;
  const double observed = inside < end ? ionisation.at(inside) : ionisation.cm2.back();
  const double factor = observed / by_formula;
  if (energy_ev <= end) return factor;
  const double way = std::min(1.0, std::log10(energy_ev / end));
  return factor + (1.0 - factor) * way;
}

std::array<GasCollisions, kGases> scaled_collisions(const std::map<int, double>& factor_of_process) {
  const CsvTable table = embedded_csv_table("cross_sections.csv"), shells = embedded_csv_table("shells.csv");
  return {read_gas(table, shells, Gas::n2, factor_of_process),
          read_gas(table, shells, Gas::o2, factor_of_process),
          read_gas(table, shells, Gas::o, factor_of_process)};
}

const GasCollisions& gas_collisions(Gas gas) {
  static const std::array<GasCollisions, kGases> gases = scaled_collisions({});
  return gases[static_cast<std::size_t>(gas)];
}

double elastic_transfer_ratio(double energy_ev) {
  static const CollisionCurve transfer =
      collision_curve(embedded_csv_table("cross_sections.csv"), kTransferOfN2);
  const GasCollisions& n2 = gas_collisions(Gas::n2);
  const double inside = std::clamp(energy_ev, transfer.energy_ev.front(), transfer.energy_ev.back());
  const double value = inside < transfer.energy_ev.back() ? transfer.at(inside) : transfer.cm2.back();
  double ratio = value / n2.elastic_cm2(inside);
  if (energy_ev > inside)
    ratio *= mean_turn(screening(kCharge[0], energy_ev)) / mean_turn(screening(kCharge[0], inside));
  return std::min(1.0, ratio);
}

double stopping_ev_cm2(Gas gas, double energy_ev) {
  const GasCollisions& collisions = gas_collisions(gas);
  double sum = 0.0;
  for (const Excitation& e : collisions.excitations) sum += e.curve.at(energy_ev) * e.curve.loss_ev;
  const double factor = collisions.shell_factor(energy_ev);
  constexpr int kSteps = 400;
  for (const IonisedShell& shell : collisions.shells) {
    const ShellSpectrum spectrum(shell, energy_ev);
    sum += factor * spectrum.cm2() * shell.loss_ev;
    const double span = std::log1p(spectrum.max_ev() / shell.binding_ev);
    double below = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
      const double upper = shell.binding_ev * std::expm1(span * i / kSteps);
      const double middle = shell.binding_ev * std::expm1(span * (i - 0.5) / kSteps);
      const double to_here = spectrum.cm2_below(upper);
      sum += factor * (to_here - below) * middle;
      below = to_here;
    }
  }
  return sum;
}

ShellSpectrum::ShellSpectrum(const IonisedShell& shell, double energy_ev) : binding_ev_(shell.binding_ev) {
  if (energy_ev <= shell.binding_ev || energy_ev <= shell.loss_ev) return;
  max_ev_ = 0.5 * (energy_ev - shell.binding_ev);
  t_ = energy_ev / binding_ev_;
  const double rest = energy_ev / kElectronRestEv, b = binding_ev_ / kElectronRestEv;
  const double beta2 = beta2_of(energy_ev);
  const double speeds = beta2 + beta2_of(shell.kinetic_ev) + beta2_of(binding_ev_);
  prefactor_cm2_ =
      4.0 * kPi * kBohrCm * kBohrCm * std::pow(kFineStructure, 4) * shell.electrons / (speeds * 2.0 * b);
  const double recoil = (1.0 + 0.5 * rest) * (1.0 + 0.5 * rest);
  exchange_ = (1.0 + 2.0 * rest) / (recoil * (t_ + 1.0));
  constant_ = b * b / recoil;
  dipole_ = std::log(beta2 / (1.0 - beta2)) - beta2 - std::log(2.0 * b);
  at_zero_ = integral(0.0);
}

double ShellSpectrum::integral(double w) const {
  const double near = w + 1.0, far = t_ - w;
  return 1.0 / far - 1.0 / near - exchange_ * std::log(near / far) + constant_ * w +
         0.5 * dipole_ * (1.0 / (far * far) - 1.0 / (near * near));
}

double ShellSpectrum::cm2_below(double secondary_ev) const {
  if (max_ev_ <= 0.0 || secondary_ev <= 0.0) return 0.0;
  const double w = std::min(secondary_ev, max_ev_) / binding_ev_;
  return prefactor_cm2_ * (integral(w) - at_zero_);
}

}  // namespace vegard::sim
