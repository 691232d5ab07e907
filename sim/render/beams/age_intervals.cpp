#include "sim/render/beams/age_intervals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
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

void take_share(const LightShare& share, HeightProfile& profile) {
  for (int l = 0; l < profile.lines; ++l)
    for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
      const std::size_t at = static_cast<std::size_t>(a) * profile.stride + l;
      profile.rate[at] *= share[l][a];
      if (!profile.d_rate_d_ln_energy.empty()) profile.d_rate_d_ln_energy[at] *= share[l][a];
    }
}

}  // namespace vegard::sim
