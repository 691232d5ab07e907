// The lenses that a search among unknown cameras assumes: pinholes, stereographic, equidistant and equisolid
// ones of 20 to 230 degrees across the picture's longer side.
#pragma once

#include <vector>

#include "fit/photo/pointing/chance_agreement.h"
#include "fit/photo/pointing/sky_camera.h"

namespace vegard::fit {

struct AssumedLens {
  sim::LensModel model;
  double half_width_deg;  ///< the angle off the axis at half of the longer side
};

/// Returns the lenses, in steps that change an asterism's code by less than the tolerance of the search.
const std::vector<AssumedLens>& assumed_lenses();

/// Returns the camera with this lens and its centre there; its rotation is the identity.
SkyCamera assumed_camera(const AssumedLens& lens, bool mirrored, const Frame& frame, double centre_x_px,
                         double centre_y_px);

/// A camera that a few stars suggest.
struct CameraHit {
  double score = 0.0;  ///< natural logarithm of the odds that it is right
  SkyCamera camera;
  std::vector<StarMatch> seed;
  double reach_px = 0.0;  ///< around the seed's middle

  /// Takes into the score that a star has no point of light at its place, or has one within the tolerance where
  /// `density` points to a square pixel lie by chance. Of stars as bright as those that suggest the camera six in
  /// ten are expected to be seen, of fainter ones three.
  void count_missing(bool is_bright);
  void count_seen(bool is_bright, double density, double tolerance_px);
};

}  // namespace vegard::fit
