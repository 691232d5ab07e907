// The lines of a picture under blur.model = "physical": the light of metastable atoms spread as far as they
// come within their lifetimes (sim/light/excited_atom.h), by altitude and distance; that of prompt lines as
// it falls on the film.
//
// What is lost: light that is spread into the picture from more than four of its own standard deviations
// outside; and what is spread more widely than widest_spread_px(), by light that is nearer than any the
// picture shows or so slow that it is a veil, is spread by that.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "sim/base/image.h"
#include "sim/light/excited_atom.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Whether the scene's picture is made so, with a spread for each point of a beam: by a pinhole without
/// distortion, its axis in the middle, and of beams alone. Every other goes by slabs of altitude
/// (sim/render/slab_exposer.h).
bool is_spread_by_beams(const Scene& scene);

/// The widest spread on the picture, in pixels (standard deviation): the largest that light below `top_km`
/// can have where the picture looks highest and so nearest, but at most half the picture's diagonal.
double widest_spread_px(const Scene& scene, const SpreadProfile& spread, double top_km);

/// Adds the scene's lines to the channels of `rayleigh`, a dark image of the camera's size. Returns the
/// number of deflection points computed for one line. `progress` and `stop` as in RenderOptions,
/// `only_sheet` as in Exposer.
std::uint64_t add_lines_physically(const Scene& scene, int threads,
                                   const std::function<void(double)>& progress, const std::atomic<bool>* stop,
                                   Image& rayleigh, int only_sheet = -1);

}  // namespace vegard::sim
