// What commands say, on the standard output and on standard error. All of it goes through here: words of
// inputs are made safe to show (sim/base/shown_text.h), and whether what was printed could be written is
// checked once at the end.
#pragma once

#include <string>

namespace vegard::apps {

/// Opens what stands in for standard streams that were closed when the program began, such that using them
/// fails. Without it an output file would get the number of the standard output, and with it all that is
/// printed. To be called before any file is opened.
void replace_closed_streams();

/// How much is said: --quiet and --json, which every subcommand has.
struct Voice {
  bool is_quiet = false;  ///< no progress, no notes and no summary; results, warnings and errors still
  bool is_json = false;   ///< one JSON object (json_answer.h) in place of all words on the standard output
};
Voice& voice();

/// As std::printf, a line of a summary; what stands before a line's end at the end of `format` is one line. A
/// failure is kept for finish_output(): what a command has yet to write to files is worth more than its
/// words.
[[gnu::format(printf, 1, 2)]] void say(const char* format, ...);
/// Of several lines.
void say_text(const std::string& text);
/// The same of what a command is asked to print, not of what it has written: said with --quiet too.
void say_result(const std::string& text);
/// A line of a verdict: yellow on a terminal if it is doubtful, red if it is bad.
enum class Tone { good, doubtful, bad };
void say_verdict(Tone tone, const std::string& line, bool is_summary = true);
/// What --json promises, already JSON: said whatever else is not.
void say_json(const std::string& text);

/// While it lives, what is said is kept as well: for a report that quotes it. One at a time.
class CapturedOutput {
 public:
  CapturedOutput();
  ~CapturedOutput();
  CapturedOutput(const CapturedOutput&) = delete;
  CapturedOutput& operator=(const CapturedOutput&) = delete;

  const std::string& text() const { return text_; }

 private:
  friend void capture_output(const std::string& text);
  std::string text_;
};

/// A warning, or how an interrupted command goes on: on standard error, whose failures are nobody's.
[[gnu::format(printf, 1, 2)]] void tell(const char* format, ...);
/// Progress and notes, which --quiet leaves out.
[[gnu::format(printf, 1, 2)]] void tell_progress(const char* format, ...);
/// An error: "PROGRAM: MESSAGE", the program's name in red on a terminal.
void complain(const std::string& program, const std::string& message);

/// Whether a stream may have colours: it is a terminal that knows them, and the user has not set NO_COLOR
/// (https://no-color.org).
bool may_have_colours(int stream);

/// What was printed so far is to be seen now, before long work. Failures as in say().
void show_output();

/// Throws Error(unwritable_output) if anything that was printed could not be written. Nothing may be printed
/// after it.
void finish_output();

}  // namespace vegard::apps
