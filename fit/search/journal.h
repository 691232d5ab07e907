// Journals: records of the finished steps of a fit, from which an interrupted fit is resumed.
//
// A step has a unique name and is a pure function of the fit's inputs and of the steps before it. A fit runs
// the same code whether a step is computed or read from a journal. So a resumed fit gives the same result, to
// the last bit, as an uninterrupted one.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fit/search/descent.h"
#include "sim/base/error.h"

namespace vegard::fit {

/// The result of a step, and the fit's counters and trace after it.
struct StepOutput {
  std::map<std::string, std::vector<double>> numbers;  ///< stored exactly, NaN and infinity too
  std::map<std::string, std::string> words;            ///< UTF-8
  std::map<std::string, bool> flags;
  std::vector<TraceRow> trace;  ///< rows that the step has added
  /// The members of EvaluationLog that a step changes, as they are after the step.
  struct Counters {
    int residuals = 0, jacobians = 0;
    double best_chi2 = 0.0;
    bool best_is_full = false;
    std::vector<double> best_values;
  } counters;
  bool whole = true;    ///< false: the user stopped the step. Such an output is used but never stored
  std::string kept_in;  ///< name of the journal from which it was read; empty if it was computed

  /// These return what is stored under a key. They throw sim::Error(existing_output), with the journal's
  /// name, if there is no such key or not `count` numbers: a line of a journal may have the right checksum
  /// and yet not be written by vegard.
  const std::vector<double>& numbers_at(const std::string& key) const;
  const std::vector<double>& numbers_at(const std::string& key, std::size_t count) const;
  double number_at(const std::string& key) const { return numbers_at(key, 1)[0]; }
  const std::string& words_at(const std::string& key) const;
  bool flag_at(const std::string& key) const;
  /// Converts a number to a count. Throws error_at() unless it is a whole number from 0 to `most`.
  std::size_t count_of(double number, const std::string& key, std::size_t most) const;
  /// Returns sim::Error(existing_output) about the key.
  sim::Error error_at(const std::string& key) const;
};

class Journal {
 public:
  virtual ~Journal() = default;

  /// Returns the stored output of the step `name`; if there is none, calls `work`, stores its output and
  /// returns it. Each name may be used only once (else it is a programming error).
  StepOutput step(const std::string& name, const std::function<StepOutput()>& work);

 private:
  virtual const StepOutput* stored(const std::string& name) const = 0;
  virtual void store(const std::string& name, const StepOutput& output) = 0;

  std::set<std::string> asked_;
};

/// A journal that stores nothing.
class NullJournal final : public Journal {
 private:
  const StepOutput* stored(const std::string&) const override { return nullptr; }
  void store(const std::string&, const StepOutput&) override {}
};

/// Does a step that evaluates the cost: `work` counts evaluations in `log` and adds rows to `trace`; it need
/// not fill in the output's trace and counters. If the output comes from the journal, `log` and `trace` are
/// updated as if `work` had been called. Nothing is stored once log.stop is set. If `journal` is null, `work`
/// is always called. Points in the counters and the trace must have `free` numbers, otherwise this throws
/// StepOutput::error_at().
StepOutput recorded_step(Journal* journal, const std::string& name, std::size_t free, EvaluationLog& log,
                         std::vector<TraceRow>& trace, const std::function<StepOutput()>& work);

/// Convert a descent to a step's output, and back; its values must be `free` numbers.
StepOutput output_of(const Descent& descent);
Descent descent_of(const StepOutput& output, std::size_t free);

// The outcome of the search, and its form in a journal.

struct SearchOutcome {
  Descent best;                 ///< with the full model
  std::vector<Descent> others;  ///< the other polished descents, best first; for the verdict
  double chi2_initial = 0.0;    ///< of the full model at the user's start
};

/// Convert an outcome to a step's output, and back.
StepOutput output_of(const SearchOutcome& outcome);
SearchOutcome search_outcome_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
