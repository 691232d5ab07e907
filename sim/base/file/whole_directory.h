// WholeDirectory: an output directory that appears complete or not at all; see whole_file.h for files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/base/file/durable_rename.h"

namespace vegard::sim {

/// What is known about an existing folder with the name of an output.
struct KnownFolder {
  /// Why the folder is not an output of vegard ("it has no result.json"); empty if it is one, and for an
  /// empty folder.
  std::string objection;
  /// True if vegard wrote the regular file of that name. Everything else in the folder is the user's.
  std::function<bool(const std::string& name)> has;
};

/// A kind of output directory: how an old one is recognised, file by file, before it is replaced.
struct DirectoryKind {
  std::string words;  ///< "a run", for messages
  /// Inspects a folder without changing it. It must not follow links and must not trust the content.
  std::function<KnownFolder(const std::string& directory)> look;
  /// The files by which `look` recognises the folder. They are removed last and in this order, so that the
  /// rest of an interrupted removal is still recognised.
  std::vector<std::string> marks;
};

/// The directory `target` while it is written: files are collected in a sibling ".h000.partial-812-0" that is
/// renamed at the end. An old directory of that name stays unchanged until then. Not thread-safe.
class WholeDirectory {
 public:
  /// Creates the empty temporary directory and missing parent folders (removed again without a commit), and
  /// removes temporaries of killed processes. Throws Error(existing_output) if the target exists and
  /// overwrite is false, or if it must not be replaced: it is not a directory, is not recognised, contains
  /// anything but the files of its kind (such as a folder, a link or a file of the user), is the working
  /// directory of a terminal, the home folder or a mount point. An empty folder is replaced. Throws
  /// Error(unwritable_output) if the temporary cannot be created.
  WholeDirectory(const std::string& target, bool overwrite, DirectoryKind kind);
  ~WholeDirectory();
  WholeDirectory(const WholeDirectory&) = delete;
  WholeDirectory& operator=(const WholeDirectory&) = delete;

  /// Returns the path of the temporary directory, to write into.
  const std::string& temporary() const { return temporary_; }

  /// Returns the path of a file inside of the temporary directory.
  std::string file(const std::string& name) const { return temporary_ + "/" + name; }

  /// Makes every file durable and gives the directory its name. An old directory is exchanged with it; then
  /// the known files of the old one are deleted one by one, and no others. Throws as the constructor does;
  /// the old directory is unchanged then.
  void commit();

  /// Calls `write`, which writes the files, and commits. Of an Error about a file in the temporary directory
  /// the user is told as about one of the directory that he named.
  void fill(const std::function<void()>& write);

 private:
  std::string named_;  ///< the target as it was given
  std::string target_;
  std::string resolved_;  ///< the target with its symbolic links followed
  std::string temporary_;
  PartialLock lock_;
  std::vector<std::string> made_parents_;  ///< outermost first
  bool overwrite_;
  DirectoryKind kind_;
  bool is_ours_ = true;  ///< temporary_ is the new directory, not the old one after the exchange
};

}  // namespace vegard::sim
