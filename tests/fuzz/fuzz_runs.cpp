// Any bytes as what a fit or a survey leaves behind: 'j' before a journal of finished steps, 'd' before a
// database of a survey, anything else before the result.json of a run.
#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "fit/report/table/run_comparison.h"
#include "fit/search/file_journal.h"
#include "fit/survey/survey_results.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/run_subject.h"
#include "tests/fuzz/target.h"

namespace {

using namespace vegard;
using tests::require;

/// The name of the step that a line holds, if it holds one; what is read comes back to the last bit.
void check_line(const std::string& line) {
  const auto text = fit::checked_text(line);
  if (!text) return;
  const auto step = fit::step_of_text(*text);
  if (!step) return;
  const auto again = fit::step_of_text(fit::step_text(step->first, step->second));
  require(again && again->first == step->first &&
          again->second.numbers.size() == step->second.numbers.size());
}

void journal(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    check_line(std::string(bytes.substr(at, end - at)));
    at = end + 1;
  }
  const tests::InputFile file(bytes, "it.part");
  for (const auto mode : {fit::JournalMode::fresh, fit::JournalMode::resume, fit::JournalMode::overwrite})
    tests::read_or_refused([&] {
      fit::FileJournal journal(file.path("it.part"), tests::fuzzed_subject(), mode);
      require(journal.found() >= 0);
      // A step that is not there is done and kept.
      fit::StepOutput output;
      output.numbers["values"] = {1.0};
      journal.step("a step that no seed has", [&] { return output; });
      require(journal.problem().empty());
    });
}

void survey_database(std::string_view bytes) {
  const tests::InputFile file(bytes, "it.sqlite");
  tests::read_or_refused([&] {
    const fit::SqliteFile database(file.path("it.sqlite"), fit::SqliteFile::Opening::read);
    const fit::SurveyReader reader(database);
    for (const fit::AnsweredBlock& block : reader.blocks()) require(block.frames >= 0);
    reader.frames(0, std::numeric_limits<int>::max(), [&](const fit::FrameAnswer& answer) {
      require(answer.frame >= 0 && std::isfinite(answer.time_s));
    });
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'j') {
    journal(bytes);
    return 0;
  }
  if (data[0] == 'd') {
    survey_database(bytes);
    return 0;
  }
  const tests::InputFile file(bytes, "result.json");
  tests::read_or_refused([&] { fit::read_run(file.folder()); });
  return 0;
}
