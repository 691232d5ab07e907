// Exports a survey's database for other programs: as tables (CSV) and as netCDF.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "fit/survey/sqlite_file.h"
#include "fit/survey/survey_results.h"

namespace vegard::fit {

enum class SurveyTableKind {
  wide,        ///< a row per frame, with a column for each quantity (survey_columns.h)
  frames,      ///< a row per frame
  results,     ///< a row for each frame and work
  quantities,  ///< a row for each quantity
  velocities,  ///< a row for each quantity that vegard survey smooth has followed
  flags,       ///< a row for each quantity flagged as an outlier or a break
};
/// Returns the kind with a name such as "wide"; none for other words.
std::optional<SurveyTableKind> survey_table_kind(const std::string& word);

/// Writes the table, completely or not at all, with memory for one row at a time. Unknown values are empty.
/// Throws sim::Error(usage) if the database lacks the table (velocities, flags), and as SurveyReader and
/// WholeFile do.
void write_survey_csv(const SqliteFile& database, SurveyTableKind kind, const std::string& output,
                      bool overwrite);

// The columns of a table with one row per frame of a survey.

/// A quantity of frames. If a frame has several items of a kind, the column is for the first: a border's
/// brightest trace, a map's first curtain; for profiles it is for the middle strip.
struct SurveyColumn {
  SurveyWork work = SurveyWork::border;
  std::string name, unit;
  bool operator<(const SurveyColumn& o) const;
};

struct SurveyColumns {
  int frames = 0;
  std::map<SurveyWork, std::set<std::string>> verdicts;  ///< that occur, for each work
  std::set<SurveyColumn> columns;
  std::set<SurveyColumn> with_trust;  ///< columns of quantities that have a trust
};

/// Finds the columns; reads all frames once.
SurveyColumns survey_columns(const SurveyReader& reader);

/// Returns the answer of a frame's work; null if the work was not done.
const WorkAnswer* work_in(const FrameAnswer& answer, SurveyWork work);

/// Returns the column's quantity; null if `work` is null or does not have it.
const SurveyQuantity* quantity_in(const WorkAnswer* work, const SurveyColumn& column);

/// Exports the database as one netCDF-4 file by the CF conventions, version 1.8 (https://cfconventions.org),
/// completely or not at all; docs/file_formats.md describes its variables. Reads the database twice, some
/// thousand frames at a time. The same rows give the same bytes with the same versions of netCDF and HDF5.
/// Throws as SurveyReader, sim::WholeFile and sim::NetcdfFile do.
void write_survey_netcdf(const SqliteFile& database, const std::string& output, bool overwrite);

}  // namespace vegard::fit
