// The motion of a survey's curtains: numbers smoothed from frame to frame, with velocities and flags.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

struct SurveyMotionOptions {
  double gap_s = 300.0;        ///< after a longer one a track ends
  double false_alarms = 1e-4;  ///< share of sound frames that either question flags (track_smoother.h)
  std::vector<std::string> quantities;  ///< names of further numbers to follow
};

struct SurveyMotion {
  int tracks = 0;
  int used = 0;  ///< numbers that the tracks are of
  int outliers = 0, breaks = 0;
};

/// Writes a copy of the database with three more tables (docs/surveys.md): track, velocity, flag. Followed
/// are distances and altitudes of lower borders (fit/survey/followed_quantity.h), of a border its brightest
/// trace, as far as they have an error and their work's verdict is good or doubtful: one track for each
/// camera and number, until the camera's frames have a gap. Velocities of what is in km are in m/s, of all
/// else in the unit per second; of a distance they are positive if it grows. `output` appears whole or not at
/// all; the same rows and options give the same bytes. Holds one track of each number at a time. Throws
/// sim::Error (usage) for an option out of range, and as SurveyReader and sim::WholeFile do.
SurveyMotion smooth_survey(const std::string& database, const std::string& output,
                           const SurveyMotionOptions& options, bool overwrite);

}  // namespace vegard::fit
