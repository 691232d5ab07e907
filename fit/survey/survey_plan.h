// The plan of a survey: every frame with its place in a block, so that what is done with it does not depend
// on how the work is cut into shards.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/survey.h"

namespace vegard::fit {

struct PlannedFrame {
  std::string file;     ///< as frame_reference() takes it, relative to SurveyPlan::folder, or absolute
  double time_s = 0.0;  ///< since 1970 in UTC
  std::string skip;     ///< why nothing is done with it; empty: something is
};

/// Consecutive frames of one camera and one calibration. A frame starts where the one before it has ended,
/// the first by itself: a block is done by one process, from its beginning.
struct PlannedBlock {
  int camera = 0;
  int calibration = -1;  ///< of the camera; -1: there is none for this time, and all frames are skipped
  int first_frame = 0;   ///< its number among all frames of the plan
  double seconds = 0.0;  ///< that it takes, as estimated
  std::vector<PlannedFrame> frames;
};

/// Something that the answers depend on, with its hash when the plan was made.
struct PlanInput {
  std::string what;  ///< "the survey", "the setup of gill, calibration 1", "frames/list.txt"
  std::string sha256;
};

struct SurveyPlan {
  std::string name;
  std::string folder;   ///< of the survey, relative to the plan's, or absolute
  std::string version;  ///< of the program that made it
  std::vector<SurveyWork> work;
  std::vector<SurveyCamera> cameras;  ///< without what they were listed from
  std::vector<PlanInput> inputs;
  std::vector<PlannedBlock> blocks;
  int shards = 1;  ///< tasks that the work is to be cut into, as the survey wants them to be long

  // Not in the file.
  std::string file;    ///< where it was read
  std::string sha256;  ///< of the file's bytes

  int frames() const;
  double seconds() const;
  /// A file's name of the plan as it may be opened.
  std::string place(const std::string& name) const;
  /// The hash of the input; empty if there is none.
  std::string sha256_of(const std::string& what) const;
};

/// "the setup of gill, calibration 1": what PlanInput calls all that a camera's frames are worked out by.
std::string setup_words(const SurveyCamera& camera, int calibration);

/// Lists all frames and makes blocks of them: by camera, in the order of time, cut where the calibration
/// changes, after gaps, and after block_frames. `setups`: an input for each camera and calibration. `folder`
/// of the plan is left empty. Throws as survey_frames() does.
SurveyPlan plan_survey(const Survey& survey, const std::vector<PlanInput>& setups);

/// How many tasks of at least this length there are, one at least.
int shard_count(const std::vector<PlannedBlock>& blocks, double min_seconds, int max_shards);

/// Whole blocks, one after the other, [begin, end): shard `shard` from 1 to `shards`, all about as long as
/// estimated. The shards have each block once; there may be empty ones where there are fewer blocks.
struct BlockRange {
  int begin = 0, end = 0;
};
BlockRange blocks_of_shard(const SurveyPlan& plan, int shard, int shards);

}  // namespace vegard::fit
