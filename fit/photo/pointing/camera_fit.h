// Fits a camera's numbers to stars by least squares (Ceres, with exact derivatives).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/photo/pointing/sky_camera.h"

namespace vegard::fit {

/// Flags of the stars that take part, one per star; empty: all.
using StarSet = std::vector<char>;

struct CameraFit {
  SkyCamera camera;
  bool good = false;            ///< true if the descent converged and every star that takes part has an image
  double sum_of_squares = 0.0;  ///< sum of those stars' squared residuals, in px^2
};

/// Fits the free numbers, from those of `start`. `cauchy_px`: scale of Cauchy's loss; 0: plain least squares.
CameraFit fit_camera(const SkyCamera& start, const std::vector<LensNumber>& free,
                     const std::vector<StarSighting>& stars, const StarSet& used = {},
                     double cauchy_px = 0.0);

/// Returns the residual (dx, dy) of every star, observed minus computed, in px; infinite if the lens has no
/// image of it.
std::vector<Eigen::Vector2d> residuals(const SkyCamera& camera, const std::vector<StarSighting>& stars);

/// Returns d (computed x, y) / d free number, with two rows for each star that takes part, each of which must
/// have an image.
Eigen::MatrixXd place_jacobian(const SkyCamera& camera, const std::vector<LensNumber>& free,
                               const std::vector<StarSighting>& stars, const StarSet& used = {});

/// Returns the number of stars that take part.
int count(const StarSet& used);

}  // namespace vegard::fit
