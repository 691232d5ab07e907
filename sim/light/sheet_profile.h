// The height profile of a sheet, by the emission model that the sheet names: the common entry to all emission
// models.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {

struct Scene;
struct Sheet;

/// True if a sheet's light is given by its brightness, so that its energy flux has no effect.
bool has_given_brightness(const Sheet& sheet);

/// Returns the profile of scene.sheets[sheet] by the model that its key `profile` names: the light per
/// mW m^-2 at the sheet's own energy flux, by emission.flux_law. For a sheet of given brightness it returns
/// the profile at an energy flux of 1, scaled so that the column of 557.7 nm from the bottom up to top_km,
/// seen vertically, is brightness_kilorayleigh, whatever lines `wavelengths_nm` has. (A path along the field
/// is longer by one over the cosine to the vertical; the beams are weaker by the same factor:
/// sim/render/beams/beams.cpp.)
HeightProfile sheet_profile(const std::vector<double>& wavelengths_nm, const Scene& scene, int sheet);

/// The energies (rungs) at which height profiles are computed for a sheet whose energy varies along its
/// curve: a fixed step apart in ln(E), the same for all sheets. Between two rungs the light is interpolated
/// linearly in ln(E); the error is at most 0.2 % of a profile's peak, halfway (sim/light/profile_table.cpp).
struct EnergyLadder {
  static constexpr double kLnStep = 0.04;
  int first = 0;                        ///< rung 0 is at exp(first kLnStep) keV
  int count = 0;                        ///< at least 2; 0: the sheet has one energy
  double min_kev = 0.0, max_kev = 0.0;  ///< the limits of the emission tables

  /// Returns the energy of a rung, limited to min_kev .. max_kev.
  double energy_kev(int rung) const;
};

/// Returns the ladder that covers all energies along the curve of scene.sheets[sheet].
EnergyLadder energy_ladder(const Scene& scene, int sheet);

/// Returns the sheet_profile() of each rung; empty for a sheet of one energy.
std::vector<HeightProfile> ladder_profiles(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                           int sheet);

/// Returns d rate / d number, indexed as HeightProfile::rate, for a number of the scene on which the shape of
/// the sheet's profile depends: a number of the sheet, or the oxygen factor of the tables, which all sheets
/// of electrons share. Not for energy_kev, whose derivative is in the profile itself. Empty if the profile
/// does not depend on the number. For energy_flux_mw_m2 it is the non-linear part only, d(rate per mW
/// m^-2)/dQ.
std::vector<float> profile_slope(const std::vector<double>& wavelengths_nm, const Scene& scene, int sheet,
                                 const ParameterId& number);

/// Returns profile_slope() for each rung of the sheet's ladder, or for its one profile. Empty if no profile
/// depends on the number.
std::vector<std::vector<float>> profile_slopes(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                               int sheet, const ParameterId& number);

/// Throws Error(unreadable_input) if a profile from a user's table cannot be used for the scene's lines and
/// brightness, and what check_emission_tables() throws. To be called after a scene is read, before any
/// computation.
void check_profiles(const Scene& scene);

}  // namespace vegard::sim
