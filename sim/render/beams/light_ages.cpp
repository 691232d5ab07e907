#include "sim/render/beams/light_ages.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "sim/emit/aurora/change_times.h"
#include "sim/render/beams/kernel_scene.h"

namespace vegard::sim {

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
        take_share(shares[age], part);
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

}  // namespace vegard::sim
