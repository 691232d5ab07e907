// Estimates the memory that a fit needs, before any is allocated.
#pragma once

#include <string>

#include "sim/base/memory_limit.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Returns an upper estimate of the largest number of bytes in use during the fit of the scene's photographs
/// (or of one photograph of its camera's size) and its report, for pictures that are full of light.
/// Validation (--bootstrap, --mcmc) adds little.
double fit_bytes(const sim::Scene& scene, int threads);

/// Throws as sim::require_memory() if a fit of the scene's photographs would take more than the limit; else
/// returns fit_bytes() with the program's own memory. The need grows with the part of the picture that is
/// lit. So, where the user gave no limit, it throws only if the memory would not suffice for a picture that
/// is half dark.
double require_memory_of_fit(const sim::Scene& scene, int threads, const sim::MemoryLimit& limit);

/// "a fit of 720 x 480 pixels", for messages.
std::string fit_in_words(const sim::Scene& scene);
/// How to need less memory, for messages.
inline constexpr const char* kLighterFit =
    "A part of the picture (fit.roi_px), a smaller picture with its camera.width and camera.height, or fewer "
    "threads need less";

}  // namespace vegard::fit
