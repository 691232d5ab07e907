// Parses an observer's position on a command line.
#pragma once

#include <string>
#include <vector>

#include "apps/options/command.h"
#include "sim/view/sky/star_place.h"

namespace vegard::apps {

/// Adds --site LAT,LON[,HEIGHT]; `words` stays empty if it is not given, and must outlive the parsing.
void add_site_option(const Command& command, std::vector<std::string>& words);

/// The same for several sites, one text with commas for each occurrence: see site_of_text().
void add_repeated_site_option(const Command& command, std::vector<std::string>& sites);

/// Parses two or three words. A latitude and a longitude are decimal degrees or degrees, minutes and seconds,
/// with a sign or with one of N, S, E, W before or behind them: "78.148", "78.148N", "N78.148", "78°8'53\"N",
/// "16.043 E". With letters the longitude may come first; it is from -180 to 360 degrees. The height is in
/// metres, "520" or "520m"; 0 if it is not given. Throws Error(usage) about `key`.
sim::Observer site_place(const std::vector<std::string>& words, const std::string& key = "--site");

/// The same of a text with commas between the words.
sim::Observer site_of_text(const std::string& text, const std::string& key = "--site");

}  // namespace vegard::apps
