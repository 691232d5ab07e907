// A run directory that appears whole or not at all; see whole_file.h for files.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

/// A directory on its way to `target`: files are collected in a sibling ".h000.partial-812-0" that is renamed
/// at the end. An old directory of that name stays as it is until then. Not copied, not shared between
/// threads.
class WholeDirectory {
 public:
  /// Creates the empty temporary, and parent folders that are missing (removed again if nothing is
  /// committed). Throws Error(existing_output) if the target exists and overwrite is false, or if it exists
  /// and is not a run: not a directory, or one that has things in it but no result.json. Throws
  /// Error(unwritable_output) if the temporary cannot be made. Other directories than runs are known by
  /// another file, `mark`, and called `kind` in messages.
  explicit WholeDirectory(const std::string& target, bool overwrite = false,
                          const std::string& mark = "result.json", const std::string& kind = "a run");
  ~WholeDirectory();
  WholeDirectory(const WholeDirectory&) = delete;
  WholeDirectory& operator=(const WholeDirectory&) = delete;

  /// The directory to write into.
  const std::string& temporary() const { return temporary_; }

  /// Path of a file inside the directory to write into.
  std::string file(const std::string& name) const { return temporary_ + "/" + name; }

  /// Makes every file durable and gives the directory its name; an old one is exchanged for it, then deleted.
  /// Throws as the constructor does, and then the old directory is as it was.
  void commit();

 private:
  std::string target_;
  std::string resolved_;  ///< the target with its symbolic links followed
  std::string temporary_;
  std::vector<std::string> made_parents_;  ///< outermost first
  bool overwrite_;
  std::string mark_, kind_;
  bool committed_ = false;
};

}  // namespace vegard::sim
