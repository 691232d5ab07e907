// Divides the frames of a survey into nights.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/sqlite_file.h"

namespace vegard::fit {

/// Frames of a database, by their numbers: [first, end).
struct FrameRange {
  int first = 0, end = 0;
};

/// The frames of one camera in one night.
struct CameraNight {
  std::string camera;
  std::vector<FrameRange> ranges;  ///< one, unless several plans were merged
};

struct SurveyNight {
  std::string name;                  ///< the date (UTC) of its middle: "2019-03-01"
  double begin_s = 0.0;              ///< since 1970 in UTC; a night lasts for 24 hours
  std::vector<CameraNight> cameras;  ///< by their names
};

struct SurveyNights {
  int begins_at_s = 0;              ///< second of the day (UTC) at which nights begin and end
  std::vector<SurveyNight> nights;  ///< those that have frames, in their order
};

/// Divides the frames into nights; reads only the frames' times. Nights end in the middle of the longest
/// period of the day (UTC, in steps of ten minutes) without any frame, or, if there is none, in the ten
/// minutes with fewest frames. So a night is not cut in two, wherever the cameras are.
SurveyNights survey_nights(const SqliteFile& database);

/// Returns the second of the day (UTC) at which nights end, from the number of frames in each step of ten
/// minutes.
int night_boundary_s(const std::vector<int>& frames_of_step);

}  // namespace vegard::fit
