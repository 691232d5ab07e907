// Finished steps of a fit, so that long work that was cut off goes on where it was.
//
// A fit is the same logic whether steps are computed or answered from a journal: a step is a pure function of
// the fit's inputs and of the steps before it, with a name of its own. So what a resumed fit finds has the
// same bytes as what an uninterrupted one does.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fit/search/descent.h"

namespace vegard::fit {

/// What a step has found, and what it has done to the fit's books.
struct StepOutput {
  std::map<std::string, std::vector<double>> numbers;  ///< kept to the last bit, NaN and infinity too
  std::map<std::string, std::string> words;            ///< UTF-8
  std::map<std::string, bool> flags;
  std::vector<TraceRow> trace;  ///< rows that the step has added
  /// The books after the step: those of EvaluationLog that change.
  struct Counters {
    int residuals = 0, jacobians = 0;
    double best_chi2 = 0.0;
    bool best_is_full = false;
    std::vector<double> best_values;
  } counters;
  bool whole = true;    ///< false: the user cut it short. Such an output is handed on and never stored
  std::string kept_in;  ///< the journal that it was read from; empty of one that was just worked out

  /// What is kept under a key. A line of a journal can have the right checksum and yet be no work of ours:
  /// these throw sim::Error(existing_output), with the journal's name, if there is no such key or not `count`
  /// numbers.
  const std::vector<double>& numbers_at(const std::string& key) const;
  const std::vector<double>& numbers_at(const std::string& key, std::size_t count) const;
  double number_at(const std::string& key) const { return numbers_at(key, 1)[0]; }
  const std::string& words_at(const std::string& key) const;
  bool flag_at(const std::string& key) const;
  /// A number that counts something. Throws the same of one that is no whole number from 0 to `most`.
  std::size_t count_of(double number, const std::string& key, std::size_t most) const;
  /// Throws that error about what is kept under the key.
  [[noreturn]] void refuse(const std::string& key) const;
};

class Journal {
 public:
  virtual ~Journal() = default;

  /// The stored output of the step of that name; else that of `work`, which is then stored. To ask for one
  /// name twice is a programmer's mistake.
  StepOutput step(const std::string& name, const std::function<StepOutput()>& work);

 private:
  virtual const StepOutput* stored(const std::string& name) const = 0;
  virtual void store(const std::string& name, const StepOutput& output) = 0;

  std::set<std::string> asked_;
};

/// Stores nothing.
class NullJournal final : public Journal {
 private:
  const StepOutput* stored(const std::string&) const override { return nullptr; }
  void store(const std::string&, const StepOutput&) override {}
};

/// A step that evaluates: `work` counts in `log` and writes into `trace`. Both are afterwards as if the work
/// had been done now, wherever the output comes from; `work` need not fill in the output's trace and books.
/// While log.stop is raised nothing is stored. Without a journal (null) the work is done. Points in the books
/// and the trace have `free` numbers, or the journal is refused as StepOutput::refuse() does.
StepOutput recorded_step(Journal* journal, const std::string& name, std::size_t free, EvaluationLog& log,
                         std::vector<TraceRow>& trace, const std::function<StepOutput()>& work);

/// A descent as a step's output, and back: its values are `free` numbers.
StepOutput output_of(const Descent& descent);
Descent descent_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
