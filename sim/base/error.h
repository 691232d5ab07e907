// Error: the exception for problems with the user's input, with a complete message.
//
// Programming mistakes are assertions, and numerical problems in a fit are a verdict in its result; neither
// is an Error.
#pragma once

#include <exception>
#include <string>

namespace vegard::sim {

/// The kind of the error, from which the command line derives its documented exit code.
enum class ErrorKind {
  usage,              ///< invalid command line
  scene,              ///< an invalid scene file (or --set)
  existing_output,    ///< an output that is already there and may not be overwritten
  unreadable_input,   ///< a photograph, mask or table that is missing, truncated or not what it claims to be
  unwritable_output,  ///< an output that cannot be written (full disk, no permission)
};

/// The parts of a message. Only `problem` is required; empty parts are left out of the text.
struct ErrorDetails {
  std::string problem;   ///< what is wrong, "unknown key 'widht'"
  std::string file;      ///< the user's file with the problem
  int line = 0;          ///< 1-based line in that file, 0 if none
  std::string key;       ///< the key or option, "camera.width"
  std::string expected;  ///< what would have been right, "a number above 0"
  std::string hint;      ///< what to do, "did you mean 'width'?"
};

/// what() is "file:line: key: problem (expected …). Hint.", safe to show on a terminal (shown_text.h). The
/// parts that a place knows are added by name, also to a copy of what was caught:
///
///   throw Error(ErrorKind::scene, "unknown key 'widht'").file(path).line(7).hint("did you mean 'width'?");
///   throw Error(caught).kind(ErrorKind::usage).key("--width");
///
/// A function whose errors have parts in common returns them: throw bad_row(line, "…").expected("…").
/// Without its throw that is a warning.
class [[nodiscard]] Error : public std::exception {
 public:
  Error(ErrorKind kind, std::string problem);

  [[nodiscard]] Error&& kind(ErrorKind other) &&;
  [[nodiscard]] Error&& problem(std::string what_is_wrong) &&;
  [[nodiscard]] Error&& file(std::string name) &&;
  [[nodiscard]] Error&& line(int number) &&;
  [[nodiscard]] Error&& key(std::string name) &&;
  [[nodiscard]] Error&& expected(std::string what_is_right) &&;
  [[nodiscard]] Error&& hint(std::string what_to_do) &&;

  const char* what() const noexcept override { return text_.c_str(); }
  ErrorKind kind() const { return kind_; }
  const ErrorDetails& details() const { return details_; }

 private:
  Error&& with(std::string ErrorDetails::*part, std::string text);

  ErrorKind kind_;
  ErrorDetails details_;
  std::string text_;
};

/// Returns Error(unreadable_input) about a file; truncated() and damaged() begin with "the file is truncated:
/// " or "the file is damaged: ", and hint at kCopyAgain.
Error unreadable(const std::string& file, const std::string& problem);
Error truncated(const std::string& file, const std::string& what_is_missing);
Error damaged(const std::string& file, const std::string& problem);

inline constexpr const char* kCopyAgain = "copy it again from where it came";

/// Returns Error(unwritable_output) about a file or directory, for an errno value.
Error unwritable(const std::string& target, int error_number);

/// Returns Error(existing_output) with a hint about --overwrite.
Error already_exists(const std::string& target);

}  // namespace vegard::sim
