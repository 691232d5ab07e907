#include "sim/base/error.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include "sim/base/shown_text.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kMaxOfName = 1000;  // of a file, which one wants to find

std::string message_of(const ErrorDetails& d) {
  std::string text;
  if (!d.file.empty()) {
    text += shortened_text(d.file, kMaxOfName);
    if (d.line > 0) text += ":" + std::to_string(d.line);
    text += ": ";
  }
  if (!d.key.empty()) text += shortened_text(d.key) + ": ";
  text += shortened_quotes(d.problem);
  if (!d.expected.empty()) text += " (expected " + shortened_quotes(d.expected) + ")";
  if (!d.hint.empty()) text += "; " + shortened_quotes(d.hint);
  return text;
}

std::string hint_for(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return "does its folder exist?";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "nothing was left behind; make room or choose another disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    default:
      return {};
  }
}

}  // namespace

Error::Error(ErrorKind kind, std::string problem)
    : kind_(kind), details_{std::move(problem), {}, 0, {}, {}, {}}, text_(message_of(details_)) {}

Error&& Error::with(std::string ErrorDetails::*part, std::string text) {
  details_.*part = std::move(text);
  text_ = message_of(details_);
  return std::move(*this);
}

Error&& Error::problem(std::string what_is_wrong) && {
  return with(&ErrorDetails::problem, std::move(what_is_wrong));
}
Error&& Error::file(std::string name) && { return with(&ErrorDetails::file, std::move(name)); }
Error&& Error::key(std::string name) && { return with(&ErrorDetails::key, std::move(name)); }
Error&& Error::hint(std::string what_to_do) && { return with(&ErrorDetails::hint, std::move(what_to_do)); }
Error&& Error::expected(std::string what_is_right) && {
  return with(&ErrorDetails::expected, std::move(what_is_right));
}

Error&& Error::kind(ErrorKind other) && {
  kind_ = other;
  return std::move(*this);
}

Error&& Error::line(int number) && {
  details_.line = number;
  text_ = message_of(details_);
  return std::move(*this);
}

Error unreadable(const std::string& file, const std::string& problem) {
  return Error(ErrorKind::unreadable_input, problem).file(file);
}

Error truncated(const std::string& file, const std::string& what_is_missing) {
  return unreadable(file, "the file is truncated: " + what_is_missing).hint(kCopyAgain);
}

Error damaged(const std::string& file, const std::string& problem) {
  return unreadable(file, "the file is damaged: " + problem).hint(kCopyAgain);
}

Error unwritable(const std::string& target, int error_number) {
  return Error(ErrorKind::unwritable_output,
               "cannot be written: " + std::generic_category().message(error_number))
      .file(target)
      .hint(hint_for(error_number));
}

Error already_exists(const std::string& target) {
  return Error(ErrorKind::existing_output, "exists already")
      .file(target)
      .hint("use --overwrite to replace it, or choose another name");
}

}  // namespace vegard::sim
