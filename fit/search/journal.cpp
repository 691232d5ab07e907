#include "fit/search/journal.h"

#include <cassert>

namespace vegard::fit {

StepOutput Journal::step(const std::string& name, const std::function<StepOutput()>& work) {
  const bool first = asked_.insert(name).second;
  assert(first && "two steps of one name");
  static_cast<void>(first);
  if (const StepOutput* found = stored(name)) return *found;
  StepOutput output = work();
  if (output.whole) store(name, output);
  return output;
}

StepOutput recorded_step(Journal* journal, const std::string& name, EvaluationLog& log,
                         std::vector<TraceRow>& trace, const std::function<StepOutput()>& work) {
  const std::size_t rows_before = trace.size();
  bool worked = false;
  const auto with_books = [&] {
    worked = true;
    StepOutput output = work();
    output.trace.assign(trace.begin() + static_cast<std::ptrdiff_t>(rows_before), trace.end());
    output.books = {log.residuals, log.jacobians, log.best_chi2, log.best_is_full, log.best_values};
    if (log.stop != nullptr && log.stop->load()) output.whole = false;
    return output;
  };
  StepOutput output = journal == nullptr ? with_books() : journal->step(name, with_books);
  if (!worked) {
    trace.insert(trace.end(), output.trace.begin(), output.trace.end());
    log.residuals = output.books.residuals;
    log.jacobians = output.books.jacobians;
    log.best_chi2 = output.books.best_chi2;
    log.best_is_full = output.books.best_is_full;
    log.best_values = output.books.best_values;
  }
  return output;
}

StepOutput output_of(const Descent& descent) {
  StepOutput output;
  output.numbers["values"] = descent.values;
  output.numbers["chi2"] = {descent.chi2, descent.chi2_initial};
  output.flags["converged"] = descent.converged;
  output.words["termination"] = descent.termination;
  return output;
}

Descent descent_of(const StepOutput& output) {
  Descent descent;
  descent.values = output.numbers.at("values");
  descent.chi2 = output.numbers.at("chi2").at(0);
  descent.chi2_initial = output.numbers.at("chi2").at(1);
  descent.converged = output.flags.at("converged");
  descent.termination = output.words.at("termination");
  return descent;
}

}  // namespace vegard::fit
