#include "sim/light/ionosphere/ionosphere.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/base/number/constants.h"
#include "sim/light/field/igrf.h"

namespace vegard::sim {
namespace {

constexpr const char* kPairsColumn = "ionisation_electron";
constexpr double kFloorOfMost = 1.5e-6;
constexpr double kJoulePerEv = 1.602176634e-19;

/// Takes off what the tables raise all rates to.
std::vector<double> known_pairs(std::vector<double> pairs) {
  const double floor = kFloorOfMost * *std::max_element(pairs.begin(), pairs.end());
  for (double& rate : pairs) rate = std::max(0.0, rate - floor);
  return pairs;
}

std::vector<ElectronPiece> pieces_of(const EmissionTables& tables, const ElectronSpectrum& spectrum,
                                     double energy_kev) {
  switch (spectrum.kind) {
    case ElectronSpectrum::Kind::gaussian:
      return gaussian_pieces(energy_kev, spectrum.spread);
    case ElectronSpectrum::Kind::kappa:
      return kappa_pieces({tables}, energy_kev, spectrum.kappa);
    default:
      return {{energy_kev, 1.0, 1.0, 0.0}};
  }
}

double mass_density(const ReactingAir& air) { return 28.014 * air.n2 + 31.998 * air.o2 + 15.999 * air.o; }

/// The place in increasing values: linear between them, and beyond their ends as at the end.
struct Between {
  std::size_t lower = 0;
  double upper_share = 0.0;
};
Between between_rising(const std::vector<double>& values, double at) {
  const auto after = std::upper_bound(values.begin() + 1, values.end() - 1, at);
  const auto upper = static_cast<std::size_t>(after - values.begin());
  return {upper - 1, std::clamp((at - values[upper - 1]) / (values[upper] - values[upper - 1]), 0.0, 1.0)};
}

}  // namespace

IonosphereAir ionosphere_air(const AirTable& table, const std::vector<double>& altitudes_km,
                             const FieldPlace& place) {
  const AirTable at = air_at(table, altitudes_km);
  const Igrf igrf(place.year);
  IonosphereAir air;
  for (std::size_t i = 0; i < altitudes_km.size(); ++i) {
    air.places.push_back({altitudes_km[i], at.temperature_k[i], at.electron_temperature_k[i],
                          at.density_cm3[static_cast<std::size_t>(Gas::n2)][i],
                          at.density_cm3[static_cast<std::size_t>(Gas::o2)][i],
                          at.density_cm3[static_cast<std::size_t>(Gas::o)][i], at.no_cm3[i], at.n_cm3[i]});
    const ReactingAir& here = air.places.back();
    air.stopping.push_back(stopping_air(here.altitude_km, here.temperature_k, here.n2, here.o2, here.o));
    const FieldVector field = igrf.at(place.latitude_deg, place.longitude_deg, altitudes_km[i]);
    air.field_nt.push_back(std::hypot(field.north_nt, field.east_nt, field.down_nt));
  }
  return air;
}

std::vector<double> ion_pairs(const EmissionTables& tables, const ElectronSpectrum& spectrum,
                              double energy_kev, double energy_flux_mw_m2, double oxygen_factor) {
  std::vector<double> pairs;
  if (spectrum.kind == ElectronSpectrum::Kind::maxwellian) {
    for (const Emission1d& made : tables.maxwellian().at_energy(kPairsColumn, energy_kev, oxygen_factor))
      pairs.push_back(energy_flux_mw_m2 * made.rate);
    return known_pairs(std::move(pairs));
  }
  pairs.assign(tables.mono().altitudes_km().size(), 0.0);
  for (const ElectronPiece& piece : pieces_of(tables, spectrum, energy_kev)) {
    const std::vector<MonoRate> rates =
        tables.mono().at_energy(kPairsColumn, piece.energy_kev, oxygen_factor);
    for (std::size_t a = 0; a < pairs.size(); ++a)
      pairs[a] += energy_flux_mw_m2 * piece.share * std::exp(rates[a].value);
  }
  return known_pairs(std::move(pairs));
}

std::vector<double> moved_ion_pairs(const std::vector<double>& pairs, const IonosphereAir& from,
                                    const IonosphereAir& to) {
  assert(pairs.size() == from.places.size());
  constexpr double kFaint = 1e-60, kNone = 1e-12;  // for logarithms; cm^-3 s^-1 that make no ion a day
  // By increasing mass column, from the top down.
  std::vector<double> ln_column, ln_per_mass;
  for (std::size_t i = pairs.size(); i-- > 0;) {
    ln_column.push_back(std::log(from.stopping[i].mass_column_g_cm2));
    ln_per_mass.push_back(std::log(std::max(kFaint, pairs[i] / mass_density(from.places[i]))));
  }
  std::vector<double> moved;
  for (std::size_t i = 0; i < to.places.size(); ++i) {
    const Between at = between_rising(ln_column, std::log(to.stopping[i].mass_column_g_cm2));
    const double low = ln_per_mass[at.lower], high = ln_per_mass[at.lower + 1];
    const double rate = std::exp(low + at.upper_share * (high - low)) * mass_density(to.places[i]);
    moved.push_back(rate > kNone ? rate : 0.0);
  }
  return moved;
}

IonProduction ion_production(double pairs_cm3_s, const ReactingAir& air, const IonospherePhysics& physics) {
  constexpr double kN2 = 0.92, kO2 = 1.0, kO = 0.56;
  // The states of O+: weights over thresholds in eV.
  constexpr double k4s = 1.0 / 3.0 / 13.62, k2d = 5.0 / 12.0 / 16.94, k2p = 0.25 / 18.63;
  constexpr double kStates = k4s + k2d + k2p;
  const double weight = kN2 * air.n2 + kO2 * air.o2 + kO * air.o;
  IonProduction made;
  if (!(weight > 0.0) || !(pairs_cm3_s > 0.0)) return made;
  const double pair = pairs_cm3_s / weight;
  const double n2 = pair * kN2 * air.n2 * physics.ionisation[0],
               o2 = pair * kO2 * air.o2 * physics.ionisation[1],
               o = pair * kO * air.o * physics.ionisation[2];
  const double np_share = physics.reactions.value(Reaction::np_share),
               op_share = physics.reactions.value(Reaction::op_share);
  made.np = np_share * n2;
  made.n2p = n2 - made.np;
  made.o2p = (1.0 - op_share) * o2;
  made.op = op_share * o2 + k4s / kStates * o;
  made.op2d = k2d / kStates * o;
  made.op2p = k2p / kStates * o;
  return made;
}

double Ionosphere::deposited_w_m3(std::size_t place) const {
  constexpr double kPerM3 = 1e6;
  return kPerM3 * kEvPerIonPair * kJoulePerEv * pairs_cm3_s[place];
}

double Ionosphere::deposited_mw_m2() const {
  constexpr double kMilli = 1e3;
  std::vector<double> watts;
  for (std::size_t i = 0; i < altitude_km.size(); ++i) watts.push_back(deposited_w_m3(i));
  return kMilli * height_integral(altitude_km, watts);
}

Ionosphere ionosphere(const IonosphereAir& air, const std::vector<double>& pairs_cm3_s,
                      const IonospherePhysics& physics) {
  assert(pairs_cm3_s.size() == air.places.size());
  Ionosphere result;
  result.pairs_cm3_s = pairs_cm3_s;
  constexpr double kNoneCm3 = 1e-30;  // for logarithms
  const bool is_steady = std::isinf(physics.seconds);
  std::vector<double> ln_electrons, pedersen, hall;
  for (std::size_t i = 0; i < air.places.size(); ++i) {
    const ReactingAir& here = air.places[i];
    result.altitude_km.push_back(here.altitude_km);
    result.ions.push_back(ion_balance(here, ion_production(pairs_cm3_s[i], here, physics), physics.reactions,
                                      physics.seconds, physics.night));
    result.conductivity.push_back(
        conductivity(here, result.ions.back(), air.field_nt[i], physics.collisions));
    const double electrons = result.ions.back().electrons;
    const bool is_of_the_night =
        !is_steady && electrons < kAboveNight * physics.night * night_ions(here).electrons;
    ln_electrons.push_back(std::log(is_of_the_night ? kNoneCm3 : std::max(kNoneCm3, electrons)));
    pedersen.push_back(result.conductivity.back().pedersen);
    hall.push_back(result.conductivity.back().hall);
  }
  result.pedersen_s = height_integral(result.altitude_km, pedersen);
  result.hall_s = height_integral(result.altitude_km, hall);
  const DensityPeak peak = density_peak(result.altitude_km, ln_electrons);
  const bool has_any = peak.ln > std::log(kNoneCm3);
  result.peak_cm3 = has_any ? std::exp(peak.ln) : 0.0;
  result.peak_km = has_any ? peak.altitude_km : kNaN;
  return result;
}

DensityPeak density_peak(const std::vector<double>& altitude_km, const std::vector<double>& ln) {
  const auto top = static_cast<std::size_t>(std::max_element(ln.begin(), ln.end()) - ln.begin());
  if (top == 0 || top + 1 == ln.size()) return {ln[top], altitude_km[top]};
  const double left = altitude_km[top - 1] - altitude_km[top],
               right = altitude_km[top + 1] - altitude_km[top];
  const double low = (ln[top - 1] - ln[top]) / left, high = (ln[top + 1] - ln[top]) / right;
  const double bend = (high - low) / (right - left), slope = low - bend * left;
  if (!(bend < 0.0)) return {ln[top], altitude_km[top]};
  const double away = std::clamp(-0.5 * slope / bend, left, right);
  return {ln[top] + away * (slope + away * bend), altitude_km[top] + away};
}

double height_integral(const std::vector<double>& altitude_km, const std::vector<double>& per_m) {
  constexpr double kMetresPerKm = 1e3;
  double sum = 0.0;
  for (std::size_t i = 1; i < altitude_km.size(); ++i)
    sum += 0.5 * (altitude_km[i] - altitude_km[i - 1]) * (per_m[i] + per_m[i - 1]);
  return kMetresPerKm * sum;
}

}  // namespace vegard::sim
