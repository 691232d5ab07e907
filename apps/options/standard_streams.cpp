#include "apps/options/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/shown_text.h"

namespace vegard::apps {
namespace {

int first_failure = 0;  ///< errno of the first write that failed

void keep_failure() {
  if (first_failure == 0) first_failure = errno != 0 ? errno : EIO;
}

constexpr const char *kRed = "\033[31m", *kYellow = "\033[33m", *kPlain = "\033[0m";

void put(const std::string& text, std::FILE* to) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), to) != text.size() && to == stdout) keep_failure();
}

/// What a person reads on the standard output.
void put_words(const std::string& text, bool is_summary) {
  if (!voice().is_json && !(is_summary && voice().is_quiet)) put(text, stdout);
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

void replace_closed_streams() {
  // The wrong way round, so that reading from the input and writing to the outputs fail as on closed streams.
  for (const auto& [stream, way] : {std::pair{STDIN_FILENO, O_WRONLY}, std::pair{STDOUT_FILENO, O_RDONLY},
                                    std::pair{STDERR_FILENO, O_RDONLY}}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // The lowest free number is this one, since those before it are taken by now.
    if (open("/dev/null", way) != stream) continue;
  }
}

Voice& voice() {
  static Voice voice;
  return voice;
}

bool may_have_colours(int stream) {
  const char* const none = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  return isatty(stream) == 1 && (none == nullptr || *none == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

void say_text(const std::string& text) { put_words(sim::shown_lines(text), true); }

void say_result(const std::string& text) { put_words(sim::shown_lines(text), false); }

void say_verdict(Tone tone, const std::string& line, bool is_summary) {
  const std::string text = sim::shown_text(line);
  if (tone == Tone::good || !may_have_colours(STDOUT_FILENO)) {
    put_words(text + '\n', is_summary);
    return;
  }
  const bool is_silent = voice().is_json || (is_summary && voice().is_quiet);
  if (!is_silent) put((tone == Tone::bad ? kRed : kYellow) + text + kPlain + '\n', stdout);
}

fit::Tell said() {
  return fit::Tell([](const std::string& line, fit::Tell::Tone tone) {
    say_verdict(tone == fit::Tell::Tone::plain ? Tone::good : Tone::doubtful, line);
    show_output();
  });
}

void say_json(const std::string& text) { put(text, stdout); }

void say(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  put_words(formatted(format, arguments), true);
  va_end(arguments);
}

void tell(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  put(formatted(format, arguments), stderr);
  va_end(arguments);
}

void tell_progress(const char* format, ...) {
  if (voice().is_quiet) return;
  std::va_list arguments;
  va_start(arguments, format);
  put(formatted(format, arguments), stderr);
  va_end(arguments);
}

void complain(const std::string& program, const std::string& message) {
  const bool colours = may_have_colours(STDERR_FILENO);
  put((colours ? kRed + program + ":" + kPlain : program + ":") + " " + sim::shown_text(message) + "\n",
      stderr);
}

void show_output() {
  errno = 0;
  if (std::fflush(stdout) != 0) keep_failure();
}

void finish_output() {
  errno = 0;
  // Some file systems report a full disk only when a file is closed.
  if (std::fclose(stdout) != 0) keep_failure();
  if (first_failure == 0) return;
  throw sim::Error(sim::ErrorKind::unwritable_output,
                   "cannot be written: " + std::generic_category().message(first_failure))
      .file("the standard output");
}

}  // namespace vegard::apps
