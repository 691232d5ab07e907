#include "sim/scene/structs/photo_entry_keys.h"

namespace vegard::sim {

const std::vector<PhotoTextKey>& photo_text_keys() {
  static const std::vector<PhotoTextKey> keys = {
      {"name", "name in fit.free and results; default the file's name without its ending", &PhotoEntry::name},
      {"file", "photograph, relative to the scene's file", &PhotoEntry::file},
      {"mask", "mask of the same size: white = use; default all", &PhotoEntry::mask},
      {"decoding", "decoding; default fit.decoding", &PhotoEntry::decoding},
  };
  return keys;
}

}  // namespace vegard::sim
