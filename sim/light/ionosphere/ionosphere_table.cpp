#include "sim/light/ionosphere/ionosphere_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/light/chemistry/ion_balance.h"

namespace vegard::sim {
namespace {

constexpr double kEnergyStep = 0.35, kFluxStep = 1.2;  // of logarithms, at most
constexpr std::size_t kNodesOfCubic = 4;
constexpr double kCoarseEnergyStep = 2.7, kCoarseFluxStep = 6.0;
constexpr std::size_t kStride = 2;  // of altitudes, for draws
constexpr std::uint64_t kDrawSeed = 1;
// For logarithms of what is not there: 1 cm^-3; S m^-1 and W m^-3 that nothing depends on.
constexpr double kLeastDensity = 1.0, kLeastOther = 1e-20;

double least_of(std::size_t number) {
  return number <= static_cast<std::size_t>(IonosphereNumber::n2p) ? kLeastDensity : kLeastOther;
}

double ln_above(double value, double least) { return std::log(std::max(value, least)); }

/// Appends the logarithms of all numbers by altitude, and of the conductances.
void append_logs(const Ionosphere& of, std::vector<double>& ln) {
  for (std::size_t n = 0; n < kIonosphereNumbers; ++n)
    for (std::size_t a = 0; a < of.altitude_km.size(); ++a)
      ln.push_back(ln_above(ionosphere_number(of, static_cast<IonosphereNumber>(n), a), least_of(n)));
  ln.push_back(ln_above(of.pedersen_s, kLeastOther));
  ln.push_back(ln_above(of.hall_s, kLeastOther));
}

double night_cm3(double altitude_km) {
  ReactingAir place;
  place.altitude_km = altitude_km;
  return night_ions(place).electrons;
}

/// Half of the middle 68 % of values: a draw of a few seconds since the onset, or one whose largest density
/// is in another layer, is one of them and no more.
double half_of_the_middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(place), values.size() - 2);
    return values[low] + (place - static_cast<double>(low)) * (values[low + 1] - values[low]);
  };
  constexpr double kLow = 0.1587, kHigh = 0.8413;
  return 0.5 * (at(kHigh) - at(kLow));
}

double combined(double by_energy, double by_flux, const ElectronEstimate& of) {
  const double e = by_energy * of.ln_energy_sigma, q = by_flux * of.relative_flux_sigma;
  const double variance = e * e + q * q + 2.0 * of.correlation * e * q;
  return variance < 0.0 ? 0.0 : std::sqrt(variance);  // rounding below 0; NaN stays
}

}  // namespace

double ionosphere_number(const Ionosphere& of, IonosphereNumber number, std::size_t place) {
  const IonDensities& ions = of.ions[place];
  switch (number) {
    case IonosphereNumber::electrons:
      return ions.electrons;
    case IonosphereNumber::op:
      return ions.op + ions.op2d + ions.op2p;
    case IonosphereNumber::o2p:
      return ions.o2p;
    case IonosphereNumber::nop:
      return ions.nop;
    case IonosphereNumber::n2p:
      return ions.n2p;
    case IonosphereNumber::pedersen:
      return of.conductivity[place].pedersen;
    case IonosphereNumber::hall:
      return of.conductivity[place].hall;
    case IonosphereNumber::deposited:
      return of.deposited_w_m3(place);
  }
  return kNaN;
}

IonosphereTable::Axis IonosphereTable::Axis::over(double least, double most, double step, std::size_t nodes) {
  Axis axis;
  axis.count = std::max(nodes, static_cast<std::size_t>(std::ceil((most - least) / step)) + 1);
  axis.first = least;
  axis.step = (most - least) / static_cast<double>(axis.count - 1);
  return axis;
}

IonosphereTable::Weights IonosphereTable::weights_at(const Axis& axis, double at) {
  const double node = (at - axis.first) / axis.step;
  const auto most = static_cast<double>(axis.count - kNodesOfCubic);
  Weights weights;
  weights.lower = static_cast<std::size_t>(std::clamp(std::floor(node) - 1.0, 0.0, most));
  const double t = node - static_cast<double>(weights.lower);
  // Lagrange's polynomials through 0, 1, 2, 3, and their derivatives.
  for (std::size_t i = 0; i < kNodesOfCubic; ++i) {
    double product = 1.0, slope = 0.0, scale = 1.0;
    for (std::size_t j = 0; j < kNodesOfCubic; ++j) {
      if (j == i) continue;
      slope = slope * (t - static_cast<double>(j)) + product;
      product *= t - static_cast<double>(j);
      scale *= static_cast<double>(i) - static_cast<double>(j);
    }
    weights.value[i] = product / scale;
    weights.slope[i] = slope / scale / axis.step;
  }
  return weights;
}

IonosphereTable::IonosphereTable(const IonosphereModel& model, const Range& range, int draws, int threads)
    : altitudes_km_(model.altitudes_km()), is_steady_(model.is_steady()), has_draws_(draws > 1) {
  // A range of a point is widened: the derivatives need neighbours.
  const double ln_least = std::log(model.least_kev()), ln_most = std::log(model.most_kev());
  const double middle =
      std::clamp(0.5 * std::log(range.least_kev * range.most_kev), ln_least + 0.15, ln_most - 0.15);
  energy_ = Axis::over(std::max(ln_least, std::min(std::log(range.least_kev), middle - 0.15)),
                       std::min(ln_most, std::max(std::log(range.most_kev), middle + 0.15)), kEnergyStep,
                       kNodesOfCubic);
  const double least_flux = std::log(std::max(kLeastFlux, range.least_mw_m2)),
               most_flux = std::log(std::max(kLeastFlux, range.most_mw_m2)),
               flux = 0.5 * (least_flux + most_flux);
  flux_ =
      Axis::over(std::min(least_flux, flux - 0.3), std::max(most_flux, flux + 0.3), kFluxStep, kNodesOfCubic);
  std::vector<std::vector<double>> rows(energy_.count * flux_.count);
  parallel_for(rows.size(), threads, [&](std::size_t node, int) {
    append_logs(model.at(std::exp(energy_.at(node / flux_.count)), std::exp(flux_.at(node % flux_.count))),
                rows[node]);
  });
  for (const std::vector<double>& row : rows) ln_.insert(ln_.end(), row.begin(), row.end());
  if (has_draws_) draw(model, draws, threads);
}

void IonosphereTable::draw(const IonosphereModel& model, int draws, int threads) {
  const auto last = [](const Axis& axis) { return axis.at(axis.count - 1); };
  coarse_energy_ = Axis::over(energy_.first, last(energy_), kCoarseEnergyStep, 2);
  coarse_flux_ = Axis::over(flux_.first, last(flux_), kCoarseFluxStep, 2);
  const std::vector<double> thinned = model.altitudes_of_draws_km(kStride);
  const std::size_t nodes = coarse_energy_.count * coarse_flux_.count, all = static_cast<std::size_t>(draws);
  struct Drawn {
    std::vector<double> ln;
    double peak_km = 0.0;
  };
  std::vector<Drawn> drawn(nodes * all);
  parallel_for(drawn.size(), threads, [&](std::size_t i, int) {
    const std::size_t node = i / all;
    const Ionosphere of = model.drawn(std::exp(coarse_energy_.at(node / coarse_flux_.count)),
                                      std::exp(coarse_flux_.at(node % coarse_flux_.count)), kDrawSeed,
                                      static_cast<std::uint32_t>(i % all), kStride);
    append_logs(of, drawn[i].ln);
    drawn[i].peak_km = of.peak_km;
  });
  std::vector<double> values(all);
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto sigma_of = [&](const auto& value_of) {
      for (std::size_t d = 0; d < all; ++d) values[d] = value_of(drawn[node * all + d]);
      return half_of_the_middle(values);
    };
    for (std::size_t n = 0; n < kIonosphereNumbers; ++n)
      for (std::size_t a = 0; a < altitudes_km_.size(); ++a) {
        // Thinned altitudes are every second one; between two of them the mean.
        const std::size_t low = a / kStride, high = std::min(low + a % kStride, thinned.size() - 1);
        const auto at = [&](std::size_t place) {
          return sigma_of([&](const Drawn& of) { return of.ln[n * thinned.size() + place]; });
        };
        sigma_.push_back(low == high ? at(low) : 0.5 * (at(low) + at(high)));
      }
    for (std::size_t c = 0; c < 2; ++c)
      sigma_.push_back(
          sigma_of([&](const Drawn& of) { return of.ln[kIonosphereNumbers * thinned.size() + c]; }));
    std::vector<double> peaks;
    for (std::size_t d = 0; d < all; ++d)
      if (const double peak_km = drawn[node * all + d].peak_km; std::isfinite(peak_km))
        peaks.push_back(peak_km);
    sigma_.push_back(2 * peaks.size() > all ? half_of_the_middle(peaks) : kNaN);
  }
}

IonosphereTable::Place IonosphereTable::place_of(const ElectronEstimate& of) const {
  Place place;
  const double flux = of.energy_flux_mw_m2;
  if (!(flux >= 0.0)) return place;
  place.is_dark = flux == 0.0 && is_steady_;
  if (!std::isfinite(of.energy_kev) && flux > 0.0) return place;
  place.is_known = true;
  // What electrons of no flux would have for an energy does not matter.
  const double ln_energy =
      std::isfinite(of.energy_kev) ? std::log(of.energy_kev) : energy_.at(energy_.count / 2);
  const double ln_flux = std::log(std::max(kLeastFlux, flux));
  if (flux > 0.0 && flux < kLeastFlux && is_steady_) place.beyond = std::log(flux / kLeastFlux);
  const auto held = [](const Axis& axis, double at) {
    return std::clamp(at, axis.first, axis.at(axis.count - 1));
  };
  place.energy = weights_at(energy_, held(energy_, ln_energy));
  place.flux = weights_at(flux_, held(flux_, ln_flux));
  if (!has_draws_) return place;
  const auto coarse = [&](const Axis& axis, double at, std::size_t& lower, double& share) {
    const double node = (held(axis, at) - axis.first) / axis.step;
    lower = std::min(static_cast<std::size_t>(node), axis.count - 2);
    share = node - static_cast<double>(lower);
  };
  coarse(coarse_energy_, ln_energy, place.coarse_energy, place.coarse_energy_share);
  coarse(coarse_flux_, ln_flux, place.coarse_flux, place.coarse_flux_share);
  return place;
}

IonosphereTable::LnNumber IonosphereTable::ln_number(const Place& place, std::size_t index) const {
  LnNumber number;
  for (std::size_t e = 0; e < kNodesOfCubic; ++e) {
    double value = 0.0, slope = 0.0;
    for (std::size_t q = 0; q < kNodesOfCubic; ++q) {
      const double ln = ln_[((place.energy.lower + e) * flux_.count + place.flux.lower + q) * size() + index];
      value += place.flux.value[q] * ln;
      slope += place.flux.slope[q] * ln;
    }
    number.value += place.energy.value[e] * value;
    number.by_energy += place.energy.slope[e] * value;
    number.by_flux += place.energy.value[e] * slope;
  }
  number.value += place.beyond * number.by_flux;
  return number;
}

double IonosphereTable::physics_sigma(const Place& place, std::size_t index) const {
  if (!has_draws_) return 0.0;
  const auto at = [&](std::size_t e, std::size_t q) {
    return sigma_[((place.coarse_energy + e) * coarse_flux_.count + place.coarse_flux + q) * (size() + 1) +
                  index];
  };
  const double by_energy[] = {1.0 - place.coarse_energy_share, place.coarse_energy_share};
  const double by_flux[] = {1.0 - place.coarse_flux_share, place.coarse_flux_share};
  // A node whose draws have no peak has none of its errors.
  double sum = 0.0, weight = 0.0;
  for (std::size_t e = 0; e < 2; ++e)
    for (std::size_t q = 0; q < 2; ++q)
      if (const double sigma = at(e, q); std::isfinite(sigma)) {
        sum += by_energy[e] * by_flux[q] * sigma;
        weight += by_energy[e] * by_flux[q];
      }
  return weight > 0.5 ? sum / weight : kNaN;
}

KnownNumber IonosphereTable::known(const Place& place, const ElectronEstimate& electrons,
                                   std::size_t index) const {
  const LnNumber number = ln_number(place, index);
  const double value = std::exp(number.value);
  constexpr double kAboveLeast = 1.5;
  const std::size_t which = index / altitudes_km_.size();
  if (value < kAboveLeast * (which < kIonosphereNumbers ? least_of(which) : kLeastOther)) return {0.0, kNaN};
  const double relative =
      std::hypot(combined(number.by_energy, number.by_flux, electrons), physics_sigma(place, index));
  return {value, value * relative};
}

IonosphereEstimate IonosphereTable::at(const ElectronEstimate& electrons) const {
  const Place place = place_of(electrons);
  constexpr KnownNumber kUnknown{kNaN, kNaN}, kNothing{0.0, kNaN};
  if (!place.is_known) return {kUnknown, kUnknown, kUnknown, kUnknown, kNaN, kNaN};
  if (place.is_dark) return {kNothing, kNothing, kNothing, kUnknown, kNaN, kNaN};
  const std::size_t altitudes = altitudes_km_.size(), pedersen = kIonosphereNumbers * altitudes;
  IonosphereEstimate estimate;
  estimate.pedersen_s = known(place, electrons, pedersen);
  estimate.hall_s = known(place, electrons, pedersen + 1);
  estimate.pedersen_physics_sigma = estimate.pedersen_s.value * physics_sigma(place, pedersen);
  estimate.hall_physics_sigma = estimate.hall_s.value * physics_sigma(place, pedersen + 1);
  // The peak of the densities here, and how it moves with the electrons.
  std::vector<double> here, by_energy, by_flux;
  constexpr double kSmall = 0.05;
  for (std::size_t a = 0; a < altitudes; ++a) {
    const LnNumber ln = ln_number(place, a);
    here.push_back(ln.value);
    by_energy.push_back(ln.value + kSmall * ln.by_energy);
    by_flux.push_back(ln.value + kSmall * ln.by_flux);
  }
  const DensityPeak peak = density_peak(altitudes_km_, here), harder = density_peak(altitudes_km_, by_energy),
                    brighter = density_peak(altitudes_km_, by_flux);
  const auto at_peak = static_cast<std::size_t>(std::max_element(here.begin(), here.end()) - here.begin());
  const auto way = [&](double now) { return (now - peak.altitude_km) / kSmall; };
  const double cm3 = std::exp(peak.ln);
  estimate.peak_cm3 = estimate.peak_km = kUnknown;
  if (!is_steady_ && cm3 < kAboveNight * night_cm3(peak.altitude_km)) return estimate;
  estimate.peak_cm3 = {cm3, cm3 * std::hypot(combined((harder.ln - peak.ln) / kSmall,
                                                      (brighter.ln - peak.ln) / kSmall, electrons),
                                             physics_sigma(place, at_peak))};
  estimate.peak_km = {peak.altitude_km,
                      std::hypot(combined(way(harder.altitude_km), way(brighter.altitude_km), electrons),
                                 physics_sigma(place, size()))};
  return estimate;
}

std::vector<KnownNumber> IonosphereTable::profile(const ElectronEstimate& electrons,
                                                  IonosphereNumber number) const {
  const Place place = place_of(electrons);
  std::vector<KnownNumber> values(altitudes_km_.size(), KnownNumber{place.is_dark ? 0.0 : kNaN, kNaN});
  if (!place.is_known || place.is_dark) return values;
  for (std::size_t a = 0; a < values.size(); ++a)
    values[a] = known(place, electrons, static_cast<std::size_t>(number) * values.size() + a);
  return values;
}

}  // namespace vegard::sim
