// The file system calls of WholeFile and WholeDirectory. Results of type int are errno values, 0 for success.
#pragma once

#include <optional>
#include <string>

namespace vegard::sim {

/// fsync of a file or directory by name.
int make_durable(const std::string& path);

/// Renames without replacing: EEXIST if `to` exists.
int rename_to_free_name(const std::string& from, const std::string& to);

/// Exchanges the names of the directories `from` and `to`.
int exchange_directories(const std::string& from, const std::string& to);

/// Returns the name of a partial output, ".stem.partial-<process>-<attempt>.ext" beside `target`.
std::string partial_name(const std::string& target, int attempt);

/// The parts of a name that partial_name() has made, without its folder.
struct Partial {
  std::string target;  ///< without a folder
  int process = 0;
};
/// Returns nothing for any other name.
std::optional<Partial> partial_of(const std::string& name);

/// Registers (removes from the register) a file that this process has not finished, for signal handlers. More
/// than 64 names, and names of 4096 bytes or more, are not registered: such a file is left for
/// stale_partials().
void keep_unfinished(const std::string& path);
void forget_unfinished(const std::string& path);

/// Deletes all registered files. May be called by a signal handler, in any thread at any time; the process
/// must end afterwards, since the owners of the files are not informed.
void delete_unfinished_files() noexcept;

/// False if no process of this machine has that number.
bool is_alive(int process);

}  // namespace vegard::sim
