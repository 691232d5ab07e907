// The curtains of a map as the files of maps: GeoJSON (RFC 7946) and KML (OGC 12-007r2).
//
// A curtain is a line through its feet, at 110 km altitude, with the numbers of curtains.csv at each of its
// points, null where unknown. The map's Earth is a sphere, so that a latitude may be off by 0.2 degrees from
// one on the ellipsoid far from the site; at the site both are the same.
#pragma once

#include <string>
#include <vector>

#include "fit/map/curtains/curtains.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Return the file's text, for the scene of the map; the same curtains give the same bytes. A flux that is
/// not absolute is called relative. Points beyond the sphere's edge are left out.
std::string curtains_geojson(const sim::Scene& scene, bool flux_is_absolute,
                             const std::vector<Curtain>& curtains);
std::string curtains_kml(const sim::Scene& scene, const std::vector<Curtain>& curtains);

}  // namespace vegard::fit
