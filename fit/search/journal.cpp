#include "fit/search/journal.h"

#include <cassert>
#include <cmath>
#include <string>

#include "sim/base/error.h"

namespace vegard::fit {

sim::Error StepOutput::error_at(const std::string& key) const {
  return sim::Error(sim::ErrorKind::existing_output,
                    "a finished step of the fit does not have what belongs there")
      .file(kept_in)
      .key(key)
      .hint("use --overwrite without --resume to begin again");
}

const std::vector<double>& StepOutput::numbers_at(const std::string& key) const {
  const auto found = numbers.find(key);
  if (found == numbers.end()) throw error_at(key);
  return found->second;
}

const std::vector<double>& StepOutput::numbers_at(const std::string& key, std::size_t count) const {
  const std::vector<double>& found = numbers_at(key);
  if (found.size() != count) throw error_at(key);
  return found;
}

const std::string& StepOutput::words_at(const std::string& key) const {
  const auto found = words.find(key);
  if (found == words.end()) throw error_at(key);
  return found->second;
}

bool StepOutput::flag_at(const std::string& key) const {
  const auto found = flags.find(key);
  if (found == flags.end()) throw error_at(key);
  return found->second;
}

std::size_t StepOutput::count_of(double number, const std::string& key, std::size_t most) const {
  if (!(number >= 0.0 && number <= static_cast<double>(most)) || number != std::floor(number))
    throw error_at(key);
  return static_cast<std::size_t>(number);
}

StepOutput Journal::step(const std::string& name, const std::function<StepOutput()>& work) {
  const bool first = asked_.insert(name).second;
  assert(first && "two steps of one name");
  static_cast<void>(first);
  if (const StepOutput* found = stored(name)) return *found;
  StepOutput output = work();
  if (output.whole) store(name, output);
  return output;
}

StepOutput recorded_step(Journal* journal, const std::string& name, std::size_t free, EvaluationLog& log,
                         std::vector<TraceRow>& trace, const std::function<StepOutput()>& work) {
  const std::size_t rows_before = trace.size();
  bool worked = false;
  const auto with_counters = [&] {
    worked = true;
    StepOutput output = work();
    output.trace.assign(trace.begin() + static_cast<std::ptrdiff_t>(rows_before), trace.end());
    output.counters = {log.residuals, log.jacobians, log.best_chi2, log.best_is_full, log.best_values};
    if (log.stop != nullptr && log.stop->load()) output.whole = false;
    return output;
  };
  StepOutput output = journal == nullptr ? with_counters() : journal->step(name, with_counters);
  if (!worked) {
    for (const TraceRow& row : output.trace)
      if (row.values.size() != free) throw output.error_at("trace");
    const std::size_t best = output.counters.best_values.size();
    if (best != free && best != 0) throw output.error_at("books");
    trace.insert(trace.end(), output.trace.begin(), output.trace.end());
    log.residuals = output.counters.residuals;
    log.jacobians = output.counters.jacobians;
    log.best_chi2 = output.counters.best_chi2;
    log.best_is_full = output.counters.best_is_full;
    log.best_values = output.counters.best_values;
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

Descent descent_of(const StepOutput& output, std::size_t free) {
  Descent descent;
  descent.values = output.numbers_at("values", free);
  const std::vector<double>& chi2 = output.numbers_at("chi2", 2);
  descent.chi2 = chi2[0];
  descent.chi2_initial = chi2[1];
  descent.converged = output.flag_at("converged");
  descent.termination = output.words_at("termination");
  return descent;
}

namespace {

std::string named(const std::string& part, std::size_t i) { return part + " " + std::to_string(i); }

}  // namespace

StepOutput output_of(const SearchOutcome& outcome) {
  StepOutput output = output_of(outcome.best);
  output.numbers["chi2 at the start"] = {outcome.chi2_initial};
  output.numbers["others"] = {static_cast<double>(outcome.others.size())};
  for (std::size_t i = 0; i < outcome.others.size(); ++i) {
    const StepOutput other = output_of(outcome.others[i]);
    for (const auto& [key, values] : other.numbers) output.numbers[named(key, i)] = values;
    for (const auto& [key, words] : other.words) output.words[named(key, i)] = words;
    for (const auto& [key, flag] : other.flags) output.flags[named(key, i)] = flag;
  }
  return output;
}

SearchOutcome search_outcome_of(const StepOutput& output, std::size_t free) {
  SearchOutcome outcome;
  outcome.best = descent_of(output, free);
  outcome.chi2_initial = output.number_at("chi2 at the start");
  const auto others = output.count_of(output.number_at("others"), "others", output.numbers.size());
  // A descent's keys, from the best's.
  const StepOutput keys = output_of(outcome.best);
  for (std::size_t i = 0; i < others; ++i) {
    StepOutput other;
    other.kept_in = output.kept_in;
    for (const auto& [key, values] : keys.numbers) other.numbers[key] = output.numbers_at(named(key, i));
    for (const auto& [key, words] : keys.words) other.words[key] = output.words_at(named(key, i));
    for (const auto& [key, flag] : keys.flags) other.flags[key] = output.flag_at(named(key, i));
    outcome.others.push_back(descent_of(other, free));
  }
  return outcome;
}

}  // namespace vegard::fit
