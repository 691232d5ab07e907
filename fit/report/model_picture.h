// The best model as a picture beside its photograph.
//
// The fit compares the photograph with the expectation of the light, whatever the scene's own beams are: it
// leaves out their random spacing (fit/model/profile_model.cpp). The picture is of the same: no jitter, and
// beams so dense that single ones are not seen. `vegard render best.toml` shows one realisation instead.
#pragma once

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "sim/base/image.h"

namespace vegard::fit {

struct ModelPicture {
  sim::Image rgb;       ///< R, G, B in the photograph's linear units, sky included
  sim::Image rayleigh;  ///< the emission lines before any gain, named as sim::Rendering has them
  sim::Image residual;  ///< photograph - rgb, signed, also where the photograph was not used
};

/// What a column of the picture is multiplied by: a band's gain at the band's centre, linear between two
/// centres, so that the picture has no seams, and level outside of the outermost. (The fit itself has one
/// gain in all of a band.) fitted.gain may be empty: then the best scene's own.
double gain_at_column(const FittedPhoto& fitted, double x_px, int channel);

/// fitted.best as the picture has it: spacing_jitter 0 and 4 to 16 times the beams in every sheet.
sim::Scene scene_of_expectation(const FittedPhoto& fitted);

/// Renders scene_of_expectation(fitted). The photograph must have its camera's size. threads: 0 for all
/// cores.
ModelPicture model_picture(const FittedPhoto& fitted, const Photo& photo, int threads);

}  // namespace vegard::fit
