// Which way round a map of directions belongs to a picture: of the four ways, the one by which the
// catalogue's stars stand where the picture has points of light.
#pragma once

#include <optional>
#include <vector>

#include "fit/photo/pointing/star_finder.h"
#include "fit/photo/pointing/star_sighting.h"
#include "fit/photo/sky_map_file.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

struct MapFlip {
  SkyMapFlip flip;
  int stars = 0;   ///< number of stars with a point of light within two pixels by it
  int others = 0;  ///< the largest such number by one of the other ways
};

/// Returns the flip; none unless so many more stars than by any other way are by chance less than once in a
/// million. `points`: in the pixels of the map; `sky`: the stars that should be seen.
std::optional<MapFlip> flip_by_stars(const sim::DirectionMap& map, const std::vector<FoundStar>& points,
                                     const std::vector<StarSighting>& sky);

/// Returns "as stored", "rows", "columns" or "both".
const char* words_of(const SkyMapFlip& flip);

}  // namespace vegard::fit
