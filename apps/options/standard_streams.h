// All output of commands on standard output and standard error. Text from inputs is made safe to show
// (sim/base/shown_text.h), and errors of writing are checked once at the end.
#pragma once

#include <string>

#include "fit/measurement/words.h"

namespace vegard::apps {

/// Opens replacements for standard streams that were closed when the program began, such that using them
/// fails. Without this, an output file would get the descriptor of standard output, and all that is printed
/// would be written into it. To be called before any file is opened.
void replace_closed_streams();

/// How much is printed: --quiet and --json, which every subcommand has.
struct Voice {
  bool is_quiet = false;  ///< no progress, no notes and no summary; results, warnings and errors still
  bool is_json = false;   ///< one JSON object (json_answer.h) instead of all text on standard output
};
Voice& voice();

/// Prints a summary, as std::printf. If the only line end in `format` is its last character, exactly one line
/// is printed: line ends in arguments are escaped. A failure is kept until finish_output(), since the files
/// that a command has yet to write are more important than its messages.
[[gnu::format(printf, 1, 2)]] void say(const char* format, ...);
/// Prints a summary of several lines.
void say_text(const std::string& text);
/// Prints results that the user asked for (not reports of what was written), also with --quiet.
void say_result(const std::string& text);
/// Prints a line of a verdict: on a terminal yellow if it is doubtful, red if it is bad.
enum class Tone { good, doubtful, bad };
void say_verdict(Tone tone, const std::string& line, bool is_summary = true);
/// Prints the JSON text for --json, always.
void say_json(const std::string& text);

/// Prints what a stage of a measurement tells, each line as soon as it is told.
fit::Tell said();

/// Prints a warning, or how to continue an interrupted command, on standard error. Failures are ignored.
[[gnu::format(printf, 1, 2)]] void tell(const char* format, ...);
/// Prints progress and notes, which --quiet suppresses.
[[gnu::format(printf, 1, 2)]] void tell_progress(const char* format, ...);
/// Prints an error: "PROGRAM: MESSAGE", with the program's name in red on a terminal.
void complain(const std::string& program, const std::string& message);

/// Whether a stream may have colours: it is a terminal that supports them, and the user has not set NO_COLOR
/// (https://no-color.org).
bool may_have_colours(int stream);

/// Flushes what was printed, before long work. Failures are kept as in say().
void show_output();

/// Throws Error(unwritable_output) if anything that was printed could not be written. Nothing may be printed
/// after it.
void finish_output();

}  // namespace vegard::apps
