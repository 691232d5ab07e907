#include "sim/light/excited_atom.h"

#include <cmath>
#include <string_view>

#include "sim/light/height_profile.h"
#include "sim/light/reactions.h"

namespace vegard::sim {
namespace {

constexpr double kPromptS = 1e-3;
constexpr double kBoltzmannPerDalton = 8314.463;  // J kg^-1 K^-1 times the mass in daltons
constexpr double kDiffusionPerCmS = 6.986e18;     // of O in N2, D n at 273.15 K
constexpr double kDiffusionPower = 0.75;
constexpr double kOxygenInN2 = 10.18, kOxygenInOxygen = 8.00;  // reduced masses, daltons

double mass_dalton(const EmissionLine& line) { return std::string_view(line.species) == "O" ? 16.0 : 14.0; }

/// Returns the rate at which the line's upper state ends, per second, by light and by collisions.
double end_s(const EmissionLine& line, const Air& air) {
  using R = Reaction;
  const Reactions& reactions = Reactions::standard();
  const auto k = [&](Reaction reaction) { return reactions.rate(reaction, air.temperature_k); };
  const std::string_view transition = line.transition;
  if (transition == "(1D)-(3P)")
    return reactions.value(R::o1d_6300) + reactions.value(R::o1d_6364) + k(R::o1d_n2) * air.n2_cm3 +
           k(R::o1d_o2) * air.o2_cm3 + k(R::o1d_o) * air.o_cm3;
  if (transition == "(1S)-(1D)")
    return reactions.value(R::o1s_5577) + reactions.value(R::o1s_2972) + k(R::o1s_o2) * air.o2_cm3 +
           k(R::o1s_o) * air.o_cm3;
  if (transition == "(2D)-(4S)")
    return reactions.value(R::n2d_5200) + k(R::n2d_o2) * air.o2_cm3 + k(R::n2d_o) * air.o_cm3;
  return 1.0 / line.lifetime_s;
}

}  // namespace

bool is_prompt(const EmissionLine& line) { return line.lifetime_s < kPromptS || !is_auroral(line); }

double effective_lifetime_s(const EmissionLine& line, const Air& air) { return 1.0 / end_s(line, air); }

double thermal_variance_m2_s2(const EmissionLine& line, const Air& air) {
  return kBoltzmannPerDalton * air.temperature_k / mass_dalton(line);
}

double collision_frequency_s(const EmissionLine& line, const Air& air) {
  const double in_molecules = kDiffusionPerCmS * std::pow(air.temperature_k / 273.15, kDiffusionPower);
  const double in_oxygen = in_molecules * std::sqrt(kOxygenInN2 / kOxygenInOxygen);
  const double inverse_s_cm2 = (air.n2_cm3 + air.o2_cm3) / in_molecules + air.o_cm3 / in_oxygen;
  constexpr double kCm2PerM2 = 1e4;
  return thermal_variance_m2_s2(line, air) * kCm2PerM2 * inverse_s_cm2;
}

double displacement_variance(double thermal_variance, double collision_frequency_s, double lifetime_s) {
  return 2.0 * thermal_variance * lifetime_s * lifetime_s / (1.0 + collision_frequency_s * lifetime_s);
}

SpreadProfile spread_profile(const EmissionLine& line, double wind_m_s) {
  constexpr double kKm2PerM2 = 1e-6;
  SpreadProfile profile;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const Air air = standard_air(HeightProfile::kBottomKm + a * HeightProfile::kStepKm);
    const double lifetime_s = effective_lifetime_s(line, air);
    const double thermal = displacement_variance(thermal_variance_m2_s2(line, air),
                                                 collision_frequency_s(line, air), lifetime_s);
    const double carried_m = wind_m_s * lifetime_s;
    profile.lifetime_s.push_back(static_cast<float>(lifetime_s));
    profile.variance_km2.push_back(static_cast<float>((thermal + carried_m * carried_m / 3.0) * kKm2PerM2));
  }
  return profile;
}

}  // namespace vegard::sim
