// Lists the pictures of a sequence or a keogram, and when they were taken.
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
  std::optional<fit::ImagerTime> time;  ///< the time of a frame, if it has one
};

/// Lists images in their order, or those of one list (.txt) as for sequence_photos(); all frames of a file
/// with many frames, unless one is chosen (fit/photo/frames/frame_name.h). `key` is the option, for messages.
/// Throws Error(usage, unreadable_input).
std::vector<ListedPhoto> listed_photos(const std::vector<std::string>& words, const std::string& key);

struct SequencePhoto {
  std::string name;  ///< name of the file without its ending, with a frame's number; unique
  std::string file;
  double time_s = 0.0;  ///< on the scene's clock
};

/// Lists images in their order, or those of one list (.txt) with a line "FILE" or "FILE TIME_S" for each;
/// empty lines and those that begin with # are ignored, and files are relative to the list. Where no time is
/// given, it follows from the scene's frames_per_second and start_s; for frames whose files all have times,
/// it is the number of seconds after the first of them. Throws Error(usage, unreadable_input).
std::vector<SequencePhoto> sequence_photos(const std::vector<std::string>& words, const sim::Scene& scene);

struct TimedPictures {
  std::vector<std::string> files;  ///< in the order of time
  fit::PictureTimes times;         ///< one for each of them
};

/// Lists images, or those of one list (.txt) as in sequence_photos(), with their times. Times are taken from
/// the first of these sources that is available:
///   1. the table `times_file`, with a line "FILE,TIME" for each picture (TIME in ISO 8601, UTC, or for all
///      of them in seconds; a first line "file,time" and lines that begin with # are ignored; FILE without
///      its folder);
///   2. the list;
///   3. the metadata of the files (sim/base/picture/picture_metadata.h), if all of them have a time in UTC
///      and no two the same;
///   4. the names of the files (sim/base/utc_time.h), if all have a time;
///   5. the clock of the camera, whose time zone is not known, if all have it and no two the same: seconds
///      since the first of them;
///   6. numbers in the order given.
/// Throws Error(usage, unreadable_input).
TimedPictures timed_pictures(const std::vector<std::string>& words, const std::string& times_file);

}  // namespace vegard::apps
