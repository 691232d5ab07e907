// Exports a survey's database as tables for other programs (CSV).
#pragma once

#include <optional>
#include <string>

#include "fit/survey/sqlite_file.h"

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

}  // namespace vegard::fit
