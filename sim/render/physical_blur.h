// The lines of a picture under blur.model = "physical": the light of metastable atoms is spread by the
// distance that they move within their lifetimes (sim/light/excited_atom.h), according to altitude and
// distance; the light of prompt lines is not spread.
//
// Two things are approximate. Light that would be spread into the picture from more than four of its own
// standard deviations outside is lost. Light with a larger spread than widest_spread_px(), because it is
// nearer than any light in the picture or so slow that it is a uniform veil, is spread by widest_spread_px()
// only.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "sim/base/image.h"
#include "sim/light/excited_atom.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// True if the picture is made with a spread for each point of a beam: the camera is a pinhole without
/// distortion, with its axis in the middle, and the scene has beams only. All other pictures are made by
/// slabs of altitude (sim/render/slab_exposer.h).
bool is_spread_by_beams(const Scene& scene);

/// Returns the widest spread in the picture, as standard deviation in pixels: the largest that light below
/// `top_km` can have at the picture's highest elevation, where light is nearest, but at most half the
/// picture's diagonal.
double widest_spread_px(const Scene& scene, const SpreadProfile& spread, double top_km);

/// Adds the scene's lines to the channels of `rayleigh`, a dark image of the camera's size. Returns the
/// number of deflection points computed for one line. `progress` and `stop` as in RenderOptions,
/// `only_sheet` as in Exposer.
std::uint64_t add_lines_physically(const Scene& scene, int threads,
                                   const std::function<void(double)>& progress, const std::atomic<bool>* stop,
                                   Image& rayleigh, int only_sheet = -1);

}  // namespace vegard::sim
