#include "sim/scene/structs/sensor.h"

namespace vegard::sim {

ResponseKind response_kind(const std::string& response) {
  if (response == "cie") return ResponseKind::cie;
  if (response == "filters") return ResponseKind::filters;
  return response == "grey" ? ResponseKind::grey : ResponseKind::measured;
}

const std::vector<std::string>& built_in_cameras() {
  static const std::vector<std::string> names = {"canon_5d_mark_ii", "nikon_d200", "nikon_d700",
                                                 "sony_a7s_ii"};
  return names;
}

}  // namespace vegard::sim
