// The files of data/: tables that are compiled into the library, and those that are read at run time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

/// Returns the text of a table by its file name ("us76.csv"), or, for emission tables, by folder and file
/// ("glow/ver_maxwellian.csv"); empty if there is none of that name.
std::string_view embedded_table(std::string_view name);

/// Returns the folders that may contain the files of data/, in the order of search: the environment variable
/// VEGARD_DATA if it is set; share/vegard/data beside the folder of the running program; data beside this code's
/// shared object (a Python wheel); the installation folder of this build; that of Debian's package; the source
/// folder. They need not exist.
std::vector<std::string> data_folders();

/// Returns the path of this file in the first of data_folders() that has it; empty if none has.
std::string find_data_file(const std::string& name);

}  // namespace vegard::sim
