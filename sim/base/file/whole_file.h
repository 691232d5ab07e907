// Outputs that appear whole or not at all.
//
// Everything is written under a temporary name beside its target (".model.partial-812-0.exr") and renamed at
// the very end, so that neither a full disk nor an interruption leaves half a file under a name that someone
// trusts. A process that is killed outright leaves the temporary; its name says what it is (partial_of in
// sim/base/file/durable_rename.h), nothing ever reads it, and the next that writes the same output removes it
// (sim/base/file/stale_partial.h).
//
// A file above the shell's limit (ulimit -f) is reported as any other failed write only if the process
// ignores SIGXFSZ; signals belong to the program, not to a library.
#pragma once

#include <string>
#include <string_view>

#include "sim/base/file/stale_partial.h"

namespace vegard::sim {

/// What killed processes have left of the same output: of thousands of outputs in one folder, whoever writes
/// them looks for it once.
enum class Leftovers { removed, not_looked_for };

/// One file on its way to `target`. Not copied, not shared between threads.
class WholeFile {
 public:
  /// Creates the empty temporary, so that an output that cannot be written is refused before the work, not
  /// after it. A symbolic link is followed: the file it points to is the one replaced. Throws
  /// Error(existing_output) if the target exists and overwrite is false; Error(unwritable_output) if its
  /// folder is missing or closed to us, or if the target is no regular file (a device would be replaced by a
  /// file).
  explicit WholeFile(const std::string& target, bool overwrite = false,
                     Leftovers leftovers = Leftovers::removed);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Where to write: in the target's folder and with its extension, by which image writers choose the format.
  const std::string& temporary() const { return temporary_; }

  /// Writes all of `bytes` into the temporary, in place of what it held. Throws Error(unwritable_output).
  void write(std::string_view bytes);

  /// Makes the temporary durable and gives it its name. With overwrite false a file that has appeared under
  /// that name in the meantime is not replaced. Throws as the constructor does; the temporary is then removed
  /// by the destructor.
  void commit();

 private:
  std::string target_;
  std::string resolved_;  ///< the target with its symbolic links followed
  std::string temporary_;
  PartialLock lock_;
  bool overwrite_;
  bool committed_ = false;
};

/// The whole way of a small file: constructor, write, commit.
void write_whole(const std::string& path, std::string_view bytes, bool overwrite = false);

}  // namespace vegard::sim
