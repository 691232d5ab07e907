// The light of a sheet's beams against altitude, as the sheet asks for it: the one door to all emission
// models.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {

/// Whether a sheet's light is given by its brightness, and its energy flux has no effect.
bool has_given_brightness(const Sheet& sheet);

/// The profile of scene.sheets[sheet], by the model that its key `profile` names: the light per mW m^-2 at
/// the sheet's own energy flux, by emission.flux_law. Of a sheet of given brightness, the model at an energy
/// flux of 1, scaled for a flux of 1: the column of 557.7 nm from the bottom up to top_km is then
/// brightness_kilorayleigh seen vertically, whatever lines are asked for. (Seen along the field, where a path
/// is longer by one over the cosine to the vertical, the beams are weaker by as much:
/// sim/render/beams/beams.cpp.)
HeightProfile sheet_profile(const std::vector<double>& wavelengths_nm, const Scene& scene, int sheet);

/// The energies at which a sheet whose energy varies along its curve has height profiles: rungs a fixed step
/// apart in ln(E), the same for all sheets. Between two rungs light is linear in ln(E); half of a step away
/// from them that is off by 0.2 % of a profile's peak at most (sim/light/profile_table.cpp).
struct EnergyLadder {
  static constexpr double kLnStep = 0.04;
  int first = 0;                        ///< rung 0 is at exp(first kLnStep) keV
  int count = 0;                        ///< at least 2; 0: the sheet has one energy
  double min_kev = 0.0, max_kev = 0.0;  ///< the limits of the emission tables

  /// The energy of a rung, within these limits.
  double energy_kev(int rung) const;
};

/// Of all energies that the curve of scene.sheets[sheet] can pass through.
EnergyLadder energy_ladder(const Scene& scene, int sheet);

/// What sheet_profile() gives for each rung; empty for a sheet of one energy.
std::vector<HeightProfile> ladder_profiles(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                           int sheet);

/// d rate / d number, as HeightProfile::rate, for a number of the scene that shapes the sheet's profile other
/// than by energy_kev, whose derivative the profile itself carries: one of its own, or the oxygen factor of
/// the tables, which all sheets of electrons share. Empty for a number that does not. By energy_flux_mw_m2 it
/// is the part that comes on top of proportion, d(rate per mW m^-2)/dQ.
std::vector<float> profile_slope(const std::vector<double>& wavelengths_nm, const Scene& scene, int sheet,
                                 const ParameterId& number);

/// The same for each rung of the sheet's ladder, or of its one profile. Empty for a number that shapes none.
std::vector<std::vector<float>> profile_slopes(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                               int sheet, const ParameterId& number);

/// Throws Error(unreadable_input) if a profile that comes from a user's table cannot be used for the scene's
/// lines and brightness, and what check_emission_tables() throws. To be called when a scene has been read,
/// before any work.
void check_profiles(const Scene& scene);

}  // namespace vegard::sim
