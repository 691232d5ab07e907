#include "sim/light/tables/ionisation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

constexpr double kP[8][4] = {
    {1.24616, 1.45903, -2.42269e-1, 5.95459e-2},         {2.23976, -4.22918e-7, 1.36458e-2, 2.53332e-3},
    {1.41754, 1.44597e-1, 1.70433e-2, 6.39717e-4},       {2.48775e-1, -1.50890e-1, 6.30894e-9, 1.23707e-3},
    {-4.65119e-1, -1.05081e-1, -8.95701e-2, 1.22450e-2}, {3.86019e-1, 1.75430e-3, -7.42960e-4, 4.60881e-4},
    {-6.45454e-1, 8.49555e-4, -4.28581e-2, -2.99302e-3}, {9.48930e-1, 1.97385e-1, -2.50660e-3, -2.06938e-3}};
constexpr double kProtonP[12][4] = {
    {2.55050, 2.69476e-1, -2.58425e-1, 4.43190e-2},     {6.39287e-1, -1.85817e-1, -3.15636e-2, 1.01370e-2},
    {1.63996, 2.43580e-1, 4.29873e-2, 3.77803e-2},      {-2.13479e-1, 1.42464e-1, 1.55840e-2, 1.97407e-3},
    {-1.65764e-1, 3.39654e-1, -9.87971e-3, 4.02411e-3}, {-3.59358e-2, 2.50330e-2, -3.29365e-2, 5.08057e-3},
    {-6.26528e-1, 1.46865, 2.51853e-1, -4.57132e-2},    {1.01384, 5.94301e-2, -3.27839e-2, 3.42688e-3},
    {-1.29454e-6, -1.43623e-1, 2.82583e-1, 8.29809e-2}, {-1.18622e-1, 1.79191e-1, 6.49171e-2, -3.99715e-3},
    {2.94890, -5.75821e-1, 2.48563e-2, 8.31078e-2},     {-1.89515e-1, 3.53452e-2, 7.77964e-2, -4.06034e-3}};
constexpr double kIonPairKev = 0.035;
constexpr double kKevPerErg = 6.241509074e8;            // 1 mW m^-2 = 1 erg cm^-2 s^-1
constexpr double kColumn = 6e-6, kProtonColumn = 1e-4;  // g cm^-2
constexpr double kUnitG = 1.66053907e-24;               // of atomic mass
constexpr double kBoltzmannErgK = 1.380649e-16;
constexpr double kGravityCmS2 = 980.665;  // at sea level
constexpr double kMassO = 15.999, kMassO2 = 31.998, kMassN2 = 28.014;

/// A fit of f(y) by terms of four coefficients each.
struct Dissipation {
  const double (*p)[4];
  int terms;
  double min_kev;  ///< below it the polynomials would diverge
};
constexpr Dissipation kElectrons = {kP, 2, 0.05}, kProtons = {kProtonP, 3, 0.1};

/// Returns ln(A y^B exp(-C y^D)) for a term, at ln(y), which falls as ln(E) grows.
LogRate log_term(const Dissipation& of, int term, double log_y, double log_energy) {
  const double least = std::log(of.min_kev), l = std::max(log_energy, least);
  double log_c[4], slope[4];
  for (int i = 0; i < 4; ++i) {
    const double* p = of.p[4 * term + i];
    log_c[i] = p[0] + l * (p[1] + l * (p[2] + l * p[3]));
    slope[i] = log_energy > least ? p[1] + l * (2.0 * p[2] + l * 3.0 * p[3]) : 0.0;
  }
  const double b = std::exp(log_c[1]), d = std::exp(log_c[3]);
  const double depth = std::exp(log_c[2] + d * log_y);
  return {log_c[0] + b * log_y - depth,
          slope[0] + b * (slope[1] * log_y - 1.0) - depth * (slope[2] + d * (slope[3] * log_y - 1.0))};
}

LogRate log_dissipation(const Dissipation& of, double log_y, double log_energy) {
  constexpr int kMostTerms = 3;
  LogRate terms[kMostTerms];
  double largest = -std::numeric_limits<double>::infinity(), sum = 0.0, slope = 0.0;
  for (int t = 0; t < of.terms; ++t) {
    terms[t] = log_term(of, t, log_y, log_energy);
    largest = std::max(largest, terms[t].value);
  }
  // Summed so that none can underflow: far below where they stop all are e to the minus thousands.
  for (int t = 0; t < of.terms; ++t) {
    const double share = std::exp(terms[t].value - largest);
    sum += share;
    slope += share * terms[t].slope;
  }
  return {largest + std::log(sum), slope / sum};
}

LogRate log_pairs(LogRate dissipation, double scale_height_cm) {
  dissipation.value += std::log(kKevPerErg / (kIonPairKev * scale_height_cm));
  return dissipation;
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
  return log_pairs(log_dissipation(kElectrons, log_y, log_energy), air.scale_height_cm);
}

double energy_dissipation(double y, double energy_kev) {
  return std::exp(log_dissipation(kElectrons, std::log(y), std::log(energy_kev)).value);
}

LogRate log_proton_ionisation(const StoppingAir& air, double energy_kev) {
  const double log_energy = std::log(energy_kev);
  const double log_y = std::log(7.5) - log_energy + 0.9 * std::log(air.mass_column_g_cm2 / kProtonColumn);
  return log_pairs(log_dissipation(kProtons, log_y, log_energy), air.scale_height_cm);
}

double proton_energy_dissipation(double y, double energy_kev) {
  return std::exp(log_dissipation(kProtons, std::log(y), std::log(energy_kev)).value);
}

}  // namespace vegard::sim
