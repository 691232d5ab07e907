// Which pictures a sequence or a keogram has, and when they were taken.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "fit/measure/keogram.h"
#include "fit/photo/frames/imager_words.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct ListedPhoto {
  std::string file;
  double time_s = NAN;                  ///< NaN if the list does not say
  std::optional<fit::ImagerTime> time;  ///< of a frame that has one
};

/// From images in their order, or from one list (.txt) as below; of a file with many frames all of them, from
/// the first to the last, unless one is chosen (fit/photo/frames/frame_name.h). `key`: the option, for
/// messages. Throws Error(usage, unreadable_input).
std::vector<ListedPhoto> listed_photos(const std::vector<std::string>& words, const std::string& key);

struct SequencePhoto {
  std::string name;  ///< the file's without its ending, with a frame's number; no two are alike
  std::string file;
  double time_s = 0.0;  ///< on the scene's clock
};

/// From images in their order, or from one list (.txt) with a line "FILE" or "FILE TIME_S" for each, empty
/// lines and those that begin with # left out, files relative to the list. Where no time is given: as the
/// scene's frames_per_second has it, from its start_s on; of frames whose files all say when they were
/// taken, so many seconds after the first of them. Throws Error(usage, unreadable_input).
std::vector<SequencePhoto> sequence_photos(const std::vector<std::string>& words, const sim::Scene& scene);

struct TimedPictures {
  std::vector<std::string> files;  ///< in the order of time
  fit::PictureTimes times;         ///< one for each of them
};

/// From images, or from one list (.txt) as sequence_photos() takes it. Times, of the first that there is:
///   1. the table `times_file`, with a line "FILE,TIME" for each picture (TIME in ISO 8601, UTC, or for all
///      of them in seconds; a first line "file,time" and lines that begin with # are passed over; FILE
///      without its folder);
///   2. the list;
///   3. the files' own words (sim/base/picture/picture_metadata.h), if all of them have a time in UTC and no
///   two the
///      same;
///   4. the files' names (sim/base/utc_time.h), if all have one;
///   5. the clock of the camera, whose zone is not known, if all have it and no two the same: seconds since
///      the first of them;
///   6. numbers in the order given.
/// Throws Error(usage, unreadable_input).
TimedPictures timed_pictures(const std::vector<std::string>& words, const std::string& times_file);

}  // namespace vegard::apps
