#include "sim/render/beams/light_ages.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/emit/aurora/motion.h"
#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"

namespace vegard::sim {
namespace {

// The first interval is short beside what changes, but not shorter than what an eye or a camera tells apart,
// and than a seventh of the 0.7 s of 557.7 nm.
constexpr double kFirstPerChange = 1.0 / 16.0, kMinFirstS = 0.1;
constexpr double kGrowth = 2.0;      // from interval to interval
constexpr double kNoneLeft = 0.002;  // of a line's light: where the last interval begins
constexpr double kLongestS = 3600.0;

double lifetime_at_s(const EmissionLine& line, double altitude_km) {
  return is_prompt(line) ? 0.0 : effective_lifetime_s(line, standard_air(altitude_km));
}

}  // namespace

LightAges::LightAges(const Scene& scene) {
  of_sheet_.resize(scene.sheets.size());
  if (scene.emission.lag == EmissionLag::none || scene.film.weight == PointWeight::unit) return;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s)
    of_sheet_[s] =
        AgeIntervals(scene, scene.sheets[s].top_km, soonest_change_s(scene.sheets[s], scene.substorm));
}

bool LightAges::any() const {
  return std::any_of(of_sheet_.begin(), of_sheet_.end(),
                     [](const AgeIntervals& ages) { return ages.count() > 1; });
}

void LightAges::split(const Scene& scene, std::vector<HeightProfile>& profiles) const {
  for (std::size_t s = 0; s < of_sheet_.size(); ++s) {
    const int sheet = static_cast<int>(s);
    if (!lags(sheet)) continue;
    const std::vector<LightShare> shares = of_sheet_[s].shares();
    const ProfilesOfSheet own = profiles_of_sheet(scene, sheet);
    const std::vector<HeightProfile> whole(profiles.begin() + own.first,
                                           profiles.begin() + own.first + own.count());
    for (int age = 0; age < count(sheet); ++age)
      for (int rung = 0; rung < own.count(); ++rung) {
        HeightProfile part = whole[rung];
        multiply_by_share(shares[age], part);
        if (age == 0)
          profiles[own.first + rung] = std::move(part);
        else
          profiles.push_back(std::move(part));
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
  std::vector<float> all;
  for (const std::vector<float>& share : of_sheet_[sheet].shares_of(wavelength_nm))
    for (std::size_t i = 0; i < rates.size(); ++i)
      all.push_back(rates[i] * share[i % HeightProfile::kAltitudes]);
  return all;
}

AgeIntervals::AgeIntervals(const Scene& scene, double top_km, double change_s)
    : lines_nm_(scene.emission.lines) {
  double slowest_s = 0.0;  // lifetimes grow with the altitude
  for (const double nm : lines_nm_) {
    std::vector<double>& lifetimes_s = lifetimes_s_.emplace_back();
    const auto line = find_line(scene, nm);
    if (!line || is_prompt(*line)) continue;
    slowest_s = std::max(slowest_s, lifetime_at_s(*line, std::min(top_km, HeightProfile::kTopKm)));
    for (int a = 0; a < HeightProfile::kAltitudes; ++a)
      lifetimes_s.push_back(lifetime_at_s(*line, HeightProfile::altitude_km(a)));
  }
  const double last_s = std::min(kLongestS, -std::log(kNoneLeft) * slowest_s);
  for (double from_s = std::max(kMinFirstS, kFirstPerChange * change_s); from_s < last_s; from_s *= kGrowth)
    from_s_.push_back(from_s);
}

double AgeIntervals::age_s(int age, double place) const {
  if (age == 0) return 0.0;
  // Evenly in the logarithm: over an interval where much of an exponential falls off it falls off nearly so.
  const double from = from_s(age);
  return from * std::pow(age + 1 < count() ? to_s(age) / from : kGrowth, place);
}

std::vector<float> AgeIntervals::share(std::size_t line, int age) const {
  std::vector<float> all(HeightProfile::kAltitudes, age == 0 ? 1.0f : 0.0f);
  for (std::size_t a = 0; a < lifetimes_s_[line].size(); ++a)
    all[a] = static_cast<float>(std::exp(-from_s(age) / lifetimes_s_[line][a]) -
                                std::exp(-to_s(age) / lifetimes_s_[line][a]));
  return all;
}

std::vector<LightShare> AgeIntervals::shares() const {
  std::vector<LightShare> all(from_s_.size());
  for (int age = 0; age < count(); ++age)
    for (std::size_t line = 0; line < lines_nm_.size(); ++line) all[age].push_back(share(line, age));
  return all;
}

std::vector<std::vector<float>> AgeIntervals::shares_of(double wavelength_nm) const {
  const auto line = static_cast<std::size_t>(line_index(lines_nm_, wavelength_nm));
  std::vector<std::vector<float>> all;
  for (int age = 0; age < count(); ++age) all.push_back(share(line, age));
  return all;
}

void multiply_by_share(const LightShare& share, HeightProfile& profile) {
  for (int l = 0; l < profile.lines; ++l)
    for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
      const std::size_t at = static_cast<std::size_t>(a) * profile.stride + l;
      profile.rate[at] *= share[l][a];
      if (!profile.d_rate_d_ln_energy.empty()) profile.d_rate_d_ln_energy[at] *= share[l][a];
    }
}

}  // namespace vegard::sim
