// WholeFile: an output file that appears complete or not at all; WholeFiles: several of them.
//
// A file is written under a temporary name beside its target (".model.partial-812-0.exr") and renamed at the
// end, so that neither a full disk nor an interruption leaves an incomplete file under the target's name. A
// process that is killed leaves the temporary file; its name shows what it is (partial_of() in
// sim/base/file/durable_rename.h), nothing reads it, and the next process that writes the same output removes
// it (sim/base/file/durable_rename.h).
//
// A file above the shell's limit (ulimit -f) is reported like any other failed write only if the process
// ignores SIGXFSZ; setting signals is left to programs.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/file/durable_rename.h"

namespace vegard::sim {

/// Whether to remove temporary files that killed processes have left of the same output. The search is slow
/// for thousands of outputs in one folder; their writer searches once.
enum class Leftovers { removed, not_looked_for };

/// The file `target` while it is written. Not thread-safe.
class WholeFile {
 public:
  /// Creates the empty temporary file, so that an output that cannot be written is refused before the work. A
  /// symbolic link is followed: the file to which it points is replaced. Throws Error(existing_output) if the
  /// target exists and overwrite is false; Error(unwritable_output) if its folder is missing or not writable,
  /// or if the target is not a regular file (a device would be replaced by a file).
  explicit WholeFile(const std::string& target, bool overwrite = false,
                     Leftovers leftovers = Leftovers::removed);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Returns the path to write to, with the target's extension, by which image writers choose the format.
  const std::string& temporary() const { return temporary_; }

  /// Replaces the content of the temporary file by `bytes`. Throws Error(unwritable_output).
  void write(std::string_view bytes);

  /// Makes the temporary file durable and gives it the target's name. With overwrite false, a file that has
  /// appeared under that name in the meantime is not replaced. Throws as the constructor does; the destructor
  /// then removes the temporary file.
  void commit();

 private:
  std::string target_;
  std::string resolved_;  ///< the target with its symbolic links followed
  std::string temporary_;
  PartialLock lock_;
  bool overwrite_;
  bool committed_ = false;
};

/// The outputs of one piece of work: all are claimed before it, so that one that may not be written is
/// refused then, and none gets its name before all are written. An empty name is no output. Not thread-safe.
class WholeFiles {
 public:
  explicit WholeFiles(bool overwrite) : overwrite_(overwrite) {}
  /// Claims the outputs in this order. Throws as WholeFile does.
  WholeFiles(const std::vector<std::string>& names, bool overwrite);

  /// Claims one more output.
  void claim(const std::string& name);

  /// Returns a claimed output for a writer of its own.
  WholeFile& file(const std::string& name);
  void write(const std::string& name, std::string_view bytes);

  /// Commits what file() or write() was called for, in that order; the other outputs leave no trace.
  void commit();
  /// The names of what commit() commits, in order.
  const std::vector<std::string>& written() const { return written_; }

 private:
  bool overwrite_;
  std::vector<std::pair<std::string, std::unique_ptr<WholeFile>>> claimed_;
  std::vector<std::string> written_;
};

/// Writes a small file: constructor, write, commit.
void write_whole(const std::string& path, std::string_view bytes, bool overwrite = false);

}  // namespace vegard::sim
