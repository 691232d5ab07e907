// The quantities of a survey whose evolution through a night is followed (plotted and smoothed).
#pragma once

#include <optional>
#include <string>

#include "fit/survey/survey_answer.h"

namespace vegard::fit {

enum class FollowedKind {
  energy,          ///< mean energy of the electrons
  characteristic,  ///< characteristic energy E0, of a map's strongest curtain
  flux,            ///< energy flux
  distance,        ///< of a curtain, or of a border if it is 105 km high
  altitude,        ///< of the lower border of a line's light
  border,          ///< largest elevation of the border
  border_azimuth,  ///< azimuth of the border's highest point
  sheet_azimuth,   ///< of a sheet's nearest point
  velocity,        ///< of a distance, as written by vegard survey smooth
};

/// Returns the kind of a quantity, recognised by the name that fit/answer and fit/survey give it; none if it
/// is not followed. For a border only the brightest trace is followed, for a map only the curtain with most
/// energy.
std::optional<FollowedKind> followed_kind(SurveyWork work, const SurveyQuantity& quantity);

/// Returns the owner in a quantity's name: "main" for "distance of the main sheet"; empty if there is none.
std::string owner_of_quantity(const std::string& name);

/// The assumed altitude of a border for which its distance is followed.
inline constexpr double kFollowedBorder_km = 105.0;

}  // namespace vegard::fit
