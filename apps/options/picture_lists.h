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
  fit::StreamTime stream;               ///< of a frame of a film
};

/// Lists images in their order, or those of one list (.txt) as for sequence_photos(); all frames of a file
/// with many frames, unless one is chosen (fit/photo/frames/frame_name.h); the pictures of a folder by their
/// names. `key` is the option, for messages. Throws Error(usage, unreadable_input).
std::vector<ListedPhoto> listed_photos(const std::vector<std::string>& words, const std::string& key);

struct SequencePhoto {
  std::string name;  ///< name of the file without its ending, with a frame's number; unique
  std::string file;
  double time_s = 0.0;  ///< on the scene's clock
};

/// Lists images in their order, or those of one list (.txt) with a line "FILE" or "FILE TIME_S" for each;
/// empty lines and those that begin with # are ignored, and files are relative to the list. Where no time is
/// given, it follows from the scene's frames_per_second and start_s; for frames whose files all have times,
/// it is the number of seconds after the first of them; so it is for frames of one film. Throws Error(usage,
/// unreadable_input).
std::vector<SequencePhoto> sequence_photos(const std::vector<std::string>& words, const sim::Scene& scene);

struct TimedPictures {
  std::vector<std::string> files;  ///< in the order of time
  fit::PictureTimes times;         ///< one for each of them
};

/// What the user says about times.
struct GivenTimes {
  std::string table;              ///< a file; empty: none
  std::optional<double> start_s;  ///< of the first picture, since 1970 in UTC
  std::optional<double> step_s;   ///< from one picture to the next, in the order in which they are listed
};

/// Lists images, or those of one list (.txt) as in sequence_photos(), with their times. Times are taken from
/// the first of these sources that is available:
///   1. start and step; the start alone for frames of one film, by the film's clock; the step alone for
///      seconds after the first picture; or the table `table`, with a line "FILE,TIME" for each picture (TIME
///      in ISO 8601, UTC, or for all of them in seconds; a first line "file,time" and lines that begin with #
///      are ignored; FILE without its folder);
///   2. the list;
///   3. the metadata of the files (sim/base/picture/picture_metadata.h), if all of them have a time in UTC
///      and no two the same;
///   4. the names of the files (sim/base/utc_time.h), if all have a time; that of a film is of its first
///      frame;
///   5. the clock of the camera, whose time zone is not known, if all have it and no two the same: seconds
///      since the first of them; of a film the container's;
///   6. the film's clock, if all are frames of one: seconds since its first frame;
///   7. numbers in the order given.
/// Throws Error(usage, unreadable_input).
TimedPictures timed_pictures(const std::vector<std::string>& words, const GivenTimes& given);

}  // namespace vegard::apps
