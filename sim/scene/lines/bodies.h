// The bodies that have a name, with the lines of their aurorae.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct KnownBody {
  Body body;
  const char* source;            ///< of the body's numbers
  double pole_latitude_deg;      ///< of the dipole's pole in the north
  double pole_longitude_deg;     ///< east positive
  std::vector<OwnLine> lines;    ///< none: the scene has those of the emission tables
  std::vector<double> shown_nm;  ///< emission.lines
  const char* lines_source;      ///< of the lines
};

/// The Earth first.
const std::vector<KnownBody>& known_bodies();

/// "earth" and the others, and "own", whose numbers the scene gives.
std::vector<std::string> body_names();

/// What the name of the scene's body brings along, in the place of what was there: the body's numbers, the
/// dipole's pole, on another body than the Earth a dipole field, the scene's own lines and emission.lines. An
/// own body brings nothing.
void adopt_body(Scene& scene);

}  // namespace vegard::sim
