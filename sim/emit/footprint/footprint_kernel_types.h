// The plain numbers and arrays of the interface of the march through footprints: the footprint's grid, and
// the light of a stretch of a ray.
#pragma once

#include <array>

#include "sim/emit/footprint/lit_map.h"
#include "sim/emit/footprint/march_span.h"
#include "sim/emit/footprint/step_profile.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

/// A part of a footprint's grid that holds all its light, with a dark border.
struct TexelWindow {
  const float* flux = nullptr;       ///< [row][column]; null: dark
  const float* ln_energy = nullptr;  ///< null: 0 everywhere
  int columns = 0, rows = 0;
  double first_x = 0.0, first_y = 0.0;  ///< texel of the grid at which the window begins
};

struct FootprintKernel {
  FootProjection projection = FootProjection::vertical;
  double axis[3] = {0.0, 0.0, -1.0};  ///< as in FootRule
  const FieldPatch* patches = nullptr;
  /// Conversion from places on the plane in km, or on a face, to texels of the grid: x = place * texels +
  /// first.
  double texels = 1.0, first_x = 0.0, first_y = 0.0;
  std::array<TexelWindow, 6> window;   ///< for a plane only the first
  std::array<const LitMap*, 6> lit{};  ///< null: nothing is skipped
  const StepProfile* profile = nullptr;
  double sphere_km = kEarthRadiusKm;  ///< radius of the body
};

struct SpanLight {
  double rayleigh[kMaxLines];
  double weighted_km;  ///< sum over the lines of rayleighs times the distance along the ray
  double entry_km;     ///< where the first block with light begins; infinity if there is none
};

}  // namespace vegard::sim
