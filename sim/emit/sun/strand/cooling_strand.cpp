#include "sim/emit/sun/strand/cooling_strand.h"

namespace vegard::sim {
namespace {

constexpr double kBoltzmann_erg_k = 1.380649e-16, kConductivity = 1e-6, kRadiation = 6e-20;

template <class T>
T power(const T& base, double exponent) {
  return exponential(logarithm(base) * exponent);
}

template <class T>
T radiation_s(const T& temperature_k, const T& density_cm3) {
  return power(temperature_k, 1.5) / density_cm3 * (3.0 * kBoltzmann_erg_k / kRadiation);
}

}  // namespace

template <class T>
CoolingStrand<T>::CoolingStrand(const T& temperature_k, const T& density_cm3, const T& half_length_cm)
    : hot_k_(temperature_k),
      hot_cm3_(density_cm3),
      tau_c_(density_cm3 * half_length_cm * half_length_cm / power(temperature_k, 2.5) *
             (3.0 * kBoltzmann_erg_k / kConductivity)),
      until_s_(0.0),
      cooler_k_(temperature_k),
      denser_cm3_(density_cm3) {
  const T ratio = radiation_s(hot_k_, hot_cm3_) / tau_c_;
  T while_conducting(0.0);
  if (value_of(ratio) > 1.0) {
    const T sixth = power(ratio, 1.0 / 6.0), grown = power(ratio, 7.0 / 12.0);  // grown: 1 + t' / tau_c
    until_s_ = tau_c_ * (grown - 1.0);
    cooler_k_ = hot_k_ / sixth;
    denser_cm3_ = hot_cm3_ * sixth;
    while_conducting = hot_cm3_ * hot_cm3_ * tau_c_ * (power(grown, 11.0 / 7.0) - 1.0) * (7.0 / 11.0);
  }
  tau_r_ = radiation_s(cooler_k_, denser_cm3_);
  lifetime_s_ = until_s_ + tau_r_ * (2.0 / 3.0);
  // n² goes as T, so that with u from 1 to 0 it is the integral of u^(2/3) over 2/3 tau'.
  square_density_s_ = while_conducting + denser_cm3_ * denser_cm3_ * tau_r_ * (2.0 / 3.0 * 0.6);
}

template <class T>
typename CoolingStrand<T>::State CoolingStrand<T>::at(const T& since_s) const {
  if (value_of(since_s) < value_of(until_s_)) {
    const T cooled = power(since_s / tau_c_ + 1.0, 2.0 / 7.0);
    return {hot_k_ / cooled, hot_cm3_ * cooled};
  }
  const T left = T(1.0) - (since_s - until_s_) * 1.5 / tau_r_;
  if (!(value_of(left) > 0.0)) return {T(0.0), T(0.0)};
  const T share = power(left, 2.0 / 3.0);
  return {cooler_k_ * share, denser_cm3_ * square_root(share)};
}

template class CoolingStrand<double>;
template class CoolingStrand<FreeDual>;

}  // namespace vegard::sim
