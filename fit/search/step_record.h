// One line of a journal's file: a checksum, then JSON.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "fit/search/journal.h"

namespace vegard::fit {

/// SHA-256 of the text, a space, the text, a line's end. The text has no line's end of its own.
std::string checked_line(const std::string& text);

/// The text of a line given without its end; none if it is torn or damaged.
std::optional<std::string> checked_text(const std::string& line);

/// A step as JSON on one line. Doubles stand as their 64 bits in hexadecimal digits, those of a vector one
/// after the other, so that they come back to the last bit.
std::string step_text(const std::string& name, const StepOutput& output);

/// Back again; none if the text is no step.
std::optional<std::pair<std::string, StepOutput>> step_of_text(const std::string& text);

}  // namespace vegard::fit
