// The tables of data/ that are compiled into the library.
#pragma once

#include <string_view>

namespace vegard::sim {

/// Returns the text of a table by its file name ("us76.csv"), or, for emission tables, by folder and file
/// ("glow/ver_maxwellian.csv"); empty if there is none of that name.
std::string_view embedded_table(std::string_view name);

}  // namespace vegard::sim
