// Lists the frames of a camera with their times: by their names, by a list, or, for a file that may hold
// many (PGM, PPM, gzipped or not), by its own metadata. Only such files are opened.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/survey.h"

namespace vegard::fit {

struct ListedFrame {
  std::string file;     ///< for frame_reference(), relative to the survey's folder, or absolute
  double time_s = 0.0;  ///< since 1970 in UTC
  std::string skip;     ///< why it is not analysed; empty: it is
};

/// A list or a folder from which frames come, with its hash for the plan.
struct FrameSource {
  std::string name;    ///< as in the survey
  std::string sha256;  ///< of a list's bytes; for a folder, of the names of its frames
};

struct ListedFrames {
  std::vector<ListedFrame> frames;  ///< by time, then by name; each once
  std::vector<FrameSource> sources;
};

/// Lists the frames of a camera. A folder stands for all files in it and in its subfolders that have one of
/// the camera's endings, except hidden ones; links to folders are not followed. A list (.txt) has a line
/// "FRAME" or "FRAME TIME" for each frame, TIME in ISO 8601 (UTC or with a zone), names relative to the list;
/// empty lines and lines that begin with # are ignored. A file with many frames stands for each of them,
/// "night.pgm.gz#7", unless a list gives a time with it; a damaged one stands for the frames before the
/// damage, and one more for the rest. Times that are not given in a list are those in the metadata of such
/// files, else those in the file names (fit/photo/frames/imager_name.h, sim/base/utc_time.h), assumed to be
/// UTC. A frame to be skipped has the reason of the first of the survey's skips that applies. Throws
/// sim::Error(unreadable_input) for a folder, list or file that does not exist, an invalid line, a frame
/// without a time; and (scene) for a camera without frames.
ListedFrames survey_frames(const Survey& survey, const SurveyCamera& camera);

}  // namespace vegard::fit
