// A survey's database as pages to look at: index.html for the whole, night-DATE.html for each night.
#pragma once

#include <functional>
#include <string>

#include "fit/survey/report/night_keogram.h"
#include "fit/survey/sqlite_file.h"

namespace vegard::fit {

struct SurveyReportOptions {
  SurveyFrames frames;    ///< without a plan there are no keograms, links and latitudes
  bool keograms = true;   ///< to be made where there is a plan
  int max_columns = 900;  ///< of a keogram: frames that are read
  bool overwrite = false;
  std::function<void(double share)> progress;  ///< of the nights; may be empty
};

struct SurveyReport {
  int nights = 0, keograms = 0;
  std::string why_no_keogram;  ///< of the first that could not be made; empty: there is none
};

/// Writes the folder, whole or not at all. Holds one night at a time. The same database, plan and frames give
/// the same bytes. Throws sim::Error: (usage) for a plan that the database is not of; and as SurveyReader
/// and sim::WholeDirectory do.
SurveyReport write_survey_report(const SqliteFile& database, const std::string& folder,
                                 const SurveyReportOptions& options);

}  // namespace vegard::fit
