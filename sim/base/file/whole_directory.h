// A run directory that appears whole or not at all; see whole_file.h for files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/base/file/stale_partial.h"

namespace vegard::sim {

/// What is known of a folder that stands where one is to be written.
struct KnownFolder {
  /// Why it is no output of ours ("it has no result.json"); empty if it is one. Never for an empty folder.
  std::string objection;
  /// Whether a regular file of that name is one that we wrote. Anything else in the folder is not ours.
  std::function<bool(const std::string& name)> has;
};

/// A kind of folder, by which an old one is recognised and known file by file before another takes its place.
struct DirectoryKind {
  std::string words;  ///< "a run", for messages
  /// Looks into a folder without changing it. It follows no link and trusts nothing that it finds.
  std::function<KnownFolder(const std::string& directory)> look;
  /// The files by which `look` knows others, removed last and in this order, so that what an interrupted
  /// removal has left is still recognised.
  std::vector<std::string> marks;
};

/// A directory on its way to `target`: files are collected in a sibling ".h000.partial-812-0" that is renamed
/// at the end. An old directory of that name stays as it is until then. Not copied, not shared between
/// threads.
class WholeDirectory {
 public:
  /// Creates the empty temporary in the place of those that killed processes have left, and parent folders
  /// that are missing (removed again if nothing is committed). Throws Error(existing_output) if the target
  /// exists and overwrite is false, or if it exists and may not be replaced: it is not a directory, is not
  /// recognised, or holds something else than the files of its kind, such as a folder, a link or a file of
  /// the user's; if someone's terminal stands in it or it is the home folder or where a disk is mounted. An
  /// empty folder is replaced. Throws Error(unwritable_output) if the temporary cannot be made.
  WholeDirectory(const std::string& target, bool overwrite, DirectoryKind kind);
  ~WholeDirectory();
  WholeDirectory(const WholeDirectory&) = delete;
  WholeDirectory& operator=(const WholeDirectory&) = delete;

  /// The directory to write into.
  const std::string& temporary() const { return temporary_; }

  /// Path of a file inside the directory to write into.
  std::string file(const std::string& name) const { return temporary_ + "/" + name; }

  /// Makes every file durable and gives the directory its name; an old one is exchanged for it, and then its
  /// files are deleted one by one, those that are known and no others. Throws as the constructor does, and
  /// then the old directory is as it was.
  void commit();

 private:
  std::string target_;
  std::string resolved_;  ///< the target with its symbolic links followed
  std::string temporary_;
  PartialLock lock_;
  std::vector<std::string> made_parents_;  ///< outermost first
  bool overwrite_;
  DirectoryKind kind_;
  bool is_ours_ = true;  ///< what bears the temporary's name was made here, and is no folder that it replaced
};

}  // namespace vegard::sim
