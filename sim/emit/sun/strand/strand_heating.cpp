#include "sim/emit/sun/strand/strand_heating.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/number/gauss_quadrature.h"
#include "sim/base/number/random.h"
#include "sim/base/number/vec3.h"
#include "sim/emit/sun/line_light.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

constexpr int kWordsOfCell = 12;  // of which one is the number of flares and 11 are their times
constexpr double kKPerMk = 1e6;

/// Poisson's of mean 1: of 11 or more there are 1e-8, which are taken as 11.
int poisson_count(double chance) {
  double term = std::exp(-1.0), sum = term;
  int count = 0;
  while (chance > sum && count < kWordsOfCell - 1) {
    ++count;
    term /= count;
    sum += term;
  }
  return count;
}

template <class T>
T length_of(const Strand<T>& strand) {
  static const GaussLegendre<12> nodes;  // of |dB / du|
  T sum(0.0);
  for (int n = 0; n < 12; ++n) {
    const double u = nodes.place[n], v = 1.0 - u;
    Vec3<T> speed = times3(minus3(strand.points[1], strand.points[0]), 3.0 * v * v);
    speed = along3(speed, 6.0 * u * v, minus3(strand.points[2], strand.points[1]));
    speed = along3(speed, 3.0 * u * u, minus3(strand.points[3], strand.points[2]));
    sum = sum + length3(speed) * nodes.weight[n];
  }
  return sum;
}

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

std::vector<double> flare_times_s(const Loop& loop, std::uint64_t seed, int strand, double from_s,
                                  double to_s) {
  const double interval = loop.heating_interval_s;
  std::vector<double> times;
  const auto last = static_cast<std::int64_t>(std::floor(to_s / interval));
  for (auto cell = static_cast<std::int64_t>(std::floor(from_s / interval)); cell <= last; ++cell) {
    const auto word = [&](int which) {
      const auto block = static_cast<std::uint32_t>(cell * (kWordsOfCell / 4) + which / 4);
      return random_words(seed, Stream::flare, static_cast<std::uint32_t>(strand), name_number(loop.name),
                          block)[which % 4];
    };
    const int count = poisson_count(uniform(word(0)));
    for (int k = 1; k <= count; ++k)
      times.push_back((static_cast<double>(cell) + uniform(word(k))) * interval);
  }
  return times;
}

template <class T>
void heat_strands(const Scene& scene, const Loop& loop, const std::vector<double>& instants_s,
                  const NumberAs<T>& number, Strands<T>& strands) {
  std::vector<std::optional<TemperatureResponse>> response;
  for (const double line : scene.emission.lines) response.push_back(temperature_response(line));
  const double cm_per_unit = scene.sun.unit_km * kCmPerKm;
  const T hot_k = number(loop.heating_temperature_mk) * kKPerMk, density = number(loop.heating_density_cm3);
  const auto [earliest, latest] = std::minmax_element(instants_s.begin(), instants_s.end());
  const double per_instant = 1.0 / static_cast<double>(instants_s.size());
  for (std::size_t k = 0; k < strands.all.size(); ++k) {
    Strand<T>& strand = strands.all[k];
    const CoolingStrand<T> cooling(hot_k, density, length_of(strand) * (0.5 * cm_per_unit));
    const T per_flare = T(loop.heating_interval_s * per_instant) / cooling.square_density_s();
    strand.line_gain.assign(response.size(), T(0.0));
    for (const double flare : flare_times_s(loop, scene.seed, static_cast<int>(k),
                                            *earliest - value_of(cooling.lifetime_s()), *latest))
      for (const double instant : instants_s) {
        const double since = instant - flare;
        if (since < 0.0 || since >= value_of(cooling.lifetime_s())) continue;
        const auto now = cooling.at(T(since));
        const T measure = now.density_cm3 * now.density_cm3 * per_flare;
        for (std::size_t l = 0; l < response.size(); ++l) {
          T& gain = strand.line_gain[l];
          gain =
              gain + (response[l] ? measure * response_at(*response[l], now.temperature_k * (1.0 / kKPerMk))
                                  : measure);
        }
      }
  }
}

template void heat_strands(const Scene&, const Loop&, const std::vector<double>&, const NumberAs<double>&,
                           Strands<double>&);
template void heat_strands(const Scene&, const Loop&, const std::vector<double>&, const NumberAs<FreeDual>&,
                           Strands<FreeDual>&);

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
