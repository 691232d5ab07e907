#include "sim/light/ionosphere/conductivity.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace vegard::sim {
namespace {

// SI, CODATA 2018.
constexpr double kChargeC = 1.602176634e-19, kElectronKg = 9.1093837015e-31, kUnitKg = 1.66053906660e-27;
constexpr double kOxygenU = 15.999, kNitrogenU = 14.007;
constexpr double kPerM3 = 1e6, kTeslaPerNt = 1e-9;

/// The frequency over the density of the ion's own gas, cm^3 s^-1.
double charge_exchange(double coefficient, double bend, double temperature_k) {
  const double straight = 1.0 - bend * std::log10(temperature_k);
  return coefficient * std::sqrt(temperature_k) * straight * straight;
}

/// One kind of charge.
struct Charges {
  double cm3 = 0.0, kg = 0.0, collisions_s = 0.0;
};

}  // namespace

double ion_gyrofrequency_s(double mass_u, double field_nt) {
  return kChargeC * kTeslaPerNt * field_nt / (mass_u * kUnitKg);
}

CollisionFrequencies collision_frequencies(const ReactingAir& a, double electrons_cm3) {
  constexpr double kO2Dipole = 4.08e-10;  // 2.21 pi 0.5 sqrt(1.59e-24 e^2/(16 u)), cm^3 s^-1
  const double tr = a.temperature_k, te = a.electron_temperature_k, root = std::sqrt(te);
  CollisionFrequencies nu;
  nu.op = charge_exchange(3.67e-11, 0.064, tr) * a.o + 6.82e-10 * a.n2 + 6.64e-10 * a.o2;
  nu.o2p =
      std::max(kO2Dipole, charge_exchange(2.59e-11, 0.073, tr)) * a.o2 + 4.13e-10 * a.n2 + 2.31e-10 * a.o;
  nu.nop = 4.34e-10 * a.n2 + 4.27e-10 * a.o2 + 2.44e-10 * a.o;
  nu.n2p = charge_exchange(5.14e-11, 0.069, tr) * a.n2 + 4.49e-10 * a.o2 + 2.58e-10 * a.o;
  nu.np = 7.47e-10 * a.n2 + 7.25e-10 * a.o2 + 4.42e-10 * a.o;
  // The fit of N2 is for electrons below some 4000 K; hotter ones must not be slowed by less than nothing.
  nu.electrons = 2.33e-11 * a.n2 * std::max(0.0, 1.0 - 1.21e-4 * te) * te +
                 1.82e-10 * a.o2 * (1.0 + 3.6e-2 * root) * root + 8.9e-11 * a.o * (1.0 + 5.7e-4 * te) * root;
  nu.electrons_with_ions = 54.5 * electrons_cm3 / (te * root);
  return nu;
}

Conductivity conductivity(const ReactingAir& air, const IonDensities& ions, double field_nt,
                          const CollisionFactors& factors) {
  const CollisionFrequencies nu = collision_frequencies(air, ions.electrons);
  const double field_t = kTeslaPerNt * field_nt;
  Conductivity sigma;
  double drifting = 0.0;  // charges that follow the electric drift: electrons less ions, m^-3
  const auto add = [&](const Charges& of, double sign) {
    if (of.cm3 <= 0.0) return;
    const double m3 = kPerM3 * of.cm3, r = of.collisions_s * of.kg / (kChargeC * field_t);
    sigma.pedersen += m3 * r / (1.0 + r * r);
    drifting += sign * m3 / (1.0 + r * r);
  };
  const double all_op = ions.op + ions.op2d + ions.op2p;
  for (const Charges& of : {Charges{all_op, kOxygenU, nu.op},
                            {ions.o2p, 2.0 * kOxygenU, nu.o2p},
                            {ions.nop, kNitrogenU + kOxygenU, nu.nop},
                            {ions.n2p, 2.0 * kNitrogenU, nu.n2p},
                            {ions.np, kNitrogenU, nu.np}}) {
    const Charges scaled{of.cm3, of.kg * kUnitKg, of.collisions_s * factors.ions};
    add(scaled, -1.0);
    if (scaled.cm3 > 0.0)
      sigma.parallel += kPerM3 * scaled.cm3 * kChargeC * kChargeC / (scaled.kg * scaled.collisions_s);
  }
  const double electrons_s = nu.electrons * factors.electrons;
  add({ions.electrons, kElectronKg, electrons_s}, 1.0);
  if (ions.electrons > 0.0)
    sigma.parallel += kPerM3 * ions.electrons * kChargeC * kChargeC /
                      (kElectronKg * (electrons_s + nu.electrons_with_ions));
  sigma.pedersen *= kChargeC / field_t;
  sigma.hall = kChargeC / field_t * drifting;
  return sigma;
}

}  // namespace vegard::sim
