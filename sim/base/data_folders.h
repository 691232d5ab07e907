// The places of the files of data/ that are read at run time.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

/// The folders that may hold what data/ does, in the order in which to look: the environment's VEGARD_DATA if
/// it is set; share/vegard/data beside the running program's own folder, wherever it was installed; where
/// this build installs it; where Debian's package does; the sources it was built from. None of them needs to
/// exist.
std::vector<std::string> data_folders();

/// The first of data_folders() that has this file, as a path to it; empty if none has.
std::string find_data_file(const std::string& name);

}  // namespace vegard::sim
