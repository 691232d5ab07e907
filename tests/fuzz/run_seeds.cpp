// A journal of two steps, one torn, results of runs as far as they are read, a survey's database.
#include <fstream>
#include <iterator>

#include "fit/search/file_journal.h"
#include "fit/survey/survey_results.h"
#include "sim/base/file/sha256.h"
#include "tests/fit/survey/made_answers.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/run_subject.h"
#include "tests/fuzz/target.h"

namespace vegard::tests {
namespace {

fit::StepOutput output() {
  fit::StepOutput step;
  step.numbers["values"] = {1.5, -2.0};
  step.numbers["chi2"] = {10.0, 30.0};
  step.words["termination"] = "converged";
  step.flags["converged"] = true;
  step.trace.push_back({"descent 1", 7, 10.0, {1.5, -2.0}});
  step.counters.residuals = 9;
  step.counters.best_values = {1.5, -2.0};
  return step;
}

std::string journal_bytes() {
  const InputFile folder("", "none");
  std::string bytes;
  {
    fit::FileJournal journal(folder.path("a.part"), fuzzed_subject(), fit::JournalMode::fresh);
    for (const char* name : {"scan", "descent 1"}) journal.step(name, output);
    std::ifstream stream(folder.path("a.part"), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return bytes;
}

/// Of a shard of two blocks.
std::string database_bytes() {
  const InputFile folder("", "none");
  const fit::SurveyPlan plan = made_survey_plan(2, 3);
  {
    fit::ShardResults results(folder.path("a.sqlite"), plan);
    for (const int frame : {0, 1, 2}) results.add({made_answer(plan, 0, frame)});
    results.add({made_answer(plan, 1, 0)});
  }
  std::ifstream stream(folder.path("a.sqlite"), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

constexpr const char* kResult = R"({"verdict": "good", "parameters": [{"path": "sheet.main.energy_kev",
"value": 3.1, "sigma": null, "unit": "keV"}, {"path": "sheet.main.center_km.north", "value": null, "sigma": 0.5,
"unit": "km"}], "chi2": 100.5, "dof": 90, "correlated_residuals": 1.25, "inputs": [{"role": "scene", "sha256": "00"},
{"role": "photo", "sha256": "11"}], "decoding": "sRGB", "compared": {"regions_px": [[0, 0, 16, 12]], "values": 96,
"sum_of_weights": 12.5, "sampling_error": 0.01, "unknowns": 6}})";

}  // namespace

std::vector<std::string> fuzz_seeds(const std::string&) {
  const std::string journal = journal_bytes(), result = kResult;
  std::string several = result;
  several.replace(several.find("\"decoding\": \"sRGB\""), 18,
                  R"("photos": [{"name": "a", "decoding": "sRGB"}, {"name": "b", "decoding": "linear"}])");
  const std::string other = fit::checked_line(R"({"journal": 1, "of": {"the scene": "of another"}})") +
                            fit::checked_line("no step");
  return {"j" + journal,
          "j" + other,
          "j" + journal.substr(0, journal.size() - 40),
          "j" + journal.substr(0, 30),
          "r" + result,
          "r" + several,
          "d" + database_bytes()};
}

std::vector<std::string> fuzz_dictionary() {
  return {"null",
          "true",
          "[]",
          "{}",
          "-1",
          "1e999",
          "1.5e308",
          "\"\"",
          "\"verdict\"",
          "\"parameters\"",
          "\"value\"",
          "\"sigma\"",
          "\"inputs\"",
          "\"decoding\"",
          "\"compared\"",
          "\"photos\"",
          "\"regions_px\"",
          "done",
          "fit",
          "CREATE TABLE",
          "\"journal\"",
          "\"of\"",
          "\"step\"",
          "\"numbers\"",
          "\"words\"",
          "\"flags\"",
          "\"trace\"",
          "\"books\"",
          "7ff0000000000000",
          "\\u0000",
          "\\ud800",
          "[[[[[[[["};
}

/// Checksums of a journal's lines, behind which everything else would lie hidden.
void mend_after_mutation(std::string& input) {
  constexpr std::size_t kDigits = 64;
  if (input.empty() || input[0] != 'j') return;
  for (std::size_t at = 1; at < input.size();) {
    const std::size_t end = std::min(input.find('\n', at), input.size());
    if (end - at > kDigits + 1) {
      input[at + kDigits] = ' ';
      input.replace(at, kDigits, sim::sha256(input.substr(at + kDigits + 1, end - at - kDigits - 1)));
    }
    at = end + 1;
  }
}

}  // namespace vegard::tests
