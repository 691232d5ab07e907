// The keys of an entry of [[fit.photo]], each named once for the reader, the writer and the listings.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

inline const char* const photo_key = "photo";  ///< array of tables inside the table free_table: [[fit.photo]]
inline const char* const photo_set_key = "set";

struct PhotoTextKey {
  std::string key, meaning;
  std::string PhotoEntry::*place;
};
const std::vector<PhotoTextKey>& photo_text_keys();

}  // namespace vegard::sim
