#include "sim/light/profile_table.h"

#include <algorithm>
#include <cmath>

#include "sim/light/sheet_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {
namespace {

/// The step of ln E. Half a step off, a profile differs from the line between its neighbours by 0.2 % of its
/// peak at most: its peak is some 0.3 wide in ln E, and linear interpolation errs by the square of the step
/// over 8 times the curvature.
constexpr double kLnStep = 0.04;

/// Returns a scene with nothing but one sheet that has the footprint's electrons.
Scene scene_of(const Scene& scene, const Footprint& f) {
  Scene one;
  one.file = scene.file;
  one.body = scene.body;
  one.site = scene.site;
  one.field = scene.field;
  one.own_lines = scene.own_lines;
  one.emission = scene.emission;
  Sheet sheet;
  sheet.name = f.name;
  sheet.profile = f.profile;
  sheet.energy_kev = f.energy_kev;
  sheet.energy_flux_mw_m2 = f.energy_flux_mw_m2;
  sheet.energy_spread = f.energy_spread;
  sheet.peak_km = f.peak_km;
  sheet.lower_km = f.lower_km;
  sheet.upper_km = f.upper_km;
  sheet.top_km = f.top_km;
  one.sheets = {sheet};
  return one;
}

/// Leaves light up to the first altitude at or above `top_km`, so that it can be cut off exactly there.
void darken_above(double top_km, HeightProfile& profile) {
  const int last =
      static_cast<int>(std::ceil((top_km - HeightProfile::kBottomKm) / HeightProfile::kStepKm - 1e-9));
  const std::size_t from = static_cast<std::size_t>(std::clamp(last + 1, 0, HeightProfile::kAltitudes)) *
                           static_cast<std::size_t>(profile.stride);
  std::fill(profile.rate.begin() + static_cast<std::ptrdiff_t>(from), profile.rate.end(), 0.0f);
  std::fill(profile.d_rate_d_ln_energy.begin() + static_cast<std::ptrdiff_t>(from),
            profile.d_rate_d_ln_energy.end(), 0.0f);
}

}  // namespace

ProfileTable profile_table(const std::vector<double>& lines_nm, const Scene& scene, const Footprint& f,
                           double ln_least, double ln_most) {
  Scene one = scene_of(scene, f);
  const std::vector<double>& energies = emission_tables(scene).energies_kev();
  const double ln_lowest = std::log(energies.front() / f.energy_kev),
               ln_highest = std::log(energies.back() / f.energy_kev);
  ln_least = std::clamp(ln_least, ln_lowest, ln_highest);
  ln_most = std::clamp(ln_most, ln_least, ln_highest);
  const int steps = static_cast<int>(std::ceil((ln_most - ln_least) / kLnStep - 1e-9));
  ProfileTable table;
  table.ln_first = ln_least;
  table.ln_step = steps > 0 ? (ln_most - ln_least) / steps : 0.0;
  for (int i = 0; i <= steps; ++i) {
    one.sheets[0].energy_kev =
        std::clamp(f.energy_kev * std::exp(ln_least + i * table.ln_step), energies.front(), energies.back());
    table.of_energy.push_back(sheet_profile(lines_nm, one, 0));
    darken_above(f.top_km, table.of_energy.back());
  }
  return table;
}

ProfileChanges profile_changes(const std::vector<double>& lines_nm, const Scene& scene, const Footprint& f,
                               const ProfileTable& table) {
  const EmissionTables& tables = emission_tables(scene);
  Scene one = scene_of(scene, f);
  const auto changes_by = [&](const ParameterId& number) {
    ProfileTable changes = table;
    for (std::size_t i = 0; i < table.of_energy.size(); ++i) {
      const double ln = table.ln_first + static_cast<double>(i) * table.ln_step;
      one.sheets[0].energy_kev = std::clamp(f.energy_kev * std::exp(ln), tables.energies_kev().front(),
                                            tables.energies_kev().back());
      changes.of_energy[i].d_rate_d_ln_energy = profile_slope(lines_nm, one, 0, number);
      if (changes.of_energy[i].d_rate_d_ln_energy.empty()) return ProfileTable();
    }
    return changes;
  };
  ProfileChanges changes;
  changes.by_flux = changes_by(parameter_with(ParameterRole::energy_flux, 0));
  if (tables.maxwellian().oxygen_factors().size() > 1)
    changes.by_oxygen = changes_by(parameter_with(ParameterRole::oxygen_factor, -1));
  return changes;
}

}  // namespace vegard::sim
