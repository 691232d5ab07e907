// The steps from film to picture. The light on a film is, cell by cell,
//
//   1. dimmed by the air towards the cell, each line by itself (sim/render/film.h),
//   2. blurred by the camera, each line by itself,
//   3. coloured by the sensor: linear, signed RGB,
//   4. shown: what is below 0, outside of the gamut, is set to 0 where a picture cannot hold it,
//   5. added to the sky behind it; light of the night sky is shown in the same way.
//
// render() does these steps for the pixels of a picture, sim/render/picture_model.h for the cells of a film
// that a fit bins, with derivatives. Under blur.model = "physical", where excited atoms move before they
// emit, light is spread as it is exposed (sim/render/physical_blur.h, sim/render/slab_exposer.h), and the air
// is applied after that. Under blur.order = "rgb", the paper's, render() exchanges steps 2 and 3.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/render/film.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/colour/matrix3.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

/// Returns the cells that are the pixels of the camera's picture, on a film with one cell per pixel
/// (film_for()).
Window pixels_on(const FilmGeometry& film, const Camera& camera);

/// Returns the window of all cells of a film.
Window all_of(const FilmGeometry& film);

/// Returns the blur of a line in units of the film's cells: that by angle, if lines are blurred. (The
/// physical blur has already been applied.)
PlaneBlur line_blur(const Scene& scene, const FilmGeometry& film, int line);

/// Returns the derivatives of the weights of both kernels (along rows and columns), each with respect to the
/// blur's standard deviation in cells of its direction. Only for a line that is blurred.
PlaneBlur line_blur_slope(const Scene& scene, const FilmGeometry& film, int line);

/// Does step 2 for any planes of a film, one per line. `out` becomes a picture of the window with one channel
/// per line; its memory is reused if it has that size already.
void blur_lines(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                int threads, Image& out);

/// For blur.order = "rgb", from light that is not blurred yet: returns red, green and blue of a window,
/// blurred by the widths of 630.0, 557.7 and 427.8 nm respectively, or not at all if the scene has no such
/// line. Linear and signed.
Image blurred_colours(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                      int threads);

/// Copies the planes of light that is blurred already to a picture of the window, one channel per line.
void take_lines(const Scene& scene, const FilmGeometry& film, const float* planes, const Window& window,
                int threads, Image& out);

/// Does steps 1 and 2: `rayleigh` becomes the light of a window's cells, in rayleighs. The exposure,
/// including its volumes' share, is dimmed in place.
void form_lines(const Scene& scene, Exposure& exposure, const Window& window, int threads, Image& rayleigh);

/// Does the same for an exposure with derivatives with respect to `free`. The derivatives are dimmed but not
/// blurred: no caller needs a blurred derivative of each cell (sim/render/cell_weights.h).
void form_lines(const Scene& scene, const std::vector<ParameterId>& free, Exposure& exposure,
                const Window& window, int threads, Image& rayleigh);

/// Step 4: true if this amount of light in a channel is shown.
inline bool is_shown(double light) { return light > 0.0; }

/// Step 4 for a whole image: values that are not shown become 0.
void clip_out_of_gamut(Image& light);

}  // namespace vegard::sim
