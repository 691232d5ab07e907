#include "sim/light/ionosphere/recombination.h"

#include <cmath>

namespace vegard::sim {

Recombination balance_recombination(const ReactingAir& air, const IonospherePhysics& physics,
                                    double electrons_cm3) {
  constexpr double kPairs = 1.0, kStep = 1e-3;
  const IonProduction production = ion_production(kPairs, air, physics);
  const auto ln_coefficient = [&](double ln_density) {
    const double density = std::exp(ln_density);
    return std::log(balanced_production(air, production, physics.reactions, density) * production.all()) -
           2.0 * ln_density;
  };
  const double ln_density = std::log(electrons_cm3);
  return {std::exp(ln_coefficient(ln_density)),
          (ln_coefficient(ln_density + kStep) - ln_coefficient(ln_density - kStep)) / (2.0 * kStep)};
}

double vickrey_recombination_cm3_s(double altitude_km) {
  constexpr double kGround = 2.5e-6, kHeightKm = 51.2;
  return kGround * std::exp(-altitude_km / kHeightKm);
}

GrownDensity grown_density(double pairs_cm3_s, double recombination_cm3_s, double before_cm3,
                           double seconds) {
  const double steady = std::sqrt(pairs_cm3_s / recombination_cm3_s),
               tau = seconds * std::sqrt(pairs_cm3_s * recombination_cm3_s), r = before_cm3 / steady;
  const double t = std::tanh(tau), below = 1.0 + r * t, rest = 1.0 - t * t;
  GrownDensity grown;
  DensityWithSlopes& end = grown.end;
  end.value = steady * (r + t) / below;
  const double end_by_r = steady * rest / (below * below), end_by_tau = end_by_r * (1.0 - r * r);
  end.by_before = r * end_by_r;
  end.by_pairs = 0.5 * (end.value - r * end_by_r + tau * end_by_tau);
  end.by_recombination = 0.5 * (-end.value + r * end_by_r + tau * end_by_tau);

  // ln(cosh tau + r sinh tau), without cancellation for a short time, nor overflow for a long one.
  constexpr double kShort = 1.0;
  const double half = std::sinh(0.5 * tau);
  const double logarithm = tau < kShort
                               ? std::log1p(2.0 * half * half + r * std::sinh(tau))
                               : tau + std::log(0.5 * ((1.0 + r) + (1.0 - r) * std::exp(-2.0 * tau)));
  const double scale = 1.0 / (recombination_cm3_s * seconds);
  DensityWithSlopes& mean = grown.mean;
  mean.value = scale * logarithm;
  const double mean_by_r = scale * t / below, mean_by_tau = scale * (t + r) / below;
  mean.by_before = r * mean_by_r;
  mean.by_pairs = 0.5 * (-r * mean_by_r + tau * mean_by_tau);
  mean.by_recombination = -mean.value + 0.5 * (r * mean_by_r + tau * mean_by_tau);
  return grown;
}

}  // namespace vegard::sim
