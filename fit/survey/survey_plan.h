// The plan of a survey: it assigns every frame to a block, so that the results do not depend on how the work
// is divided into shards.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/survey.h"

namespace vegard::fit {

struct PlannedFrame {
  std::string file;     ///< for frame_reference(), relative to SurveyPlan::folder, or absolute
  double time_s = 0.0;  ///< since 1970 in UTC
  std::string skip;     ///< why it is not analysed; empty: it is
};

/// Consecutive frames of one camera and one calibration. The fit of a frame starts at the result of the frame
/// before it, the first one without such a start; therefore one process does a block from its beginning.
struct PlannedBlock {
  int camera = 0;
  int calibration = -1;  ///< of the camera; -1: there is none for this time, and all frames are skipped
  int first_frame = 0;   ///< its number among all frames of the plan
  double seconds = 0.0;  ///< estimated computing time
  std::vector<PlannedFrame> frames;

  /// Returns the number of the first frame after the block.
  int end_frame() const { return first_frame + static_cast<int>(frames.size()); }
};

/// An input on which the answers depend, with its hash at the time the plan was made.
struct PlanInput {
  std::string what;  ///< "the survey", "the setup of gill, calibration 1", "frames/list.txt"
  std::string sha256;
};

struct SurveyPlan {
  std::string name;
  std::string folder;   ///< of the survey, relative to the plan's, or absolute
  std::string version;  ///< of the program that made it
  std::vector<SurveyWork> work;
  std::vector<SurveyCamera> cameras;  ///< without the sources of their frames (SurveyCamera::frames, endings)
  std::vector<PlanInput> inputs;
  std::vector<PlannedBlock> blocks;
  int shards = 1;  ///< number of tasks, by the survey's shard_minutes and max_shards

  // Not in the file.
  std::string file;    ///< where it was read
  std::string sha256;  ///< of the file's bytes

  int frames() const;
  double seconds() const;
  /// Returns a name with which a file of the plan can be opened.
  std::string place(const std::string& name) const;
  /// Returns the hash of an input (PlanInput::what); empty if there is none.
  std::string sha256_of(const std::string& what) const;
};

/// Returns "the setup of gill, calibration 1": PlanInput::what of a camera's setup, on which the analysis of
/// its frames depends.
std::string setup_words(const SurveyCamera& camera, int calibration);

/// The frames of a camera with their times: by their names, by a list, or, for a file that may hold many
/// (PGM, PPM, gzipped or not), by its own metadata. Only such files are opened.
struct ListedFrames {
  std::vector<PlannedFrame> frames;  ///< by time, then by name; each once
  std::vector<PlanInput> sources;    ///< lists by their bytes, folders by the names of their frames
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

/// Lists all frames and divides them into blocks: by camera, in the order of time, with a new block when the
/// calibration changes, after gaps, and after block_frames frames. `setups`: an input for each camera and
/// calibration. The plan's `folder` is left empty. Throws as survey_frames() does.
SurveyPlan plan_survey(const Survey& survey, const std::vector<PlanInput>& setups);

/// Returns the number of shards, at least one, that take at least `min_seconds` each.
int shard_count(const std::vector<PlannedBlock>& blocks, double min_seconds, int max_shards);

/// The consecutive blocks [begin, end) of shard `shard`, from 1 to `shards`. All shards have about the same
/// estimated time. Every block is in exactly one shard; a shard may be empty if there are few blocks.
struct BlockRange {
  int begin = 0, end = 0;
};
BlockRange blocks_of_shard(const SurveyPlan& plan, int shard, int shards);

// Reads and writes plans of surveys as JSON files, whose format docs/file_formats.md describes.

/// Returns a plan as JSON, with one line per block. The same plan gives the same bytes; all numbers are
/// restored exactly.
std::string plan_json(const SurveyPlan& plan);

/// Parses a plan. Throws sim::Error(unreadable_input) with the name `file` if the text is not a plan, or one
/// of another version of the format.
SurveyPlan plan_of_json(const std::string& json, const std::string& file);

/// Reads a plan from a file. Throws as plan_of_json().
SurveyPlan read_plan(const std::string& file);

}  // namespace vegard::fit
