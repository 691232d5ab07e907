// Reads the JSON of a run, a map or a sequence leniently: what is missing or null is NaN or empty.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vegard::fit {

using RecordOfRun = nlohmann::ordered_json;

/// Reads a JSON object. Throws sim::Error(unreadable_input), with `expected`, if the file is not one or is
/// too large.
RecordOfRun read_record(const std::string& file, const std::string& expected);

/// NaN for anything but a number.
double record_number(const RecordOfRun& json, const char* key);
/// Empty for anything but a text.
std::string record_text(const RecordOfRun& json, const char* key);
/// An empty list for anything but a list.
const RecordOfRun& record_list(const RecordOfRun& json, const char* key);

}  // namespace vegard::fit
