// The quantities of a survey that are followed through a night.
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
  border,          ///< elevation of the border where it is highest
  border_azimuth,  ///< of that place
  sheet_azimuth,   ///< of a sheet's nearest point
  velocity,        ///< of a distance, of what vegard survey smooth has written
};

/// By the words that fit/answer and fit/survey name numbers by; none for all others. Of a border it is the
/// brightest trace's, of a map the curtain's that carries most.
std::optional<FollowedKind> followed_kind(SurveyWork work, const SurveyQuantity& quantity);

/// "main", of "distance of the main sheet"; empty if nothing is named.
std::string owner_of_quantity(const std::string& name);

/// The border's altitude whose distance is followed.
inline constexpr double kFollowedBorder_km = 105.0;

}  // namespace vegard::fit
