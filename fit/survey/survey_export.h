// A survey's database as tables for other programs (CSV).
#pragma once

#include <optional>
#include <string>

#include "fit/survey/sqlite_file.h"

namespace vegard::fit {

enum class SurveyTableKind {
  wide,        ///< a row a frame, with a column for each quantity; of a border its first trace
  frames,      ///< a row a frame
  results,     ///< a row for each frame and work
  quantities,  ///< a row for each number
  velocities,  ///< a row for each number that vegard survey smooth has followed
  flags,       ///< a row for each that jumps
};
/// By its word, "wide".
std::optional<SurveyTableKind> survey_table_kind(const std::string& word);

/// Writes the table, whole or not at all, a row at a time. What is unknown is empty. Throws
/// sim::Error(usage) for tables of motion that are not there, and as SurveyReader and WholeFile do.
void write_survey_csv(const SqliteFile& database, SurveyTableKind kind, const std::string& output,
                      bool overwrite);

}  // namespace vegard::fit
