// One line of a journal's file: a checksum, then JSON.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "fit/search/journal.h"

namespace vegard::fit {

/// Returns a line of the SHA-256 of the text, a space, the text and a newline. The text must not contain a
/// newline.
std::string checked_line(const std::string& text);

/// Returns the text of a line, given without its newline; none if the line is incomplete or damaged.
std::optional<std::string> checked_text(const std::string& line);

/// Returns a step as JSON on one line. Doubles are written as the hexadecimal digits of their 64 bits, those
/// of a vector one after the other, so that they are restored exactly.
std::string step_text(const std::string& name, const StepOutput& output);

/// Inverse of step_text(); none if the text is not a step.
std::optional<std::pair<std::string, StepOutput>> step_of_text(const std::string& text);

}  // namespace vegard::fit
