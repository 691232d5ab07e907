// What a command answers to --json: one object, whose numbers have their units in their names.
//
// A command says its words as ever (standard_streams.h), which --json keeps silent, and puts the same numbers
// here; Command::runs() prints the object when the command has ended without an error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace vegard::apps {

using Json = nlohmann::ordered_json;

/// The object, to be filled. One for the program: a command that runs others (vegard measure) begins it
/// again.
Json& json_answer();

/// The object is what this JSON says, as a run's own files have it; nothing is read where --json is not
/// given.
void answer_with(const std::string& json);

/// Null for what is not known, and for NaN and infinity, which JSON has no words for.
Json json_number(const std::optional<double>& number);
/// Names of files that were written; empty ones are left out.
Json json_names(const std::vector<std::string>& names);
/// The object as text.
std::string json_answer_text();

}  // namespace vegard::apps
