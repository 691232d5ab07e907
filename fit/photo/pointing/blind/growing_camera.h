// Grows a camera from a few recognised stars to all stars in the picture, and computes the probability that
// the agreement is by chance.
//
// The camera grows outwards from an asterism of four stars: stars of the catalogue are predicted within a
// radius, each is matched with the nearest point if it is also the point's nearest, the camera is fitted
// robustly, the radius grows and the tolerance shrinks. The centre and the lens are fitted as soon as there
// are enough stars; of several lenses the one with the smallest residuals is taken.
//
// Whether chance explains the agreement as well is asked of chance_agreement.h.
#pragma once

#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/chance_agreement.h"
#include "fit/photo/pointing/lens_form.h"

namespace vegard::fit {

struct GrownCamera {
  SkyCamera camera;
  LensForm form;
  /// The count of its stars; while it grows, the matches alone.
  ChanceAgreement agreement;
  double rms_px = 0.0;  ///< sqrt(sum (dx^2 + dy^2) / N)
};

/// Grows `start`. `stars`: in any axes, the brightest first. `seed`: the stars recognised so far; `reach_px`:
/// radius around their middle within which they constrain the camera. `trials`: number of cameras tried
/// before; `pixels`: where the picture shows sky. Of a narrow field, by which lenses and the place of the
/// centre cannot be told apart, only pinholes are fitted, the centre held.
GrownCamera grow_camera(const SkyCamera& start, const Frame& frame, const std::vector<StarSighting>& stars,
                        const std::vector<FoundStar>& points, const PointCells& cells,
                        const std::vector<StarMatch>& seed, double reach_px, double trials,
                        const SkyPixels& pixels = {}, bool is_narrow = false);

/// True if the recognition is certain: is_no_chance() of its count.
bool is_certain(const GrownCamera& grown);

}  // namespace vegard::fit
