// The names of the measured cameras whose responses are built in (data/cameras).
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

/// Each has a table data/cameras/NAME.csv.
const std::vector<std::string>& built_in_cameras();

}  // namespace vegard::sim
