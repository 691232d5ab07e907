// A place in the observer's tangent plane.
#pragma once

namespace vegard::sim {

/// A point or vector in the tangent plane of the observer: kilometres to the east and to the north.
struct EastNorth {
  double east = 0.0;
  double north = 0.0;
};

}  // namespace vegard::sim
