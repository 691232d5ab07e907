// The air before the film: what an exposure, with its derivatives, keeps of its light.
//
// The air comes before the lens, so it dims the cells before any blur by angle. Under the physical blur,
// where atoms wander before they shine, it dims the finished picture.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/render/film.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Multiplies every cell of every line by the transmission of the air towards the cell's centre. Nothing is
/// touched where scene.air.model is "none". The volumes' share of the exposure is dimmed too.
void dim_by_air(const Scene& scene, Exposure& exposure, int threads = 0);

/// The same with the derivatives by `free`, numbers of the scene in the order of
/// exposure.derivative: T dI + I dT, where T depends on the camera's angles and on the aerosol's depth and
/// exponent.
void dim_by_air(const Scene& scene, const std::vector<ParameterId>& free, Exposure& exposure,
                int threads = 0);

/// That transmission itself, [line][row][column]; empty where scene.air.model is "none".
std::vector<float> transmission_on_film(const Scene& scene, const FilmGeometry& film, int threads = 0);

/// The same of a finished picture of the camera, one channel per line of the scene.
void dim_picture_by_air(const Scene& scene, Image& rayleigh, int threads = 0);

}  // namespace vegard::sim
