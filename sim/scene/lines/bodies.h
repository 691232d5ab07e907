// The named planets and moons, with the emission lines of their aurorae.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/body.h"
#include "sim/scene/structs/light.h"

namespace vegard::sim {

struct Scene;

struct KnownBody {
  Body body;
  const char* source;            ///< reference for the body's numbers
  double pole_latitude_deg;      ///< of the dipole's pole in the north
  double pole_longitude_deg;     ///< east positive
  std::vector<OwnLine> lines;    ///< the body's own lines; empty: those of the emission tables
  std::vector<double> shown_nm;  ///< default of emission.lines
  const char* lines_source;      ///< reference for the lines
};

/// Returns the named bodies; the Earth is first.
const std::vector<KnownBody>& known_bodies();

/// Returns the choices of body.name: the named bodies and "own", whose numbers the scene gives.
std::vector<std::string> body_names();

/// Replaces the scene's settings by those of the body that body.name names: the body's numbers, the dipole's
/// pole, a dipole field (except for the Earth), the scene's own lines and emission.lines. The body "own"
/// changes nothing.
void adopt_body(Scene& scene);

}  // namespace vegard::sim
