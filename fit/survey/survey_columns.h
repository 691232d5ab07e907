// The columns of a table with one row per frame of a survey.
#pragma once

#include <map>
#include <set>
#include <string>

#include "fit/survey/survey_results.h"

namespace vegard::fit {

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

}  // namespace vegard::fit
