// Pictures of skies as the field has them: stars of the catalogue and fainter ones behind clouds and trees,
// twilight, lamps, planets and hot pixels; or all of that without any star.
#pragma once

#include <cstdint>

#include "fit/photo/pointing/sky_camera.h"
#include "sim/base/image.h"
#include "sim/view/sky/star_place.h"

namespace vegard::tests {

struct MadeStars {
  sim::Image picture;
  fit::Frame frame;
  fit::SkyCamera truth;  ///< in the observer's sky
  sim::Observer observer;
  double julian_date = 0.0;
  double fov_deg = 0.0;  ///< across the longer side
  int findable = 0;  ///< stars of the catalogue that stand out of the noise six times, not behind anything
  int nameless = 0;  ///< the same of stars that are fainter than the catalogue's
};

/// A uniform number from 0 to 1 for a use of its own.
double drawn(std::uint64_t seed, std::uint32_t number, std::uint32_t use, std::uint32_t i = 0);

/// The sky of this number, 720 x 480 px. Fields from `narrowest_deg` to 180 degrees, evenly in the logarithm:
/// pinholes to 100 degrees, equidistant, equisolid and stereographic lenses; half of the cameras look 10 to
/// 70 degrees high and are level to 4 degrees, those above 110 degrees look to the zenith to 6 degrees, a
/// fifth is mirrored. Wanted are 5 to 200 stars, evenly in the logarithm: the noise is such that the last of
/// them stands out six times. Where the catalogue has fewer, fainter ones are strewn as densely as the sky
/// has them: three times as many to each magnitude. Of three skies one has clouds over up to 70 % of it, one
/// a twilight that brightens thirtyfold to one side; below the horizon is dark ground, with trees of speckles
/// up to 8 degrees in every second; up to four lamps, two planets, forty hot pixels. Without stars all of
/// that remains.
MadeStars made_stars(std::uint64_t seed, std::uint32_t number, bool with_stars, double narrowest_deg = 5.0);

/// Whether a camera of the observer's sky sees the catalogue's stars where the true one does, to 6 px (rms,
/// one that is farther off than 20 px counted as 20).
bool is_right(const MadeStars& sky, const fit::SkyCamera& found);

}  // namespace vegard::tests
