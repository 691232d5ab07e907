#include "sim/light/chemistry/ion_balance.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

double over(double production, double loss) { return production > 0.0 ? production / loss : 0.0; }

/// Returns all ions for a given density of thermal electrons.
IonDensities ions_among(const ReactingAir& a, const IonProduction& p, const RatesAtPlace& k, double diffusion,
                        double electrons) {
  using R = Reaction;
  IonDensities i;
  i.electrons = electrons;
  const double e = electrons;
  i.op2p = over(p.op2p, k(R::op2p_light_4s) + k(R::op2p_light_2d) + k(R::op2p_n2) * a.n2 +
                            k(R::op2p_o2) * a.o2 + k(R::op2p_o) * a.o + k(R::op2p_e) * e);
  i.op2d = over(p.op2d + i.op2p * (k(R::op2p_light_2d) + k(R::op2p_o) * a.o + k(R::op2p_e) * e),
                k(R::op2d_n2) * a.n2 + k(R::op2d_o2) * a.o2 + k(R::op2d_o) * a.o + k(R::op2d_e) * e);
  const double np_o2 = k(R::np_o2) * a.o2;
  i.np = over(p.np, np_o2 + k(R::np_o) * a.o + k(R::np_no) * a.no);
  i.n2p = over(
      p.n2p + a.n2 * (k(R::op2d_n2) * i.op2d + k(R::op2p_n2) * i.op2p),
      (k(R::n2p_o) + k(R::n2p_o_charge)) * a.o + k(R::n2p_o2) * a.o2 + k(R::n2p_no) * a.no + k(R::n2p_e) * e);
  i.op = over(p.op + k(R::op2p_light_4s) * i.op2p + i.op2d * (k(R::op2d_o) * a.o + k(R::op2d_e) * e) +
                  i.np * (k(R::np_o) * a.o + k(R::np_to_op) * np_o2) + k(R::n2p_o_charge) * a.o * i.n2p,
              k(R::op_n2) * a.n2 + k(R::op_o2) * a.o2 + diffusion);
  i.leaving_cm3_s = diffusion * i.op;
  i.o2p = over(p.o2p +
                   a.o2 * (k(R::op_o2) * i.op + k(R::op2d_o2) * i.op2d + k(R::op2p_o2) * i.op2p +
                           k(R::n2p_o2) * i.n2p) +
                   k(R::np_to_o2p) * np_o2 * i.np,
               k.o2p_e() * e + k(R::o2p_no) * a.no + k(R::o2p_n) * a.n);
  i.nop = over(k(R::op_n2) * a.n2 * i.op + k(R::n2p_o) * a.o * i.n2p +
                   a.no * (k(R::n2p_no) * i.n2p + k(R::np_no) * i.np + k(R::o2p_no) * i.o2p) +
                   k(R::np_to_nop) * np_o2 * i.np + k(R::o2p_n) * a.n * i.o2p,
               k.nop_e() * e);
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

IonDensities ion_balance(const ReactingAir& air, const IonProduction& production,
                         const Reactions& reactions) {
  if (production.all() <= 0.0) return {};
  const RatesAtPlace rates = reactions.at(air.temperature_k, air.electron_temperature_k);
  const double diffusion = diffusion_loss_s(air);
  // In logarithms: the sum of ions over the electrons falls through 1.
  constexpr double kMin = 1e-12, kMax = 1e12;
  constexpr int kHalvings = 60;
  double low = std::log(kMin), high = std::log(kMax);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high), electrons = std::exp(middle);
    (ions_among(air, production, rates, diffusion, electrons).ions() > electrons ? low : high) = middle;
  }
  return ions_among(air, production, rates, diffusion, std::exp(0.5 * (low + high)));
}

}  // namespace vegard::sim
