// Looks for the stars of a narrow field, 3 to 30 degrees across: those of the whole catalogue to magnitude 8.
//
// As in star_recognition.h four neighbouring points are looked up by their code. So narrow a field is a flat
// map of the sky whatever the lens, so that two pinholes do for all, and codes are right to a hundredth: each
// finds one or no asterism of the sky by chance, though the sky has half a million.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/photo/pointing/blind/growing_camera.h"

namespace vegard::fit {

struct NarrowSearch {
  bool found = false;  ///< is_certain() of `best`
  bool has_best = false;
  GrownCamera best;      ///< its matches have the indices of deep_equatorial_sky()
  double cameras = 0.0;  ///< number of cameras that were tried
  int figures = 0;       ///< number of the picture's asterisms that were looked up
};

/// `points`: the brightest first. `zenith`: the observer's in the axes of equatorial_sky(), if it is known:
/// what has stars below the horizon is left out. Cameras that see more than 37 degrees from corner to corner
/// are too.
NarrowSearch search_narrow(const std::vector<FoundStar>& points, const Frame& frame, const SkyPixels& pixels,
                           const std::optional<Eigen::Vector3d>& zenith);

}  // namespace vegard::fit
