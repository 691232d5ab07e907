// The database of a survey's results; docs/surveys.md describes its tables.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit/survey/sqlite_file.h"
#include "fit/survey/survey_answer.h"
#include "fit/survey/survey_plan.h"

namespace vegard::fit {

/// Which program has worked out answers: others may differ in the last digits, or in more.
struct SurveyVersions {
  std::string vegard, ceres, eigen, opencv;
  bool operator==(const SurveyVersions& o) const {
    return vegard == o.vegard && ceres == o.ceres && eigen == o.eigen && opencv == o.opencv;
  }
  bool operator<(const SurveyVersions& o) const;
  std::string words() const;  ///< "vegard 0.1.0, Ceres 2.1.0, …"
};
SurveyVersions survey_versions();

/// A plan that answers are of.
struct AnsweredPlan {
  std::string sha256, name;
  int frames = 0, blocks = 0;
  std::vector<PlanInput> inputs;
};
AnsweredPlan answered_plan(const SurveyPlan& plan);

/// A block that is there, at least in part.
struct AnsweredBlock {
  int block = 0, first_frame = 0;  ///< of the plan
  int frames = 0;                  ///< that it has
  int done = 0;                    ///< frames that are there: the first so many
  int origin = 0;                  ///< SurveyReader::origins() of it
};

/// Makes the tables in an empty database.
void make_survey_tables(SqliteFile& file);

/// Throws sim::Error(unreadable_input) unless the tables are those that this version makes, with or without
/// those of motion.
void check_survey_tables(const SqliteFile& file);

/// The tables of fit/survey/survey_motion.h: whether they are there; makes them, and removes them again.
bool has_motion(const SqliteFile& file);
void make_motion_tables(SqliteFile& file);
void drop_motion_tables(SqliteFile& file);

/// Rows, as they are; for merging, which numbers them again.
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

/// A database of a survey that is read, whoever made it.
class SurveyReader {
 public:
  struct Origin {
    int plan = 0;  ///< index into plans()
    SurveyVersions versions;
  };

  explicit SurveyReader(const SqliteFile& file);

  const std::vector<AnsweredPlan>& plans() const { return plans_; }
  const std::vector<Origin>& origins() const { return origins_; }

  /// In their order; `done` counted.
  std::vector<AnsweredBlock> blocks() const;

  /// All frames whose numbers lie in [first, end), in their order, with works and quantities in theirs.
  void frames(int first, int end, const std::function<void(const FrameAnswer& answer)>& take) const;

 private:
  const SqliteFile& file_;
  std::vector<AnsweredPlan> plans_;
  std::vector<Origin> origins_;
};

/// A shard's database, which grows frame by frame and is gone on with after whatever has ended it.
class ShardResults {
 public:
  /// Makes it, or goes on with it. Throws sim::Error(existing_output) for one of another plan or of other
  /// versions, and as SqliteFile and check_survey_tables() do.
  ShardResults(const std::string& file, const SurveyPlan& plan);

  /// How many frames of the block are there: the first so many.
  int done(int block) const;

  /// The fit of the last frame of the block that has one; none if none has.
  std::optional<WorkAnswer> last_fit(int block) const;

  /// The next frames of blocks, in one transaction; none of them is there if the disk is full
  /// (Error(unwritable_output)). What another process has added meanwhile stays: a task that its cluster
  /// believed dead, and began again elsewhere, finds the same answers.
  void add(const std::vector<FrameAnswer>& answers);

  /// A frame that could not be had.
  struct Lost {
    int frame = 0;  ///< of the plan
    FrameStatus status = FrameStatus::missing;
    std::string sha256;  ///< of the file as it was; empty: there was none
  };
  /// Those of the block, in their order.
  std::vector<Lost> lost(int block) const;

  /// The block's frames from this one of the plan on were never done. How many were.
  int forget(int block, int from_frame);

  /// How many frames were there already when they were to be added.
  int frames_of_others() const { return others_; }

  const std::string& name() const { return file_.name(); }

 private:
  const SurveyPlan& plan_;
  SqliteFile file_;
  std::optional<SurveyWriter> writer_;
  int others_ = 0;
};

/// Frames of a database by their status, in the order of FrameStatus.
std::vector<int> count_by_status(const SqliteFile& file);

/// False for what a run leaves that ended before its first transaction: a database without tables.
bool is_begun(const SqliteFile& file);

}  // namespace vegard::fit
