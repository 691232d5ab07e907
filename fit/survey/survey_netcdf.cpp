#include "fit/survey/survey_export.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "fit/answer/trust.h"
#include "fit/survey/survey_results.h"
#include "sim/base/file/netcdf_dataset.h"
#include "sim/base/file/netcdf_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using sim::NetcdfFile;
using sim::NetcdfType;

constexpr std::size_t kRowsAtATime = 4096;

/// A variable and its rows that are not yet in the file.
template <class T>
struct BufferedColumn {
  NetcdfFile::Variable variable;
  std::vector<T> rows;
  void put(NetcdfFile& file, std::size_t first) {
    file.put(variable, first, rows);
    rows.clear();
  }
};

/// Words as the CF conventions have flags: numbers from 0 on with their meanings beside them. There are not
/// more than a byte has room for, unless somebody has tampered with the database.
class FlagColumn : public BufferedColumn<int> {
 public:
  static constexpr std::size_t kMaxFlags = 100;
  FlagColumn(NetcdfFile& file, const std::string& name, const std::string& long_name,
             const std::vector<std::string>& words, const std::vector<NetcdfFile::Dimension>& dimensions)
      : BufferedColumn{file.variable(name, NetcdfType::flag, dimensions), {}},
        words_(words.begin(),
               words.begin() + static_cast<std::ptrdiff_t>(std::min(words.size(), kMaxFlags))) {
    file.attribute(variable, "long_name", long_name);
    std::vector<int> numbers;
    for (std::size_t i = 0; i < words_.size(); ++i) numbers.push_back(static_cast<int>(i));
    if (words_.empty()) return;
    file.flags(variable, "flag_values", numbers);
    file.attribute(variable, "flag_meanings", sim::netcdf_flag_meanings(words_));
  }
  void add(const std::optional<std::string>& word) {
    rows.push_back(word ? sim::flag_number(words_, *word) : sim::kNetcdfNoFlag);
  }

 private:
  std::vector<std::string> words_;
};

struct RealColumn : BufferedColumn<double> {
  RealColumn(NetcdfFile& file, const std::string& name, const std::string& long_name, const std::string& unit,
             const std::vector<NetcdfFile::Dimension>& dimensions)
      : BufferedColumn{file.variable(name, NetcdfType::real, dimensions), {}} {
    file.attribute(variable, "long_name", long_name);
    file.attribute(variable, "units", sim::udunits_of(unit));
  }
  void add(const std::optional<double>& value) { rows.push_back(value.value_or(sim::kNaN)); }
};

/// A number with its error, and whether to trust it.
struct QuantityColumns {
  SurveyColumn quantity;
  RealColumn value, sigma;
  std::optional<FlagColumn> trust;
};

/// The motion of a number, which vegard survey smooth has written.
struct MotionColumns {
  std::string work, name;
  int item = 0;
  RealColumn velocity, sigma;
  FlagColumn flag;
};

std::vector<std::string> status_words() {
  std::vector<std::string> words;
  for (const FrameStatus status : kFrameStatuses) words.emplace_back(frame_status_name(status));
  return words;
}

class SurveyNetcdf {
 public:
  SurveyNetcdf(NetcdfFile& file, const SqliteFile& database, const SurveyReader& reader,
               const SurveyColumns& all)
      : file_(file) {
    const std::vector<NetcdfFile::Dimension> frame = {
        file.dimension("frame", static_cast<std::size_t>(all.frames))};
    number_.variable =
        define("frame_number", NetcdfType::whole, "number of the frame in the survey's plan", frame);
    file.attribute(number_.variable, "units", "1");
    time_.variable = define("time", NetcdfType::real, "when the frame was taken", frame);
    file.attribute(time_.variable, "standard_name", "time");
    file.attribute(time_.variable, "units", "seconds since 1970-01-01 00:00:00");
    file.attribute(time_.variable, "calendar", "standard");
    camera_.variable = define("camera", NetcdfType::text, "camera", frame);
    frame_file_.variable =
        define("file", NetcdfType::text, "file of the frame, from the survey's folder", frame);
    status_.emplace(file, names_.of("status"), "what became of the frame", status_words(), frame);
    at_time(status_->variable);
    for (const auto& [work, verdicts] : all.verdicts) {
      const std::string name = survey_work_name(work);
      verdicts_.emplace_back(work,
                             FlagColumn(file, names_.of(name + " verdict"), "verdict of the work " + name,
                                        {verdicts.begin(), verdicts.end()}, frame));
      at_time(verdicts_.back().second.variable);
    }
    for (const SurveyColumn& column : all.columns)
      define_quantity(column, all.with_trust.count(column) > 0, frame);
    if (has_motion(database)) define_motion(database, frame);
    describe(reader);
  }

  void take(const FrameAnswer& answer) {
    number_.rows.push_back(answer.frame);
    time_.rows.push_back(answer.time_s);
    camera_.rows.push_back(answer.camera);
    frame_file_.rows.push_back(answer.file);
    status_->add(std::string(frame_status_name(answer.status)));
    for (auto& [work, column] : verdicts_) {
      const WorkAnswer* found = work_in(answer, work);
      column.add(found != nullptr ? std::optional(found->verdict) : std::nullopt);
    }
    for (QuantityColumns& column : quantities_) {
      const SurveyQuantity* q = quantity_in(work_in(answer, column.quantity.work), column.quantity);
      column.value.add(q != nullptr ? q->value : std::nullopt);
      column.sigma.add(q != nullptr ? q->sigma : std::nullopt);
      if (column.trust) column.trust->add(q != nullptr ? q->trust : std::nullopt);
    }
    for (MotionColumns& column : motions_) take_motion(answer.frame, column);
    if (number_.rows.size() == kRowsAtATime) put();
  }

  void put() {
    if (number_.rows.empty()) return;
    const std::size_t count = number_.rows.size();
    number_.put(file_, first_);
    time_.put(file_, first_);
    camera_.put(file_, first_);
    frame_file_.put(file_, first_);
    status_->put(file_, first_);
    for (auto& [work, column] : verdicts_) column.put(file_, first_);
    for (QuantityColumns& column : quantities_) {
      column.value.put(file_, first_);
      column.sigma.put(file_, first_);
      if (column.trust) column.trust->put(file_, first_);
    }
    for (MotionColumns& column : motions_) {
      column.velocity.put(file_, first_);
      column.sigma.put(file_, first_);
      column.flag.put(file_, first_);
    }
    first_ += count;
  }

 private:
  NetcdfFile::Variable define(const std::string& name, NetcdfType type, const std::string& long_name,
                              const std::vector<NetcdfFile::Dimension>& dimensions) {
    const NetcdfFile::Variable made = file_.variable(names_.of(name), type, dimensions);
    file_.attribute(made, "long_name", long_name);
    return made;
  }
  void at_time(const NetcdfFile::Variable& variable) { file_.attribute(variable, "coordinates", "time"); }

  void define_quantity(const SurveyColumn& column, bool has_trust,
                       const std::vector<NetcdfFile::Dimension>& frame) {
    const std::string work = survey_work_name(column.work), name = names_.of(work + " " + column.name);
    const std::string sigma = names_.of(name + "_sigma"), trust = has_trust ? names_.of(name + "_trust") : "";
    QuantityColumns made{column, RealColumn(file_, name, column.name, column.unit, frame),
                         RealColumn(file_, sigma, "standard deviation of " + column.name, column.unit, frame),
                         std::nullopt};
    if (has_trust)
      made.trust.emplace(file_, trust, "whether to trust " + column.name,
                         std::vector<std::string>{trust_name(Trust::good), trust_name(Trust::doubtful),
                                                  trust_name(Trust::unconstrained)},
                         frame);
    if (column.unit == "white")
      file_.attribute(made.value.variable, "comment", "share of the picture's white");
    file_.attribute(made.value.variable, "ancillary_variables", sigma + (has_trust ? " " + trust : ""));
    for (const NetcdfFile::Variable& one : {made.value.variable, made.sigma.variable}) at_time(one);
    if (made.trust) at_time(made.trust->variable);
    quantities_.push_back(std::move(made));
  }

  void define_motion(const SqliteFile& database, const std::vector<NetcdfFile::Dimension>& frame) {
    SqliteStatement rows(database,
                         "SELECT DISTINCT work, item, name, velocity_unit FROM velocity ORDER BY work, item, "
                         "name");
    while (rows.step()) {
      const std::string work = rows.text(0), words = rows.text(2);
      const std::string name = names_.of(work + " velocity of " + words), sigma = names_.of(name + "_sigma"),
                        flag = names_.of(name + "_flag");
      motions_.push_back(
          {work, words, static_cast<int>(rows.integer(1)),
           RealColumn(file_, name, "how fast it grows: " + words, rows.text(3), frame),
           RealColumn(file_, sigma, "standard deviation of how fast it grows: " + words, rows.text(3), frame),
           FlagColumn(file_, flag, "whether it jumps: " + words, {"sound", "outlier", "break"}, frame)});
      const MotionColumns& made = motions_.back();
      file_.attribute(made.velocity.variable, "ancillary_variables", sigma + " " + flag);
      for (const NetcdfFile::Variable& one :
           {made.velocity.variable, made.sigma.variable, made.flag.variable})
        at_time(one);
    }
    motion_.emplace(
        database,
        "SELECT velocity, velocity_sigma, (SELECT kind FROM flag f WHERE f.frame = v.frame AND "
        "f.work = v.work AND f.item = v.item AND f.name = v.name) FROM velocity v WHERE frame = ? "
        "AND work = ? AND item = ? AND name = ?");
  }

  void take_motion(int frame, MotionColumns& column) {
    motion_->bind_all(frame, column.work, column.item, column.name);
    const bool is_known = motion_->step();
    column.velocity.add(is_known ? motion_->number_or_none(0) : std::nullopt);
    column.sigma.add(is_known ? motion_->number_or_none(1) : std::nullopt);
    column.flag.add(is_known ? std::optional(motion_->text_or_none(2).value_or("sound")) : std::nullopt);
    if (is_known) motion_->reset();
  }

  void describe(const SurveyReader& reader) {
    file_.attribute("Conventions", "CF-1.8");
    std::string names, sources, plans;
    for (const AnsweredPlan& plan : reader.plans()) {
      names += (names.empty() ? "" : ", ") + plan.name;
      plans += (plans.empty() ? "" : " ") + plan.sha256;
    }
    for (const SurveyReader::Origin& origin : reader.origins())
      sources += (sources.empty() ? "" : "; ") + origin.versions.words();
    file_.attribute("title", "vegard survey " + names);
    file_.attribute("source", sources);
    file_.attribute("plan_sha256", plans);
    file_.attribute(
        "comment",
        std::string("A row a frame, by camera and time. Of a border the brightest trace. Written by "
                    "vegard ") +
            sim::version() + ".");
  }

  NetcdfFile& file_;
  sim::NetcdfNames names_;
  BufferedColumn<int> number_;
  BufferedColumn<double> time_;
  BufferedColumn<std::string> camera_, frame_file_;
  std::optional<FlagColumn> status_;
  std::vector<std::pair<SurveyWork, FlagColumn>> verdicts_;
  std::vector<QuantityColumns> quantities_;
  std::vector<MotionColumns> motions_;
  std::optional<SqliteStatement> motion_;
  std::size_t first_ = 0;
};

}  // namespace

void write_survey_netcdf(const SqliteFile& database, const std::string& output, bool overwrite) {
  const SurveyReader reader(database);
  sim::WholeFile whole(output, overwrite);
  const SurveyColumns all = survey_columns(reader);
  NetcdfFile file(whole.temporary(), output);
  SurveyNetcdf survey(file, database, reader, all);
  reader.frames(0, std::numeric_limits<int>::max(), [&](const FrameAnswer& answer) { survey.take(answer); });
  survey.put();
  file.close();
  whole.commit();
}

}  // namespace vegard::fit
