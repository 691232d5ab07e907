// Films that go around all of an equirectangular picture: what is beyond their edges, how wide their rows
// are, and blur along the sphere.
#pragma once

#include <vector>

#include "sim/view/camera/camera.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

/// The width of a row within the turn over that of the equator: the mean cosine of its latitudes.
double width_of_row(const FilmGeometry& film, int row);

/// The cell within the turn that shows what a cell of the margin does: left of the first column is the last,
/// above the first row is itself half a turn on.
struct CellWithin {
  int row, column;  ///< counted from the film's own first
};
CellWithin cell_within(const FilmGeometry& film, int row, int column);

/// Of a plane [row][column] that was splatted as if every row were as wide as the equator: what fell into the
/// margin is added to where it belongs, all is divided by the rows' widths, and the margin is filled with
/// what it shows. T is float or double.
template <class T>
void close_turn(const FilmGeometry& film, T* plane);

/// Blurs a plane along the sphere by a Gaussian of a standard deviation in rows, cut at `radius` rows unless
/// that is negative: across by as many columns more as a row is narrower, then down, over the poles; within 8
/// standard deviations of a pole on a plane of its own. An even sky stays even. Of the result the window,
/// [row][column].
void blur_on_sphere(const FilmGeometry& film, const float* plane, double sigma_rows, int radius,
                    const Window& window, float* out, int threads);

}  // namespace vegard::sim
