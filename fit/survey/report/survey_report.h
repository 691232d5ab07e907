// Writes a report on a survey's database as HTML pages: index.html for the whole, night-DATE.html for each
// night.
#pragma once

#include <functional>
#include <string>

#include "fit/survey/report/night_keogram.h"
#include "fit/survey/sqlite_file.h"

namespace vegard::fit {

struct SurveyReportOptions {
  SurveyFrames frames;    ///< without a plan there are no keograms, links and latitudes
  bool keograms = true;   ///< make keograms if there is a plan
  int max_columns = 900;  ///< largest number of frames of a keogram
  bool overwrite = false;
  std::function<void(double share)> progress;  ///< called with the share of nights done; may be empty
};

struct SurveyReport {
  int nights = 0, keograms = 0;
  std::string why_no_keogram;  ///< why the first keogram that failed could not be made; empty: none failed
};

/// Writes the folder, completely or not at all. Memory is needed for one night. The same database, plan and
/// frames give the same bytes. Throws sim::Error(usage) if the database is not of the plan; and as
/// SurveyReader and sim::WholeDirectory do.
SurveyReport write_survey_report(const SqliteFile& database, const std::string& folder,
                                 const SurveyReportOptions& options);

}  // namespace vegard::fit
