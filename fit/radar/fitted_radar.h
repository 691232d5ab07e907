// A radar's densities and what a fit makes of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

struct FittedRadar {
  std::string name, file, sha256;  ///< the file without its folder
  double time_s = 0.0;             ///< of the profile, as the file counts it; NaN: not told

  // By altitude. Densities in cm^-3.
  std::vector<double> altitude_km, density_cm3, sigma_cm3;
  std::vector<double> electrons_cm3;  ///< of the scene's electrons, with physics as it is
  std::vector<double> model_cm3;      ///< the same with the scale, and physics moved within its errors

  double foot_latitude_deg = 0.0, foot_longitude_deg = 0.0;  ///< at 110 km, of the largest density's line
  double energy_flux_mw_m2 = 0.0, energy_kev = 0.0;          ///< of the electrons there; NaN: none
  double scale = 1.0;                                        ///< measured over true densities
  std::optional<double> scale_sigma;  ///< at these electrons; none if the scale is held
  double chi2 = 0.0;
  int values = 0;
};

/// True if densities are not explained: their chi2 has a chance below 0.0027.
bool contradicts(const FittedRadar& radar);

}  // namespace vegard::fit
