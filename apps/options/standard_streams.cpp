#include "apps/options/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/shown_text.h"

namespace vegard::apps {

void capture_output(const std::string& text);

namespace {

CapturedOutput* captured = nullptr;

int first_failure = 0;  ///< errno of the first write that failed

void keep_failure() {
  if (first_failure == 0) first_failure = errno != 0 ? errno : EIO;
}

void put(const std::string& text, std::FILE* to) {
  if (to == stdout) capture_output(text);
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), to) != text.size() && to == stdout) keep_failure();
}

/// A format of one line makes one line, whatever is in the arguments.
std::string formatted(const char* format, std::va_list arguments) {
  std::va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, again);
  va_end(again);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, arguments);
  const std::string_view pattern(format);
  if (pattern.empty() || pattern.find('\n') != pattern.size() - 1) return sim::shown_lines(text);
  text.pop_back();
  return sim::shown_text(text) + '\n';
}

}  // namespace

CapturedOutput::CapturedOutput() { captured = this; }

CapturedOutput::~CapturedOutput() { captured = nullptr; }

void capture_output(const std::string& text) {
  if (captured != nullptr) captured->text_ += text;
}

void replace_closed_streams() {
  // The wrong way round, so that reading from the input and writing to the outputs fail as on closed streams.
  for (const auto& [stream, way] : {std::pair{STDIN_FILENO, O_WRONLY}, std::pair{STDOUT_FILENO, O_RDONLY},
                                    std::pair{STDERR_FILENO, O_RDONLY}}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // The lowest free number is this one, since those before it are taken by now.
    if (open("/dev/null", way) != stream) continue;
  }
}

void say_text(const std::string& text) { put(sim::shown_lines(text), stdout); }

void say(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  put(formatted(format, arguments), stdout);
  va_end(arguments);
}

void tell(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  put(formatted(format, arguments), stderr);
  va_end(arguments);
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
