// The one way from film to picture. What a film has caught is, cell by cell,
//
//   1. dimmed by the air towards the cell, each line by itself (sim/render/air_on_film.h),
//   2. blurred by the camera, each line by itself,
//   3. coloured by the sensor: linear, signed RGB,
//   4. shown: what is below 0, outside of the gamut, counts as no light where a picture cannot hold it,
//   5. and lies before the sky, whose night sky is shown likewise.
//
// render() goes this way for the pixels of a picture, sim/render/picture_model.h for the cells of a film that
// a fit bins, with derivatives. Under blur.model = "physical", where atoms wander before they shine, light is
// spread as it is exposed (sim/render/physical_blur.h, sim/render/slab_exposer.h), and the air comes after
// that. Under blur.order = "rgb", the paper's, render() exchanges steps 2 and 3.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/render/film.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/colour/matrix3.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

/// The cells that are the pixels of the camera's picture, on a film of one cell to a pixel (film_for()).
Window pixels_on(const FilmGeometry& film, const Camera& camera);

/// All cells.
Window all_of(const FilmGeometry& film);

/// What a line is blurred by in the film's cells: by its angle, if lines are blurred. (The physical blur has
/// been before.)
PlaneBlur line_blur(const Scene& scene, const FilmGeometry& film, int line);

/// The derivative of both kernels' weights by the standard deviation of the blur in cells of their own
/// direction; for a line that is blurred at all.
PlaneBlur line_blur_slope(const Scene& scene, const FilmGeometry& film, int line);

/// Step 2 for any planes of a film, one per line: a picture of the window, one channel per line. `out` keeps
/// its memory if it has that size already.
void blur_lines(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                int threads, Image& out);

/// Of light that nothing has blurred, under blur.order = "rgb": red, green and blue of a window, each blurred
/// by the width of 630.0, 557.7 and 427.8 nm, or not if the scene has no such line. Linear and signed.
Image blurred_colours(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                      int threads);

/// The same of light that is blurred already.
void take_lines(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                int threads, Image& out);

/// Steps 1 and 2: the light of a window's cells, in rayleighs. The exposure, with its volumes' share, is
/// dimmed where it is.
void form_lines(const Scene& scene, Exposure& exposure, const Window& window, int threads, Image& rayleigh);

/// The same of an exposure with derivatives by `free`, which are dimmed too, but not blurred: a blurred
/// derivative of each cell is more than anyone asks for (sim/render/spread_runs.h).
void form_lines(const Scene& scene, const std::vector<ParameterId>& free, Exposure& exposure,
                const Window& window, int threads, Image& rayleigh);

/// Step 4: whether this much light of a channel is shown.
inline bool is_shown(double light) { return light > 0.0; }

/// The same for all of an image: the rest becomes 0.
void clip_out_of_gamut(Image& light);

}  // namespace vegard::sim
