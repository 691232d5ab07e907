// The file system calls under whole files and whole directories. All report by errno value, 0 for success.
#pragma once

#include <optional>
#include <string>

namespace vegard::sim {

/// fsync of a file or directory by name.
int make_durable(const std::string& path);

/// Renames and never replaces: EEXIST if `to` exists.
int rename_to_free_name(const std::string& from, const std::string& to);

/// Puts `from` in the place of the directory `to` and the old one under the name of `from`.
int exchange_directories(const std::string& from, const std::string& to);

/// ".stem.partial-<process>-<attempt>.ext" beside `target`.
std::string partial_name(const std::string& target, int attempt);

/// What a name without a folder, as partial_name makes it, says.
struct Partial {
  std::string target;  ///< without a folder
  int process = 0;
};
/// None if it is no such name.
std::optional<Partial> partial_of(const std::string& name);

/// Keeps the name of a file that this process has not finished, until it is forgotten, where a signal handler
/// finds it. Beyond 64 names at a time, and of one of 4096 bytes or more, nothing is kept: such a file stays
/// for stale_partials() to find.
void keep_unfinished(const std::string& path);
void forget_unfinished(const std::string& path);

/// Deletes all files whose names are kept. May be called by a signal handler, of any thread at any time; the
/// process is to end then, for the files' owners do not know.
void delete_unfinished_files() noexcept;

/// False if no process of this machine has that number.
bool is_alive(int process);

}  // namespace vegard::sim
