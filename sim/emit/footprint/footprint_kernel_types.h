// The interface of the kernel that marches through footprints: stretches of rays in, their light out.
//
// The implementation is compiled once per instruction set; the interface passes plain arrays. The steps of a
// ray lie side by side in the lanes, sixteen to a block; so no lane waits for another ray, and a block is
// skipped as a whole if the LitMap says that it is dark. The light of a block does not depend on which other
// blocks are skipped, nor on the instruction set.
#pragma once

#include <array>
#include <cstddef>

#include "sim/emit/footprint/lit_map.h"
#include "sim/emit/footprint/march_span.h"
#include "sim/emit/footprint/step_profile.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

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

/// Computes the light of each span. Returns the number of steps that were not skipped.
std::size_t march_spans(const FootprintKernel& kernel, const MarchSpan* spans, std::size_t count,
                        SpanLight* out);

}  // namespace vegard::sim
