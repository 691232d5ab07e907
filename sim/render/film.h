// The film that a scene's light falls on, how widely its lines are blurred there, and how the air dims it.
#pragma once

#include <vector>

#include "sim/base/image.h"
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

// The functions below multiply the light of an exposure, and its derivatives, by the transmission of the air.
//
// The air comes before the lens, so it dims the cells before any blur by angle. Under the physical blur,
// where excited atoms move before they emit, it dims the finished picture.

/// Multiplies every cell of every line by the transmission of the air towards the cell's centre. Nothing is
/// touched where scene.air.model is "none". The volumes' share of the exposure is dimmed too.
void dim_by_air(const Scene& scene, Exposure& exposure, int threads = 0);

/// As above, and applies the product rule, T dI + I dT, to the derivatives with respect to `free`, parameters
/// of the scene in the order of exposure.derivative. T depends on the camera's angles and on the aerosol's
/// depth and exponent.
void dim_by_air(const Scene& scene, const std::vector<ParameterId>& free, Exposure& exposure,
                int threads = 0);

/// Returns the transmission of the air towards each cell's centre, [line][row][column]; empty where
/// scene.air.model is "none".
std::vector<float> transmission_on_film(const Scene& scene, const FilmGeometry& film, int threads = 0);

/// Dims a finished picture of the camera, with one channel per line of the scene, in the same way.
void dim_picture_by_air(const Scene& scene, Image& rayleigh, int threads = 0);

}  // namespace vegard::sim
