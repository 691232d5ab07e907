// Which photographs a sequence has, and when they were taken.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct ListedPhoto {
  std::string file;
  double time_s;  ///< NaN if the list does not say
};

/// From images in their order, or from one list (.txt) as below. `key`: the option, for messages. Throws
/// Error(usage, unreadable_input).
std::vector<ListedPhoto> listed_photos(const std::vector<std::string>& words, const std::string& key);

struct SequencePhoto {
  std::string name;  ///< the file's without its ending; no two are alike
  std::string file;
  double time_s = 0.0;  ///< on the scene's clock
};

/// From images in their order, or from one list (.txt) with a line "FILE" or "FILE TIME_S" for each, empty
/// lines and those that begin with # left out, files relative to the list. Where no time is given: as the
/// scene's frames_per_second has it, from its start_s on. Throws Error(usage, unreadable_input).
std::vector<SequencePhoto> sequence_photos(const std::vector<std::string>& words, const sim::Scene& scene);

}  // namespace vegard::apps
