// The values of sensor.response: a word, the name of a measured camera (data/cameras), or a table.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

enum class ResponseKind {
  cie,      ///< "cie", the CIE 1931 observer
  filters,  ///< "filters", a narrow filter per line
  grey,     ///< "grey", the same response to every photon
  measured  ///< anything else: a camera or a table
};
ResponseKind response_kind(const std::string& response);

/// Returns the names of the built-in cameras; each has a table data/cameras/NAME.csv.
const std::vector<std::string>& built_in_cameras();

}  // namespace vegard::sim
