// The texts of a folder of emission tables.
#pragma once

#include <map>
#include <string>

namespace vegard::sim {

struct TableFolder {
  std::string place;                         ///< path of the folder, for messages
  std::map<std::string, std::string> files;  ///< text of each file by its name, "ver_maxwellian.csv"
};

}  // namespace vegard::sim
