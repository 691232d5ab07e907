// Lists the frames of a camera with their times: by their names, by a list, or, for a file that may hold
// many (PGM, PPM, gzipped or not), by its own metadata. Only such files are opened.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/survey.h"

namespace vegard::fit {

struct ListedFrame {
  std::string file;     ///< as frame_reference() takes it, relative to the survey's folder, or absolute
  double time_s = 0.0;  ///< since 1970 in UTC
  std::string skip;     ///< why it is left out; empty: it is not
};

/// What a list or a folder has given, beside its frames: for the plan.
struct FrameSource {
  std::string name;    ///< as the survey has it
  std::string sha256;  ///< of a list's bytes; of a folder's names of frames
};

struct ListedFrames {
  std::vector<ListedFrame> frames;  ///< by time, then by name; each once
  std::vector<FrameSource> sources;
};

/// A folder gives all files in it and in folders in it whose ending is one of the camera's, hidden ones left
/// out; links to folders are not followed. A list (.txt) gives a line "FRAME" or "FRAME TIME" for each, TIME
/// in ISO 8601 (UTC or with a zone), names relative to the list; empty lines and those that begin with # are
/// left out. A file with many frames gives each of them, "night.pgm.gz#7", unless a list gives a time with
/// it; of a damaged one those before the damage, and one more that stands for what is behind it. Times that
/// are not given are those that the frames of such files have, else those of the names
/// (fit/photo/frames/imager_name.h, sim/base/utc_time.h), taken for UTC. What is skipped is marked by the
/// first of the survey's skips that has it. Throws sim::Error(unreadable_input) for a folder, list or file
/// that is not there, a line that cannot be understood, a frame that has no time; and (scene) for a camera
/// without a frame.
ListedFrames survey_frames(const Survey& survey, const SurveyCamera& camera);

}  // namespace vegard::fit
