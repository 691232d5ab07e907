// Estimates the memory that a fit needs, before any is allocated.
#pragma once

#include <string>

#include "sim/base/memory_limit.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Bytes at the worst moment of a fit of the scene's photographs, or of one of its camera's size, and of the
/// report: from above, of a picture that is full of light. Validation (--bootstrap, --mcmc) adds little.
double fit_bytes(const sim::Scene& scene, int threads);

/// Throws as sim::require_memory() if a fit of the scene's photographs would take more than the limit, and
/// returns the bytes that it takes at most. How much that is depends on how much of the picture is lit: where
/// no limit was given it must be too much even for a picture that is half dark.
double require_memory_of_fit(const sim::Scene& scene, int threads, const sim::MemoryLimit& limit);

/// "a fit of 720 x 480 pixels", and how to need less than it takes.
std::string fit_in_words(const sim::Scene& scene);
inline constexpr const char* kLighterFit =
    "A part of the picture (fit.roi_px), a smaller picture with its camera.width and camera.height, or fewer "
    "threads need less";

}  // namespace vegard::fit
