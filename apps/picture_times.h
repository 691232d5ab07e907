// Which pictures a keogram has, and when they were taken.
#pragma once

#include <string>
#include <vector>

#include "fit/measure/keogram.h"

namespace vegard::apps {

struct TimedPictures {
  std::vector<std::string> files;  ///< in the order of time
  fit::PictureTimes times;         ///< one for each of them
};

/// From images, or from one list (.txt) as sequence_photos() takes it. Times, of the first that there is:
///   1. the table `times_file`, with a line "FILE,TIME" for each picture (TIME in ISO 8601, UTC, or for all
///      of them in seconds; a first line "file,time" and lines that begin with # are passed over; FILE
///      without its folder);
///   2. the list;
///   3. the files' own words (sim/base/picture/picture_metadata.h), if all of them tell a time in UTC and no
///      two the same;
///   4. the files' names (sim/base/utc_seconds.h), if all have one;
///   5. the clock of the camera, whose zone is not known, if all tell it and no two the same: seconds since
///      the first of them;
///   6. numbers in the order given.
/// Throws Error(usage, unreadable_input).
TimedPictures timed_pictures(const std::vector<std::string>& words, const std::string& times_file);

}  // namespace vegard::apps
