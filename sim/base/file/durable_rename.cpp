#include "sim/base/file/durable_rename.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <regex>

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
static_assert(std::atomic<PlaceState>::is_always_lock_free);

bool passes(UnfinishedPlace& place, PlaceState from, PlaceState to) {
  return place.state.compare_exchange_strong(from, to);
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

void keep_unfinished(const std::string& path) {
  const std::lock_guard<std::mutex> alone(keeping);
  for (UnfinishedPlace& place : unfinished) {
    if (place.state.load() != PlaceState::free || path.size() >= sizeof place.path) continue;
    std::memcpy(place.path, path.c_str(), path.size() + 1);
    place.state.store(PlaceState::kept);
    return;
  }
}

void forget_unfinished(const std::string& path) {
  const std::lock_guard<std::mutex> alone(keeping);
  for (UnfinishedPlace& place : unfinished)
    if (place.state.load() == PlaceState::kept && path == place.path &&
        passes(place, PlaceState::kept, PlaceState::free))
      return;
}

void delete_unfinished_files() noexcept {
  for (UnfinishedPlace& place : unfinished)
    if (passes(place, PlaceState::kept, PlaceState::being_deleted)) ::unlink(place.path);
}

bool is_alive(int process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

}  // namespace vegard::sim
