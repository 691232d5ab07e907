// Where and when an observer stands: [site], [field], [time], [substorm].
#pragma once

#include <string>

namespace vegard::sim {

struct Site {
  double latitude_deg = 65.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
  std::string time_utc;  ///< ISO 8601, empty if unknown; file headers have this time, never the computer's
};

enum class FieldModel {
  uniform,  ///< the same everywhere
  dipole,   ///< the direction of a tilted dipole's field at each foot
  igrf      ///< the direction of the IGRF at each foot, at the site's time
};

/// The geomagnetic field. Every beam has a straight field line with the field's direction at its foot.
struct Field {
  FieldModel model = FieldModel::uniform;
  double inclination_deg = 78.0;       ///< of the uniform field, below the horizon in the north
  double declination_deg = 0.0;        ///< of the uniform field, from north to the east
  double pole_latitude_deg = 80.65;    ///< of the dipole's pole in the north
  double pole_longitude_deg = -72.68;  ///< of the dipole's pole in the north, east positive
};

/// The times of pictures and animations on the scene's clock. A picture is the mean of its instants
/// start_s + k exposure_s / instants, k = 0 ... instants - 1.
struct Time {
  double start_s = 0.0;
  double exposure_s = 0.0;
  int instants = 1;
  double frames_per_second = 60.0;  ///< of an animation: frame n is at start_s + n lapse / frames_per_second
  int frames = 60;
  double lapse = 1.0;  ///< of an animation: seconds of the scene's clock per second of the animation
};

/// The brightness of all aurora during a substorm, as a factor on the brightness of the emitters.
struct Substorm {
  double quiet = 1.0;  ///< before the growth phase and after the recovery; 1: no substorm
  double grown = 0.3;  ///< at the end of the growth phase, when the expansion sets in
  double onset_s = 3600.0;
  double growth_s = 3600.0;
  double expansion_s = 1200.0;
  double recovery_s = 3600.0;
};

}  // namespace vegard::sim
