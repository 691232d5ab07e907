// Features of a frame of a camera whose directions are known: those of any picture (fit/sky_kind), and those
// that use the direction of each cell, which have the same meaning for any lens. On a flat Earth an arc in
// magnetic east-west direction is a line of constant angle in the magnetic meridian: the angle atan2(up,
// magnetic north) of the line of sight. This needs neither a height nor a distance, and the gradient of the
// angle is the direction across arcs.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/sky_kind/sky_features.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The cells of a picture, with their directions. The same for all frames of a camera.
struct FilterCells : FeatureCells {
  std::vector<std::array<double, 3>> enu;  ///< directions of the cells' centres; unit vectors
};

/// Returns the cells of the scene's camera. `is_kept`: per pixel, 0 if masked; empty: no mask. A cell is sky
/// if half of its pixels are kept and its centre is higher than 5 degrees above the horizon. Throws
/// sim::Error(unreadable_input) if no cell is sky.
FilterCells filter_cells(const sim::Scene& scene, const std::vector<std::uint8_t>& is_kept);

/// Computes all features of a photograph in the pixels of its file, with the scene's site, field and camera.
/// `utc_s`: when it was taken, seconds since 1970. The same picture gives the same numbers. Throws
/// sim::Error(unreadable_input) if its size is not the camera's.
SkyFeatures frame_features(const Photo& photo, const sim::Scene& scene, const FilterCells& cells,
                           double utc_s);

}  // namespace vegard::fit
