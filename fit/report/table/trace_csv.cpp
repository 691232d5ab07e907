#include "fit/report/table/trace_csv.h"

#include <limits>

#include "sim/base/file/csv_text.h"

namespace vegard::fit {

std::string trace_csv(const FitResult& result) {
  std::string text = csv_comment("the way of the search: accepted evaluations, and the best of every stage");
  text += csv_comment("evaluation: evaluations of the residuals so far");
  text += "stage,evaluation,chi2,chi2_per_dof";
  for (const FittedParameter& p : result.parameters) text += "," + csv_cell(p.path);
  text += "\n";
  for (const TraceRow& row : result.trace) {
    text += csv_cell(row.stage) + "," + std::to_string(row.evaluation) + "," + csv_number(row.chi2) + "," +
            csv_number(result.dof > 0 ? row.chi2 / result.dof : std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < result.parameters.size(); ++i)
      text += "," + (i < row.values.size() ? csv_number(row.values[i]) : std::string());
    text += "\n";
  }
  return text;
}

}  // namespace vegard::fit
