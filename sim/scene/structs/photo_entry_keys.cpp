#include "sim/scene/structs/photo_entry_keys.h"

namespace vegard::sim {

const std::vector<PhotoTextKey>& photo_text_keys() {
  static const std::vector<PhotoTextKey> keys = {
      {"name", "by which fit.free and the results call it; left out: the file's name without its ending",
       &PhotoEntry::name},
      {"file", "a photograph of any format that is read; relative to the scene's file", &PhotoEntry::file},
      {"mask", "an image of the same size: white = use; left out: all of it", &PhotoEntry::mask},
      {"decoding", "in place of fit.decoding; left out: that", &PhotoEntry::decoding},
  };
  return keys;
}

}  // namespace vegard::sim
