// Steps come back from a journal to the last bit, and nothing but whole steps of the same fit does.
#include "fit/search/journal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "fit/search/file_journal.h"
#include "fit/uncertainty/converged_fit.h"
#include "fit/uncertainty/sampled_uncertainty.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::tests::journal_test {
namespace {

using fit::FileJournal;
using fit::JournalMode;
using fit::StepOutput;

const fit::JournalSubject kSubject = {{"the scene", "aa"}, {"the photograph", "bb"}};

StepOutput awkward() {
  StepOutput output;
  output.numbers["values"] = {0.1,
                              -0.0,
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::denorm_min(),
                              std::nan(""),
                              1.0 / 3.0};
  output.numbers["nothing"] = {};
  output.words["end"] = "two\nlines, \"quoted\", é";
  output.flags["converged"] = true;
  output.trace = {{"polish 1", 17, 1.0 / 7.0, {2.0 / 3.0, std::nan("")}}, {"empty", 18, 0.0, {}}};
  output.counters = {18, 3, 1.0 / 9.0, true, {1e300}};
  return output;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), 8 * a.size()) == 0);
}

void expect_same(const StepOutput& a, const StepOutput& b) {
  ASSERT_EQ(a.numbers.size(), b.numbers.size());
  for (const auto& [key, values] : a.numbers) EXPECT_TRUE(same_bits(values, b.numbers.at(key))) << key;
  EXPECT_EQ(a.words, b.words);
  EXPECT_EQ(a.flags, b.flags);
  ASSERT_EQ(a.trace.size(), b.trace.size());
  for (std::size_t i = 0; i < a.trace.size(); ++i) {
    EXPECT_EQ(a.trace[i].stage, b.trace[i].stage);
    EXPECT_EQ(a.trace[i].evaluation, b.trace[i].evaluation);
    EXPECT_EQ(a.trace[i].chi2, b.trace[i].chi2);
    EXPECT_TRUE(same_bits(a.trace[i].values, b.trace[i].values));
  }
  EXPECT_EQ(a.counters.residuals, b.counters.residuals);
  EXPECT_EQ(a.counters.jacobians, b.counters.jacobians);
  EXPECT_EQ(a.counters.best_chi2, b.counters.best_chi2);
  EXPECT_EQ(a.counters.best_is_full, b.counters.best_is_full);
  EXPECT_TRUE(same_bits(a.counters.best_values, b.counters.best_values));
}

StepOutput numbered(double x) {
  StepOutput output;
  output.numbers["x"] = {x};
  return output;
}

/// Steps "0", "1", ... as far as asked; returns how many were worked out rather than looked up.
int worked(fit::Journal& journal, int steps) {
  int count = 0;
  for (int i = 0; i < steps; ++i) {
    const StepOutput output = journal.step(std::to_string(i), [&] {
      ++count;
      return numbered(i + 0.5);
    });
    EXPECT_EQ(output.numbers.at("x").at(0), i + 0.5);
  }
  return count;
}

TEST(StepRecord, ComesBackToTheLastBit) {
  const std::string text = fit::step_text("descent 2", awkward());
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto back = fit::step_of_text(text);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->first, "descent 2");
  expect_same(awkward(), back->second);
  EXPECT_FALSE(fit::step_of_text("{}"));
  EXPECT_FALSE(fit::step_of_text("no JSON"));
}

TEST(StepRecord, ADamagedLineIsNone) {
  std::string line = fit::checked_line("{\"a\":1}");
  line.pop_back();
  ASSERT_EQ(fit::checked_text(line), "{\"a\":1}");
  std::string damaged = line;
  damaged.back() = ']';
  EXPECT_FALSE(fit::checked_text(damaged));
  EXPECT_FALSE(fit::checked_text(line.substr(0, line.size() - 1)));
  EXPECT_FALSE(fit::checked_text(""));
}

TEST(NullJournal, WorksEveryStepOut) {
  fit::NullJournal journal;
  EXPECT_EQ(worked(journal, 3), 3);
}

TEST(FileJournal, FinishedStepsAreNotDoneAgain) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  {
    FileJournal journal(file, kSubject, JournalMode::fresh);
    EXPECT_EQ(journal.found(), 0);
    EXPECT_EQ(worked(journal, 3), 3);
  }
  {
    FileJournal journal(file, kSubject, JournalMode::resume);
    EXPECT_EQ(journal.found(), 3);
    EXPECT_EQ(worked(journal, 5), 2);
    EXPECT_EQ(journal.problem(), "");
  }
  FileJournal journal(file, kSubject, JournalMode::resume);
  EXPECT_EQ(worked(journal, 5), 0);
  journal.remove();
  EXPECT_EQ(folder.entries(), 0);
}

TEST(FileJournal, WhereverAKillTearsItTheStepsBeforeStay) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  {
    FileJournal journal(file, kSubject, JournalMode::fresh);
    worked(journal, 2);
  }
  const std::string bytes = bytes_of(file);
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] == '\n') ends.push_back(i + 1);
  ASSERT_EQ(ends.size(), 3u);  // header and two steps
  std::vector<std::size_t> lengths = {0, 1, 64, 65, 66};
  for (const std::size_t end : ends)
    for (const std::size_t length : {end - 40, end - 1, end, std::min(end + 1, bytes.size())})
      lengths.push_back(length);
  for (const std::size_t length : lengths) {
    put(file, bytes.substr(0, length));
    FileJournal journal(file, kSubject, JournalMode::resume);
    ASSERT_EQ(journal.found(), (length >= ends[1]) + (length >= ends[2])) << length;
    ASSERT_EQ(worked(journal, 2), 2 - journal.found()) << length;
    ASSERT_EQ(bytes_of(file), bytes) << length;
  }
}

TEST(FileJournal, ADamagedStepIsDoneAgain) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  {
    FileJournal journal(file, kSubject, JournalMode::fresh);
    worked(journal, 3);
  }
  const std::string bytes = bytes_of(file);
  std::string damaged = bytes;
  const std::size_t header = bytes.find('\n'), first = bytes.find('\n', header + 1);
  damaged[first + 80] ^= 1;  // inside of the second step
  put(file, damaged);
  FileJournal journal(file, kSubject, JournalMode::resume);
  EXPECT_EQ(journal.found(), 1);
  EXPECT_EQ(journal.dropped(), 2);  // the third rests on the second
  EXPECT_TRUE(tests::has_facts(journal.why_dropped(), "line 3 of " + file + " | checksum"));
  EXPECT_EQ(worked(journal, 3), 2);
  EXPECT_EQ(bytes_of(file), bytes);
}

TEST(FileJournal, IsRefusedUnlessTheUserSaysWhatToDo) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  {
    FileJournal journal(file, kSubject, JournalMode::fresh);
    worked(journal, 1);
  }
  const std::string bytes = bytes_of(file);
  const auto opened = [&](const fit::JournalSubject& subject, JournalMode mode) {
    return expect_error(sim::ErrorKind::existing_output, [&] { FileJournal(file, subject, mode); });
  };
  const std::string fresh = opened(kSubject, JournalMode::fresh);
  EXPECT_NE(fresh.find("--resume"), std::string::npos) << fresh;
  EXPECT_NE(fresh.find("--overwrite"), std::string::npos) << fresh;
  const fit::JournalSubject other = {{"the scene", "aa"}, {"the photograph", "cc"}};
  const std::string differs = opened(other, JournalMode::resume);
  EXPECT_NE(differs.find("the photograph differs"), std::string::npos) << differs;
  EXPECT_EQ(bytes_of(file), bytes) << "a refusal has touched the journal";

  FileJournal journal(file, other, JournalMode::overwrite);
  EXPECT_EQ(journal.found(), 0);
  EXPECT_EQ(worked(journal, 1), 1);
  const std::string in_use = opened(other, JournalMode::resume);
  EXPECT_NE(in_use.find("in use"), std::string::npos) << in_use;
}

TEST(FileJournal, NeverReplacesWhatIsNone) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  put(file, "a film, by hand\n");
  for (const JournalMode mode : {JournalMode::fresh, JournalMode::resume, JournalMode::overwrite})
    expect_error(sim::ErrorKind::existing_output, [&] { FileJournal(file, kSubject, mode); });
  EXPECT_EQ(bytes_of(file), "a film, by hand\n");
  std::filesystem::create_directories(folder / "folder.part");
  expect_error(sim::ErrorKind::unwritable_output,
               [&] { FileJournal(folder / "folder.part", kSubject, JournalMode::overwrite); });
}

TEST(FileJournal, OfSomethingThatIsNoFitIsOfAnotherFormat) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  for (const char* header :
       {R"({"journal":1,"of":5})", R"({"journal":1,"of":["the scene"]})", R"({"journal":{}})"}) {
    put(file, fit::checked_line(header) + fit::checked_line("no step"));
    const std::string words = expect_error(sim::ErrorKind::existing_output,
                                           [&] { FileJournal(file, kSubject, JournalMode::resume); });
    EXPECT_NE(words.find("another format"), std::string::npos) << words;
  }
}

TEST(FileJournal, WithoutAStepNothingIsLeft) {
  const TemporaryFolder folder;
  { const FileJournal journal(folder / "run.part", kSubject, JournalMode::fresh); }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(FileJournal, AFullDiskStopsTheStoringNotTheFit) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  {
    FileJournal journal(file, kSubject, JournalMode::fresh);
    worked(journal, 1);
    const FullDisk disk(std::filesystem::file_size(file) + 20);
    int count = 0;
    const auto work = [&] {
      ++count;
      return numbered(1.5);
    };
    EXPECT_EQ(journal.step("1", work).numbers.at("x").at(0), 1.5);
    EXPECT_EQ(count, 1);
    EXPECT_NE(journal.problem().find("cannot be written"), std::string::npos) << journal.problem();
  }
  FileJournal journal(file, kSubject, JournalMode::resume);
  EXPECT_EQ(journal.found(), 1);
}

TEST(FileJournal, StandsBesideTheRun) {
  EXPECT_EQ(fit::journal_file("runs/mine"), "runs/mine.part");
  EXPECT_EQ(fit::journal_file("runs/mine//"), "runs/mine.part");
}

/// A step that counts in the log, keeps a best point and adds two rows.
StepOutput counted(fit::EvaluationLog& log, std::vector<fit::TraceRow>& trace, fit::Journal* journal,
                   bool* was_worked) {
  return fit::recorded_step(journal, "descent", 1, log, trace, [&] {
    *was_worked = true;
    for (int i = 0; i < 2; ++i) trace.push_back({"descent", ++log.residuals, 5.0 - i, {1.0 * i}});
    ++log.jacobians;
    log.best_chi2 = 4.0;
    log.best_values = {1.0};
    return numbered(2.5);
  });
}

TEST(RecordedStep, LeavesTheBooksAsTheWorkWould) {
  const TemporaryFolder folder;
  for (const JournalMode mode : {JournalMode::fresh, JournalMode::resume}) {
    FileJournal journal(folder / "run.part", kSubject, mode);
    fit::EvaluationLog log;
    log.residuals = 7;
    log.limit = 100;
    std::vector<fit::TraceRow> trace = {{"start", 7, 9.0, {0.0}}};
    bool was_worked = false;
    const StepOutput output = counted(log, trace, &journal, &was_worked);
    EXPECT_EQ(was_worked, mode == JournalMode::fresh);
    EXPECT_EQ(output.numbers.at("x").at(0), 2.5);
    EXPECT_EQ(log.residuals, 9);
    EXPECT_EQ(log.jacobians, 1);
    EXPECT_EQ(log.limit, 100);
    EXPECT_EQ(log.best_chi2, 4.0);
    EXPECT_EQ(log.best_values, std::vector<double>{1.0});
    ASSERT_EQ(trace.size(), 3u);
    EXPECT_EQ(trace[2].evaluation, 9);
    EXPECT_EQ(trace[2].chi2, 4.0);
  }
}

TEST(RecordedStep, OneThatTheUserCutShortIsNotStored) {
  const TemporaryFolder folder;
  const std::atomic<bool> stop{true};
  {
    FileJournal journal(folder / "run.part", kSubject, JournalMode::fresh);
    worked(journal, 1);
    fit::EvaluationLog log;
    log.stop = &stop;
    std::vector<fit::TraceRow> trace;
    bool was_worked = false;
    counted(log, trace, &journal, &was_worked);
    EXPECT_TRUE(was_worked);
    EXPECT_EQ(trace.size(), 2u);
  }
  FileJournal journal(folder / "run.part", kSubject, JournalMode::resume);
  EXPECT_EQ(journal.found(), 1);
}

TEST(RecordedStep, ADescentComesBack) {
  fit::Descent descent;
  descent.values = {1.0 / 3.0, 2.0};
  descent.chi2 = 5.5;
  descent.chi2_initial = std::numeric_limits<double>::infinity();
  descent.converged = true;
  descent.termination = "converged";
  const fit::Descent back = fit::descent_of(fit::output_of(descent), 2);
  EXPECT_EQ(back.values, descent.values);
  EXPECT_EQ(back.chi2, descent.chi2);
  EXPECT_EQ(back.chi2_initial, descent.chi2_initial);
  EXPECT_EQ(back.converged, descent.converged);
  EXPECT_EQ(back.termination, descent.termination);
}

TEST(StepOutputs, ASearchAndErrorBarsComeBack) {
  fit::SearchOutcome outcome;
  outcome.best = {{1.0, 2.0}, 3.0, 4.0, true, "converged"};
  outcome.others = {{{1.5, 2.5}, 3.5, 4.5, false, "not"}, {{-1.0, 0.5}, 5.0, 6.0, true, "yes"}};
  outcome.chi2_initial = 99.0;
  const fit::SearchOutcome back = fit::search_outcome_of(fit::output_of(outcome), 2);
  EXPECT_EQ(back.chi2_initial, 99.0);
  EXPECT_EQ(back.best.values, outcome.best.values);
  ASSERT_EQ(back.others.size(), 2u);
  EXPECT_EQ(back.others[0].values, outcome.others[0].values);
  EXPECT_EQ(back.others[0].termination, "not");
  EXPECT_EQ(back.others[1].chi2, 5.0);
  EXPECT_TRUE(back.others[1].converged);

  fit::Uncertainty u;
  u.sigma = {0.5, std::nan("")};
  u.correlation = {{1.0, 0.25}, {0.25, 1.0}};
  u.covariance = {{0.25, 0.1}, {0.1, 0.5}};
  u.undetermined = {{0.0, 1.0}};
  u.inflation = 1.75;
  u.by_bands = {1.5, 1.0};
  const fit::Uncertainty same = fit::uncertainty_of(fit::output_of(u), 2);
  EXPECT_TRUE(same_bits(same.sigma, u.sigma));
  EXPECT_EQ(same.correlation, u.correlation);
  EXPECT_EQ(same.covariance, u.covariance);
  EXPECT_EQ(same.undetermined, u.undetermined);
  EXPECT_EQ(same.inflation, 1.75);
  EXPECT_EQ(same.by_bands, u.by_bands);
  u.undetermined.clear();
  EXPECT_TRUE(fit::uncertainty_of(fit::output_of(u), 2).undetermined.empty());
}

/// What is said of a step "descent" with the right checksum, when `read` asks for what it holds.
std::string words_of_refusal(const StepOutput& kept, const std::function<void(const StepOutput&)>& read) {
  const TemporaryFolder folder;
  const std::string file = folder / "run.part";
  {
    FileJournal journal(file, kSubject, JournalMode::fresh);
    journal.step("descent", [&] { return kept; });
  }
  FileJournal journal(file, kSubject, JournalMode::resume);
  EXPECT_EQ(journal.found(), 1);
  const std::string words = expect_error(sim::ErrorKind::existing_output, [&] {
    read(journal.step("descent", [] {
      ADD_FAILURE() << "worked out again";
      return StepOutput();
    }));
  });
  EXPECT_NE(words.find("run.part (descent)"), std::string::npos) << words;
  return words;
}

/// Each key of an output left out, and each list of numbers one too long and one too short.
std::vector<StepOutput> spoilt(const StepOutput& whole) {
  std::vector<StepOutput> all;
  for (const auto& [key, numbers] : whole.numbers) {
    all.push_back(whole);
    all.back().numbers.erase(key);
    all.push_back(whole);
    all.back().numbers[key].push_back(1.0);
    if (numbers.empty()) continue;
    all.push_back(whole);
    all.back().numbers[key].pop_back();
  }
  for (const auto& [key, words] : whole.words) {
    all.push_back(whole);
    all.back().words.erase(key);
  }
  for (const auto& [key, flag] : whole.flags) {
    all.push_back(whole);
    all.back().flags.erase(key);
  }
  return all;
}

TEST(StepOutputs, WhatAnotherHandHasWrittenIsRefusedInWords) {
  fit::SearchOutcome outcome;
  outcome.best = {{1.0, 2.0}, 3.0, 4.0, true, "converged"};
  outcome.others = {{{1.5, 2.5}, 3.5, 4.5, false, "not"}};
  for (const StepOutput& kept : spoilt(fit::output_of(outcome)))
    words_of_refusal(kept, [](const StepOutput& output) { fit::search_outcome_of(output, 2); });

  fit::Uncertainty u;
  u.sigma = {0.5, 0.25};
  u.correlation = u.covariance = {{1.0, 0.25}, {0.25, 1.0}};
  u.undetermined = {{0.0, 1.0}};
  for (const StepOutput& kept : spoilt(fit::output_of(u)))
    words_of_refusal(kept, [](const StepOutput& output) { fit::uncertainty_of(output, 2); });

  fit::LikelihoodProfile profile;
  profile.path = {{0.5, 1.0, {0.5, 0.0}}, {0.75, 4.0, {0.75, 0.1}}};
  profile.better = fit::ProfilePoint{0.5, 0.1, {}};
  for (const StepOutput& kept : spoilt(fit::output_of(profile)))
    words_of_refusal(kept, [](const StepOutput& output) { fit::likelihood_profile_of(output, 2); });

  fit::BandBootstrap bootstrap;
  bootstrap.bands = 8;
  bootstrap.replicates = 2;
  bootstrap.samples = {0.1, 0.2, 0.3, 0.4};
  for (const StepOutput& kept : spoilt(fit::output_of(bootstrap)))
    words_of_refusal(kept, [](const StepOutput& output) { fit::band_bootstrap_of(output, 2); });
}

TEST(StepOutputs, ACountThatIsNoneIsRefused) {
  fit::SearchOutcome outcome;
  outcome.best = {{1.0}, 3.0, 4.0, true, "converged"};
  for (const double others : {-1.0, 0.5, 1e300, std::nan("")}) {
    StepOutput kept = fit::output_of(outcome);
    kept.numbers["others"] = {others};
    const std::string words =
        words_of_refusal(kept, [](const StepOutput& output) { fit::search_outcome_of(output, 1); });
    EXPECT_NE(words.find("others"), std::string::npos) << words;
  }
}

TEST(RecordedStep, PointsOfAnotherNumberOfParametersAreRefused) {
  StepOutput of_trace, of_books;
  of_trace.trace = {{"descent", 1, 2.0, {1.0, 2.0}}};
  of_books.counters.best_values = {1.0, 2.0};
  for (const StepOutput& kept : {of_trace, of_books}) {
    const TemporaryFolder folder;
    {
      FileJournal journal(folder / "run.part", kSubject, JournalMode::fresh);
      journal.step("descent", [&] { return kept; });
    }
    FileJournal journal(folder / "run.part", kSubject, JournalMode::resume);
    fit::EvaluationLog log;
    std::vector<fit::TraceRow> trace;
    bool was_worked = false;
    expect_error(sim::ErrorKind::existing_output, [&] { counted(log, trace, &journal, &was_worked); });
    EXPECT_FALSE(was_worked);
  }
}

}  // namespace
}  // namespace vegard::tests::journal_test
