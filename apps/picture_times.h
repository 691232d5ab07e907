// Which pictures a keogram has, and when they were taken.
#pragma once

#include <string>
#include <vector>

#include "fit/keogram.h"

namespace vegard::apps {

struct TimedPictures {
  std::vector<std::string> files;  ///< in the order of time
  fit::PictureTimes times;         ///< one for each of them
};

/// From images, or from one list (.txt) as sequence_photos() takes it. Times: of the table `times_file` if
/// one is named, with a line "FILE,TIME" for each picture (TIME in ISO 8601, UTC, or for all of them in
/// seconds; a first line "file,time" and lines that begin with # are passed over; FILE without its folder);
/// else those of the list; else those in the files' names (sim/base/utc_seconds.h), if all have one; else
/// numbers in the order given. Throws Error(usage, unreadable_input).
TimedPictures timed_pictures(const std::vector<std::string>& words, const std::string& times_file);

}  // namespace vegard::apps
