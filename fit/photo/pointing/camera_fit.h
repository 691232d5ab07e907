// Least squares of a camera's numbers to stars: Ceres with exact derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/photo/pointing/sky_camera.h"

namespace vegard::fit {

/// Which stars take part, one entry a star; empty: all.
using StarSet = std::vector<char>;

struct CameraFit {
  SkyCamera camera;
  bool good = false;            ///< the descent ended well and every star that takes part has an image
  double sum_of_squares = 0.0;  ///< of those stars' residuals, in px^2
};

/// Moves the free numbers of `start`. `cauchy_px`: the scale beyond which a star counts less and less
/// (Cauchy's loss); 0: plain least squares.
CameraFit fit_camera(const SkyCamera& start, const std::vector<LensNumber>& free,
                     const std::vector<StarSighting>& stars, const StarSet& used = {},
                     double cauchy_px = 0.0);

/// Seen minus computed, in px, of every star, (dx, dy); infinite where the lens has no image.
std::vector<Eigen::Vector2d> residuals(const SkyCamera& camera, const std::vector<StarSighting>& stars);

/// d (computed x, y) / d free number, two rows a star that takes part. A star must have an image.
Eigen::MatrixXd place_jacobian(const SkyCamera& camera, const std::vector<LensNumber>& free,
                               const std::vector<StarSighting>& stars, const StarSet& used = {});

/// How many stars take part.
int count(const StarSet& used);

}  // namespace vegard::fit
