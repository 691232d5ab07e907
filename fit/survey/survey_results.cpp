#include "fit/survey/survey_results.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>

#include "fit/version.h"
#include "sim/base/error.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

constexpr std::int64_t kApplication = 0x76677376;  // "vgsv"
constexpr int kTablesFormat = 2;

struct TableOfSurvey {
  const char *name, *columns;
};
/// The tables of every survey's database, in the order of their names.
constexpr std::array<TableOfSurvey, 7> kTables = {{
    {"block",
     "(block INTEGER PRIMARY KEY, origin INTEGER NOT NULL, first_frame INTEGER NOT NULL, frames INTEGER NOT "
     "NULL)"},
    {"frame",
     "(frame INTEGER PRIMARY KEY, block INTEGER NOT NULL, camera TEXT NOT NULL, file TEXT NOT NULL, time_utc "
     "TEXT NOT NULL, time_s REAL NOT NULL, status TEXT NOT NULL, reason TEXT, sha256 TEXT, decoding TEXT)"},
    {"input",
     "(plan INTEGER NOT NULL, input INTEGER NOT NULL, what TEXT NOT NULL, sha256 TEXT NOT NULL, PRIMARY KEY "
     "(plan, input)) WITHOUT ROWID"},
    {"origin",
     "(origin INTEGER PRIMARY KEY, plan INTEGER NOT NULL, vegard TEXT NOT NULL, ceres TEXT NOT NULL, eigen "
     "TEXT NOT NULL, opencv TEXT NOT NULL)"},
    {"plan",
     "(plan INTEGER PRIMARY KEY, sha256 TEXT NOT NULL, name TEXT NOT NULL, frames INTEGER NOT NULL, blocks "
     "INTEGER NOT NULL, first_frame INTEGER NOT NULL, first_block INTEGER NOT NULL)"},
    {"quantity",
     "(frame INTEGER NOT NULL, work TEXT NOT NULL, item INTEGER NOT NULL, name TEXT NOT NULL, unit TEXT NOT "
     "NULL, value REAL, sigma REAL, trust TEXT, reason TEXT, PRIMARY KEY (frame, work, item, name)) WITHOUT "
     "ROWID"},
    {"result",
     "(frame INTEGER NOT NULL, work TEXT NOT NULL, verdict TEXT NOT NULL, words TEXT, start TEXT, "
     "chi2_per_dof REAL, "
     "seed INTEGER, free_values TEXT, physics TEXT, PRIMARY KEY (frame, work)) WITHOUT ROWID"},
}};

/// The further tables that vegard survey smooth writes.
constexpr std::array<TableOfSurvey, 3> kMotionTables = {{
    {"flag",
     "(frame INTEGER NOT NULL, work TEXT NOT NULL, item INTEGER NOT NULL, name TEXT NOT NULL, track INTEGER "
     "NOT NULL, kind TEXT NOT NULL, chi2 REAL, chi2_limit REAL NOT NULL, PRIMARY KEY (frame, work, item, "
     "name)) WITHOUT ROWID"},
    {"track",
     "(track INTEGER PRIMARY KEY, camera TEXT NOT NULL, work TEXT NOT NULL, item INTEGER NOT NULL, name TEXT "
     "NOT NULL, unit TEXT NOT NULL, first_frame INTEGER NOT NULL, last_frame INTEGER NOT NULL, used INTEGER "
     "NOT NULL, outliers INTEGER NOT NULL, breaks INTEGER NOT NULL, process_noise REAL, process_noise_unit "
     "TEXT NOT NULL, innovation_chi2 REAL)"},
    {"velocity",
     "(frame INTEGER NOT NULL, work TEXT NOT NULL, item INTEGER NOT NULL, name TEXT NOT NULL, track INTEGER "
     "NOT NULL, position REAL NOT NULL, position_sigma REAL NOT NULL, unit TEXT NOT NULL, velocity REAL NOT "
     "NULL, velocity_sigma REAL NOT NULL, velocity_unit TEXT NOT NULL, PRIMARY KEY (frame, work, item, "
     "name)) WITHOUT ROWID"},
}};

std::string creation_of(const TableOfSurvey& table) {
  return std::string("CREATE TABLE ") + table.name + " " + table.columns;
}

sim::Error bad_database(const SqliteFile& file, const std::string& problem) {
  return sim::unreadable(file.name(), problem).expected("a database of vegard survey");
}

/// Reads an int, which only a foreign database can exceed.
int small_number(const SqliteFile& file, const SqliteStatement& row, int column) {
  const std::int64_t number = row.integer(column);
  if (number < 0 || number > std::numeric_limits<int>::max())
    throw bad_database(file, "has a number that no survey has");
  return static_cast<int>(number);
}

std::optional<std::string> values_text(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return nlohmann::json(values).dump();
}

std::vector<double> values_of_text(const SqliteFile& file, const std::optional<std::string>& text) {
  if (!text) return {};
  try {
    return nlohmann::json::parse(*text).get<std::vector<double>>();
  } catch (const nlohmann::json::exception&) {
    throw bad_database(file, "has free values that are none");
  }
}

constexpr const char* kResultColumns =
    "SELECT work, verdict, words, start, chi2_per_dof, seed, free_values, physics FROM result ";

WorkAnswer work_of_row(const SqliteFile& file, const SqliteStatement& row) {
  WorkAnswer answer;
  const std::optional<SurveyWork> work = survey_work_of(row.text(0));
  if (!work) throw bad_database(file, "has a result of work that no survey does");
  answer.work = *work;
  answer.verdict = row.text(1);
  answer.words = row.text_or_none(2);
  answer.start = row.text_or_none(3);
  answer.chi2_per_dof = row.number_or_none(4);
  answer.seed = row.integer_or_none(5);
  answer.free_values = values_of_text(file, row.text_or_none(6));
  answer.physics = row.text_or_none(7);
  return answer;
}

FrameStatus status_of(const SqliteFile& file, const std::string& name) {
  for (const FrameStatus status : kFrameStatuses)
    if (name == frame_status_name(status)) return status;
  throw bad_database(file, "has a frame of a status that there is none of");
}

SurveyVersions survey_versions() {
  return {sim::version(), ceres_version(), sim::eigen_version(), opencv_version()};
}

/// Throws sim::Error(unreadable_input) unless the tables are those that this version makes, with or without
/// the tables of motion.
void check_survey_tables(const SqliteFile& file) {
  if (file.integer("PRAGMA application_id") != kApplication)
    throw bad_database(file, "is no database of a survey");
  if (file.integer("PRAGMA user_version") != kTablesFormat)
    throw bad_database(file, "is of another version of vegard, whose tables are others");
  std::vector<TableOfSurvey> tables(kTables.begin(), kTables.end());
  if (has_motion(file)) tables.insert(tables.end(), kMotionTables.begin(), kMotionTables.end());
  std::sort(tables.begin(), tables.end(), [](const TableOfSurvey& a, const TableOfSurvey& b) {
    return std::string_view(a.name) < std::string_view(b.name);
  });
  SqliteStatement rows(file, "SELECT sql FROM sqlite_schema ORDER BY name");
  std::size_t i = 0;
  for (; rows.step(); ++i)
    if (i >= tables.size() || rows.is_null(0) || rows.text(0) != creation_of(tables[i])) break;
  rows.reset();
  if (i != tables.size() ||
      file.integer("SELECT count(*) FROM sqlite_schema") != static_cast<std::int64_t>(tables.size()))
    throw bad_database(file, "has other tables than a survey's");
}

}  // namespace

bool SurveyVersions::operator<(const SurveyVersions& o) const {
  return std::tie(vegard, ceres, eigen, opencv) < std::tie(o.vegard, o.ceres, o.eigen, o.opencv);
}

std::string SurveyVersions::words() const {
  return "vegard " + vegard + ", Ceres " + ceres + ", Eigen " + eigen + ", OpenCV " + opencv;
}

AnsweredPlan answered_plan(const SurveyPlan& plan) {
  return {plan.sha256, plan.name, plan.frames(), static_cast<int>(plan.blocks.size()), plan.inputs};
}

void make_survey_tables(SqliteFile& file) {
  file.run("PRAGMA application_id = " + std::to_string(kApplication) +
           "; PRAGMA user_version = " + std::to_string(kTablesFormat));
  for (const TableOfSurvey& table : kTables) file.run(creation_of(table));
}

bool has_motion(const SqliteFile& file) {
  return file.integer("SELECT count(*) FROM sqlite_schema WHERE name = 'velocity'") > 0;
}

void make_motion_tables(SqliteFile& file) {
  for (const TableOfSurvey& table : kMotionTables) file.run(creation_of(table));
}

void drop_motion_tables(SqliteFile& file) {
  for (const TableOfSurvey& table : kMotionTables) file.run(std::string("DROP TABLE ") + table.name);
}

SurveyWriter::SurveyWriter(SqliteFile& file)
    : plan_(file, "INSERT INTO plan VALUES (?, ?, ?, ?, ?, ?, ?)"),
      input_(file, "INSERT INTO input VALUES (?, ?, ?, ?)"),
      origin_(file, "INSERT INTO origin VALUES (?, ?, ?, ?, ?, ?)"),
      block_(file, "INSERT INTO block VALUES (?, ?, ?, ?)"),
      frame_(file, "INSERT INTO frame VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      result_(file, "INSERT INTO result VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      quantity_(file, "INSERT OR IGNORE INTO quantity VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)") {}

void SurveyWriter::add_plan(int number, const AnsweredPlan& plan, int first_frame, int first_block) {
  plan_.bind_all(number, plan.sha256, plan.name, plan.frames, plan.blocks, first_frame, first_block).run();
  int input_number = 0;
  for (const PlanInput& input : plan.inputs)
    input_.bind_all(number, ++input_number, input.what, input.sha256).run();
}

void SurveyWriter::add_origin(int number, int plan, const SurveyVersions& versions) {
  origin_.bind_all(number, plan, versions.vegard, versions.ceres, versions.eigen, versions.opencv).run();
}

void SurveyWriter::add_block(const AnsweredBlock& block) {
  block_.bind_all(block.block, block.origin, block.first_frame, block.frames).run();
}

void SurveyWriter::add_frame(const FrameAnswer& a) {
  frame_
      .bind_all(a.frame, a.block, a.camera, a.file, sim::utc_text(a.time_s), a.time_s,
                frame_status_name(a.status), a.reason, a.sha256, a.decoding)
      .run();
  for (const WorkAnswer& w : a.works) {
    const char* work = survey_work_name(w.work);
    result_
        .bind_all(a.frame, work, w.verdict, w.words, w.start, w.chi2_per_dof, w.seed,
                  values_text(w.free_values), w.physics)
        .run();
    for (const SurveyQuantity& q : w.quantities)
      quantity_.bind_all(a.frame, work, q.item, q.name, q.unit, q.value, q.sigma, q.trust, q.reason).run();
  }
}

SurveyReader::SurveyReader(const SqliteFile& file) : file_(file) {
  check_survey_tables(file);
  std::vector<int> numbers;
  SqliteStatement plans(file, "SELECT plan, sha256, name, frames, blocks FROM plan ORDER BY plan");
  SqliteStatement inputs(file, "SELECT what, sha256 FROM input WHERE plan = ? ORDER BY input");
  while (plans.step()) {
    numbers.push_back(small_number(file, plans, 0));
    AnsweredPlan plan{
        plans.text(1), plans.text(2), small_number(file, plans, 3), small_number(file, plans, 4), {}};
    inputs.bind_all(numbers.back());
    while (inputs.step()) plan.inputs.push_back({inputs.text(0), inputs.text(1)});
    plans_.push_back(std::move(plan));
  }
  SqliteStatement origins(file,
                          "SELECT origin, plan, vegard, ceres, eigen, opencv FROM origin ORDER BY origin");
  while (origins.step()) {
    Origin origin;
    const int plan = small_number(file, origins, 1);
    origin.plan = static_cast<int>(std::find(numbers.begin(), numbers.end(), plan) - numbers.begin());
    origin.versions = {origins.text(2), origins.text(3), origins.text(4), origins.text(5)};
    if (origin.plan == static_cast<int>(numbers.size()) ||
        origins.integer(0) != static_cast<std::int64_t>(origins_.size()) + 1)
      throw bad_database(file, "has an origin of no plan");
    origins_.push_back(origin);
  }
  if (plans_.empty() || origins_.empty()) throw bad_database(file, "has no plan");
  // Of an empty table both are 0.
  if (file.integer("SELECT coalesce(min(frame), 0) FROM frame") < 0 ||
      file.integer("SELECT coalesce(max(frame), 0) FROM frame") >= std::numeric_limits<int>::max())
    throw bad_database(file, "has a frame whose number no survey has");
}

std::vector<AnsweredBlock> SurveyReader::blocks() const {
  std::vector<AnsweredBlock> found;
  SqliteStatement rows(file_, "SELECT block, origin, first_frame, frames FROM block ORDER BY block");
  SqliteStatement done(file_, "SELECT count(*) FROM frame WHERE frame >= ? AND frame < ? AND block = ?");
  while (rows.step()) {
    AnsweredBlock block;
    block.block = small_number(file_, rows, 0);
    block.origin = small_number(file_, rows, 1);
    block.first_frame = small_number(file_, rows, 2);
    block.frames = small_number(file_, rows, 3);
    const bool is_after =
        found.empty() || block.first_frame >= found.back().first_frame + found.back().frames;
    if (block.origin < 1 || block.origin > static_cast<int>(origins_.size()) || !is_after ||
        block.frames > std::numeric_limits<int>::max() - block.first_frame)
      throw bad_database(file_, "has a block that no plan has");
    done.bind_all(block.first_frame, block.first_frame + block.frames, block.block);
    done.step();
    block.done = small_number(file_, done, 0);
    done.reset();
    found.push_back(block);
  }
  return found;
}

void SurveyReader::frames(int first, int end,
                          const std::function<void(const FrameAnswer& answer)>& take) const {
  SqliteStatement frames(
      file_,
      "SELECT frame, block, camera, file, time_s, status, reason, sha256, decoding FROM frame WHERE "
      "frame >= ? AND frame < ? ORDER BY frame");
  SqliteStatement works(file_, std::string(kResultColumns) + "WHERE frame = ? ORDER BY work");
  SqliteStatement quantities(
      file_,
      "SELECT item, name, unit, value, sigma, trust, reason FROM quantity WHERE frame = ? AND "
      "work = ? ORDER BY item, name");
  frames.bind_all(first, end);
  while (frames.step()) {
    FrameAnswer answer;
    answer.frame = small_number(file_, frames, 0);
    answer.block = small_number(file_, frames, 1);
    answer.camera = frames.text(2);
    answer.file = frames.text(3);
    answer.time_s = frames.number(4);
    if (!(std::abs(answer.time_s) < 1e12)) throw bad_database(file_, "has a frame of no time");
    answer.status = status_of(file_, frames.text(5));
    answer.reason = frames.text_or_none(6);
    answer.sha256 = frames.text_or_none(7);
    answer.decoding = frames.text_or_none(8);
    works.bind_all(answer.frame);
    while (works.step()) {
      WorkAnswer work = work_of_row(file_, works);
      quantities.bind_all(answer.frame, survey_work_name(work.work));
      while (quantities.step())
        work.quantities.push_back({small_number(file_, quantities, 0), quantities.text(1), quantities.text(2),
                                   quantities.number_or_none(3), quantities.number_or_none(4),
                                   quantities.text_or_none(5), quantities.text_or_none(6)});
      answer.works.push_back(std::move(work));
    }
    take(answer);
  }
}

ShardResults::ShardResults(const std::string& file, const SurveyPlan& plan)
    : plan_(plan), file_(file, SqliteFile::Opening::write) {
  const AnsweredPlan answered = answered_plan(plan);
  const SurveyVersions versions = survey_versions();
  // Both in one transaction: two processes may come at once.
  file_.transaction([&] {
    if (file_.integer("SELECT count(*) FROM sqlite_schema") > 0) return;
    make_survey_tables(file_);
    SurveyWriter writer(file_);
    writer.add_plan(1, answered, 0, 0);
    writer.add_origin(1, 1, versions);
  });
  const SurveyReader reader(file_);
  if (reader.plans().size() != 1 || reader.plans()[0].sha256 != answered.sha256)
    throw sim::Error(sim::ErrorKind::existing_output, "is of another plan")
        .file(file)
        .hint("choose another folder, or remove this one to begin again");
  if (reader.origins().size() != 1 || !(reader.origins()[0].versions == versions))
    throw sim::Error(sim::ErrorKind::existing_output,
                     "is of " + reader.origins()[0].versions.words() + "; this is " + versions.words())
        .file(file)
        .hint("choose another folder, or go on with the same version");
  writer_.emplace(file_);
}

int ShardResults::done(int block) const {
  const PlannedBlock& planned = plan_.blocks.at(static_cast<std::size_t>(block));
  SqliteStatement count(file_, "SELECT count(*) FROM frame WHERE frame >= ? AND frame < ?");
  count.bind_all(planned.first_frame, planned.end_frame());
  count.step();
  return small_number(file_, count, 0);
}

std::optional<WorkAnswer> ShardResults::last_fit(int block) const {
  const PlannedBlock& planned = plan_.blocks.at(static_cast<std::size_t>(block));
  SqliteStatement row(file_,
                      std::string(kResultColumns) +
                          "WHERE work = 'fit' AND verdict <> 'refused' AND frame >= ? AND frame < ? ORDER BY "
                          "frame DESC LIMIT 1");
  row.bind_all(planned.first_frame, planned.end_frame());
  if (!row.step()) return std::nullopt;
  return work_of_row(file_, row);
}

std::vector<ShardResults::Lost> ShardResults::lost(int block) const {
  const PlannedBlock& planned = plan_.blocks.at(static_cast<std::size_t>(block));
  SqliteStatement rows(file_,
                       "SELECT frame, status, sha256 FROM frame WHERE frame >= ? AND frame < ? AND status IN "
                       "('missing', 'unreadable') ORDER BY frame");
  rows.bind_all(planned.first_frame, planned.end_frame());
  std::vector<Lost> found;
  while (rows.step())
    found.push_back(
        {small_number(file_, rows, 0), status_of(file_, rows.text(1)), rows.text_or_none(2).value_or("")});
  return found;
}

int ShardResults::forget(int block, int from_frame) {
  const PlannedBlock& planned = plan_.blocks.at(static_cast<std::size_t>(block));
  const int end = planned.end_frame(), before = done(block);
  file_.transaction([&] {
    for (const char* table : {"frame", "result", "quantity"}) {
      SqliteStatement remove(file_, std::string("DELETE FROM ") + table + " WHERE frame >= ? AND frame < ?");
      remove.bind_all(from_frame, end).run();
    }
    if (from_frame > planned.first_frame) return;
    SqliteStatement remove(file_, "DELETE FROM block WHERE block = ?");
    remove.bind_all(block).run();
  });
  return before - done(block);
}

void ShardResults::add(const std::vector<FrameAnswer>& answers) {
  int others = 0;
  file_.transaction([&] {
    others = 0;
    for (const FrameAnswer& answer : answers) {
      const PlannedBlock& planned = plan_.blocks.at(static_cast<std::size_t>(answer.block));
      const int before = answer.frame - planned.first_frame, there = done(answer.block);
      if (there < before) throw sim::unreadable(file_.name(), "has lost frames while it was written to");
      if (there > before) {
        ++others;
        continue;
      }
      if (before == 0)
        writer_->add_block(
            {answer.block, planned.first_frame, static_cast<int>(planned.frames.size()), 0, 1});
      writer_->add_frame(answer);
    }
  });
  others_ += others;
}

bool is_begun(const SqliteFile& file) { return file.integer("SELECT count(*) FROM sqlite_schema") > 0; }

std::vector<int> count_by_status(const SqliteFile& file) {
  if (!is_begun(file)) return std::vector<int>(kFrameStatuses.size(), 0);
  check_survey_tables(file);
  std::vector<int> counts;
  SqliteStatement count(file, "SELECT count(*) FROM frame WHERE status = ?");
  for (const FrameStatus status : kFrameStatuses) {
    count.bind_all(frame_status_name(status));
    count.step();
    counts.push_back(small_number(file, count, 0));
    count.reset();
  }
  return counts;
}

}  // namespace vegard::fit
