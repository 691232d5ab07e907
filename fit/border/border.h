// Traces the lower border of the light along azimuth in a photograph of any lens, without a model of
// electrons.
//
// The picture is averaged over cells of azimuth and elevation. A smooth lower envelope is taken as the sky.
// In each column of equal azimuth, every local maximum of light that exceeds noise and sky gives a peak. Its
// border is the elevation below it at which the light, above the sky just beneath, has fallen to half of the
// peak, but for what the air between dims (fit/border/border_air.h): the convention of `lower_border_km`
// (docs/map.md). These points are linked from column to column. Near the zenith, where azimuths crowd, other
// columns are taken (fit/border/high_borders.h).
// Directions are those of the camera's pixels: apparent ones, with refraction, if the camera was calibrated
// with stars. Blurring and averaging are symmetric about an edge, so they do not shift it.
#pragma once

#include <string>
#include <vector>

#include "fit/border/border_trace.h"
#include "fit/border/sky_cells.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct Border {
  /// Claimed ones first, then those with a border over min_length_deg; by probability, then by length.
  std::vector<BorderTrace> traces;
  int measured = 0;                ///< how many of the traces are claimed
  std::vector<std::string> notes;  ///< sentences about the answer
  SkyCells cells;
};

/// Traces the borders. The scene's camera and site must be those of the photograph. Throws sim::Error(scene)
/// if the picture has another size than the camera, or the observer is not below the light. If there is no
/// light or no border, this is not an error: `measured` is 0 and the notes tell why. The same input gives the
/// same answer.
Border trace_border(const Photo& photo, const sim::Scene& scene, const BorderSettings& settings = {});

}  // namespace vegard::fit
