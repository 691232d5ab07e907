#include "apps/options/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <system_error>
#include <utility>

#include "sim/base/error.h"

namespace vegard::apps {
namespace {

int first_failure = 0;  ///< errno of the first write that failed

void keep_failure() {
  if (first_failure == 0) first_failure = errno != 0 ? errno : EIO;
}

}  // namespace

void stand_in_for_closed_streams() {
  // The wrong way round, so that reading from the input and writing to the outputs fail as on closed streams.
  for (const auto& [stream, way] : {std::pair{STDIN_FILENO, O_WRONLY}, std::pair{STDOUT_FILENO, O_RDONLY},
                                    std::pair{STDERR_FILENO, O_RDONLY}}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // The lowest free number is this one, since those before it are taken by now.
    if (open("/dev/null", way) != stream) continue;
  }
}

void say_text(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) keep_failure();
}

void say(const char* format, ...) {
  std::va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  say_text(text);
}

void show_output() {
  errno = 0;
  if (std::fflush(stdout) != 0) keep_failure();
}

void finish_output() {
  errno = 0;
  // Some file systems tell of a full disk only when a file is closed.
  if (std::fclose(stdout) != 0) keep_failure();
  if (first_failure == 0) return;
  sim::refuse_file(sim::ErrorKind::unwritable_output, "the standard output",
                   "cannot be written: " + std::generic_category().message(first_failure));
}

}  // namespace vegard::apps
