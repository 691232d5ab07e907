#include "fit/search/search_outcome.h"

#include <string>

namespace vegard::fit {
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
