#include "fit/survey/survey_export.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <tuple>

#include "fit/survey/survey_frame.h"
#include "fit/survey/survey_results.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

using Take = std::function<void(const std::string& line)>;

/// Joins cells by commas.
class CsvLine {
 public:
  template <class... Cells>
  explicit CsvLine(const Cells&... cells) {
    add(cells...);
  }
  template <class... Cells>
  CsvLine& add(const Cells&... cells) {
    ((text_ += (text_.empty() ? "" : ",") + cell(cells)), ...);
    return *this;
  }
  std::string line() const { return text_ + "\n"; }

 private:
  static std::string cell(const std::optional<std::string>& text) { return text ? sim::csv_cell(*text) : ""; }
  static std::string cell(const std::string& text) { return sim::csv_cell(text); }
  static std::string cell(const char* text) { return sim::csv_cell(text); }
  static std::string cell(const std::optional<double>& number) {
    return sim::csv_number(number.value_or(sim::kNaN));
  }
  static std::string cell(std::int64_t number) { return std::to_string(number); }
  std::string text_;
};

constexpr const char* kFacts = "frame,camera,file,time_utc,status,reason";
CsvLine facts_line(const FrameAnswer& answer) {
  return CsvLine(answer.frame, answer.camera, answer.file, sim::utc_text(answer.time_s),
                 frame_status_name(answer.status), answer.reason);
}

void each_frame(const SurveyReader& reader, const std::function<void(const FrameAnswer& answer)>& take) {
  reader.frames(0, std::numeric_limits<int>::max(), take);
}

void wide_table(const SurveyReader& reader, const Take& take) {
  const SurveyColumns all = survey_columns(reader);
  std::string head = kFacts;
  for (const auto& [work, verdicts] : all.verdicts)
    head += std::string(",") + survey_work_name(work) + " verdict";
  for (const SurveyColumn& column : all.columns) {
    const std::string name = std::string(survey_work_name(column.work)) + ": " + column.name +
                             (column.unit.empty() ? "" : " (" + column.unit + ")");
    head += "," + sim::csv_cell(name) + "," + sim::csv_cell("sigma of " + name) + "," +
            sim::csv_cell("trust of " + name);
  }
  take(head + "\n");
  each_frame(reader, [&](const FrameAnswer& answer) {
    CsvLine line = facts_line(answer);
    for (const auto& [work, verdicts] : all.verdicts) {
      const WorkAnswer* found = work_in(answer, work);
      line.add(found != nullptr ? std::optional(found->verdict) : std::nullopt);
    }
    for (const SurveyColumn& column : all.columns) {
      const SurveyQuantity* q = quantity_in(work_in(answer, column.work), column);
      if (q != nullptr)
        line.add(q->value, q->sigma, q->trust);
      else
        line.add("", "", "");
    }
    take(line.line());
  });
}

void frames_table(const SurveyReader& reader, const Take& take) {
  take(std::string(kFacts) + ",block,time_s,sha256,decoding\n");
  each_frame(reader, [&](const FrameAnswer& answer) {
    take(facts_line(answer)
             .add(answer.block, std::optional(answer.time_s), answer.sha256, answer.decoding)
             .line());
  });
}

void results_table(const SurveyReader& reader, const Take& take) {
  take(std::string(kFacts) + ",work,verdict,words,start,chi2_per_dof,seed\n");
  each_frame(reader, [&](const FrameAnswer& answer) {
    for (const WorkAnswer& w : answer.works)
      take(facts_line(answer)
               .add(survey_work_name(w.work), w.verdict, w.words, w.start, w.chi2_per_dof,
                    w.seed ? std::to_string(*w.seed) : "")
               .line());
  });
}

void quantities_table(const SurveyReader& reader, const Take& take) {
  take("frame,camera,time_utc,work,item,name,unit,value,sigma,trust,reason\n");
  each_frame(reader, [&](const FrameAnswer& answer) {
    for (const WorkAnswer& w : answer.works)
      for (const SurveyQuantity& q : w.quantities)
        take(CsvLine(answer.frame, answer.camera, sim::utc_text(answer.time_s), survey_work_name(w.work),
                     q.item, q.name, q.unit, q.value, q.sigma, q.trust, q.reason)
                 .line());
  });
}

void velocities_table(const SqliteFile& database, const Take& take) {
  take(
      "frame,camera,time_utc,work,item,name,track,position,position_sigma,unit,velocity,velocity_sigma,"
      "velocity_unit\n");
  SqliteStatement rows(
      database,
      "SELECT frame, camera, time_utc, work, item, name, track, position, position_sigma, unit, velocity, "
      "velocity_sigma, velocity_unit FROM velocity JOIN frame USING (frame) ORDER BY frame, work, item, "
      "name");
  while (rows.step())
    take(CsvLine(rows.integer(0), rows.text(1), rows.text(2), rows.text(3), rows.integer(4), rows.text(5),
                 rows.integer(6), rows.number_or_none(7), rows.number_or_none(8), rows.text(9),
                 rows.number_or_none(10), rows.number_or_none(11), rows.text(12))
             .line());
}

void flags_table(const SqliteFile& database, const Take& take) {
  take("frame,camera,file,time_utc,work,item,name,track,kind,chi2,chi2_limit\n");
  SqliteStatement rows(
      database,
      "SELECT frame, camera, file, time_utc, work, item, name, track, kind, chi2, chi2_limit "
      "FROM flag JOIN frame USING (frame) ORDER BY frame, work, item, name");
  while (rows.step())
    take(CsvLine(rows.integer(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.integer(5),
                 rows.text(6), rows.integer(7), rows.text(8), rows.number_or_none(9), rows.number_or_none(10))
             .line());
}

bool is_in_column(SurveyWork work, const SurveyQuantity& quantity) {
  constexpr int kMiddleStrip = (kSurveyStrips + 1) / 2;
  return work == SurveyWork::profile ? quantity.item == kMiddleStrip : quantity.item <= 1;
}

}  // namespace

std::optional<SurveyTableKind> survey_table_kind(const std::string& word) {
  constexpr std::array kWords = {"wide", "frames", "results", "quantities", "velocities", "flags"};
  const auto found = std::find(kWords.begin(), kWords.end(), word);
  if (found == kWords.end()) return std::nullopt;
  return static_cast<SurveyTableKind>(found - kWords.begin());
}

void write_survey_csv(const SqliteFile& database, SurveyTableKind kind, const std::string& output,
                      bool overwrite) {
  const SurveyReader reader(database);
  const bool is_of_motion = kind == SurveyTableKind::velocities || kind == SurveyTableKind::flags;
  if (is_of_motion && !has_motion(database))
    throw sim::Error(sim::ErrorKind::usage, "has no velocities yet")
        .file(database.name())
        .key("--table")
        .hint("vegard survey smooth makes them");
  sim::WholeFile whole(output, overwrite);
  std::ofstream stream(whole.temporary(), std::ios::binary);
  const auto require_written = [&] {
    if (!stream) throw sim::unwritable(output, errno);
  };
  const Take take = [&](const std::string& line) {
    stream << line;
    require_written();
  };
  switch (kind) {
    case SurveyTableKind::wide:
      wide_table(reader, take);
      break;
    case SurveyTableKind::frames:
      frames_table(reader, take);
      break;
    case SurveyTableKind::results:
      results_table(reader, take);
      break;
    case SurveyTableKind::quantities:
      quantities_table(reader, take);
      break;
    case SurveyTableKind::velocities:
      velocities_table(database, take);
      break;
    case SurveyTableKind::flags:
      flags_table(database, take);
      break;
  }
  stream.close();
  require_written();
  whole.commit();
}

bool SurveyColumn::operator<(const SurveyColumn& o) const {
  return std::tie(work, name, unit) < std::tie(o.work, o.name, o.unit);
}

SurveyColumns survey_columns(const SurveyReader& reader) {
  SurveyColumns all;
  reader.frames(0, std::numeric_limits<int>::max(), [&](const FrameAnswer& answer) {
    ++all.frames;
    for (const WorkAnswer& w : answer.works) {
      all.verdicts[w.work].insert(w.verdict);
      for (const SurveyQuantity& q : w.quantities) {
        if (!is_in_column(w.work, q)) continue;
        all.columns.insert({w.work, q.name, q.unit});
        if (q.trust) all.with_trust.insert({w.work, q.name, q.unit});
      }
    }
  });
  return all;
}

const WorkAnswer* work_in(const FrameAnswer& answer, SurveyWork work) {
  for (const WorkAnswer& one : answer.works)
    if (one.work == work) return &one;
  return nullptr;
}

const SurveyQuantity* quantity_in(const WorkAnswer* work, const SurveyColumn& column) {
  if (work == nullptr) return nullptr;
  for (const SurveyQuantity& q : work->quantities)
    if (is_in_column(work->work, q) && q.name == column.name && q.unit == column.unit) return &q;
  return nullptr;
}

}  // namespace vegard::fit
