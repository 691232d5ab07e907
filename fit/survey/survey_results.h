// The database of a survey's results; docs/surveys.md describes its tables.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/survey/sqlite_file.h"
#include "fit/survey/survey.h"
#include "fit/survey/survey_plan.h"

namespace vegard::fit {

/// The versions of the program and libraries that computed answers: with others the results may differ, in
/// the last digits or more.
struct SurveyVersions {
  std::string vegard, ceres, eigen, opencv;
  bool operator==(const SurveyVersions& o) const {
    return vegard == o.vegard && ceres == o.ceres && eigen == o.eigen && opencv == o.opencv;
  }
  bool operator<(const SurveyVersions& o) const;
  std::string words() const;  ///< "vegard 0.1.0, Ceres 2.1.0, …"
};

/// A plan whose answers are in a database.
struct AnsweredPlan {
  std::string sha256, name;
  int frames = 0, blocks = 0;
  std::vector<PlanInput> inputs;
};
AnsweredPlan answered_plan(const SurveyPlan& plan);

/// A block that is in a database, at least in part.
struct AnsweredBlock {
  int block = 0, first_frame = 0;  ///< numbers in the plan
  int frames = 0;                  ///< of the whole block
  int done = 0;                    ///< number of its frames, from the first, that are in the database
  int origin = 0;                  ///< index into SurveyReader::origins()
};

/// Makes the tables in an empty database.
void make_survey_tables(SqliteFile& file);

/// Test for, make and remove the tables of motion (fit/survey/survey_motion.h).
bool has_motion(const SqliteFile& file);
void make_motion_tables(SqliteFile& file);
void drop_motion_tables(SqliteFile& file);

/// Writes rows with the numbers given by the caller; for merging, which renumbers them.
class SurveyWriter {
 public:
  explicit SurveyWriter(SqliteFile& file);
  void add_plan(int number, const AnsweredPlan& plan, int first_frame, int first_block);
  void add_origin(int number, int plan, const SurveyVersions& versions);
  void add_block(const AnsweredBlock& block);
  void add_frame(const FrameAnswer& answer);

 private:
  SqliteStatement plan_, input_, origin_, block_, frame_, result_, quantity_;
};

/// Reads a survey's database, whether of a shard or merged.
class SurveyReader {
 public:
  struct Origin {
    int plan = 0;  ///< index into plans()
    SurveyVersions versions;
  };

  explicit SurveyReader(const SqliteFile& file);

  const std::string& name() const { return file_.name(); }
  const std::vector<AnsweredPlan>& plans() const { return plans_; }
  const std::vector<Origin>& origins() const { return origins_; }

  /// Returns the blocks in their order.
  std::vector<AnsweredBlock> blocks() const;

  /// Calls `take` for all frames with numbers in [first, end), in their order, each with its works and
  /// quantities in their order.
  void frames(int first, int end, const std::function<void(const FrameAnswer& answer)>& take) const;

 private:
  const SqliteFile& file_;
  std::vector<AnsweredPlan> plans_;
  std::vector<Origin> origins_;
};

/// A shard's database, to which frames are added one by one; an interrupted run can be continued.
class ShardResults {
 public:
  /// Makes the database, or opens an existing one. Throws sim::Error(existing_output) for one of another plan
  /// or of other versions, and as SqliteFile does; also for tables that this version does not make.
  ShardResults(const std::string& file, const SurveyPlan& plan);

  /// Returns how many frames of the block, from its first one, are in the database.
  int done(int block) const;

  /// Returns the last fit among the frames of the block; none if there is no fit.
  std::optional<WorkAnswer> last_fit(int block) const;

  /// Adds the next frames of blocks in one transaction; none of them is added if the disk is full
  /// (Error(unwritable_output)). Frames that another process has added meanwhile are kept: a task that the
  /// cluster considered dead and started again elsewhere computes the same answers.
  void add(const std::vector<FrameAnswer>& answers);

  /// A frame that was missing or unreadable.
  struct Lost {
    int frame = 0;  ///< number in the plan
    FrameStatus status = FrameStatus::missing;
    std::string sha256;  ///< of the file at that time; empty: there was none
  };
  /// Returns the missing and unreadable frames of the block, in their order.
  std::vector<Lost> lost(int block) const;

  /// Removes the block's frames from `from_frame` (number in the plan) on. Returns how many were removed.
  int forget(int block, int from_frame);

  /// Returns how many frames were not added because another process had added them.
  int frames_of_others() const { return others_; }

  const std::string& name() const { return file_.name(); }

 private:
  const SurveyPlan& plan_;
  SqliteFile file_;
  std::optional<SurveyWriter> writer_;
  int others_ = 0;
};

/// Counts the frames of a database by status, in the order of FrameStatus.
std::vector<int> count_by_status(const SqliteFile& file);

/// False for a database without tables, which a run leaves that ended before its first transaction.
bool is_begun(const SqliteFile& file);

}  // namespace vegard::fit
