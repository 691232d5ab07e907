// Where an observer stands.
#pragma once

#include <string>

namespace vegard::sim {

struct Site {
  double latitude_deg = 65.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
  std::string time_utc;  ///< ISO 8601, empty if unknown; file headers have this time, never the computer's
};

}  // namespace vegard::sim
