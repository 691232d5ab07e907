// The numbers of a whole fit: a row for each, from which result.json (and so Python), the tables of the
// report and netCDF take it. Numbers for publication are rows of fit/answer/derived.cpp instead.
#pragma once

#include <optional>
#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Where in result.json a number stands.
enum class ResultGroup { misfit, convergence, errors, effort };

enum class ResultForm {
  number,
  count,   ///< a whole number
  share,   ///< per cent in the report
  factor,  ///< with a multiplication sign in the report
};

struct ResultNumber {
  const char* key;        ///< in result.json and netCDF
  const char* long_name;  ///< in netCDF; null: it is not there
  ResultGroup group;
  ResultForm form;
  std::optional<double> (*value)(const FitResult&);     ///< none or NaN: not known
  bool (*applies)(const FitResult&);                    ///< false: result.json has no such key; null: true
  const char *title = nullptr, *explanation = nullptr;  ///< of its row in the report, HTML; null: none
};

/// In the order of result.json.
const std::vector<ResultNumber>& result_numbers();

}  // namespace vegard::fit
