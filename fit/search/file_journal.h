// A journal in a file: every finished step is on the disk before the next begins.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fit/search/journal.h"

namespace vegard::fit {

/// What a journal is of, as pairs of a name in words ("the scene") and a value, such as a SHA-256. All that
/// the fit's result depends on has to be among them.
using JournalSubject = std::vector<std::pair<std::string, std::string>>;

enum class JournalMode {
  fresh,     ///< refuse one that has steps
  resume,    ///< go on with one that is of the same subject; begin one if there is none
  overwrite  ///< discard one, whatever it is of
};

/// One line for what it is of, then one line a step, each with a checksum and flushed to the disk. A last
/// line that a kill has torn is dropped, with whatever is behind a damaged one: those steps are done again.
class FileJournal final : public Journal {
 public:
  /// Opens or makes the file, with missing folders, and locks it against other processes for the journal's
  /// lifetime. Throws sim::Error(existing_output) for a journal that the mode refuses, one of another
  /// subject, one in use, and for a file that is no journal; sim::Error(unwritable_output).
  FileJournal(const std::string& file, const JournalSubject& subject, JournalMode mode);
  /// Leaves the file, unless there is no step in it; folders made for it go with it, unless they are in use.
  ~FileJournal() override;
  FileJournal(const FileJournal&) = delete;
  FileJournal& operator=(const FileJournal&) = delete;

  /// Steps found in the file when it was opened.
  int found() const { return found_; }

  /// Lines that were found and cannot be used, and why: "line 7 does not have the checksum that it gives";
  /// those behind the first such are not looked at. A last line without an end, as a kill leaves it, is none
  /// of them.
  int dropped() const { return dropped_; }
  const std::string& why_dropped() const { return why_dropped_; }

  /// Why steps could not be stored (full disk), in words; empty if they could. The fit goes on all the same.
  const std::string& problem() const { return problem_; }

  /// The work is done: the file goes.
  void remove();

 private:
  const StepOutput* stored(const std::string& name) const override;
  void store(const std::string& name, const StepOutput& output) override;
  void open(const JournalSubject& subject, JournalMode mode);
  void read_steps(const std::string& bytes, std::size_t begin);
  void append(const std::string& line);
  void unlink();

  const std::string file_;
  std::vector<std::string> made_folders_;  ///< innermost first
  int descriptor_ = -1;
  long long end_ = 0;  ///< of the last whole line, bytes
  int found_ = 0, dropped_ = 0;
  std::string why_dropped_;
  std::map<std::string, StepOutput> steps_;
  std::string problem_;
};

/// Where the journal of a run's directory stands: "runs/mine.part" for "runs/mine" and "runs/mine/".
std::string journal_file(const std::string& run_directory);

}  // namespace vegard::fit
