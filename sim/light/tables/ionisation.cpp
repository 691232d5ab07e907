#include "sim/light/tables/ionisation.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

constexpr double kP[8][4] = {
    {1.24616, 1.45903, -2.42269e-1, 5.95459e-2},         {2.23976, -4.22918e-7, 1.36458e-2, 2.53332e-3},
    {1.41754, 1.44597e-1, 1.70433e-2, 6.39717e-4},       {2.48775e-1, -1.50890e-1, 6.30894e-9, 1.23707e-3},
    {-4.65119e-1, -1.05081e-1, -8.95701e-2, 1.22450e-2}, {3.86019e-1, 1.75430e-3, -7.42960e-4, 4.60881e-4},
    {-6.45454e-1, 8.49555e-4, -4.28581e-2, -2.99302e-3}, {9.48930e-1, 1.97385e-1, -2.50660e-3, -2.06938e-3}};
constexpr double kIonPairKev = 0.035;
constexpr double kKevPerErg = 6.241509074e8;  // 1 mW m^-2 = 1 erg cm^-2 s^-1
constexpr double kColumn = 6e-6;              // g cm^-2
constexpr double kMinKev = 0.05;
constexpr double kUnitG = 1.66053907e-24;  // of atomic mass
constexpr double kBoltzmannErgK = 1.380649e-16;
constexpr double kGravityCmS2 = 980.665;  // at sea level
constexpr double kMassO = 15.999, kMassO2 = 31.998, kMassN2 = 28.014;

/// Returns ln(A y^B exp(-C y^D)) for the four coefficients from `first` on, at ln(y), which falls as ln(E)
/// grows.
LogRate log_term(int first, double log_y, double log_energy) {
  const double least = std::log(kMinKev), l = std::max(log_energy, least);
  double log_c[4], slope[4];
  for (int i = 0; i < 4; ++i) {
    const double* p = kP[first + i];
    log_c[i] = p[0] + l * (p[1] + l * (p[2] + l * p[3]));
    slope[i] = log_energy > least ? p[1] + l * (2.0 * p[2] + l * 3.0 * p[3]) : 0.0;
  }
  const double b = std::exp(log_c[1]), d = std::exp(log_c[3]);
  const double depth = std::exp(log_c[2] + d * log_y);
  return {log_c[0] + b * log_y - depth,
          slope[0] + b * (slope[1] * log_y - 1.0) - depth * (slope[2] + d * (slope[3] * log_y - 1.0))};
}

LogRate log_dissipation(double log_y, double log_energy) {
  const LogRate a = log_term(0, log_y, log_energy), b = log_term(4, log_y, log_energy);
  // Summed so that neither can underflow: far below where they stop both are e to the minus thousands.
  const double larger = std::max(a.value, b.value);
  const double share_a = std::exp(a.value - larger), share_b = std::exp(b.value - larger);
  const double sum = share_a + share_b;
  return {larger + std::log(sum), (share_a * a.slope + share_b * b.slope) / sum};
}

}  // namespace

StoppingAir stopping_air(double altitude_km, double temperature_k, double n2_cm3, double o2_cm3,
                         double o_cm3) {
  const double density = kUnitG * (kMassO * o_cm3 + kMassO2 * o2_cm3 + kMassN2 * n2_cm3);
  const double mass = density / (o_cm3 + o2_cm3 + n2_cm3);
  const double out = 1.0 + altitude_km / kEarthRadiusKm;
  const double height = kBoltzmannErgK * temperature_k * out * out / (mass * kGravityCmS2);
  return {density * height, height};
}

LogRate log_ionisation(const StoppingAir& air, double energy_kev) {
  const double log_energy = std::log(energy_kev);
  const double log_y = std::log(2.0) - log_energy + 0.7 * std::log(air.mass_column_g_cm2 / kColumn);
  LogRate rate = log_dissipation(log_y, log_energy);
  rate.value += std::log(kKevPerErg / (kIonPairKev * air.scale_height_cm));
  return rate;
}

double energy_dissipation(double y, double energy_kev) {
  return std::exp(log_dissipation(std::log(y), std::log(energy_kev)).value);
}

}  // namespace vegard::sim
