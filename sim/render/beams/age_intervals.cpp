#include "sim/render/beams/age_intervals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/scene/lines/emission_lines.h"

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

AgeIntervals::AgeIntervals(const std::vector<double>& lines_nm, double top_km, double change_s) {
  double slowest_s = 0.0;  // lifetimes grow with the altitude
  for (const double nm : lines_nm)
    if (const EmissionLine* line = find_emission_line(nm); line != nullptr)
      slowest_s = std::max(slowest_s, lifetime_at_s(*line, std::min(top_km, HeightProfile::kTopKm)));
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

std::vector<LightShare> AgeIntervals::shares(const std::vector<double>& lines_nm) const {
  LightShare whole(lines_nm.size(), std::vector<float>(HeightProfile::kAltitudes, 1.0f));
  LightShare none(lines_nm.size(), std::vector<float>(HeightProfile::kAltitudes, 0.0f));
  std::vector<LightShare> all(from_s_.size(), none);
  all[0] = whole;
  for (std::size_t l = 0; l < lines_nm.size(); ++l) {
    const EmissionLine* line = find_emission_line(lines_nm[l]);
    if (line == nullptr || is_prompt(*line)) continue;
    for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
      const double lifetime_s = lifetime_at_s(*line, HeightProfile::altitude_km(a));
      for (int age = 0; age < count(); ++age)
        all[age][l][a] =
            static_cast<float>(std::exp(-from_s(age) / lifetime_s) - std::exp(-to_s(age) / lifetime_s));
    }
  }
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
