// The film that a scene's light falls on, and how widely its lines are blurred there.
#pragma once

#include "sim/render/exposure.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Returns the film that covers a region of the picture, with a margin for the blur (but not for the volumes'
/// glow), in cells of `cell_width_px` by `cell_height_px` pixels.
FilmGeometry film_for(const Scene& scene, double x_px, double y_px, double width_px, double height_px,
                      double cell_width_px, double cell_height_px);

/// Returns the standard deviation of a line's blur in pixels. The blur's width is an angle, and a pixel
/// covers hfov / width; or the width is the paper's, in proportion to the picture's height (blur.widths). 0
/// under the physical blur.
double blur_sigma_px(const Scene& scene, int line);

/// Returns the derivative of blur_sigma_px() with respect to the camera's parameter that sets the picture's
/// scale (scale_number).
double blur_sigma_growth_px(const Scene& scene, int line);

/// Returns the radius at which a line's blur kernel is cut off, in pixels; -1 if it is not truncated. The
/// paper's supports, "21 by 21" and "5 by 5" pixels at sigma 4.75 and 2.0, are 2.2 and 1.25 sigma
/// (docs/physics.md row B25).
int blur_radius_px(const Scene& scene, int line);

}  // namespace vegard::sim
