#include "sim/light/profile_table_by_flux.h"

#include <algorithm>
#include <cmath>

#include "sim/light/emission_table.h"
#include "sim/light/form_profile.h"

namespace vegard::sim {

ProfileTable profile_table_by_flux(const std::vector<double>& lines_nm, const Scene& scene,
                                   const Footprint& f, const ProfileTable& table) {
  const bool form = f.profile == ProfileKind::form;
  if (scene.emission.flux_law == FluxLaw::linear || !(form || f.profile == ProfileKind::maxwellian))
    return {};
  const std::vector<double>& energies = EmissionTable::glow().energies_kev();
  ProfileTable by_flux = table;
  for (std::size_t i = 0; i < table.of_energy.size(); ++i) {
    const double ln = table.ln_first + static_cast<double>(i) * table.ln_step;
    const double energy = std::clamp(f.energy_kev * std::exp(ln), energies.front(), energies.back());
    const HeightProfile slopes =
        form
            ? form_profile_by_flux(lines_nm, energy, {f.peak_km, f.lower_km, f.upper_km}, f.energy_flux_mw_m2)
            : maxwellian_profile_by_flux(lines_nm, energy, f.energy_flux_mw_m2);
    by_flux.of_energy[i] = slopes;
  }
  return by_flux;
}

}  // namespace vegard::sim
