#include "sim/base/file/durable_rename.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <regex>

namespace vegard::sim {
namespace fs = std::filesystem;

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

bool is_alive(int process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

}  // namespace vegard::sim
