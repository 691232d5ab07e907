// The picture of the best model, for comparison with its photograph.
//
// The fit compares the photograph with the expectation of the light, whatever the scene's own beams are: it
// ignores their random spacing (fit/model/profile_model.cpp). The picture shows the same: no jitter, and
// beams so dense that single ones are not visible. `vegard render best.toml` shows one realisation instead.
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

/// Returns the gain of a column of the picture: the band's gain at the band's centre, linear between two
/// centres, so that the picture has no seams, and constant outside of the outermost. (In the fit, the gain is
/// the same in all of a band.) If fitted.gain is empty, the best scene's own is used.
double gain_at_column(const FittedPhoto& fitted, double x_px, int channel);

/// Returns fitted.best for the picture: spacing_jitter 0 and 4 to 16 times the beams in every sheet.
sim::Scene scene_of_expectation(const FittedPhoto& fitted);

/// Renders scene_of_expectation(fitted). The photograph must have its camera's size. threads: 0 for all
/// cores.
ModelPicture model_picture(const FittedPhoto& fitted, const Photo& photo, int threads);

}  // namespace vegard::fit
