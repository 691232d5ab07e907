// The answer of a command to --json: one object, whose keys contain the units of the numbers.
//
// A command prints its text as usual (standard_streams.h), which --json suppresses, and puts the same numbers
// here. Command::runs() prints the object when the command has ended without an error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace vegard::apps {

using Json = nlohmann::ordered_json;

/// The object to be filled. There is one per program.
Json& json_answer();

/// Sets the object from JSON text, such as that of a run's own file. The text is not parsed without --json.
void answer_with(const std::string& json);

/// Null for an unknown value, and for NaN and infinity, which JSON cannot represent.
Json json_number(const std::optional<double>& number);
/// Names of the files that were written, as a list; empty names are left out.
Json json_names(const std::vector<std::string>& names);
/// The object as text.
std::string json_answer_text();

}  // namespace vegard::apps
