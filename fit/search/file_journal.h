// A journal in a file: every finished step is on the disk before the next begins.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/search/journal.h"

namespace vegard::fit {

/// The inputs of the fit to which a journal belongs, as pairs of a name ("the scene") and a value, such as a
/// SHA-256. They must include everything on which the fit's result depends.
using JournalSubject = std::vector<std::pair<std::string, std::string>>;

enum class JournalMode {
  fresh,     ///< refuse a journal that has steps
  resume,    ///< continue a journal of the same subject; begin a new one if there is none
  overwrite  ///< discard any journal
};

/// A journal in a file: one line for its subject, then one line per step, each with a checksum and flushed to
/// the disk. An incomplete last line (of a killed process) is dropped, and so are a damaged line and all
/// lines after it: their steps are computed again.
class FileJournal final : public Journal {
 public:
  /// Opens or makes the file, with missing folders, and locks it against other processes for the journal's
  /// lifetime. Throws sim::Error(existing_output) for a journal that the mode refuses, one of another
  /// subject, one in use, and for a file that is not a journal; sim::Error(unwritable_output).
  FileJournal(const std::string& file, const JournalSubject& subject, JournalMode mode);
  /// Keeps the file if it has steps. Otherwise removes it, with the folders that were made for it, if these
  /// are empty.
  ~FileJournal() override;
  FileJournal(const FileJournal&) = delete;
  FileJournal& operator=(const FileJournal&) = delete;

  /// Steps found in the file when it was opened.
  int found() const { return found_; }

  /// Number of unusable lines, and why: "line 7 does not have the checksum that it gives". All lines after
  /// the first unusable one are unusable. An incomplete last line is not counted.
  int dropped() const { return dropped_; }
  const std::string& why_dropped() const { return why_dropped_; }

  /// Why steps could not be stored (full disk), in words; empty if they could. The fit continues
  /// nevertheless.
  const std::string& problem() const { return problem_; }

  /// Removes the file after the fit has finished.
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
  long long end_ = 0;  ///< offset of the end of the last complete line, bytes
  int found_ = 0, dropped_ = 0;
  std::string why_dropped_;
  std::map<std::string, StepOutput> steps_;
  std::string problem_;
};

/// Returns the name of the journal of a run directory: "runs/mine.part" for "runs/mine" and "runs/mine/".
std::string journal_file(const std::string& run_directory);

// One line of a journal's file: a checksum, then JSON.

/// Returns a line of the SHA-256 of the text, a space, the text and a newline. The text must not contain a
/// newline.
std::string checked_line(const std::string& text);

/// Returns the text of a line, given without its newline; none if the line is incomplete or damaged.
std::optional<std::string> checked_text(const std::string& line);

/// Returns a step as JSON on one line. Doubles are written as the hexadecimal digits of their 64 bits, those
/// of a vector one after the other, so that they are restored exactly.
std::string step_text(const std::string& name, const StepOutput& output);

/// Inverse of step_text(); none if the text is not a step.
std::optional<std::pair<std::string, StepOutput>> step_of_text(const std::string& text);

}  // namespace vegard::fit
