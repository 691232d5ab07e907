#include "sim/base/file/durable_rename.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <regex>
#include <system_error>
#include <utility>

#include "sim/base/file/input_file.h"

namespace vegard::sim {

namespace fs = std::filesystem;
namespace {

// Files that are not finished. No memory is asked for and none is given back: a handler may come in between.
enum class PlaceState { free, kept, being_deleted };

struct UnfinishedPlace {
  std::atomic<PlaceState> state{PlaceState::free};
  char path[4096];
};

std::array<UnfinishedPlace, 64> unfinished;
std::mutex keeping;  // of whoever keeps and forgets; a handler does without
std::atomic<int> uninterrupted{0};
std::atomic<bool> is_ending{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<PlaceState>::is_always_lock_free);

/// Deletes all that is in a folder. Calls nothing that a signal handler may not call.
void delete_files_in(int folder) noexcept {
  alignas(struct dirent64) char block[4096];
  // What is deleted may move the rest: until nothing is found.
  constexpr int kMostRounds = 1000;
  bool has_deleted = true;
  for (int round = 0; round < kMostRounds && has_deleted; ++round) {
    has_deleted = false;
    if (::lseek(folder, 0, SEEK_SET) != 0) return;
    for (long got = 0; (got = ::syscall(SYS_getdents64, folder, block, sizeof block)) > 0;)
      for (long at = 0; at < got;) {
        const auto* const entry = reinterpret_cast<const struct dirent64*>(block + at);
        at += entry->d_reclen;
        const char* const name = entry->d_name;
        const bool is_folder_itself =
            name[0] == '.' && (name[1] == '\0' || (name[1] == '.' && name[2] == '\0'));
        if (is_folder_itself) continue;
        bool is_gone = ::unlinkat(folder, name, 0) == 0 || ::unlinkat(folder, name, AT_REMOVEDIR) == 0;
        if (!is_gone && (errno == ENOTEMPTY || errno == EEXIST)) {
          const int inner = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
          if (inner >= 0) {
            delete_files_in(inner);
            ::close(inner);
            is_gone = ::unlinkat(folder, name, AT_REMOVEDIR) == 0;
          }
        }
        has_deleted = has_deleted || is_gone;
      }
  }
}

void keep_unfinished(const std::string& path) {
  const std::lock_guard<std::mutex> alone(keeping);
  for (UnfinishedPlace& place : unfinished) {
    if (place.state.load() != PlaceState::free || path.size() >= sizeof place.path) continue;
    std::memcpy(place.path, path.c_str(), path.size() + 1);
    place.state.store(PlaceState::kept);
    return;
  }
}

bool passes(UnfinishedPlace& place, PlaceState from, PlaceState to) {
  return place.state.compare_exchange_strong(from, to);
}

/// Seconds since 1970 when a process began; none where the system does not tell.
std::optional<double> beginning_s(int process) {
  constexpr std::size_t kMaxStatBytes = 4096;
  const std::string text = read_input("/proc/" + std::to_string(process) + "/stat", kMaxStatBytes).bytes;
  // proc(5): the second field is a name in parentheses, which may hold anything; the 22nd counts clock ticks
  // since the machine was started.
  constexpr int kFieldsBetween = 20;
  std::size_t at = text.rfind(')');
  for (int field = 0; field < kFieldsBetween && at != std::string::npos; ++field) at = text.find(' ', at + 1);
  const long ticks_per_s = ::sysconf(_SC_CLK_TCK);
  if (at == std::string::npos || ticks_per_s <= 0) return {};
  struct timespec now {
  }, up{};
  if (::clock_gettime(CLOCK_REALTIME, &now) != 0 || ::clock_gettime(CLOCK_BOOTTIME, &up) != 0) return {};
  const double begun_up_s = std::strtod(text.c_str() + at, nullptr) / static_cast<double>(ticks_per_s);
  return static_cast<double>(now.tv_sec - up.tv_sec) + begun_up_s;
}

/// True if the process began after the file was last written to, so that it has the number of one that is
/// gone.
bool is_another(int process, const struct stat& written) {
  constexpr double kClocksDiffer_s = 60.0;  // a server's clock may be behind
  const std::optional<double> begun_s = beginning_s(process);
  return begun_s && *begun_s > static_cast<double>(written.st_mtim.tv_sec) + kClocksDiffer_s;
}

}  // namespace

int make_durable(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int error = ::fsync(descriptor) == 0 ? 0 : errno;
  if (error == EINVAL || error == ENOTSUP)
    error = 0;  // a file system that has no such thing for this kind of file
  if (::close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

int rename_to_free_name(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // Network file systems may lack the flag. Between the look and the rename lies a moment that cannot be
  // helped there.
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(to, ignored))) return EEXIST;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

int exchange_directories(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  const std::string aside = from + ".replaced";
  if (::rename(to.c_str(), aside.c_str()) != 0) return errno;
  if (::rename(from.c_str(), to.c_str()) != 0) {
    const int error = errno;
    // Should this fail too, the old directory still stands whole under the name `aside`.
    return ::rename(aside.c_str(), to.c_str()) == 0 ? error : errno;
  }
  return ::rename(aside.c_str(), from.c_str()) == 0 ? 0 : errno;
}

std::string partial_name(const std::string& target, int attempt) {
  const fs::path path(target);
  const std::string name = "." + path.stem().string() + ".partial-" + std::to_string(::getpid()) + "-" +
                           std::to_string(attempt) + path.extension().string();
  return (path.parent_path() / name).string();
}

std::optional<Partial> partial_of(const std::string& name) {
  static const std::regex form(R"(\.(.+)\.partial-([1-9][0-9]{0,8})-[0-9]+(\.[^.]*)?)");
  std::smatch parts;
  if (!std::regex_match(name, parts, form)) return {};
  return Partial{parts.str(1) + parts.str(3), std::stoi(parts.str(2))};
}

Uninterrupted::Uninterrupted() {
  sigset_t all;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &former_);
  ++uninterrupted;
  if (!is_ending.load()) return;
  --uninterrupted;
  for (;;) ::pause();  // for the process's end
}

Uninterrupted::~Uninterrupted() {
  --uninterrupted;
  ::pthread_sigmask(SIG_SETMASK, &former_, nullptr);
}

int create_unfinished_file(const std::string& path) {
  const Uninterrupted whole;
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor >= 0) keep_unfinished(path);
  return descriptor;
}

int create_unfinished_directory(const std::string& path) {
  const Uninterrupted whole;
  if (::mkdir(path.c_str(), 0777) != 0) return -1;
  keep_unfinished(path);
  return 0;
}

void forget_unfinished(const std::string& path) {
  const Uninterrupted whole;
  const std::lock_guard<std::mutex> alone(keeping);
  for (UnfinishedPlace& place : unfinished)
    if (place.state.load() == PlaceState::kept && path == place.path &&
        passes(place, PlaceState::kept, PlaceState::free))
      return;
}

void delete_unfinished_files() noexcept {
  is_ending.store(true);
  // Other threads need moments; a disk that hangs is not waited for.
  constexpr int kLongest_ms = 2000;
  for (int waited_ms = 0; uninterrupted.load() != 0 && waited_ms < kLongest_ms; ++waited_ms) {
    const struct timespec pause = {0, 1000000};
    ::nanosleep(&pause, nullptr);
  }
  for (UnfinishedPlace& place : unfinished)
    if (passes(place, PlaceState::kept, PlaceState::being_deleted) && ::unlink(place.path) != 0 &&
        (errno == EISDIR || errno == EPERM)) {
      const int folder = ::open(place.path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
      if (folder >= 0) delete_files_in(folder);
      ::rmdir(place.path);
    }
}

bool is_alive(int process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

PartialLock::PartialLock(int descriptor) : descriptor_(descriptor) {
  // Not waited for: whoever looks whether the output is stale holds it for a moment, and then sees that our
  // process is alive.
  if (descriptor_ >= 0) static_cast<void>(::flock(descriptor_, LOCK_EX | LOCK_NB));
}

PartialLock& PartialLock::operator=(PartialLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void PartialLock::delete_content() noexcept {
  if (descriptor_ >= 0) delete_files_in(descriptor_);
}

void PartialLock::release() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool is_stale_partial(const std::string& path, mode_t type) {
  const std::optional<Partial> partial = partial_of(fs::path(path).filename().string());
  struct stat status {};
  if (!partial || ::lstat(path.c_str(), &status) != 0 || (status.st_mode & S_IFMT) != type) return false;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  const bool has_owner = !is_locked && errno == EWOULDBLOCK;
  ::close(descriptor);
  if (has_owner) return false;
  return !is_alive(partial->process) || (is_locked && is_another(partial->process, status));
}

std::vector<std::string> stale_partials(const std::string& target, mode_t type) {
  const fs::path path(target);
  const std::string name = path.filename().string();
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::string> found;
  std::error_code ignored;
  fs::directory_iterator entry(folder, ignored);
  for (const fs::directory_iterator end; !ignored && entry != end; entry.increment(ignored)) {
    const std::string other = entry->path().filename().string();
    if (other.find(".partial-") == std::string::npos) continue;
    const std::optional<Partial> partial = partial_of(other);
    if (partial && partial->target == name && is_stale_partial(entry->path().string(), type))
      found.push_back(entry->path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace vegard::sim
