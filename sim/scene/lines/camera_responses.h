// What sensor.response may be: a word, the name of a measured camera whose response is built in
// (data/cameras), or a table.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

enum class ResponseKind {
  cie,      ///< "cie", the CIE 1931 observer
  filters,  ///< "filters", a narrow one per line
  grey,     ///< "grey", every photon counts alike
  measured  ///< any other: of a camera or a table
};
ResponseKind response_kind(const std::string& response);

/// Each has a table data/cameras/NAME.csv.
const std::vector<std::string>& built_in_cameras();

}  // namespace vegard::sim
