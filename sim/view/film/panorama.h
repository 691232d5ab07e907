// Films around a whole equirectangular picture (FilmGeometry::turn_columns): their margins, the widths of
// their rows, and blur on the sphere. "Within the turn" means inside of the margins.
#pragma once

#include <vector>

#include "sim/view/camera/camera.h"
#include "sim/view/film/blur.h"

namespace vegard::sim {

/// Returns the width of a row within the turn over that of the equator: the mean cosine of its latitudes.
double width_of_row(const FilmGeometry& film, int row);

/// The cell within the turn that has the same direction as a cell of the margin: left of the first column is
/// the last one; above the first row is the first row again, half a turn further.
struct CellWithin {
  int row, column;  ///< counted from the first of the film, including the margin
};
CellWithin cell_within(const FilmGeometry& film, int row, int column);

/// Completes a plane [row][column] on which light was splatted as if every row were as wide as the equator:
/// adds the light in the margin to the cells within the turn, divides by the widths of the rows, and copies
/// the result to the margin. T is float or double.
template <class T>
void close_turn(const FilmGeometry& film, T* plane);

/// Blurs a plane on the sphere by a Gaussian with a standard deviation in rows, truncated at `radius` rows
/// unless that is negative: across, by more columns in narrower rows, then down, over the poles; within 8
/// standard deviations of a pole on a separate plane. A uniform sky stays uniform. Computes only the window,
/// [row][column].
void blur_on_sphere(const FilmGeometry& film, const float* plane, double sigma_rows, int radius,
                    const Window& window, float* out, int threads);

}  // namespace vegard::sim
