#include "sim/light/chemistry/ion_balance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

/// What an implicit step in time adds to the balance: the densities before it, over its length. Nothing: a
/// steady state.
struct TimeStep {
  IonDensities before;
  double per_s = 0.0;

  double density(double production, double loss, double IonDensities::*ion) const {
    const double gained = production + per_s * before.*ion;
    return gained > 0.0 ? gained / (loss + per_s) : 0.0;
  }
};

/// Returns all ions for a given density of thermal electrons.
IonDensities ions_among(const ReactingAir& a, const IonProduction& p, const RatesAtPlace& k, double diffusion,
                        double electrons, const TimeStep& step) {
  using R = Reaction;
  IonDensities i;
  i.electrons = electrons;
  const double e = electrons;
  i.op2p = step.density(p.op2p,
                        k(R::op2p_light_4s) + k(R::op2p_light_2d) + k(R::op2p_n2) * a.n2 +
                            k(R::op2p_o2) * a.o2 + k(R::op2p_o) * a.o + k(R::op2p_e) * e,
                        &IonDensities::op2p);
  i.op2d = step.density(p.op2d + i.op2p * (k(R::op2p_light_2d) + k(R::op2p_o) * a.o + k(R::op2p_e) * e),
                        k(R::op2d_n2) * a.n2 + k(R::op2d_o2) * a.o2 + k(R::op2d_o) * a.o + k(R::op2d_e) * e,
                        &IonDensities::op2d);
  const double np_o2 = k(R::np_o2) * a.o2;
  i.np = step.density(p.np, np_o2 + k(R::np_o) * a.o + k(R::np_no) * a.no, &IonDensities::np);
  i.n2p = step.density(
      p.n2p + a.n2 * (k(R::op2d_n2) * i.op2d + k(R::op2p_n2) * i.op2p),
      (k(R::n2p_o) + k(R::n2p_o_charge)) * a.o + k(R::n2p_o2) * a.o2 + k(R::n2p_no) * a.no + k(R::n2p_e) * e,
      &IonDensities::n2p);
  i.op =
      step.density(p.op + k(R::op2p_light_4s) * i.op2p + i.op2d * (k(R::op2d_o) * a.o + k(R::op2d_e) * e) +
                       i.np * (k(R::np_o) * a.o + k(R::np_to_op) * np_o2) + k(R::n2p_o_charge) * a.o * i.n2p,
                   k(R::op_n2) * a.n2 + k(R::op_o2) * a.o2 + diffusion, &IonDensities::op);
  i.leaving_cm3_s = diffusion * i.op;
  i.o2p = step.density(p.o2p +
                           a.o2 * (k(R::op_o2) * i.op + k(R::op2d_o2) * i.op2d + k(R::op2p_o2) * i.op2p +
                                   k(R::n2p_o2) * i.n2p) +
                           k(R::np_to_o2p) * np_o2 * i.np,
                       k.o2p_e() * e + k(R::o2p_no) * a.no + k(R::o2p_n) * a.n, &IonDensities::o2p);
  i.nop = step.density(k(R::op_n2) * a.n2 * i.op + k(R::n2p_o) * a.o * i.n2p +
                           a.no * (k(R::n2p_no) * i.n2p + k(R::np_no) * i.np + k(R::o2p_no) * i.o2p) +
                           k(R::np_to_nop) * np_o2 * i.np + k(R::o2p_n) * a.n * i.o2p,
                       k.nop_e() * e, &IonDensities::nop);
  return i;
}

}  // namespace

double diffusion_loss_s(const ReactingAir& air) {
  constexpr double kBoltzmann = 1.380649e-16, kMassG = 15.999 * 1.66053907e-24;  // CGS
  constexpr double kEarthCm = 1e5 * kEarthRadiusKm, kGravityCm = 981.0;
  const double r = kEarthCm / (kEarthCm + 1e5 * air.altitude_km), gravity = kGravityCm * r * r;
  const double temperatures_k = air.temperature_k + air.electron_temperature_k;
  const double scale_cm = kBoltzmann * temperatures_k / (kMassG * gravity);
  const double bend = 1.0 - 0.064 * std::log10(air.temperature_k);
  // N2 and O2 hinder O+ as well (6.82e-10 and 6.64e-10 of the same table).
  const double collisions_s =
      3.67e-11 * std::sqrt(air.temperature_k) * bend * bend * air.o + 6.82e-10 * air.n2 + 6.64e-10 * air.o2;
  constexpr double kMinS = 1e-12;
  return kBoltzmann * temperatures_k / (kMassG * std::max(kMinS, collisions_s)) / (scale_cm * scale_cm);
}

IonDensities night_ions(const ReactingAir& air) {
  // A layer of Chapman's form (alpha), of O+ where electrons live longest, and a floor of NO+.
  constexpr double kPeakCm3 = 1e5, kPeakKm = 300.0, kHeightKm = 50.0, kFloorCm3 = 2e3;
  const double z = (air.altitude_km - kPeakKm) / kHeightKm;
  IonDensities ions;
  ions.op = kPeakCm3 * std::exp(0.5 * (1.0 - z - std::exp(-z)));
  ions.nop = kFloorCm3;
  ions.electrons = ions.op + ions.nop;
  return ions;
}

IonHistory ion_history(const ReactingAir& air, const IonProduction& production, const Reactions& reactions,
                       double seconds, double night) {
  const bool is_steady = std::isinf(seconds);
  if (is_steady && production.all() <= 0.0) return {{}, {IonDensities{}}};
  const RatesAtPlace rates = reactions.at(air.temperature_k, air.electron_temperature_k);
  const double diffusion = diffusion_loss_s(air);
  const auto balance = [&](const TimeStep& step) {
    // In logarithms: the sum of ions over the electrons falls through 1.
    constexpr double kMin = 1e-12, kMax = 1e12;
    constexpr int kHalvings = 60;
    double low = std::log(kMin), high = std::log(kMax);
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high), electrons = std::exp(middle);
      (ions_among(air, production, rates, diffusion, electrons, step).ions() > electrons ? low : high) =
          middle;
    }
    return ions_among(air, production, rates, diffusion, std::exp(0.5 * (low + high)), step);
  };
  if (is_steady) return {{}, {balance({})}};
  // Steps grow by a half, as changes slow down.
  constexpr int kSteps = 8;
  constexpr double kGrowth = 1.5;
  IonDensities before = night_ions(air);
  for (double* density : {&before.op, &before.nop, &before.electrons}) *density *= night;
  IonHistory history{{}, {before}};
  double length_s = seconds * (kGrowth - 1.0) / (std::pow(kGrowth, kSteps) - 1.0);
  for (int s = 0; s < kSteps; ++s, length_s *= kGrowth) {
    history.step_s.push_back(length_s);
    history.ions.push_back(balance({history.ions.back(), 1.0 / length_s}));
  }
  return history;
}

IonDensities ion_balance(const ReactingAir& air, const IonProduction& production, const Reactions& reactions,
                         double seconds, double night) {
  return ion_history(air, production, reactions, seconds, night).ions.back();
}

double balanced_production(const ReactingAir& air, const IonProduction& production,
                           const Reactions& reactions, double electrons_cm3) {
  const RatesAtPlace rates = reactions.at(air.temperature_k, air.electron_temperature_k);
  return electrons_cm3 / ions_among(air, production, rates, diffusion_loss_s(air), electrons_cm3, {}).ions();
}

std::vector<double> atoms_since_onset(const std::vector<double>& step_s,
                                      const std::vector<double>& made_cm3_s,
                                      const std::vector<double>& losses_s) {
  assert(made_cm3_s.size() == step_s.size() + 1 && losses_s.size() == made_cm3_s.size());
  if (step_s.empty()) return {made_cm3_s.front() / losses_s.front()};
  std::vector<double> atoms = {0.0};
  for (std::size_t s = 0; s < step_s.size(); ++s) {
    const double lost = 0.5 * (losses_s[s] + losses_s[s + 1]) * step_s[s];
    // Means over the step of what is left of an atom made in it: of all, and of those made late.
    constexpr double kSmall = 1e-3;  // below, differences would cancel
    const double all = lost < kSmall ? 1.0 - lost * (0.5 - lost / 6.0) : -std::expm1(-lost) / lost;
    const double late = lost < kSmall ? 0.5 - lost * (1.0 / 6.0 - lost / 24.0) : (1.0 - all) / lost;
    atoms.push_back(std::exp(-lost) * atoms.back() +
                    step_s[s] * ((all - late) * made_cm3_s[s] + late * made_cm3_s[s + 1]));
  }
  return atoms;
}

}  // namespace vegard::sim
