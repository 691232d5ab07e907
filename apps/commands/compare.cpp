#include "apps/commands/commands.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/report/table/run_comparison.h"
#include "sim/base/file/number_text.h"

namespace vegard::apps {
namespace {

/// Characters on the screen, not bytes.
std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// The first column to the left, the others to the right.
void print_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const std::vector<std::string>& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], columns_of(row[c]));
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string gap(widths[c] - columns_of(row[c]), ' ');
      line += c == 0 ? row[c] + gap : "  " + gap + row[c];
    }
    say_result(line + "\n");
  }
}

void print_criteria(const fit::RunComparison& comparison) {
  std::vector<std::vector<std::string>> rows = {
      {"run", "unknowns", "chi2", "chi2/dof", "AIC", "BIC", "AIC - least", "BIC - least", "verdict"}};
  for (const fit::ComparedRun& c : comparison.runs)
    rows.push_back({c.run.name, std::to_string(c.run.unknowns), fmt::format("{:.1f}", c.run.chi2),
                    fmt::format("{:.3f}", c.run.chi2 / std::max(1, c.run.dof)),
                    fmt::format("{:.1f}", c.criteria.aic), fmt::format("{:.1f}", c.criteria.bic),
                    fmt::format("{:.1f}", c.aic_difference), fmt::format("{:.1f}", c.bic_difference),
                    c.run.verdict});
  print_table(rows);
}

void print_parameters(const fit::RunComparison& comparison) {
  std::vector<std::string> paths;
  for (const fit::ComparedRun& c : comparison.runs)
    for (const std::string& path : c.run.paths)
      if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
  std::vector<std::vector<std::string>> rows = {{"parameter"}};
  for (const fit::ComparedRun& c : comparison.runs) rows.front().push_back(c.run.name);
  for (const std::string& path : paths) {
    rows.push_back({path});
    for (const fit::ComparedRun& c : comparison.runs) {
      const auto found = c.run.parameters.find(path);
      rows.back().push_back(found == c.run.parameters.end()
                                ? "-"
                                : sim::number_with_error(found->second.value, found->second.sigma));
    }
  }
  print_table(rows);
}

void answer_comparison(const fit::RunComparison& comparison, int values) {
  Json& answer = json_answer();
  answer = {{"best", comparison.runs[comparison.best].run.name},
            {"values", values},
            {"effective_sample_size", json_number(comparison.independent_values)},
            {"runs", Json::array()},
            {"sentences", comparison.sentences}};
  for (const fit::ComparedRun& c : comparison.runs) {
    Json run = {{"name", c.run.name},
                {"verdict", c.run.verdict},
                {"unknowns", c.run.unknowns},
                {"chi2", json_number(c.run.chi2)},
                {"dof", c.run.dof},
                {"chi2_per_dof", json_number(c.run.chi2 / std::max(1, c.run.dof))},
                {"aic", json_number(c.criteria.aic)},
                {"bic", json_number(c.criteria.bic)},
                {"aic_difference", json_number(c.aic_difference)},
                {"bic_difference", json_number(c.bic_difference)},
                {"parameters", Json::object()}};
    for (const std::string& path : c.run.paths) {
      const auto& number = c.run.parameters.at(path);
      run["parameters"][path] = {{"value", json_number(number.value)}, {"sigma", json_number(number.sigma)}};
    }
    answer["runs"].push_back(run);
  }
}

/// The best run's own verdict counts; a run that found nothing spoils the comparison.
ExitCode exit_code_of(const fit::RunComparison& comparison) {
  for (const fit::ComparedRun& c : comparison.runs)
    if (c.run.verdict == "failed" || c.run.verdict == "interrupted") return not_converged;
  return comparison.runs[comparison.best].run.verdict == "good" ? good : doubted;
}

int run_compare(const std::vector<std::string>& directories) {
  if (directories.size() < 2)
    throw usage_error("RUN", "one run alone cannot be compared", "two runs or more");
  std::vector<fit::RunSummary> runs;
  for (const std::string& directory : directories) runs.push_back(fit::read_run(directory));
  const fit::RunComparison comparison = fit::compared(runs);
  print_criteria(comparison);
  say_result(fmt::format(
      "{} values, worth {} independent ones; chi2 is divided by {} in AIC and BIC\n", runs.front().values,
      sim::short_number(comparison.independent_values, 3),
      sim::short_number(comparison.runs.front().run.chi2 / comparison.runs.front().criteria.chi2, 3)));
  say_result("decoding: " + runs.front().decoding + "\n\n");
  print_parameters(comparison);
  say_result("\n");
  for (const std::string& sentence : comparison.sentences) say_result(sentence + "\n");
  const ExitCode code = exit_code_of(comparison);
  const fit::RunSummary& best = comparison.runs[comparison.best].run;
  if (code == not_converged)
    say_verdict(Tone::bad, "Do not believe it: not all of the runs ended at an answer.", false);
  if (code == doubted)
    say_verdict(Tone::doubtful, "Doubtful: the verdict on " + best.name + " is \"" + best.verdict + "\".",
                false);
  answer_comparison(comparison, runs.front().values);
  return code;
}

}  // namespace

void add_compare_command(Program& program) {
  const auto directories = std::make_shared<std::vector<std::string>>();
  const Command command =
      program.add("compare", "Compare several fits of a photograph by AIC and BIC, in numbers and words");
  command.option("RUN", *directories, "Directories that vegard fit wrote, of one photograph")
      .required()
      .type_name("RUN");
  command.runs([directories] { return run_compare(*directories); });
}

}  // namespace vegard::apps
