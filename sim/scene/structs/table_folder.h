// The text of a folder of tables.
#pragma once

#include <map>
#include <string>

namespace vegard::sim {

struct TableFolder {
  std::string place;                         ///< of the folder, for messages
  std::map<std::string, std::string> files;  ///< text by the file's name, "ver_maxwellian.csv"
};

}  // namespace vegard::sim
