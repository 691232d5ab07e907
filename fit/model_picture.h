// The best model as a picture beside its photograph.
#pragma once

#include "fit/fit_result.h"
#include "fit/photo.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct ModelPicture {
  sim::Image rgb;       ///< R, G, B in the photograph's linear units, sky included
  sim::Image rayleigh;  ///< the emission lines before any gain, named as sim::Rendering has them
  sim::Image residual;  ///< photograph - rgb, signed, also where the photograph was not used
};

/// What a column of the picture is multiplied by: a band's gain at the band's centre, linear between two
/// centres, so that the picture has no seams, and level outside of the outermost. (The fit itself has one
/// gain in all of a band.) result.gain may be empty: then the best scene's own.
double gain_at_column(const FitResult& result, double x_px, int channel);

/// Renders result.best. The photograph must have its camera's size. threads: 0 for all cores.
ModelPicture model_picture(const FitResult& result, const Photo& photo, int threads);

}  // namespace vegard::fit
