// The tables of data/ that are compiled into the library.
#pragma once

#include <string_view>

namespace vegard::sim {

/// The text of a table by its file name ("us76.csv"), or, of emission tables, by folder and file
/// ("glow/ver_maxwellian.csv"); empty if there is none of that name.
std::string_view embedded_table(std::string_view name);

}  // namespace vegard::sim
