#include "sim/render/beams/light_ages.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/emit/aurora/change_times.h"
#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

// The first interval's light is taken at its end: it is short beside what changes, but not shorter than what
// an eye or a camera tells apart, and than a seventh of the 0.7 s of 557.7 nm.
constexpr double kFirstPerChange = 1.0 / 16.0, kMinFirstS = 0.1;
constexpr double kGrowth = 2.0;      // from interval to interval
constexpr double kNoneLeft = 0.002;  // of a line's light: where the last interval begins
constexpr double kLongestS = 3600.0;

double lifetime_at_s(const EmissionLine& line, double altitude_km) {
  return is_prompt(line) ? 0.0 : effective_lifetime_s(line, standard_air(altitude_km));
}

/// Of the line, at the altitudes of a HeightProfile; empty for a prompt one.
std::vector<double> lifetimes_s(double wavelength_nm) {
  const EmissionLine* line = find_emission_line(wavelength_nm);
  std::vector<double> all;
  if (line == nullptr || is_prompt(*line)) return all;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a)
    all.push_back(lifetime_at_s(*line, HeightProfile::altitude_km(a)));
  return all;
}

/// What of the light is by electrons of an interval of age, by altitude.
std::vector<float> shares(const std::vector<double>& lifetimes_s, double from_s, double to_s) {
  std::vector<float> all(HeightProfile::kAltitudes, from_s == 0.0 ? 1.0f : 0.0f);
  for (std::size_t a = 0; a < lifetimes_s.size(); ++a)
    all[a] = static_cast<float>(std::exp(-from_s / lifetimes_s[a]) - std::exp(-to_s / lifetimes_s[a]));
  return all;
}

}  // namespace

LightAges::LightAges(const Scene& scene) {
  from_s_.assign(scene.sheets.size(), {0.0});
  if (scene.emission.lag == EmissionLag::none || scene.film.weight == PointWeight::unit) return;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    const Sheet& sheet = scene.sheets[s];
    const double change_s = soonest_change_s(sheet, scene.substorm);
    double slowest_s = 0.0;  // lifetimes grow with the altitude
    for (const double nm : scene.emission.lines)
      if (const EmissionLine* line = find_emission_line(nm); line != nullptr)
        slowest_s = std::max(slowest_s, lifetime_at_s(*line, std::min(sheet.top_km, HeightProfile::kTopKm)));
    const double last_s = std::min(kLongestS, -std::log(kNoneLeft) * slowest_s);
    for (double from_s = std::max(kMinFirstS, kFirstPerChange * change_s); from_s < last_s; from_s *= kGrowth)
      from_s_[s].push_back(from_s);
  }
}

bool LightAges::any() const {
  return std::any_of(from_s_.begin(), from_s_.end(),
                     [](const std::vector<double>& of_sheet) { return of_sheet.size() > 1; });
}

double LightAges::to_s(int sheet, int age) const {
  return age + 1 < count(sheet) ? from_s_[sheet][age + 1] : std::numeric_limits<double>::infinity();
}

double LightAges::age_s(int sheet, int age, double place) const {
  // Evenly in the logarithm: over an interval where much of an exponential falls off it falls off nearly so.
  const double from = from_s(sheet, age);
  return from * std::pow(age + 1 < count(sheet) ? to_s(sheet, age) / from : kGrowth, place);
}

void LightAges::split(const Scene& scene, std::vector<HeightProfile>& profiles) const {
  if (!any()) return;
  std::vector<std::vector<double>> lifetimes;
  for (const double nm : scene.emission.lines) lifetimes.push_back(lifetimes_s(nm));
  for (std::size_t s = 0; s < from_s_.size(); ++s) {
    const int sheet = static_cast<int>(s);
    if (!lags(sheet)) continue;
    const ProfilesOfSheet own = profiles_of_sheet(scene, sheet);
    const std::vector<HeightProfile> whole(profiles.begin() + own.first,
                                           profiles.begin() + own.first + own.count());
    for (int age = 0; age < count(sheet); ++age) {
      std::vector<std::vector<float>> of_lines;
      for (const std::vector<double>& of_line : lifetimes)
        of_lines.push_back(shares(of_line, from_s(sheet, age), to_s(sheet, age)));
      for (int rung = 0; rung < own.count(); ++rung) {
        HeightProfile part = whole[rung];
        for (int a = 0; a < HeightProfile::kAltitudes; ++a)
          for (int l = 0; l < part.lines; ++l) {
            const std::size_t at = static_cast<std::size_t>(a) * part.stride + l;
            part.rate[at] *= of_lines[l][a];
            part.d_rate_d_ln_energy[at] *= of_lines[l][a];
          }
        if (age == 0)
          profiles[own.first + rung] = std::move(part);
        else
          profiles.push_back(std::move(part));
      }
    }
  }
}

int LightAges::first_profile(const Scene& scene, int sheet, int age) const {
  if (age == 0) return profiles_of_sheet(scene, sheet).first;
  int first = profile_count(scene);
  for (int before = 0; before < sheet; ++before)
    first += (count(before) - 1) * profiles_of_sheet(scene, before).count();
  return first + (age - 1) * profiles_of_sheet(scene, sheet).count();
}

std::vector<float> LightAges::split_rates(int sheet, double wavelength_nm,
                                          const std::vector<float>& rates) const {
  if (!lags(sheet)) return rates;
  const std::vector<double> lifetimes = lifetimes_s(wavelength_nm);
  std::vector<float> all;
  for (int age = 0; age < count(sheet); ++age) {
    const std::vector<float> share = shares(lifetimes, from_s(sheet, age), to_s(sheet, age));
    for (std::size_t i = 0; i < rates.size(); ++i)
      all.push_back(rates[i] * share[i % HeightProfile::kAltitudes]);
  }
  return all;
}

}  // namespace vegard::sim
