// The folder in which the studio was started: what is in it, and nothing outside of it.
#pragma once

#include <functional>
#include <string>

namespace vegard::apps {

class StudioFolder {
 public:
  /// The working directory.
  StudioFolder();

  /// The real path of a name in the folder; empty if it is outside (by "..", an absolute path or a link),
  /// hidden (a part of it begins with a point) or does not exist.
  std::string path_of(const std::string& name) const;

  /// The same of a folder's or file's name as the user writes it, relative to the folder; empty if it is
  /// outside.
  std::string name_of(const std::string& word) const;

  /// What is there, as JSON: photographs, scenes, and runs (folders with a report.html), each with its name
  /// and kind, runs also with what they have of that which the page shows; the newest first. Folders in
  /// folders are looked into three deep.
  std::string listing_json() const;

  /// Writes a new file, which appears whole or not at all, and returns its name: that which is asked for
  /// without folders, or with a number if there is such a file. `receive` hands on the bytes to its argument
  /// and returns whether all came. Throws Error(usage) for a name that no file can have, and
  /// Error(unwritable_output).
  std::string put(
      const std::string& name,
      const std::function<bool(const std::function<bool(const char*, std::size_t)>&)>& receive) const;

 private:
  std::string folder_;  ///< its real path
};

/// Whether a word of a command line names only what is inside of the folder: no part of it is "..", and none
/// is an absolute path.
bool stays_inside(const std::string& word);

/// The type by which a browser knows a file: "image/jpeg", by the end of its name.
std::string content_type(const std::string& name);

}  // namespace vegard::apps
