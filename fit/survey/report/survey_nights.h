// The frames of a survey, night by night.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/sqlite_file.h"

namespace vegard::fit {

/// Frames of a database, by their numbers: [first, end).
struct FrameRange {
  int first = 0, end = 0;
};

/// What one camera has taken in one night.
struct CameraNight {
  std::string camera;
  std::vector<FrameRange> ranges;  ///< one, unless several plans were merged
};

struct SurveyNight {
  std::string name;                  ///< the date (UTC) of its middle: "2019-03-01"
  double begin_s = 0.0;              /// since 1970 in UTC; it lasts for a day
  std::vector<CameraNight> cameras;  ///< by their names
};

struct SurveyNights {
  int begins_at_s = 0;              ///< of the day (UTC): when one night ends and the next begins
  std::vector<SurveyNight> nights;  ///< those that have frames, in their order
};

/// Nights end in the middle of the longest stretch of the day (UTC, in steps of ten minutes) in which the
/// survey has no frame at all, or, where there is none, in the ten minutes with fewest: so that a night is
/// not cut in two, wherever the cameras stand. Reads no more than the frames' times.
SurveyNights survey_nights(const SqliteFile& database);

/// The second of the day (UTC) at which nights end, of the number of frames in each step of ten minutes.
int night_boundary_s(const std::vector<int>& frames_of_step);

}  // namespace vegard::fit
