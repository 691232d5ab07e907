// Photographs of a scene as the simulator renders it, for fits that are to find what is known.
#pragma once

#include <algorithm>

#include "fit/photo/photo.h"
#include "sim/render/render.h"

namespace vegard::tests {

/// Without noise, in floats; light out of the display's gamut is clipped.
inline fit::Photo rendered_photo(const sim::Scene& scene) {
  const sim::Rendering rendering = sim::render(scene);
  fit::Photo photo;
  photo.linear = rendering.rgb;
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i)
    photo.linear.data[i] += std::max(rendering.aurora.data[i], 0.0f) - rendering.aurora.data[i];
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = true;
  return photo;
}

/// What a linear EXR or float TIFF of the scene holds: signed, without noise.
inline fit::Photo linear_photo(const sim::Scene& scene) {
  fit::Photo photo;
  photo.linear = sim::render(scene).rgb;
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  photo.decoding = "linear";
  return photo;
}

}  // namespace vegard::tests
