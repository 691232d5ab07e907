// The file system calls of WholeFile and WholeDirectory, and the partial outputs of killed processes, which
// their names distinguish from those of living processes. Results of type int are errno values, 0 for
// success.
#pragma once

#include <signal.h>
#include <sys/stat.h>

#include <optional>
#include <string>
#include <vector>

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

/// While one lives, no signal handler runs in this thread, and delete_unfinished_files() in another one
/// waits; once that has begun, the constructor waits for the process's end. For the moments in which an
/// output comes to be or gets its name.
class Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

 private:
  sigset_t former_;
};

/// Creates a file (a folder) that this process has not finished yet, and registers it for signal handlers in
/// one step, which no delete_unfinished_files() of any thread can come between. Return the file's descriptor,
/// open for writing (0 for a folder), or -1 with the reason in errno, which is EEXIST for what is there
/// already. More than 64 names, and names of 4096 bytes or more, are not registered: such a file is left for
/// stale_partials().
int create_unfinished_file(const std::string& path);
int create_unfinished_directory(const std::string& path);

/// Removes a file or a folder from the register.
void forget_unfinished(const std::string& path);

/// Deletes all registered files and folders, and from then on nothing is created that would be registered:
/// who tries waits for ever. May be called by a signal handler, in any thread at any time; the process must
/// end afterwards, since the owners of the files are not informed.
void delete_unfinished_files() noexcept;

/// False if no process of this machine has that number.
bool is_alive(int process);

/// A lock that tells all processes, on this machine and on others with the same disk, that a partial output
/// has an owner. On file systems without locks, only the process's number in the name tells it.
class PartialLock {
 public:
  /// Locks and owns `descriptor` of a file or folder; the destructor closes it. -1: no lock.
  explicit PartialLock(int descriptor = -1);
  PartialLock(PartialLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  PartialLock& operator=(PartialLock&& other) noexcept;
  ~PartialLock() { release(); }
  void release();
  /// Deletes what is in the folder that it owns, its files without a descriptor more.
  void delete_content() noexcept;

 private:
  int descriptor_ = -1;
};

/// Returns, in the order of their names, the partial outputs of `target` by partial_name(), of one type of
/// file (S_IFREG, S_IFDIR), whose process is gone: their lock is free, and the number in their name is that
/// of no process, or of one that began after they were last written to.
std::vector<std::string> stale_partials(const std::string& target, mode_t type);

/// True if one path is such a partial output; false if partial_name() cannot have made its name.
bool is_stale_partial(const std::string& path, mode_t type);

}  // namespace vegard::sim
