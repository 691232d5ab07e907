// The motion of a survey's curtains: numbers smoothed from frame to frame, with velocities and flags.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/survey/survey.h"

namespace vegard::fit {

struct SurveyMotionOptions {
  double gap_s = 300.0;        ///< a longer gap in time ends a track
  double false_alarms = 1e-4;  ///< share of sound frames that each of the two tests flags (track_smoother.h)
  std::vector<std::string> quantities;  ///< names of further numbers to follow
};

struct SurveyMotion {
  int tracks = 0;
  int used = 0;  ///< numbers that were used for the tracks
  int outliers = 0, breaks = 0;
};

/// Writes a copy of the database with three more tables (docs/surveys.md): track, velocity, flag. It follows
/// distances and altitudes of lower borders (fit/survey/survey_motion.h), for a border those of its
/// brightest trace, if they have an error and their work's verdict is good or doubtful. There is one track
/// for each camera and number; it ends at a gap of the camera's frames. The velocity of a number in km is in
/// m/s, of other numbers in their unit per second; that of a distance is positive if the distance increases.
/// `output` is written completely or not at all; the same rows and options give the same bytes. Memory is
/// needed for one track of each number. Throws sim::Error (usage) for an option out of range, and as
/// SurveyReader and sim::WholeFile do.
SurveyMotion smooth_survey(const std::string& database, const std::string& output,
                           const SurveyMotionOptions& options, bool overwrite);

// The quantities of a survey whose evolution through a night is followed (plotted and smoothed).

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

}  // namespace vegard::fit
