// Multiplies the light of an exposure, and its derivatives, by the transmission of the air.
//
// The air comes before the lens, so it dims the cells before any blur by angle. Under the physical blur,
// where excited atoms move before they emit, it dims the finished picture.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/render/film.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

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
