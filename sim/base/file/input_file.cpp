#include "sim/base/file/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "sim/base/error.h"

namespace vegard::sim {
namespace {

std::string words_of_errno(int error_number) { return std::generic_category().message(error_number); }

std::string why_no_regular_file(mode_t mode) {
  if (S_ISREG(mode)) return {};
  if (S_ISDIR(mode)) return "is a directory";
  if (S_ISFIFO(mode)) return "is a pipe, not a file";
  if (S_ISSOCK(mode)) return "is a socket, not a file";
  return "is a device, not a file";
}

}  // namespace

std::string bytes_text(std::size_t bytes) {
  constexpr std::size_t kKilo = 1 << 10, kMega = 1 << 20;
  if (bytes >= kMega) return std::to_string(bytes / kMega) + " MB";
  if (bytes >= kKilo) return std::to_string(bytes / kKilo) + " kB";
  return std::to_string(bytes) + " bytes";
}

int open_input(const std::string& path, std::string& problem, std::size_t& size_bytes) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    problem = errno == ENOENT || errno == ENOTDIR ? "there is no such file"
                                                  : "cannot be opened: " + words_of_errno(errno);
    return -1;
  }
  problem = why_no_regular_file(status.st_mode);
  if (!problem.empty()) return -1;
  // What has become a pipe since is opened without waiting for whoever writes into it.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) {
    problem = "cannot be opened: " + words_of_errno(errno);
    return -1;
  }
  if (::fstat(descriptor, &status) != 0)
    problem = "cannot be opened: " + words_of_errno(errno);
  else
    problem = why_no_regular_file(status.st_mode);
  size_bytes = static_cast<std::size_t>(status.st_size);
  if (problem.empty()) return descriptor;
  ::close(descriptor);
  return -1;
}

std::string why_no_input(const std::string& path) {
  std::string problem;
  std::size_t size = 0;
  if (const int descriptor = open_input(path, problem, size); descriptor >= 0) ::close(descriptor);
  return problem;
}

InputFile read_beginning(const std::string& path, std::size_t max_bytes) {
  InputFile file;
  std::size_t size = 0;
  const int descriptor = open_input(path, file.problem, size);
  if (descriptor < 0) return file;
  // Files of /proc say that they are empty, and others may grow meanwhile: what comes is counted.
  file.bytes.reserve(std::min(size + 1, max_bytes));
  char block[1 << 16];
  while (file.bytes.size() < max_bytes) {
    const ssize_t count = ::read(descriptor, block, std::min(sizeof block, max_bytes - file.bytes.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) file.problem = "cannot be read: " + words_of_errno(errno);
    if (count <= 0) break;
    file.bytes.append(block, static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  if (!file.problem.empty()) file.bytes.clear();
  return file;
}

InputFile read_input(const std::string& path, std::size_t max_bytes) {
  struct stat status {};
  const bool too_large = ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
                         status.st_size > static_cast<off_t>(max_bytes);
  InputFile file;
  if (!too_large) file = read_beginning(path, max_bytes + 1);
  if (too_large || file.bytes.size() > max_bytes) return {{}, "is larger than " + bytes_text(max_bytes)};
  return file;
}

std::string input_bytes(const std::string& path, const std::string& expected, std::size_t max_bytes) {
  InputFile file = read_input(path, max_bytes);
  if (!file.problem.empty()) throw unreadable(path, file.problem).expected(expected);
  return std::move(file.bytes);
}

}  // namespace vegard::sim
