#include "sim/base/file/stale_partial.h"

#include <fcntl.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "sim/base/file/durable_rename.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {
namespace fs = std::filesystem;
namespace {

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

/// Whether a process has the number of one that is gone.
bool is_another(int process, const struct stat& written) {
  constexpr double kClocksDiffer_s = 60.0;  // a server's clock may be behind
  const std::optional<double> begun_s = beginning_s(process);
  return begun_s && *begun_s > static_cast<double>(written.st_mtim.tv_sec) + kClocksDiffer_s;
}

}  // namespace

PartialLock::PartialLock(int descriptor) : descriptor_(descriptor) {
  // Not waited for: whoever looks whether the output is stale holds it for a moment, and then sees that our
  // process is alive.
  if (descriptor_ >= 0) static_cast<void>(::flock(descriptor_, LOCK_EX | LOCK_NB));
}

PartialLock& PartialLock::operator=(PartialLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
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
