// The columns that a survey's frames need in a table.
#pragma once

#include <map>
#include <set>
#include <string>

#include "fit/survey/survey_results.h"

namespace vegard::fit {

/// A number that frames have; of several items of a kind it is the first: a border's brightest trace, a map's
/// first curtain; of profiles the middle strip.
struct SurveyColumn {
  SurveyWork work = SurveyWork::border;
  std::string name, unit;
  bool operator<(const SurveyColumn& o) const;
};

struct SurveyColumns {
  int frames = 0;
  std::map<SurveyWork, std::set<std::string>> verdicts;  ///< that frames have, of each work
  std::set<SurveyColumn> columns;
  std::set<SurveyColumn> with_trust;  ///< those of which somebody says whether to trust them
};

/// Reads all frames once.
SurveyColumns survey_columns(const SurveyReader& reader);

/// The work of a frame; null if it was not done.
const WorkAnswer* work_in(const FrameAnswer& answer, SurveyWork work);

/// The column's number; null if there is none, or no work.
const SurveyQuantity* quantity_in(const WorkAnswer* work, const SurveyColumn& column);

}  // namespace vegard::fit
